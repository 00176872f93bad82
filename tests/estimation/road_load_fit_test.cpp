#include "estimation/road_load/road_load_fit.h"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>

#include "sim/core/error.h"
#include "tests/support/coastdown_study.h"

using namespace rollrig;
using estimation::calc_reference_density_kg_m3;
using estimation::CoastdownData;
using estimation::fit_road_load;
using estimation::RoadLoadFit;
using estimation::RoadLoadFitOptions;
using tests::CoastdownStudy;
using tests::simulate_coastdowns;

namespace {

RoadLoadFitOptions with_mass(double kg = 2100.0) {
  RoadLoadFitOptions options;
  options.mass_kg = kg;
  return options;
}

CoastdownStudy without_noise() {
  CoastdownStudy study;
  study.pairs = 1;
  study.noise_sd_m_s = 0.0;
  study.resolution_km_h = 0.0;
  return study;
}

/// Largest relative deviation of the force from 20 to 130 km/h.
double worst_force(const RoadLoadFit& fit, const CoastdownStudy& study) {
  double worst = 0.0;
  for (double v = 20.0 / 3.6; v < 130.1 / 3.6; v += 5.0 / 3.6) {
    worst = std::max(worst, std::abs(fit.force_N(v) / models::calc_road_load_N(study.load, v) - 1.0));
  }
  return worst;
}

bool warns_of(const RoadLoadFit& fit, const std::string& words) {
  for (const std::string& warning : fit.warnings) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a mass that is wrong by a factor of ten is doubted by the drag area", "[fast]") {
  const CoastdownData data = simulate_coastdowns(without_noise(), 1);
  CHECK(!warns_of(fit_road_load(data, with_mass()), "drag area"));
  CHECK(warns_of(fit_road_load(data, with_mass(210.0)), "is 210 kg right?"));
  CHECK(warns_of(fit_road_load(data, with_mass(60000.0)), "drag area"));
}

TEST_CASE("a coastdown without noise gives its road load back, whatever the sampling and the end", "[fast]") {
  for (const double interval_s : {0.1, 1.0}) {
    for (const double to_km_h : {15.0, 0.0}) {
      CoastdownStudy study = without_noise();
      study.interval_s = interval_s;
      study.to_km_h = to_km_h;
      const RoadLoadFit fit = fit_road_load(simulate_coastdowns(study, 1), with_mass());
      INFO(interval_s << " s, to " << to_km_h << " km/h");
      CHECK(worst_force(fit, study) < 1e-5);
      CHECK(fit.load.B_N_s_per_m == Approx(study.load.B_N_s_per_m).epsilon(1e-3));
    }
  }
}

TEST_CASE("a single run without noise, heading not known, is enough for a simulation", "[fast]") {
  CoastdownStudy study = without_noise();
  CoastdownData data = simulate_coastdowns(study, 1);
  data.runs.resize(1);
  data.runs[0].heading = 0;
  const RoadLoadFit fit = fit_road_load(data, with_mass());
  CHECK(worst_force(fit, study) < 1e-5);
  CHECK_FALSE(fit.slope.has_value());
}

TEST_CASE("times through bins give the same road load as the trace, wide bins too", "[fast]") {
  CoastdownStudy study = without_noise();
  study.interval_s = 0.01;  // for the times of the edges
  for (const double width_km_h : {5.0, 10.0, 20.0}) {
    const CoastdownData bins = tests::cut_into_bins(simulate_coastdowns(study, 1), width_km_h);
    INFO(width_km_h);
    CHECK(worst_force(fit_road_load(bins, with_mass()), study) < 1e-5);
  }
}

TEST_CASE("wind and slope are told by the headings, and the square of the wind is taken off", "[fast]") {
  CoastdownStudy study = without_noise();
  study.wind_m_s = 2.0;
  study.slope = 0.002;
  const RoadLoadFit fit = fit_road_load(simulate_coastdowns(study, 1), with_mass());
  CHECK(worst_force(fit, study) < 1e-4);
  REQUIRE(fit.winds.size() == 1);
  CHECK(fit.winds[0].wind_m_s == Approx(2.0).epsilon(1e-3));
  CHECK(*fit.slope == Approx(0.002).epsilon(1e-3));
  // against the wind and uphill the vehicle loses more
  REQUIRE(fit.headings.size() == 2);
  CHECK(fit.headings[0].estimate.force_N(20.0) > fit.headings[1].estimate.force_N(20.0));
}

TEST_CASE("measured wind and slope leave nothing for the headings to tell, and mend a single heading", "[fast]") {
  CoastdownStudy study = without_noise();
  study.wind_m_s = 2.0;
  study.slope = 0.002;
  CoastdownData data = simulate_coastdowns(study, 1);
  for (auto& run : data.runs) {
    run.conditions.wind_m_s.assign(run.time_s.size(), 2.0);
    run.conditions.slope.assign(run.time_s.size(), 0.002);
  }
  const RoadLoadFit fit = fit_road_load(data, with_mass());
  CHECK(worst_force(fit, study) < 1e-5);
  CHECK(std::abs(fit.winds.at(0).wind_m_s) < 1e-3);
  RoadLoadFitOptions with_area = with_mass();
  with_area.drag_area_m2 = 2.0 * study.load.C_N_s2_per_m2 / calc_reference_density_kg_m3(with_area);
  CHECK(worst_force(fit_road_load(data, with_area), study) < 1e-5);  // all of C is drag: the same
  data.runs.resize(1);
  const RoadLoadFit single = fit_road_load(data, with_mass());
  CHECK(worst_force(single, study) < 1e-5);
  CHECK(warns_of(single, "not both headings"));
}

TEST_CASE("weather: what was coasted down in cold dense air comes back at reference conditions", "[fast]") {
  CoastdownStudy study = without_noise();
  study.ambient_K = 278.15;
  study.ambient_pressure_Pa = 101.5e3;
  CoastdownData data = simulate_coastdowns(study, 1);
  const RoadLoadFit raw = fit_road_load(data, with_mass());
  CHECK_FALSE(raw.ambient_corrected);
  CHECK(warns_of(raw, "not corrected to reference"));
  CHECK(raw.force_N(30.0) > 1.03 * models::calc_road_load_N(study.load, 30.0));
  for (auto& run : data.runs) {
    run.conditions.ambient_K.assign(run.time_s.size(), study.ambient_K);
    run.conditions.ambient_pressure_Pa.assign(run.time_s.size(), study.ambient_pressure_Pa);
  }
  const RoadLoadFit fit = fit_road_load(data, with_mass());
  CHECK(worst_force(fit, study) < 1e-5);
  CHECK(fit.as_tested.A_N == Approx(raw.load.A_N).epsilon(1e-4));
  // 101.5/98.21 * 293.15/278.15 = 1.08923
  CHECK(fit.as_tested.C_N_s2_per_m2 / fit.load.C_N_s2_per_m2 == Approx(1.08923).epsilon(1e-4));
}

TEST_CASE("the reference density is that of 40 CFR 1066.310", "[fast]") {
  CHECK(calc_reference_density_kg_m3(RoadLoadFitOptions{}) == Approx(1.17).margin(0.005));
}

TEST_CASE("forces go with the mass, and without one they are per unit of it", "[fast]") {
  const CoastdownData data = simulate_coastdowns({}, 3);
  const RoadLoadFit one = fit_road_load(data, with_mass(2100.0));
  const RoadLoadFit two = fit_road_load(data, with_mass(4200.0));
  const RoadLoadFit per_mass = fit_road_load(data, {});
  CHECK(two.force_N(20.0) == Approx(2.0 * one.force_N(20.0)).epsilon(1e-6));
  CHECK(two.sd(1) == Approx(2.0 * one.sd(1)).epsilon(1e-3));
  CHECK(per_mass.per_mass);
  CHECK(per_mass.force_N(20.0) * 2163.0 == Approx(one.force_N(20.0)).epsilon(1e-6));
  RoadLoadFitOptions heavier = with_mass();
  heavier.rotating_mass_kg = 126.0;  // 6 % in place of 3 %
  CHECK(fit_road_load(data, heavier).force_N(20.0) == Approx(1.06 / 1.03 * one.force_N(20.0)).epsilon(1e-6));
}

TEST_CASE("with the noise of a satellite sensor the force is met to 1 % by one pair of runs", "[fast]") {
  for (const int pairs : {1, 5}) {
    CoastdownStudy study;
    study.pairs = pairs;
    double worst = 0.0;
    double slope_squares = 0.0, slope_variances = 0.0, wind_squares = 0.0, wind_variances = 0.0;  // level road, calm
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const RoadLoadFit fit = fit_road_load(simulate_coastdowns(study, seed), with_mass());
      worst = std::max(worst, worst_force(fit, study));
      slope_squares += *fit.slope * *fit.slope;
      slope_variances += fit.slope_sd * fit.slope_sd;
      REQUIRE(fit.winds.size() == 1);
      wind_squares += fit.winds[0].wind_m_s * fit.winds[0].wind_m_s;
      wind_variances += fit.winds[0].sd_m_s * fit.winds[0].sd_m_s;
    }
    CHECK(std::sqrt(wind_variances / wind_squares) == Approx(1.0).epsilon(0.4));
    CHECK(std::sqrt(slope_variances / slope_squares) == Approx(1.0).epsilon(0.4));
    std::cout << fmt::format("{} pairs, 0.05 m/s at 10 Hz: force within {:.2f} % from 20 to 130 km/h in 40 of 40\n",
                             pairs, 100.0 * worst);
    CHECK(worst < 0.01);
  }
}

