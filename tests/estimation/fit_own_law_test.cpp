// Fits of a tire whose law has numbers of its own instead of A0 to B1: the bounded law.
#include <boost/math/distributions/chi_squared.hpp>
#include <catch2/catch.hpp>

#include <Eigen/Cholesky>
#include <cmath>

#include "estimation/tire_fit/drum_residuals.h"
#include "estimation/tire_fit/fit_tire.h"
#include "estimation/tire_fit/fit_unknowns.h"
#include "models/tire/tire_model.h"
#include "sim/core/error.h"
#include "tests/estimation/estimates.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using estimation::Estimate;
using estimation::fit_tire;
using estimation::TireFit;
using measurements::MeasurementSet;
using tests::count_asked_for;
using tests::estimate_of;
using tests::find_own;
using tests::find_truth;
using tests::put_own;

namespace {

/// A tire whose law has no usual number, and no number with an uncertainty.
models::TireFile make_true_tire() {
  models::TireFile tire = tests::read_asset_tire("c1_205_55r16");
  auto& sd = tire.standard_uncertainties;
  sd.own.values.assign(sd.own.values.size(), 0.0);
  sd.rolling_resistance = {};
  sd.thermal = {};
  put_own(tire, "loss_N", 47.0);
  put_own(tire, "speed_rise", 0.37);
  put_own(tire, "fall_per_degC", 0.0133);
  put_own(tire, "speed_rise_of_fall", -0.45);
  put_own(tire, "load_exponent", 1.23);
  return tire;
}

/// What a user may take for it before the fit.
void guess_wrong(models::TireFile& tire) {
  put_own(tire, "loss_N", 62.0);
  put_own(tire, "speed_rise", 0.15);
  put_own(tire, "fall_per_degC", 0.0085);
  put_own(tire, "speed_rise_of_fall", 0.1);
  put_own(tire, "load_exponent", 0.95);
  const auto cooling = tire.parameters_on(tests::read_asset_rig().cooling_rig(), models::Baseline::kCombined).thermal;
  tire.values.thermal.rest_conductance_W_per_K = 1.5 * cooling.rest_conductance_W_per_K;
  tire.values.thermal.speed_conductance_W_s_per_m_K = 0.7 * cooling.speed_conductance_W_s_per_m_K;
}

/// Speeds and loads off those to which the law refers, 80 km/h and 4825 N; simulated as the fit does.
const MeasurementSet& several_speeds_and_loads() {
  static const MeasurementSet set = tests::make_warm_up_set(
      make_true_tire(),
      {{55.0, 4100.0, 230.0, "slow"}, {115.0, 4100.0, 230.0, "fast"}, {95.0, 5900.0, 250.0, "loaded"}},
      "source_with_gas", "quasi_static");
  return set;
}

MeasurementSet make_one_speed_set() {
  return tests::make_warm_up_set(make_true_tire(), {{95.0, 4100.0, 230.0}}, "source", "quasi_static");
}

bool has(const TireFit& fit, const std::string& key) {
  return std::any_of(fit.estimates.begin(), fit.estimates.end(), [&](const Estimate& at) { return at.key == key; });
}

models::TireFile read_back(const TireFit& fit) {
  return models::read_tire(parse_config(models::write_tire(fit.tire, fit.notes), "fitted"));
}

/// Root mean square of the set's residuals against a tire, in units of the sensors' noise.
double calc_rms(MeasurementSet set, const models::TireFile& tire) {
  set.tire = tire;
  const estimation::DrumResiduals residuals(set, measurements::make_context(set), {}, 2);
  std::vector<double> at(residuals.residual_count());
  residuals.evaluate(residuals.start().data(), at.data(), nullptr);
  double sum = 0.0;
  for (const double r : at) sum += r * r;
  return std::sqrt(sum / static_cast<double>(at.size()));
}

/// Squared distance of the estimates from the truth, by their covariance.
double calc_distance(const TireFit& fit, const MeasurementSet& truth_of) {
  const auto n = static_cast<Eigen::Index>(fit.estimates.size());
  Eigen::VectorXd off(n);
  Eigen::MatrixXd correlation(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Estimate& estimate = fit.estimates[at];
    off[i] = (estimate.value - find_truth(truth_of, estimate.key)) / estimate.sd;
    for (Eigen::Index j = 0; j < n; ++j) correlation(i, j) = fit.correlation[at][static_cast<std::size_t>(j)];
  }
  return off.dot(correlation.llt().solve(off));
}

}  // namespace

