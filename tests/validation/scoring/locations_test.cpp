// Whether an answer says where the gap lies, counted by hand.
#include "validation/scoring/locations.h"

#include <catch2/catch.hpp>

#include "sim/core/error.h"
#include "tests/validation/scoring/hand_made_cases.h"
#include "tests/validation/scoring/hand_made_places.h"
#include "validation/scoring/report.h"

using namespace rollrig;
using namespace rollrig::tests;
using validation::Case;
using validation::LocationCheck;

namespace {

void check_parts(const diagnosis::Location& named, bool channel, bool run, bool phase) {
  INFO(named.channel << " " << named.run << " " << named.phase);
  const LocationCheck check = validation::check_largest(named, make_places());
  CHECK(check.channel == channel);
  CHECK(check.run == run);
  CHECK(check.phase == phase);
  CHECK(check.is_right() == (channel && run && phase));
}

const validation::Figure& find_scored(const std::vector<validation::Figure>& figures, const std::string& id) {
  for (const validation::Figure& figure : figures) {
    if (figure.id == id) return figure;
  }
  FAIL("no figure " << id);
  return figures.front();
}

}  // namespace

TEST_CASE("channel, run and phase are right that hold 80 % of the largest change", "[fast]") {
  // roots of sums of squares: torque 11.2, liner 9.9, pressure 5.2; torque in run_1 8.9, in run_2 6.7
  check_parts(name_place(kTorque, "run_1", "begin", 1.0), true, true, true);
  check_parts(name_place(kTorque, "run_1", "rest", 1.0), true, true, false);   // 4 of 8
  check_parts(name_place(kTorque, "run_2", "begin", 1.0), true, false, true);  // 75 % of run_1
  check_parts(name_place(kTorque, "run_2", "rest", 1.0), true, false, true);   // 4.5 of 5
  check_parts(name_place(kLiner, "run_1", "begin", 1.0), true, true, true);    // 88 % of torque
  check_parts(name_place(kLiner, "run_2", "begin", 1.0), true, false, true);
  check_parts(name_place(kPressure, "run_2", "rest", 1.0), false, true, true);
}

TEST_CASE("where nothing changes, every location is wrong", "[fast]") {
  auto places = make_places();
  for (validation::TruePlace& place : places) place.of_effects = place.after_retuning = {};
  const diagnosis::Location named = name_place(kTorque, "run_1", "begin", 1.0);
  const LocationCheck check = validation::check_largest(named, places);
  CHECK_FALSE((check.channel || check.run || check.phase));
  CHECK_FALSE(validation::is_shifted(named, places));
}

TEST_CASE("a shift is right on the same side, of at least half the stated size, after retuning or before", "[fast]") {
  // the floor is 0.5 N; 3 floors after retuning, 5 before
  const auto is_right = [](double size_N) {
    return validation::is_shifted(name_place(kTorque, "run_2", "begin", size_N), make_places(3.0, 5.0));
  };
  CHECK(is_right(0.5));
  CHECK(is_right(2.9));  // 5.8 floors
  CHECK(is_right(4.9));  // 9.8: half of it is 4.9
  CHECK_FALSE(is_right(5.1));
  CHECK_FALSE(is_right(-0.5));
}

TEST_CASE("a location that is no place of the case is refused", "[fast]") {
  diagnosis::Location named = name_place(kTorque, "run_1", "begin", 1.0);
  named.end_s += 10.0;
  CHECK_THROWS_AS(validation::check_largest(named, make_places()), InputError);
  CHECK_THROWS_AS(validation::is_shifted(name_place(kTorque, "run_3", "begin", 1.0), make_places()), InputError);
}

TEST_CASE("places are read as they were written", "[fast]") {
  const auto places = make_places(3.0, 5.0);
  const auto read = validation::read_places(Json::parse(validation::make_places_json(places).dump()));
  REQUIRE(read.size() == places.size());
  CHECK(validation::make_places_json(read) == validation::make_places_json(places));
  CHECK(read[1].stretch.phase == places[1].stretch.phase);
  CHECK(read[1].after_retuning.rms == places[1].after_retuning.rms);
  CHECK_THROWS_AS(validation::read_places(Json::parse(R"([{"channel": 1}])")), Json::exception);
}

TEST_CASE("locations count by kind, the first of each answer and all of them", "[fast]") {
  Case right = say_cause(make_case("0001", {"rim_heat"}), {"rim_heat"}, 0.95);
  right.truth.kind = "drum";
  right.places = make_places(3.0, 5.0);
  right.answer.diagnosis.where = {name_place(kTorque, "run_1", "begin", 1.0),
                                  name_place(kTorque, "run_2", "rest", -1.0)};
  Case wrong = right;
  wrong.truth.kind = "road";
  wrong.answer.diagnosis.where = {name_place(kPressure, "run_2", "rest", 1.0)};
  Case silent = right;
  silent.answer.diagnosis.where.clear();
  Case unknown = right;  // where its effects act was not computed
  unknown.places.clear();
  const validation::Score score = validation::score_cases({right, wrong, silent, unknown}, {});
  const auto check = [&](const char* id, std::size_t k, std::size_t n) {
    INFO(id);
    CHECK(find_scored(score.figures, id).k == k);
    CHECK(find_scored(score.figures, id).n == n);
    CHECK(find_scored(score.figures, id).target == 0.9);
  };
  check("location", 1, 2);
  check("location_channel", 1, 2);
  check("location_run", 2, 2);
  check("location_phase", 2, 2);
  check("locations_named", 2, 3);
  CHECK(score.locations.at("drum").answers == 1);
  CHECK(score.locations.at("drum").all_three == 1);
  CHECK(score.locations.at("road").all_three == 0);
  CHECK(score.locations.at("all").named == 3);
  const Json json = validation::make_score_json(score).at("locations");
  CHECK(json.at("road").at("channel").at("k") == 0);
  CHECK(json.at("all").at("named").at("n") == 3);
  CHECK(json.at("all").at("named").at("low_95") == validation::calc_wilson_95(2, 3).low);
  CHECK_THAT(validation::format_score_markdown(score), Catch::Contains("### Locations"));
  const auto none = validation::find_figures({unknown}, {});
  CHECK_THAT(find_scored(none, "location").note, Catch::Contains("rollrig_validation locations"));
}
