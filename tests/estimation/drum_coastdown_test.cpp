// The deceleration method on made-up coasts whose loss is known: what ISO 28580's equation says, coverage of the
// intervals, what the inertia does and does not change.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cmath>

#include <iostream>
#include <map>

#include "models/deceleration_method.h"
#include "sim/core/parallel.h"
#include "tests/support/coast_study.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::DrumCoastdownFit;
using estimation::fit_drum_coastdown;
using estimation::Interval;
using tests::CoastStudy;

namespace {

CoastStudy make_quiet() {
  CoastStudy study;
  study.noise_m_s = 1e-4;
  study.missed_share = 0.0;
  study.resonance = 0.0;
  study.loaded_scatter = 0.0;
  study.lifted_scatter = 0.0;
  return study;
}

bool holds(const Interval& interval, double truth) { return interval.lower <= truth && truth <= interval.upper; }

/// Coverage of every interval; `leave_out_m_s` as a person would give it.
void check_drum_coverage(const CoastStudy& study, const std::vector<double>& leave_out_m_s) {
  const int seeds = tests::count_seeds(200);
  std::vector<DrumCoastdownFit> fits(static_cast<std::size_t>(seeds));
  parallel_for(fits.size(), 0, [&](std::size_t i) {
    estimation::CoastSet set = tests::make_coasts(study, i + 1);
    set.leave_out_m_s = leave_out_m_s;
    fits[i] = fit_drum_coastdown(set);
  });
  std::map<std::string, int> covered;
  for (const DrumCoastdownFit& fit : fits) {
    for (const auto& point : fit.points) {
      const double v = point.speed_m_s;
      const auto count = [&](const std::string& what, const Interval& interval, double truth) {
        covered[fmt::format("{} at {:.0f} m/s", what, v)] += holds(interval, truth) ? 1 : 0;
      };
      const double reference = tests::calc_true_net_m_s2(study, 420e3, 18.0);
      for (const std::size_t i : {0U, 4U}) {
        const auto& level = point.levels[i];
        const double truth = tests::calc_true_net_m_s2(study, level.pressure_Pa, v);
        count(fmt::format("net, {:.0f} kPa", level.pressure_Pa / 1e3), level.net_m_s2, truth);
        count(fmt::format("ratio, {:.0f} kPa", level.pressure_Pa / 1e3), *level.ratio, truth / reference);
      }
      count("exponent", *point.pressure_exponent, study.exponent);
      count("drum alone", *point.drum_alone_m_s2, tests::calc_true_drum_m_s2(v));
      count("directions", *point.direction_ratio, 0.0);
      count("repeatability", *point.drum_repeatability, study.lifted_scatter);
    }
  }
  for (const auto& [what, count] : covered) {
    INFO(what << " covered " << count << " of " << seeds);
    std::cout << fmt::format("{:<32} covered {} of {}\n", what, count, seeds);
    CHECK_FALSE(tests::is_rejected(count, seeds, 0.95, 0.01));
  }
}

}  // namespace

TEST_CASE("the equation: a tire without loss gives none, whatever the inertias, and the torque balance is kept",
          "[fast]") {
  // Free bodies: M a_D0 and m a_T0 are the parasitic forces, and together (M + m) a is all that slows them.
  const double drum_kg = 20.0, wheel_kg = 1.5, drum_N = 3.0, wheel_N = 0.6;
  const auto net = [&](double tire_N) {
    const models::CoastDecelerations<double> a{(drum_N + wheel_N + tire_N) / (drum_kg + wheel_kg), drum_N / drum_kg,
                                               wheel_N / wheel_kg};
    return drum_kg * models::calc_net_deceleration(a, wheel_kg / drum_kg);
  };
  CHECK(net(0.0) == Approx(0.0).margin(1e-12));
  CHECK(net(5.0) == Approx(5.0));
}

TEST_CASE("without noise net decelerations, exponent and drum alone are the true ones", "[fast]") {
  const CoastStudy study = make_quiet();
  const DrumCoastdownFit fit = fit_drum_coastdown(tests::make_coasts(study, 1));
  for (const auto& point : fit.points) {
    const double v = point.speed_m_s;
    CHECK(point.drum_alone_m_s2->value == Approx(tests::calc_true_drum_m_s2(v)).epsilon(2e-3));
    REQUIRE(point.levels.size() == study.pressures_Pa.size());
    for (const auto& level : point.levels) {
      CHECK(level.net_m_s2.value == Approx(tests::calc_true_net_m_s2(study, level.pressure_Pa, v)).epsilon(2e-3));
      CHECK_FALSE(level.force_N.has_value());
    }
    CHECK(point.pressure_exponent->value == Approx(study.exponent).margin(2e-3));
  }
}