TEST_CASE("a bounded tire is found again from wrong guesses, from several speeds and loads", "[fast]") {
  MeasurementSet set = several_speeds_and_loads();
  guess_wrong(set.tire);
  REQUIRE(calc_rms(set, set.tire) > 3.0);
  const TireFit fit = fit_tire(set, {});
  REQUIRE(count_asked_for(fit) == 8);  // five of the law, z, f, H
  for (const Estimate& estimate : fit.estimates) {
    INFO(estimate.key);
    CHECK(std::abs(estimate.value - find_truth(several_speeds_and_loads(), estimate.key)) < 0.02 * estimate.sd);
  }
  CHECK(fit.chi2_per_sample < 1e-5);
  CHECK(fit.warnings.empty());
  CHECK_FALSE(fit.two_step.has_value());
  CHECK(estimation::make_fit_json(set, fit)["two_step"].is_null());
}

TEST_CASE("with noise a bounded tire is found within its uncertainty, and noise is what is left", "[slow]") {
  constexpr int kSeeds = 6;
  double distance = 0.0;
  double degrees = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    MeasurementSet set = tests::add_noise(several_speeds_and_loads(), static_cast<std::uint64_t>(seed));
    guess_wrong(set.tire);
    const TireFit fit = fit_tire(set, {});
    distance += calc_distance(fit, several_speeds_and_loads());
    degrees += static_cast<double>(fit.estimates.size());
    for (const estimation::ChannelFit& channel : fit.channels) CHECK(channel.whitened_rms == Approx(1.0).margin(0.05));
  }
  const boost::math::chi_squared_distribution<double> expected(degrees);
  INFO(distance << " of " << degrees);
  CHECK(distance > boost::math::quantile(expected, 0.001));
  CHECK(distance < boost::math::quantile(expected, 0.999));
}

TEST_CASE("the file of a fitted bounded tire is read and gives the measurements again", "[fast]") {
  MeasurementSet set = several_speeds_and_loads();
  guess_wrong(set.tire);
  // Off by its uncertainty: the data know it better, and the file must have what they say.
  set.tire.values.thermal.heat_capacity_J_per_K *= 1.08;
  set.tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 1200.0;
  const TireFit fit = fit_tire(set, {});
  const models::TireFile back = read_back(fit);
  CHECK(calc_rms(set, back) < 0.05);
  const Estimate& capacity = estimate_of(fit, "tire.thermal.heat_capacity_J_per_K");
  CHECK(capacity.nuisance);
  CHECK(back.values.thermal.heat_capacity_J_per_K == Approx(capacity.value));
  CHECK(back.values.thermal.heat_capacity_J_per_K ==
        Approx(several_speeds_and_loads().tire.values.thermal.heat_capacity_J_per_K).epsilon(0.01));
  CHECK(back.standard_uncertainties.thermal.heat_capacity_J_per_K == Approx(capacity.sd));
  models::OwnParameters<double> own_sd = back.standard_uncertainties.own;
  for (const char* key : {"loss_N", "speed_rise", "fall_per_degC", "speed_rise_of_fall", "load_exponent"}) {
    CHECK(find_own(own_sd, key) == Approx(estimate_of(fit, std::string("tire.bounded.") + key).sd));
  }
  CHECK(back.values.thermal.rest_conductance_W_per_K ==
        Approx(set.tire.values.thermal.rest_conductance_W_per_K));  // other rigs keep theirs
}

