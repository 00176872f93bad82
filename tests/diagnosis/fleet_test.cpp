// Which effects come back from set to set, and with what.
#include "diagnosis/output/fleet.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "sim/core/text.h"
#include "tests/diagnosis/hand_made.h"

using namespace rollrig;
using diagnosis::calc_recurrence_probability;
using diagnosis::find_recurrences;
using diagnosis::FleetMember;
using diagnosis::Recurrence;
using diagnosis::Shared;

namespace {

constexpr double kPrior = 0.02;

/// A set that names warming bearings, with their fall and its standard deviation.
FleetMember warms(const std::string& machine, const std::string& tire, double fall = 0.02, double sd = 0.002) {
  FleetMember member{"sets/" + tire + "-" + machine, machine, tire, tests::make_explained(), "", std::nullopt};
  member.findings->probability["bearing_warmup"] = 0.98;
  member.findings->causes.front().parameters.front().value = fall;
  member.findings->causes.front().parameters.front().sd = sd;
  return member;
}

FleetMember is_clean(const std::string& machine, const std::string& tire) {
  FleetMember member{"sets/clean-" + tire + "-" + machine, machine, tire, tests::make_no_gap(), "", std::nullopt};
  member.findings->probability["bearing_warmup"] = 0.001;
  return member;
}

}  // namespace

TEST_CASE("one set cannot show that an effect comes back, each further one makes it likelier", "[fast]") {
  CHECK(calc_recurrence_probability({}, kPrior) == Approx(kPrior));
  CHECK(calc_recurrence_probability({1.0}, kPrior) < 0.51);
  const double two = calc_recurrence_probability({0.99, 0.99}, kPrior);
  const double three = calc_recurrence_probability({0.99, 0.99, 0.99}, kPrior);
  CHECK(two > 0.9);
  CHECK(three > two);
  // A set that says nothing of it leaves what is known as it is.
  CHECK(calc_recurrence_probability({0.99, 0.99, kPrior}, kPrior) == Approx(two));
  // A set in which it surely does not act is enough.
  CHECK(calc_recurrence_probability({0.99, 0.99, 0.0}, kPrior) < 0.01);
}

TEST_CASE("hints that none of the sets is sure of add up", "[fast]") {
  CHECK(calc_recurrence_probability({0.3, 0.3, 0.3, 0.3}, kPrior) > 0.9);
  CHECK(calc_recurrence_probability({0.3}, kPrior) < 0.3);
}

TEST_CASE("the order of sets does not matter", "[fast]") {
  CHECK(calc_recurrence_probability({0.9, 0.1, 0.4}, kPrior) ==
        Approx(calc_recurrence_probability({0.4, 0.9, 0.1}, kPrior)));
}

TEST_CASE("what comes back with every tire of a rig is the rig's", "[fast]") {
  const auto found = find_recurrences(
      {warms("drum-1", "a40"), warms("drum-1", "a50"), warms("drum-1", "a60"), is_clean("drum-2", "a40")});
  REQUIRE(found.size() == 1);
  CHECK(found[0].effect == "bearing_warmup");
  CHECK(found[0].shared == Shared::kMachine);
  CHECK(found[0].name == "drum-1");
  CHECK(found[0].sets == 3);
  CHECK(found[0].named_in == 3);
}

TEST_CASE("what comes back with a tire on every rig is the tire's", "[fast]") {
  const auto found = find_recurrences(
      {warms("drum-1", "a40"), warms("drum-2", "a40"), is_clean("drum-1", "a50"), is_clean("drum-2", "a50")});
  REQUIRE(found.size() == 1);
  CHECK(found[0].shared == Shared::kTire);
  CHECK(found[0].name == "a40");
}

TEST_CASE("an effect recurs in the widest group of sets, even where a smaller one is surer", "[fast]") {
  const auto hint = [](const std::string& machine, const std::string& tire) {  // hardly speaks against it
    FleetMember member = is_clean(machine, tire);
    member.findings->probability["bearing_warmup"] = 0.5 * kPrior;
    return member;
  };
  const auto of_rig = find_recurrences(
      {warms("drum-1", "a60"), warms("drum-1", "a60"), hint("drum-1", "a50"), is_clean("drum-2", "a50")});
  REQUIRE(of_rig.size() == 1);
  CHECK(of_rig[0].shared == Shared::kMachine);
  CHECK(of_rig[0].sets == 3);
  const auto of_tire = find_recurrences(
      {warms("drum-1", "a50"), warms("drum-1", "a50"), hint("drum-2", "a50"), is_clean("drum-2", "a60")});
  REQUIRE(of_tire.size() == 1);
  CHECK(of_tire[0].shared == Shared::kTire);
  CHECK(of_tire[0].sets == 3);
}

TEST_CASE("of one tire on one rig it cannot be told whose it is", "[fast]") {
  const auto found = find_recurrences({warms("drum-1", "a40"), warms("drum-1", "a40")});
  REQUIRE(found.size() == 1);
  CHECK(found[0].shared == Shared::kMachineAndTire);
}

