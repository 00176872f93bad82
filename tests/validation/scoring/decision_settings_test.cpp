// What a release is checked against: each change is told by name, and a new effect is none.
#include "validation/scoring/decision_settings.h"

#include <catch2/catch.hpp>

#include "diagnosis/thresholds.h"
#include "models/effect.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using namespace rollrig;
using namespace rollrig::tests;
using validation::compare_settings;

namespace {

const Json& now() {
  static const Json settings = validation::list_decision_settings();
  return settings;
}

}  // namespace

TEST_CASE("the settings hold every threshold and every effect, and do not differ from themselves", "[fast]") {
  const Json& thresholds = now().at("thresholds");
  CHECK(thresholds.at("kToldApart_nats") == diagnosis::thresholds::kToldApart_nats);
  CHECK(thresholds.at("kSecondsOfTriples") == diagnosis::thresholds::kSecondsOfTriples);
  CHECK(thresholds.at("ComparisonPriors look_alike") == diagnosis::ComparisonPriors{}.look_alike);
  CHECK(thresholds.at("kDiscrepancyScales_s").size() == std::size(diagnosis::thresholds::kDiscrepancyScales_s));
  CHECK(now().at("effects").size() == models::all_effects().size());
  for (const models::Effect* effect : models::all_effects()) {
    CHECK(now().at("effects").at(effect->info.id).at("parameters").size() == effect->info.parameters.size());
  }
  const auto same = compare_settings(Json::parse(now().dump()), now());
  CHECK(same.changes.empty());
  CHECK(same.new_effects.empty());
}

TEST_CASE("a new effect is listed and no change, and an effect that is gone is one", "[fast]") {
  Json before = now();
  before["effects"].erase("windage");
  const auto added = compare_settings(before, now());
  CHECK(added.new_effects == std::vector<std::string>{"windage"});
  CHECK(added.changes.empty());
  const auto gone = compare_settings(now(), before);
  CHECK(gone.new_effects.empty());
  REQUIRE_FALSE(gone.changes.empty());
  CHECK_THAT(gone.changes.front(), Contains("effects windage") && Contains("is gone"));
}

TEST_CASE("a changed threshold, prior or range is told by name, with what it was and is", "[fast]") {
  Json changed = now();
  changed["thresholds"]["kTail_sd"] = 4.5;
  CHECK(compare_settings(now(), changed).changes.front() == "thresholds kTail_sd was 3.0, and is 4.5");
  changed = now();
  changed["effects"]["slow_leak"]["parameters"].front()["high"] = 99.0;
  const auto widened = compare_settings(now(), changed).changes;
  REQUIRE(widened.size() == 1);
  CHECK_THAT(widened.front(), Contains("effects slow_leak parameters") && Contains("is 99.0"));
  changed = now();
  changed["effects"]["slow_leak"]["parameters"]["new_shape"] = {{"low", 0.1}};
  CHECK_THAT(compare_settings(now(), changed).changes.front(),
             Contains("slow_leak parameters new_shape") && Contains("is new"));
}

TEST_CASE("the release check compares with a record, ends with 1 where a new validation set is needed", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_validation("release-check now.json --write", folder.path()).status == 0);
  const auto same = run_validation("release-check now.json", folder.path());
  CHECK(same.status == 0);
  CHECK_THAT(same.out, Contains("No new validation set is needed"));
  Json other = Json::parse(read_file(folder.file("now.json")));
  other["thresholds"]["kTail_sd"] = 2.5;
  other["effects"].erase("rim_heat");
  write_file(folder.file("other.json"), other.dump());
  const auto differs = run_validation("release-check other.json", folder.path());
  CHECK(differs.status == 1);
  CHECK_THAT(differs.out, Contains("kTail_sd was 2.5, and is 3.0") && Contains("rim_heat is new") &&
                              Contains("A new validation set is needed"));
  write_file(folder.file("none.json"), "{}");
  CHECK(run_validation("release-check none.json", folder.path()).status == 2);
}