TEST_CASE("one speed and load give loss, its fall and one conductance, and the rest is what the file says", "[fast]") {
  const MeasurementSet truth = make_one_speed_set();
  MeasurementSet set = truth;
  put_own(set.tire, "loss_N", 62.0);
  put_own(set.tire, "fall_per_degC", 0.0085);
  set.rig->tire_cooling.at_rest_W_per_m2_K *= 1.5;  // z is that of the rig's cooling, f likewise
  const TireFit fit = fit_tire(set, {});
  REQUIRE(count_asked_for(fit) == 3);
  for (const char* key : {"tire.bounded.loss_N", "tire.bounded.fall_per_degC", "tire.thermal.z_W_per_K"}) {
    INFO(key);
    CHECK(std::abs(estimate_of(fit, key).value - find_truth(truth, key)) < 0.02 * estimate_of(fit, key).sd);
  }
  const models::TireFile back = read_back(fit);
  const models::RigThermal& on_rig = back.rig_thermal.at("drum_2m");
  CHECK(on_rig.rest_conductance_sd_W_per_K.has_value());
  // f is not decided: it stays what the rig's file says, and as uncertain.
  const double area_m2 = models::calc_outer_area_m2(set.tire.values.geometry);
  CHECK(estimate_of(fit, "tire.thermal.f_W_s_per_m_K").nuisance);
  CHECK(*on_rig.speed_conductance_W_s_per_m_K ==
        Approx(measurements::make_context(set).tire.thermal.speed_conductance_W_s_per_m_K).epsilon(1e-3));
  CHECK(*on_rig.speed_conductance_sd_W_s_per_m_K ==
        Approx(area_m2 * set.rig->tire_cooling_uncertainties.per_speed_W_s_per_m3_K).epsilon(0.05));
  CHECK(calc_rms(set, back) < 0.01);
}

TEST_CASE("what one speed does not decide moves within the uncertainty that the file gives", "[fast]") {
  MeasurementSet set = make_one_speed_set();
  find_own(set.tire.standard_uncertainties.own, "speed_rise") = 0.08;
  // f is that of the rig's cooling, and so is its uncertainty.
  const double area_m2 = models::calc_outer_area_m2(set.tire.values.geometry);
  set.rig->tire_cooling_uncertainties = {0.0, 0.2 / area_m2};
  const TireFit fit = fit_tire(set, {});
  for (const auto& [key, sd] : {std::pair("tire.bounded.speed_rise", 0.08), {"tire.thermal.f_W_s_per_m_K", 0.2}}) {
    INFO(key);
    CHECK(estimate_of(fit, key).nuisance);
    CHECK(estimate_of(fit, key).sd == Approx(sd).epsilon(0.05));
  }
  MeasurementSet known = make_one_speed_set();
  find_own(known.tire.standard_uncertainties.own, "speed_rise") = 1e-5;
  known.rig->tire_cooling_uncertainties = {0.0, 1e-5 / area_m2};
  const TireFit exact = fit_tire(known, {});
  for (const Estimate& estimate : exact.estimates) CHECK(estimate_of(fit, estimate.key).sd > 0.999 * estimate.sd);
}

TEST_CASE("noise of the recorded speed and the ramp to it are no further speed", "[fast]") {
  MeasurementSet set = make_one_speed_set();
  auto& speed_m_s = set.runs[0].columns.at(models::quantities::kSpeed);
  for (std::size_t i = 0; i < speed_m_s.size(); ++i) {
    speed_m_s[i] *= 1.0 + 0.01 * std::sin(7.0 * static_cast<double>(i));
    if (i < 40) speed_m_s[i] *= static_cast<double>(i) / 40.0;
  }
  const auto unknowns = estimation::choose_unknowns(set, std::nullopt, false, false);
  CHECK(unknowns.asked_for == 3);
}

