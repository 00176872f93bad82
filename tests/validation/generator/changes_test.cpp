// Where effects change the readings, against the files of a case and of the same case without effects.
#include "validation/generator/changes.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"
#include "tests/validation/generator/generated_set.h"
#include "validation/generator/validation_set.h"

using namespace rollrig;
using namespace rollrig::tests;
using generator::ChangeAt;
using generator::Place;

namespace {

constexpr const char* kTorque = "drum_torque_Nm";
constexpr const char* kLiner = "liner_temperature_degC";
constexpr const char* kPressure = "cavity_pressure_kPa";

std::vector<ChangeAt> find_changes(const GeneratedSet& made, const std::vector<Place>& places) {
  return generator::find_changes(generator::read_order(made.truth), places);
}

/// Mean of what the effects do from one row of the first run to another, in noise floors.
double average_difference(const GeneratedSet& made, const std::string& channel, std::size_t first, std::size_t end) {
  const std::vector<double> difference = find_difference(made, 0, channel);
  double sum = 0.0;
  for (std::size_t row = first; row < end; ++row) sum += difference[row];
  return sum / static_cast<double>(end - first) / calc_floor(made.set, channel);
}

}  // namespace

TEST_CASE("the change of a place is the mean difference that the effects make there, in noise floors", "[fast]") {
  const GeneratedSet made =
      make_generated_set("--kind drum --runs 1 --seed 21 --noise-free --effect torque_gain,rim_heat");
  const std::string run = made.set.runs[0].id;
  const auto changes = find_changes(made, {{kTorque, run, 600, 700}, {kLiner, run, 600, 640}, {kLiner, run, 640, 700}});
  CHECK(changes[0].of_effects.blocks == 10);
  CHECK(changes[1].of_effects.blocks == 4);
  CHECK(changes[2].of_effects.blocks == 6);
  CHECK(std::abs(changes[0].of_effects.mean) > 1.0);
  CHECK(changes[0].of_effects.mean == Approx(average_difference(made, kTorque, 600, 700)).epsilon(1e-5));
  CHECK(std::abs(changes[1].of_effects.mean) > 0.1);
  CHECK(changes[1].of_effects.mean == Approx(average_difference(made, kLiner, 600, 640)).epsilon(1e-5));
  CHECK(changes[2].of_effects.mean == Approx(average_difference(made, kLiner, 640, 700)).epsilon(1e-5));
  for (const ChangeAt& change : changes) CHECK(change.of_effects.rms >= std::abs(change.of_effects.mean));
}

TEST_CASE("without effects nothing changes, in any place", "[fast]") {
  const GeneratedSet made = make_generated_set("--kind road --runs 1 --seed 3");
  const std::string& run = made.set.runs[0].id;
  const auto changes = find_changes(made, {{"traction_force_N", run, 0, 300}, {"traction_force_N", run, 300, 600}});
  for (const ChangeAt& change : changes) {
    CHECK(change.of_effects.blocks > 0);
    CHECK(change.of_effects.rms == 0.0);
    CHECK(change.after_retuning.rms == 0.0);
  }
}

TEST_CASE("rows in which brakes act only with another mass leave the change a number", "[fast]") {
  const GeneratedSet made = make_generated_set("--kind road --runs 2 --seed 21 --effect wind_and_grade");
  const std::string& run = made.set.runs[0].id;
  for (const ChangeAt& change : find_changes(made, {{"traction_force_N", run, 0, 300}})) {
    CHECK(std::isfinite(change.of_effects.rms));
    CHECK(std::isfinite(change.after_retuning.rms));
  }
}

TEST_CASE("of a constant error of a sensor its offset takes most, of a drift it does not", "[fast]") {
  // 0.6 kPa are about two standard deviations of the offset, and six noise floors
  const GeneratedSet constant =
      make_generated_set("--kind drum --runs 1 --seed 21 --effect pressure_record --form warming --size 0.6");
  const GeneratedSet drift =
      make_generated_set("--kind drum --runs 1 --seed 21 --effect torque_zero_drift --form creep --size 5");
  const Place pressure{kPressure, constant.set.runs[0].id, 0, 1800};
  const Place torque{kTorque, drift.set.runs[0].id, 0, 600};
  const ChangeAt of_constant = find_changes(constant, {pressure})[0];
  const ChangeAt of_drift = find_changes(drift, {torque})[0];
  CHECK(of_constant.of_effects.rms > 3.0);
  CHECK(of_constant.after_retuning.rms < 0.1 * of_constant.of_effects.rms);
  CHECK(of_drift.after_retuning.rms > 1.0);
}

TEST_CASE("a place in no run or channel of the case is refused", "[fast]") {
  const GeneratedSet made = make_generated_set("--kind drum --runs 1 --seed 3");
  CHECK_THROWS_AS(find_changes(made, {{kTorque, "no_run", 0, 300}}), InputError);
  CHECK_THROWS_AS(find_changes(made, {{"no_channel", made.set.runs[0].id, 0, 300}}), InputError);
}