TEST_CASE("more runs narrow the standard deviations as the root of their number", "[fast]") {
  CoastdownStudy few;
  few.pairs = 2;
  CoastdownStudy many;
  many.pairs = 8;
  double ratio = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    ratio += fit_road_load(simulate_coastdowns(few, seed), with_mass()).sd(2) /
             fit_road_load(simulate_coastdowns(many, seed), with_mass()).sd(2) / 20.0;
  }
  CHECK(ratio == Approx(2.0).epsilon(0.1));
}

TEST_CASE("the scatter that made the data is found: sensor, gusts, runs", "[fast]") {
  CoastdownStudy study;
  study.pairs = 8;
  study.run_force_sd_N = 4.0;
  study.gust_N_sqrt_s = 20.0;
  double speed = 0.0, gust = 0.0, force = 0.0, sample = 0.0;
  constexpr int kSeeds = 20;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto scatter = fit_road_load(simulate_coastdowns(study, seed), with_mass()).scatter;
    sample += *scatter.sample_sd_m_s / kSeeds;
    speed += *scatter.speed_sd_m_s / kSeeds;
    gust += *scatter.gust_N_sqrt_s / kSeeds;
    force += *scatter.run_force_N / kSeeds;
  }
  CHECK(sample == Approx(0.05).epsilon(0.05));
  CHECK(speed == Approx(0.05).epsilon(0.1));
  CHECK(gust == Approx(20.0).epsilon(0.1));
  CHECK(force == Approx(4.0).epsilon(0.2));
}