TEST_CASE("a temperature in degC keeps its zero in the estimate and in the file", "[fast]") {
  MeasurementSet set = several_speeds_and_loads();
  put_own(set.tire, "cold_limit_degC", 5.0);  // true: 3
  find_own(set.tire.standard_uncertainties.own, "cold_limit_degC") = 2.0;
  const TireFit fit = fit_tire(set, {});
  const Estimate& limit = estimate_of(fit, "tire.bounded.cold_limit_degC");
  CHECK(limit.nuisance);
  CHECK(limit.value > -3.0);
  CHECK(limit.value < 9.0);
  CHECK(limit.sd <= 2.0);
  models::TireFile back = read_back(fit);
  CHECK(find_own(back.values.own, "cold_limit_degC") == Approx(limit.value + kZeroCelsius_K));
  CHECK(find_own(back.standard_uncertainties.own, "cold_limit_degC") == Approx(limit.sd));
}

TEST_CASE("every number of a fit starts within the range of its key and stays there", "[fast]") {
  MeasurementSet set = several_speeds_and_loads();
  for (double& sd : set.tire.standard_uncertainties.own.values) sd = 1e-3;
  set.tire.standard_uncertainties.rolling_resistance.pressure_exponent = 0.05;
  set.tire.standard_uncertainties.thermal.road_share_of_rest_conductance = 0.1;
  const auto unknowns = estimation::choose_unknowns(set, std::nullopt, false, true);
  models::Context<double> start = unknowns.start;
  std::size_t checked = 0;
  estimation::visit_parameters(start, [&](const std::string& table, const Field& field, double&) {
    for (const estimation::FreeParameter& parameter : unknowns.parameters) {
      if (parameter.key != table + "." + field.output_key()) continue;
      INFO(parameter.key);
      const Unit unit = unit_of_key(field.key);
      CHECK(parameter.lower_SI <= parameter.start_SI);
      CHECK(parameter.start_SI <= parameter.upper_SI);
      const double lower = unit.from_si(parameter.lower_SI);
      const double upper = unit.from_si(parameter.upper_SI);
      CHECK((std::isinf(lower) ? std::isinf(field.range.lower) : field.range.contains(lower)));
      CHECK((std::isinf(upper) ? std::isinf(field.range.upper) : field.range.contains(upper)));
      ++checked;
    }
  });
  CHECK(checked == unknowns.parameters.size());
}

TEST_CASE("where the data put a law outside what it allows, the fit goes back, and says so", "[fast]") {
  models::TireFile none = make_true_tire();  // whose loss falls with speed when it is hot
  put_own(none, "speed_rise", 0.1);
  put_own(none, "speed_rise_of_fall", 0.9);
  MeasurementSet set =
      tests::make_warm_up_set(none, {{55.0, 4100.0, 230.0}, {115.0, 4100.0, 230.0}}, "source", "quasi_static");
  REQUIRE_THROWS_AS(models::read_tire(parse_config(models::write_tire(none), "none")), InputError);
  set.tire = make_true_tire();
  const TireFit fit = fit_tire(set, {});
  CHECK_FALSE(has(fit, "tire.bounded.speed_rise_of_fall"));
  REQUIRE_FALSE(fit.warnings.empty());
  CHECK_THAT(fit.warnings[0], Catch::Contains("speed_rise_of_fall = 0"));
  models::TireFile back = read_back(fit);
  CHECK(find_own(back.values.own, "speed_rise_of_fall") == 0.0);
  CHECK(calc_rms(set, back) < calc_rms(set, make_true_tire()));
}

TEST_CASE("a map over load is refused for a law without lines over speed", "[fast]") {
  CHECK_THROWS_WITH(fit_tire(several_speeds_and_loads(), {"", true, false, 1}),
                    Catch::Contains("--load-map") && Catch::Contains("A0 to B1"));
}
