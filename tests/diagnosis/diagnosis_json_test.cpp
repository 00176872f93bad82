// The JSON of a diagnosis: the keys of the contract, and null where it says so.
#include "diagnosis/output/diagnosis_json.h"

#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "sim/core/error.h"
#include "tests/diagnosis/hand_made.h"

using namespace rollrig;

namespace {

std::set<std::string> keys_of(const Json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

bool holds(const Json& object, const std::set<std::string>& wanted) {
  const std::set<std::string> keys = keys_of(object);
  return std::includes(keys.begin(), keys.end(), wanted.begin(), wanted.end());
}

}  // namespace

TEST_CASE("a diagnosis that is read from its document has what it had", "[fast]") {
  const Findings before = tests::make_explained();
  const Json document = diagnosis::make_diagnosis_json(before);
  const Json again = diagnosis::make_diagnosis_json(diagnosis::read_diagnosis_json(document));
  for (const char* key : {"set", "verdict", "probability", "nothing_detectable", "where", "warnings", "trace"}) {
    INFO(key);
    CHECK(again[key] == document[key]);
  }
  for (const char* key : {"as_calibrated", "recalibrated", "shrink_percent"})
    CHECK(again["gap"][key] == document["gap"][key]);
  for (const char* key : {"effects", "probability", "indistinguishable_from", "parameters", "acts", "alone", "complete",
                          "adequate", "objections"}) {
    INFO(key);
    REQUIRE(again["causes"].size() == document["causes"].size());
    CHECK(again["causes"][0][key] == document["causes"][0][key]);
  }
  Json damaged = document;
  damaged["verdict"] = "perhaps";
  CHECK_THROWS_AS(diagnosis::read_diagnosis_json(damaged), InputError);
  damaged.erase("verdict");
  CHECK_THROWS_AS(diagnosis::read_diagnosis_json(damaged), Json::exception);
}

TEST_CASE("every key of the contract is there, with its meaning", "[fast]") {
  const Json json = diagnosis::make_diagnosis_json(tests::make_explained());
  CHECK(holds(json, {"format", "set", "verdict", "probability", "causes", "gap", "where", "balance", "next_test",
                     "not_excluded"}));
  CHECK(json["format"] == "rollrig-diagnosis/1");
  CHECK(json["set"] == "a50-drum-campaign");
  CHECK(json["verdict"] == "explained");
  CHECK(json["probability"]["bearing_warmup"] == 0.94);
  CHECK(json["probability"]["none"] == 0.01);
  CHECK(json["probability"]["unknown"] == 0.03);
  const Json& cause = json["causes"][0];
  CHECK(holds(cause, {"effects", "probability", "indistinguishable_from", "parameters", "adequate"}));
  CHECK(cause["effects"] == Json::array({"bearing_warmup"}));
  CHECK(cause["indistinguishable_from"].is_array());
  CHECK(cause["adequate"] == true);
  CHECK(holds(cause["parameters"][0], {"name", "value", "sd", "unit"}));
  CHECK(cause["parameters"][0]["name"] == "bearing_warmup.fall_per_K");
  CHECK(cause["parameters"][0]["unit"] == "1/K");
  const Json& gap = json["gap"];
  CHECK(holds(gap, {"as_calibrated", "recalibrated", "shrink_percent", "shrink_ci95_percent", "held_out", "unit"}));
  CHECK(gap["as_calibrated"]["before"] == 6.1);
  CHECK(gap["recalibrated"]["after"] == 0.2);
  CHECK(gap["shrink_percent"] == 91.0);
  CHECK(gap["shrink_ci95_percent"] == Json::array({84.0, 96.0}));
  CHECK(gap["held_out"].size() == 3);
  CHECK(gap["unit"] == "noise floors");
  CHECK(holds(json["where"][0], {"channel", "run", "phase", "share_percent", "size", "unit", "z"}));
  CHECK(json["where"].size() == 2);
  CHECK(holds(json["balance"][0], {"name", "share_percent"}));
  CHECK(holds(json["next_test"][0], {"test", "splits", "expected_bits_per_hour"}));
  CHECK(json["not_excluded"] == Json::array({"windage", "torque_gain"}));
}

TEST_CASE("limits of ranges and moves of the files' numbers are there, all of them", "[fast]") {
  diagnosis::Diagnosis made = tests::make_explained();
  made.causes[0].parameters[0].on_limit = RangeLimit::kLower;
  made.base_numbers = {{"thermal.H_gas_W_per_K", "W/K", 4.0, 0.6, SdSource::kUsual, 5.2, 2.0, 4.3, 0.5},
                       {"parasitic.c0_N", "N", 6.0, 0.3, SdSource::kFile, 6.3, 1.0}};
  const Json json = diagnosis::make_diagnosis_json(made);
  CHECK(json["causes"][0]["parameters"][0]["on_limit"] == "lower");
  CHECK(json["causes"][0]["parameters"][1]["on_limit"].is_null());
  REQUIRE(json["base_numbers"].size() == 2);
  const Json& first = json["base_numbers"][0];
  CHECK(first["name"] == "thermal.H_gas_W_per_K");
  CHECK(first["sd_source"] == "usual");
  CHECK(first["recalibrated"] == 5.2);
  CHECK(first["moved_sd"] == 2.0);
  CHECK(first["with_cause_moved_sd"] == 0.5);
  CHECK(json["base_numbers"][1]["sd_source"] == "file");
  CHECK(json["base_numbers"][1]["with_cause"].is_null());
  CHECK(json["gap"]["judged_on"] == json["gap"]["held_out"]);
}

TEST_CASE("the ways of judging a shrinkage stand side by side, with the runs that cannot be judged", "[fast]") {
  diagnosis::Diagnosis made = tests::make_explained();
  made.gap.not_judged = {{"load-sweep", {"load"}}};
  made.gap.stretches->energy_percent.reset();
  const Json gap = diagnosis::make_diagnosis_json(made)["gap"];
  CHECK(gap["judged_by"] == "runs_left_out");
  CHECK(gap["runs_left_out"]["percent"] == gap["shrink_percent"]);
  CHECK(gap["runs_left_out"]["energy_percent"]["before"] == 2.1);
  CHECK(gap["runs_left_out"]["energy_percent"]["after"] == 0.14);
  CHECK(gap["stretches_left_out"]["ci95_percent"] == Json::array({88.0, 97.0}));
  CHECK(gap["stretches_left_out"]["energy_percent"].is_null());
  CHECK(gap["fitted"]["before"] == 2.0);
  CHECK(gap["not_judged"] == Json::array({{{"run", "load-sweep"}, {"alone_in", {"load"}}}}));
  made.gap.runs.reset();
  made.gap.fitted->percent.reset();
  made.gap.judged_by = diagnosis::JudgedBy::kStretches;
  const Json other = diagnosis::make_diagnosis_json(made)["gap"];
  CHECK(other["judged_by"] == "stretches_left_out");
  CHECK(other["runs_left_out"].is_null());
  CHECK(other["fitted"]["ci95_percent"].is_null());
}

TEST_CASE("a trace has what a cause has, and what it changes", "[fast]") {
  diagnosis::Diagnosis made = tests::make_no_gap();
  CHECK(diagnosis::make_diagnosis_json(made)["trace"].is_null());
  made.trace = tests::make_trace();
  const Json trace = diagnosis::make_diagnosis_json(made)["trace"];
  CHECK(trace["effects"] == Json::array({"torque_gain"}));
  CHECK(trace["probability"] == 0.92);
  CHECK(trace["change"]["floors"] == 0.12);
  CHECK(trace["change"]["energy_percent"] == 0.07);
  CHECK(diagnosis::make_diagnosis_json(tests::make_explained())["causes"][0]["change"].is_null());
}

TEST_CASE("a probability that is no number is a failure, not null", "[fast]") {
  diagnosis::Diagnosis made = tests::make_explained();
  CHECK_NOTHROW(to_text(diagnosis::make_diagnosis_json(made)));
  made.causes.front().complete = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(to_text(diagnosis::make_diagnosis_json(made)), RunFailure);
  made = tests::make_explained();
  made.probability["none"] = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(to_text(diagnosis::make_diagnosis_json(made)), RunFailure);
}

TEST_CASE("without a gap there is no shrinkage, and lists are empty, not absent", "[fast]") {
  const Json json = diagnosis::make_diagnosis_json(tests::make_no_gap());
  CHECK(json["verdict"] == "no_gap");
  CHECK(json["gap"]["shrink_percent"].is_null());
  CHECK(json["gap"]["shrink_ci95_percent"].is_null());
  CHECK(json["gap"]["recalibration_percent"].is_null());
  for (const char* key : {"causes", "where", "balance", "next_test", "next_sensor", "not_excluded", "warnings"}) {
    INFO(key);
    CHECK(json[key] == Json::array());
  }
}

TEST_CASE("the words of the verdict are those of the contract", "[fast]") {
  CHECK(std::string(diagnosis::name_of(diagnosis::Verdict::kNoGap)) == "no_gap");
  CHECK(std::string(diagnosis::name_of(diagnosis::Verdict::kExplained)) == "explained");
  CHECK(std::string(diagnosis::name_of(diagnosis::Verdict::kUnexplained)) == "unexplained");
}

TEST_CASE("a number that is not finite is null, and the text is JSON all the same", "[fast]") {
  diagnosis::Diagnosis made = tests::make_explained();
  made.causes[0].parameters[0].sd = std::numeric_limits<double>::infinity();
  made.where[0].z = std::numeric_limits<double>::quiet_NaN();
  const Json json = Json::parse(diagnosis::make_diagnosis_json(made).dump());
  CHECK(json["causes"][0]["parameters"][0]["sd"].is_null());
  CHECK(json["where"][0]["z"].is_null());
}

TEST_CASE("the JSON says what an unknown effect is like, how far a cause is confirmed, and that nothing can be seen",
          "[fast]") {
  diagnosis::Diagnosis made = tests::make_explained();
  Json json = make_diagnosis_json(made);
  CHECK(json["unknown_like"].is_null());
  CHECK(json["nothing_detectable"].is_null());
  CHECK(json["gap"]["left_out_nats"].is_null());
  made.unknown_like = diagnosis::Likeness{"a force", 0.9, {"slip_loss"}};
  made.nothing_detectable = 0.97;
  made.gap.left_out_nats = 4.5;
  json = make_diagnosis_json(made);
  CHECK(json["unknown_like"]["text"] == "a force");
  CHECK(json["unknown_like"]["probability"] == 0.9);
  CHECK(json["unknown_like"]["beside"] == Json::array({"slip_loss"}));
  CHECK(json["nothing_detectable"] == 0.97);
  CHECK(json["gap"]["left_out_nats"] == 4.5);
}