TEST_CASE("one pair cannot tell how runs differ, and says so", "[fast]") {
  CoastdownStudy study;
  study.pairs = 1;
  const RoadLoadFit fit = fit_road_load(simulate_coastdowns(study, 1), with_mass());
  CHECK_FALSE(fit.scatter.run_force_N.has_value());
  CHECK(warns_of(fit, "too few runs"));
}

TEST_CASE("the order of runs and of headings does not matter", "[fast]") {
  CoastdownStudy study;
  study.wind_m_s = 1.0;
  study.pairs = 3;
  CoastdownData data = simulate_coastdowns(study, 5);
  const RoadLoadFit fit = fit_road_load(data, with_mass());
  std::reverse(data.runs.begin(), data.runs.end());
  for (auto& run : data.runs) run.heading = -run.heading;
  const RoadLoadFit turned = fit_road_load(data, with_mass());
  CHECK(turned.load.A_N == Approx(fit.load.A_N).epsilon(1e-6));
  CHECK(turned.sd(0) == Approx(fit.sd(0)).epsilon(1e-3));
  CHECK(turned.winds.at(0).wind_m_s == Approx(-fit.winds.at(0).wind_m_s).epsilon(1e-3));
}

TEST_CASE("bounds are off unless asked for, and said when on", "[fast]") {
  CoastdownStudy study = without_noise();
  study.load.B_N_s_per_m = -1.0;
  const CoastdownData data = simulate_coastdowns(study, 1);
  const RoadLoadFit free_fit = fit_road_load(data, with_mass());
  CHECK(free_fit.load.B_N_s_per_m == Approx(-1.0).epsilon(1e-3));
  RoadLoadFitOptions options = with_mass();
  options.bounds = estimation::RoadLoadBounds{};
  const RoadLoadFit bounded = fit_road_load(data, options);
  CHECK(bounded.load.B_N_s_per_m == 0.0);
  CHECK(bounded.on_bound[1]);
  CHECK_FALSE(bounded.on_bound[0]);
  CHECK(bounded.sd(1) == 0.0);
  CHECK(warns_of(bounded, "bounds are on"));
}

TEST_CASE("sessions that differ widen the standard deviations", "[fast]") {
  CoastdownStudy study;
  study.pairs = 3;
  CoastdownData data = simulate_coastdowns(study, 1);
  const double alike = fit_road_load(data, with_mass()).sd(0);
  for (int session = 2; session <= 4; ++session) {
    CoastdownStudy other = study;
    other.load.A_N += 6.0 * (session % 2 == 0 ? 1.0 : -1.0) * session / 2.0;
    for (auto& run : simulate_coastdowns(other, static_cast<std::uint64_t>(session)).runs) {
      data.runs.push_back(run);
      data.runs.back().session = "day " + std::to_string(session);
    }
  }
  const RoadLoadFit fit = fit_road_load(data, with_mass());
  CHECK(fit.scatter.session_force_N.value_or(0.0) > 3.0);
  CHECK(fit.sd(0) > 10.0 * alike);
  CHECK(warns_of(fit, "sessions differ"));
}

TEST_CASE("too few bins and speeds that do not fall are refused", "[fast]") {
  CoastdownStudy study = without_noise();
  study.to_km_h = 120.0;
  CoastdownData data = simulate_coastdowns(study, 1);
  data.runs.resize(1);
  CHECK_THROWS_AS(fit_road_load(data, with_mass()), InputError);
  CHECK_THROWS_AS(fit_road_load({}, with_mass()), InputError);
}
