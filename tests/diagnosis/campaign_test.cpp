#include "diagnosis/campaign/campaign.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/campaign/campaign_files.h"
#include "diagnosis/campaign/test_information.h"
#include "diagnosis/comparison/model_comparison.h"
#include "scenarios/run/run_spec.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// A campaign on a rig with a few effects, quick to plan.
PlannedCampaign plan(const std::string& rig, double hours, const std::vector<std::string>& only) {
  CampaignInput input;
  input.rig = rig;
  input.hours = hours;
  input.only = only;
  return diagnosis::plan_campaign(input);
}

const EffectVisibility& find_effect(const PlannedCampaign& campaign, const std::string& name) {
  return *std::find_if(campaign.effects.begin(), campaign.effects.end(),
                       [&](const EffectVisibility& one) { return one.effect == name; });
}

bool has_test(const PlannedCampaign& campaign, const std::string& id) {
  return std::any_of(campaign.ledger.begin(), campaign.ledger.end(),
                     [&](const CampaignTest& test) { return test.id == id; });
}

const std::vector<std::string> kFew{"torque_gain", "torque_zero_drift", "slow_leak", "rim_heat", "bearing_warmup"};

}  // namespace

TEST_CASE("a campaign keeps to its hours, and more hours show no less", "[slow]") {
  std::size_t visible = 0;
  double shares = 0.0;
  for (const double hours : {1.5, 4.0, 12.0}) {
    const PlannedCampaign campaign = plan("drum", hours, kFew);
    INFO(hours);
    CHECK(campaign.hours <= hours);
    double sum_h = 0.0;
    std::set<std::string> ids;
    for (std::size_t i = 0; i < campaign.ledger.size(); ++i) {
      sum_h += campaign.tests[i].hours;
      CHECK(campaign.ledger[i].hours_until_end == Approx(sum_h));
      CHECK(campaign.ledger[i].hours == campaign.tests[i].hours);
      CHECK(ids.insert(campaign.ledger[i].id).second);  // each once
    }
    CHECK(campaign.hours == Approx(sum_h));
    CHECK(campaign.effects.size() == kFew.size());
    CHECK(count_visible(campaign) == campaign.ledger.back().visible);
    CHECK(count_visible(campaign) >= visible);
    visible = count_visible(campaign);
    double now = 0.0;
    for (const EffectVisibility& one : campaign.effects) now += one.share_percent;
    CHECK(now > shares);
    shares = now;
  }
  CHECK(visible == kFew.size());
}

TEST_CASE("weights make the scale of the force visible, on rollers too", "[fast]") {
  for (const char* rig : {"drum", "dyno"}) {
    INFO(rig);
    const PlannedCampaign campaign = plan(rig, 2.0, {"torque_gain"});
    CHECK(find_effect(campaign, "torque_gain").is_visible);
    if (rig == std::string("dyno")) CHECK(has_test(campaign, "dead_weights"));
  }
  const PlannedCampaign loads = plan("dyno", 2.0, {"load_record", "tie_down_load", "speed_record"});
  CHECK(has_test(loads, "wheel_scale"));
  CHECK(find_effect(loads, "load_record").is_visible);
}

TEST_CASE("the smallest visible size has a detectability of 5 when it is simulated", "[fast]") {
  const PlannedCampaign campaign = plan("drum", 3.0, {"slow_leak", "torque_gain"});
  for (const EffectVisibility& one : campaign.effects) {
    INFO(one.effect);
    REQUIRE(one.smallest.has_value());
    CHECK(std::abs(*one.smallest) == Approx(std::abs(one.usual) * 5.0 / one.detectability));
    CHECK(one.is_visible == (std::abs(*one.smallest) <= std::abs(one.usual)));
    CHECK(one.is_visible == (one.share_percent >= 50.0));
  }
}

TEST_CASE("what a campaign promises is what the screening of its measured set finds", "[slow]") {
  const PlannedCampaign campaign = plan("drum", 6.0, kFew);
  measurements::MeasurementSet set = campaign.set;
  set.runs.clear();
  const tests::TemporaryFolder folder;
  for (const auto& [name, content] : write_campaign(campaign)) tests::write_file(folder.file(name), content);
  std::size_t number = 0;
  for (std::size_t t = 0; t < campaign.tests.size(); ++t) {
    for (std::size_t r = 0; r < campaign.tests[t].runs.size(); ++r) {
      const std::string file = folder.file("run-" + std::to_string(++number) + ".toml");
      const scenarios::RunSpec spec = scenarios::read_run_spec(read_config(file), folder.path());
      const tests::TemporaryFolder written;
      for (const auto& [name, content] :
           scenarios::write_measurement_set(spec, scenarios::run_scenario(spec, {}), "paper")) {
        tests::write_file(written.file(name), content);
      }
      const measurements::MeasurementSet rehearsed = measurements::read_measurement_set(written.path());
      measurements::MeasuredRun run = rehearsed.runs.front();
      // Not logged: what a plan does not read, and the torque beside weights that the simulation does not hang.
      if (campaign.tests[t].id == "dead_weights") continue;
      run.id = campaign.tests[t].runs[r].id;
      run.session = campaign.tests[t].id + campaign.tests[t].runs[r].session;
      run.force_at_standstill = campaign.tests[t].extra.force_at_standstill;
      set.runs.push_back(run);
    }
  }
  StudySettings settings;
  for (const std::string& id : kFew) settings.terms.push_back(&find_term(id));
  Study study(set, settings);
  const Comparison comparison = compare_models(study);
  for (const char* id : {"slow_leak", "bearing_warmup", "rim_heat"}) {
    INFO(id);
    const double promised = find_effect(campaign, id).detectability;
    const double found = comparison.find_detectability(find_term(id));
    CHECK(found > 0.7 * promised);  // the half hour in which a plan warms the tire is logged here
  }
}

