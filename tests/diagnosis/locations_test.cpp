#include "diagnosis/findings/locations.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "diagnosis/comparison/report_unit.h"
#include "diagnosis/findings/balance.h"
#include "models/effect.h"
#include "sim/core/parallel.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::Location;

namespace {

constexpr const char* kTorque = "drum_torque_Nm";
constexpr double kAdded_N = 1.2;
constexpr double kBegin_s = 1840.0;  // the faster part of run 2
constexpr double kEnd_s = 2640.0;

/// A resisting force in one phase of run 2 that the baseline does not have.
void add_force(measurements::MeasurementSet& set) {
  const double radius_m = 0.5 * set.rig->drum.diameter_m;
  tests::add_to_channel(set.runs[1], kTorque, [&](double time_s) {
    return time_s >= kBegin_s && time_s < kEnd_s ? kAdded_N * radius_m : 0.0;
  });
}

bool is_there(const Location& location) {
  return location.channel == kTorque && location.run == "run_2" && location.phase == "120 km/h 4.2 kN";
}

}  // namespace

TEST_CASE("sets without a gap have a location at the family-wise rate", "[slow]") {
  constexpr int kSeeds = 200;
  const tests::RepeatedBaseline baseline(tests::make_gap_set({}, 2));
  std::vector<char> located(kSeeds, 0);
  parallel_for(kSeeds, 0,
               [&](std::size_t i) { located[i] = diagnosis::find_locations(*baseline.draw(i + 1)).empty() ? 0 : 1; });
  const auto sets = static_cast<int>(std::count(located.begin(), located.end(), 1));
  INFO("with a location: " << sets << " of " << kSeeds);
  CHECK_FALSE(tests::is_rejected(sets, kSeeds, 0.01, 0.01));
}

TEST_CASE("a force added in one phase is located there, with intervals that cover it", "[slow]") {
  constexpr int kSeeds = 200;
  const tests::RepeatedBaseline baseline(tests::make_gap_set({}, 2));
  std::vector<std::vector<Location>> found(kSeeds);
  parallel_for(kSeeds, 0,
               [&](std::size_t i) { found[i] = diagnosis::find_locations(*baseline.draw(i + 1, add_force)); });
  int alone = 0;
  int covered = 0;
  for (const auto& where : found) {
    REQUIRE(!where.empty());
    CHECK(is_there(where.front()));
    CHECK(where.front().unit == "N");
    const double sd = where.front().size / where.front().z;
    if (where.size() == 1) ++alone;
    if (std::abs(where.front().size - kAdded_N) < 1.96 * sd) ++covered;
  }
  INFO("alone " << alone << ", covered " << covered << " of " << kSeeds);
  CHECK_FALSE(tests::is_rejected(covered, kSeeds, 0.95, 0.01));
  CHECK_FALSE(tests::is_rejected(kSeeds - alone, kSeeds, 0.01, 0.01));  // no echo in other phases
}

TEST_CASE("a force added in one phase is located on the fitted baseline", "[fast]") {
  auto measured = tests::make_gap_set({}, 2);
  add_force(measured);
  const tests::FittedBaseline fitted(tests::add_noise(measured, 1));
  const auto where = diagnosis::find_locations(fitted);
  REQUIRE(!where.empty());
  const Location& at = where.front();
  CHECK(is_there(at));
  CHECK(std::abs(at.size - kAdded_N) < 3.0 * std::abs(at.size / at.z));
  CHECK(at.start_s == Approx(kBegin_s).margin(1.5));
  CHECK(at.end_s == Approx(kEnd_s).margin(1.5));
  double shares_percent = 0.0;
  for (const Location& location : where) shares_percent += location.share_percent;
  CHECK(shares_percent <= 100.0 + 1e-9);
  CHECK(at.share_percent > 50.0);
}

TEST_CASE("bearings that warm are located in the torque of the first skims", "[fast]") {
  // Coefficients of the warm rig: the cold bearings resist more, by the rise that is still missing.
  const auto effect = tests::make_active(models::find_effect("bearing_warmup"), {0.02, 20.0, 15.0, 1.0});
  const tests::FittedBaseline fitted(tests::add_noise(tests::make_gap_set({effect}, 3), 1));
  const auto where = diagnosis::find_locations(fitted);
  for (const std::string run : {"run_1", "run_2", "run_3"}) {
    INFO(run);
    const auto at = std::find_if(where.begin(), where.end(), [&](const Location& location) {
      return location.run == run && location.phase == "skim 1" && location.channel == kTorque;
    });
    REQUIRE(at != where.end());
    CHECK(at->size > 0.0);
  }
  double torque_percent = 0.0;
  for (const Location& location : where) {
    if (location.channel == kTorque) torque_percent += location.share_percent;
  }
  CHECK(torque_percent > 80.0);
}