TEST_CASE("what one set of three has does not come back", "[fast]") {
  CHECK(find_recurrences({warms("drum-1", "a40"), is_clean("drum-1", "a50"), is_clean("drum-1", "a60")}).empty());
  CHECK(find_recurrences({warms("drum-1", "a40")}).empty());
}

TEST_CASE("a set whose files are in doubt says nothing of any effect", "[fast]") {
  FleetMember in_doubt = is_clean("drum-1", "a50");
  in_doubt.findings->probability["bearing_warmup"] = 0.0;
  in_doubt.findings->doubt = "speed_km_h may hold m/s";
  const auto found = find_recurrences({warms("drum-1", "a40"), warms("drum-1", "a60"), in_doubt});
  REQUIRE(found.size() == 1);
  CHECK(found[0].sets == 2);
}

TEST_CASE("a set in which an effect cannot act says nothing of it", "[fast]") {
  FleetMember elsewhere = is_clean("drum-1", "a50");
  elsewhere.findings->probability.erase("bearing_warmup");
  CHECK(find_recurrences({warms("drum-1", "a40"), elsewhere}).empty());
  const auto found = find_recurrences({warms("drum-1", "a40"), warms("drum-1", "a60"), elsewhere});
  REQUIRE(found.size() == 1);
  CHECK(found[0].sets == 2);
}

TEST_CASE("sizes are averaged by their uncertainty, and it is said where they differ", "[fast]") {
  const auto alike = find_recurrences({warms("d", "a40", 0.020, 0.002), warms("d", "a50", 0.022, 0.002)});
  REQUIRE(alike.size() == 1);
  CHECK(*alike[0].mean_size == Approx(0.021));
  CHECK(alike[0].mean_size_sd == Approx(0.002 / std::sqrt(2.0)));
  CHECK(*alike[0].same_size_p > 0.3);
  const auto apart = find_recurrences({warms("d", "a40", 0.010, 0.001), warms("d", "a50", 0.030, 0.001)});
  REQUIRE(apart.size() == 1);
  CHECK(*apart[0].same_size_p < 1e-6);
  const auto unequal = find_recurrences({warms("d", "a40", 0.010, 0.001), warms("d", "a50", 0.020, 0.1)});
  CHECK(*unequal[0].mean_size == Approx(0.010).epsilon(0.01));
}

TEST_CASE("a fleet is a row a set in 80 columns, failures with their reason", "[fast]") {
  diagnosis::Fleet fleet;
  fleet.members = {warms("drum-1", "a40"), is_clean("drum-1", "a-tire-with-a-name-that-does-not-fit-into-its-column")};
  fleet.members.push_back(
      {"sets/broken", "drum-1", "a60", std::nullopt, "the baseline cannot be fitted to the set", std::nullopt});
  const InputProblem typo{"unknown column 'sped_km_h'",
                          "sets/typo/a.csv",
                          0,
                          "",
                          "",
                          "time_s, speed_km_h, load_N, ambient_degC, drum_torque_Nm, liner_temperature_degC",
                          ""};
  fleet.members.push_back({"sets/typo", "", "", std::nullopt, InputError(typo).what(), typo});
  fleet.members.push_back(is_clean("drum-1", "exchanged"));
  fleet.members.back().findings->doubt = "the liner temperature and the pressure may be exchanged";
  fleet.members.back().findings->warnings = {fleet.members.back().findings->doubt, "few samples"};
  fleet.recurrences = find_recurrences({warms("drum-1", "a40"), warms("drum-1", "a50")});
  std::istringstream text(diagnosis::format_fleet(fleet));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  REQUIRE(lines.size() >= 6);
  for (const std::string& line : lines) {
    INFO(line);
    CHECK(count_characters(line) <= 80);
  }
  const auto row_of = [&lines](const std::string& start) {
    const auto found =
        std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.rfind(start, 0) == 0; });
    return found == lines.end() ? "" : *found;
  };
  CHECK_THAT(row_of("a40-drum-1 "), Catch::Contains("explained") && Catch::Contains("bearing_warmup"));
  CHECK_THAT(row_of("clean-a-tire-with-"), Catch::Contains("no_gap"));
  CHECK_THAT(row_of("broken"), Catch::Contains("failed"));
  CHECK_THAT(row_of("clean-exchanged"), Catch::Contains("in doubt") && !Catch::Contains("no_gap"));
  const std::string whole = diagnosis::format_fleet(fleet);
  CHECK_THAT(whole, Catch::Contains("broken: the baseline cannot be fitted"));
  CHECK_THAT(whole, Catch::Contains("typo: unknown column 'sped_km_h'\n  where    sets/typo/a.csv\n"));
  CHECK_THAT(whole, Catch::Contains("clean-exchanged-drum-1: the liner temperature and the pressure may be"));
  CHECK_THAT(whole, Catch::Contains("clean-exchanged-drum-1 1\n"));  // warnings beside the doubt
  const Json json = diagnosis::make_fleet_json(fleet);
  CHECK(json["sets"].size() == 5);
  CHECK(json["sets"][0]["diagnosis"]["format"] == "rollrig-diagnosis/1");
  CHECK(json["sets"][2]["diagnosis"].is_null());
  CHECK(json["recurring"].size() == 1);
}