TEST_CASE("a campaign's files are run files, a set to fill and a plan", "[slow]") {
  for (const char* rig : {"drum", "dyno", "road"}) {
    INFO(rig);
    const PlannedCampaign campaign = plan(rig, 5.0, {"torque_gain", "load_exponent", "inertia_error"});
    const tests::TemporaryFolder folder;
    const auto files = write_campaign(campaign);
    for (const auto& [name, content] : files) tests::write_file(folder.file(name), content);
    std::size_t number = 0;
    for (const PlannedTest& test : campaign.tests) {
      for (const measurements::MeasuredRun& run : test.runs) {
        const std::string file = "run-" + std::to_string(++number) + ".toml";
        const scenarios::RunSpec spec = scenarios::read_run_spec(read_config(folder.file(file)), folder.path());
        CHECK_NOTHROW(scenarios::prepare_run(spec));
        CHECK_THAT(files.at("plan.txt"), Catch::Contains(file));
        CHECK_THAT(files.at("set.toml"), Catch::Contains("id = \"" + run.id + "\""));
        // What is measured goes beside it under the name that the set has for it.
        tests::write_file(folder.file(run.id + "_measured.csv"), files.at(run.id + ".csv"));
      }
    }
    const measurements::MeasurementSet set = measurements::read_measurement_set(folder.path());
    CHECK(set.runs.size() == number);
    CHECK(set.kind == campaign.set.kind);
    std::set<std::string> sessions;
    for (const measurements::MeasuredRun& run : set.runs) sessions.insert(run.session);
    CHECK(sessions.size() >= campaign.tests.size());  // sensors are zeroed before each test
  }
}

TEST_CASE("information of tests adds up and never takes visibility away", "[fast]") {
  const PlannedCampaign campaign = plan("drum", 4.0, kFew);
  REQUIRE(campaign.tests.size() >= 2);
  const Study study(campaign.set);
  std::vector<JudgedSize> sizes;
  for (const std::string& id : kFew) {
    for (const JudgedSize& size : list_judged_sizes(find_term(id))) sizes.push_back(size);
  }
  const auto first = predict_information(study, sizes, campaign.tests[0]);
  const auto second = predict_information(study, sizes, campaign.tests[1]);
  REQUIRE(first.has_value());
  REQUIRE(second.has_value());
  TestInformation both = *first;
  both += *second;
  const Eigen::VectorXd alone = first->calc_detectability();
  const Eigen::VectorXd other = second->calc_detectability();
  const Eigen::VectorXd together = both.calc_detectability();
  for (Eigen::Index i = 0; i < together.size(); ++i) {
    CHECK(together[i] >= std::max(alone[i], other[i]) - 1e-9);
  }
  CHECK(make_no_information(study, sizes).calc_detectability().norm() == 0.0);
}

TEST_CASE("machines, hours and effects of a campaign are checked", "[fast]") {
  CHECK_THROWS_WITH(plan("drumm", 8.0, {}), Catch::Contains("drum"));
  CHECK_THROWS_WITH(plan("drum_3m", 8.0, {}), Catch::Contains("drum_2m"));
  CHECK_THROWS_WITH(plan("drum", 0.0, {}), Catch::Contains("--hours"));
  CHECK_THROWS_WITH(plan("drum", std::nan(""), {}), Catch::Contains("--hours"));
  CHECK_THROWS_WITH(plan("drum", 0.6, {"slow_leak"}), Catch::Contains("no test"));
  CHECK_THROWS_WITH(plan("drum", 8.0, {"slow_leek"}), Catch::Contains("slow_leak"));
  CHECK_THROWS_AS(plan("drum", 8.0, {"wind_and_grade"}), InputError);  // acts on the road
  CHECK(plan("drum_1m7", 2.0, {"torque_gain"}).set.rig->name == "drum_1m7");
}