namespace {

/// Mean difference of a location's stretch from the recalibrated baseline, in its unit.
double find_mean_difference(const diagnosis::Study& study, const Location& location) {
  const Eigen::VectorXd difference =
      study.make_model({}).subtract_from_measured(study.null.fit.unknowns, study.null.fit.simulated);
  double sum = 0.0;
  int count = 0;
  for (const diagnosis::Series& series : study.set.series()) {
    if (study.set.channels()[series.channel].header() != location.channel) continue;
    if (study.set.runs()[series.run].measured.id != location.run) continue;
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (series.time_s[k] < location.start_s || series.time_s[k] >= location.end_s) continue;
      sum += difference[diagnosis::to_index(series.first_residual + k)];
      ++count;
    }
  }
  const Quantity& channel = *std::find_if(study.set.channels().begin(), study.set.channels().end(),
                                          [&](const Quantity& one) { return one.header() == location.channel; });
  return sum / count * diagnosis::find_report_unit(study.set, channel).per_SI;
}

}  // namespace

TEST_CASE("the sizes of a gap that is everywhere are not far beyond what is seen", "[fast]") {
  int limited = 0;
  const std::map<std::string, double> sizes{{"rim_heat", 30.0}, {"load_exponent", 0.3}, {"pressure_exponent", 0.5}};
  for (const auto& [effect, size] : sizes) {
    const models::Effect& found = models::find_effect(effect);
    std::vector<double> own;
    for (const auto& parameter : found.info.parameters) own.push_back(parameter.prior.center());
    own.front() = size;
    const tests::FittedBaseline fitted(tests::add_noise(tests::make_gap_set({tests::make_active(found, own)}, 3), 1));
    for (const Location& location : diagnosis::find_locations(fitted)) {
      const double mean = find_mean_difference(fitted, location);
      INFO(effect << " " << location.channel << " " << location.run << " " << location.phase << " " << location.size
                  << " " << mean << " z " << location.z);
      CHECK(location.size * mean > 0.0);
      CHECK(std::abs(location.size) < 2.1 * std::abs(mean));
      if (location.size == Approx(mean)) ++limited;
    }
  }
  CHECK(limited > 0);
}

TEST_CASE("what a sensor's offset takes has no location", "[fast]") {
  auto measured = tests::add_noise(tests::make_gap_set({}, 2), 1);
  for (const auto& [channel, sensor] : measured.sensors) {
    const double offset = 1.5 * sensor.offset_sd;
    tests::add_to_channel(measured.runs[0], channel.header(), [&](double) { return offset; });
  }
  const tests::FittedBaseline fitted(measured);
  CHECK(diagnosis::find_locations(fitted).empty());
}

TEST_CASE("sizes come in the unit of their channel, and long phases are cut", "[fast]") {
  auto measured = tests::make_gap_set({}, 2);
  // Early in a phase of 1,400 s at one speed and load: rest of it as the baseline has it.
  const auto early = [](double size) { return [=](double t) { return t >= 300.0 && t < 900.0 ? size : 0.0; }; };
  tests::add_to_channel(measured.runs[0], "cavity_pressure_kPa", early(2e3));
  tests::add_to_channel(measured.runs[1], "liner_temperature_degC", early(-2.0));
  const tests::FittedBaseline fitted(tests::add_noise(measured, 3));
  const auto where = diagnosis::find_locations(fitted);
  const auto check = [&](const char* channel, const char* run, const char* phase, const char* unit, double size) {
    const auto at = std::find_if(where.begin(), where.end(), [&](const Location& location) {
      return location.channel == channel && location.run == run && location.phase == phase;
    });
    REQUIRE(at != where.end());
    CHECK(at->unit == unit);
    CHECK(at->size == Approx(size).margin(std::max(4.0 * std::abs(at->size / at->z), 0.1 * std::abs(size))));
  };
  check("cavity_pressure_kPa", "run_1", "80 km/h 5.4 kN, first 10 min", "kPa", 2.0);
  check("liner_temperature_degC", "run_2", "80 km/h 4.2 kN, first 10 min", "degC", -2.0);
}

TEST_CASE("gross errors of the data give finite locations and shares", "[fast]") {
  auto measured = tests::add_noise(tests::make_gap_set({}, 1), 1);
  for (double& value : measured.runs[0].columns.at("cavity_pressure_kPa")) value = 300e3;
  for (double& value : measured.runs[0].columns.at("liner_temperature_degC")) value = std::nan("");
  for (double& value : measured.runs[0].columns.at(kTorque)) value *= 3.6;
  const tests::FittedBaseline fitted(measured);
  const auto where = diagnosis::find_locations(fitted);
  CHECK(!where.empty());
  for (const Location& location : where) {
    CHECK(std::isfinite(location.size));
    CHECK(std::isfinite(location.z));
    CHECK((location.share_percent >= 0.0 && location.share_percent <= 100.0 + 1e-9));
    CHECK(location.channel != "liner_temperature_degC");
  }
  const auto balance = diagnosis::find_balance(fitted);
  CHECK(!balance.empty());
  for (const auto& share : balance) CHECK((share.share_percent >= 1.0 && share.share_percent <= 100.0 + 1e-9));
}

TEST_CASE("what whitening did can be undone", "[fast]") {
  const diagnosis::PreparedSet set(tests::make_gap_set({}, 1));
  for (const auto& series : set.series()) {
    std::vector<double> values = series.measured;
    series.whitener.apply(values.data(), 1);
    CHECK(values.back() != Approx(series.measured.back()));
    series.whitener.undo(values.data(), 1);
    for (std::size_t k = 0; k < values.size(); ++k) CHECK(values[k] == Approx(series.measured[k]));
  }
}