TEST_CASE("the wheel's own loss is taken off where its share of the mass is given, and stays in else", "[fast]") {
  CoastStudy study = make_quiet();
  study.mass_ratio = 0.05;
  estimation::CoastSet set = tests::make_coasts(study, 1);
  const auto known = fit_drum_coastdown(set);
  const auto& level = known.points[2].levels[2];
  CHECK(level.net_m_s2.value == Approx(tests::calc_true_net_m_s2(study, 420e3, 18.0)).epsilon(3e-3));
  CHECK(known.points[2].pressure_exponent->value == Approx(study.exponent).margin(3e-3));
  set.wheel_mass_ratio.reset();
  const auto unknown = fit_drum_coastdown(set);
  CHECK(unknown.points[2].levels[2].net_m_s2.value > level.net_m_s2.value);
  // the slope that is reported foretells where the exponent goes
  const double foretold = unknown.points[2].pressure_exponent->value + 0.05 * unknown.points[2].exponent_per_mass_ratio;
  CHECK(foretold == Approx(known.points[2].pressure_exponent->value).margin(0.02));
}

TEST_CASE("twice the inertia is twice the force and the same ratios", "[fast]") {
  estimation::CoastSet set = tests::make_coasts({}, 7);
  set.drum_inertia_kg_m2 = 10.0;
  const auto one = fit_drum_coastdown(set);
  set.drum_inertia_kg_m2 = 20.0;
  const auto two = fit_drum_coastdown(set);
  for (std::size_t s = 0; s < one.points.size(); ++s) {
    for (std::size_t i = 0; i < one.points[s].levels.size(); ++i) {
      const auto& a = one.points[s].levels[i];
      const auto& b = two.points[s].levels[i];
      CHECK(b.force_N->value == Approx(2.0 * a.force_N->value));
      CHECK(b.force_N->upper - b.force_N->lower == Approx(2.0 * (a.force_N->upper - a.force_N->lower)));
      CHECK(b.ratio->value == a.ratio->value);
      CHECK(b.ratio->lower == a.ratio->lower);
    }
    CHECK(one.points[s].pressure_exponent->value == two.points[s].pressure_exponent->value);
  }
  CHECK(one.points[0].levels[0].force_N->value ==
        Approx(10.0 / (0.75 * 0.75) * one.points[0].levels[0].net_m_s2.value));
}

TEST_CASE("a difference of the directions is found, with its sign", "[fast]") {
  CoastStudy study;
  study.left_over_right = 0.10;
  const auto fit = fit_drum_coastdown(tests::make_coasts(study, 2));
  REQUIRE(fit.directions == std::vector<std::string>{"left", "right"});
  REQUIRE(fit.points[2].direction_ratio.has_value());
  CHECK(holds(*fit.points[2].direction_ratio, 0.10));
  CHECK(fit.points[2].direction_ratio->lower > 0.0);
}

TEST_CASE("missed and double pulses barely move what is found", "[fast]") {
  CoastStudy clean;
  clean.missed_share = 0.0;
  clean.resonance = 0.0;  // at its speed what is left out depends on the noise; the coverage study looks at that
  clean.loaded_scatter = clean.lifted_scatter = 0.0;
  CoastStudy dirty = clean;
  dirty.missed_share = 0.05;
  dirty.doubled_share = 0.03;
  const auto a = fit_drum_coastdown(tests::make_coasts(clean, 5));
  const auto b = fit_drum_coastdown(tests::make_coasts(dirty, 5));
  for (std::size_t s = 0; s < a.points.size(); ++s) {
    for (std::size_t i = 0; i < a.points[s].levels.size(); ++i) {
      CHECK(b.points[s].levels[i].net_m_s2.value == Approx(a.points[s].levels[i].net_m_s2.value).epsilon(0.01));
    }
  }
  std::size_t rejected = 0;
  for (const auto& analysis : b.analyses) rejected += analysis.coast.missed + analysis.coast.doubled;
  CHECK(rejected > 100);
}

TEST_CASE("one lifted run, or no pressure run twice, is said: intervals cannot hold the scatter of runs", "[fast]") {
  CoastStudy study;
  study.lifted_runs = 1;
  estimation::CoastSet set = tests::make_coasts(study, 1);
  for (std::size_t i = 10; i-- > 1;) {
    if (i % 2 == 1) set.runs.erase(set.runs.begin() + static_cast<std::ptrdiff_t>(i));
  }
  const auto fit = fit_drum_coastdown(set);
  std::string all;
  for (const std::string& warning : fit.warnings) all += warning;
  CHECK_THAT(all, Catch::Contains("one lifted run") && Catch::Contains("no pressure was run twice"));
}

TEST_CASE("95 % intervals of net decelerations, ratios, exponent and drum alone cover at their rate", "[slow]") {
  check_drum_coverage({}, {});  // noise, 3 % of pulses missed, a resonance at 10 m/s, runs that scatter
}

TEST_CASE("with noise that hides the resonance, intervals cover where the range is named", "[slow]") {
  CoastStudy study;
  study.noise_m_s = 0.02;
  check_drum_coverage(study, {8.5, 11.5});
}
