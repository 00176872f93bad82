#include "diagnosis/comparison/base_parameters.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/comparison/evidence.h"
#include "measurements/resimulation.h"
#include "models/tire/rolling_resistance.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using estimation::FreeParameter;

namespace {

constexpr double kSpeed_m_s = 80.0 / 3.6;

/// A set without runs: base parameters hang on the files alone.
measurements::MeasurementSet make_set() { return tests::make_gap_set({}, 0); }

std::map<std::string, FreeParameter> find(const measurements::MeasurementSet& set,
                                          diagnosis::TireBelief belief = diagnosis::TireBelief::kIdentified) {
  std::map<std::string, FreeParameter> by_key;
  for (const FreeParameter& parameter : diagnosis::find_base_parameters(set, measurements::make_context(set), belief)) {
    CHECK(by_key.emplace(parameter.key, parameter).second);
    CHECK(parameter.prior_sd_SI > 0.0);
  }
  return by_key;
}

/// Relative change of the tire's loss at 80 km/h and a temperature when a parameter moves by its uncertainty.
double find_change_of_loss(const measurements::MeasurementSet& set, const std::string& key, double temperature_K,
                           double load_N = 5400.0) {
  models::Context<double> context = measurements::make_context(set);
  const FreeParameter parameter = find(set).at(key);
  const auto loss_N = [&] {
    return models::calc_rolling_resistance_N(context.tire, kSpeed_m_s, load_N,
                                             context.tire.rolling_resistance.reference_pressure_Pa, temperature_K);
  };
  const double before = loss_N();
  estimation::find_parameter(context, key) += parameter.prior_sd_SI;
  return std::abs(loss_N() / before - 1.0);
}

}  // namespace

TEST_CASE("data that move one number move those that the tire's file correlates with it", "[fast]") {
  // The data see the tire's heat capacity, but hardly the gas's.
  auto set = tests::make_gap_set({}, 2);
  auto& sd = set.tire.standard_uncertainties.thermal;
  sd.heat_capacity_J_per_K = 1000.0;
  sd.gas_heat_capacity_J_per_K = 5.0;
  set.tire.values.thermal.heat_capacity_J_per_K -= 1500.0;  // the file's is too low
  const auto fit = [&set](double correlation) {
    set.tire.correlation = {{"thermal.heat_capacity_J_per_K", "thermal.gas_heat_capacity_J_per_K"},
                            {{1.0, correlation}, {correlation, 1.0}}};
    const tests::FittedBaseline fitted(set);
    const diagnosis::Model model = fitted.make_model({});
    const Eigen::MatrixXd moves = model.moves_by_unknowns();
    const Eigen::VectorXd moved = moves * fitted.null.fit.unknowns;
    const diagnosis::Evidence evidence(fitted.discrepancy, fitted.null.fit);
    const Eigen::MatrixXd covariance =
        moves * evidence.solve(fitted.null.amplitudes, true).covariance * moves.transpose();
    std::map<std::string, std::pair<double, double>> found;  // in prior standard deviations: the move, its sd
    for (std::size_t i = 0; i < model.base().size(); ++i) {
      const Eigen::Index k = diagnosis::to_index(i);
      found[model.base()[i].key] = {moved[k], std::sqrt(covariance(k, k))};
    }
    return std::pair{found.at("tire.thermal.heat_capacity_J_per_K"),
                     found.at("tire.thermal.gas_heat_capacity_J_per_K")};
  };
  const auto [tire_alone, gas_alone] = fit(0.0);
  const auto [tire, gas] = fit(0.9);
  const auto [tire_against, gas_against] = fit(-0.9);
  CHECK(tire_alone.first > 0.7);
  CHECK(std::abs(gas_alone.first) < 0.2);
  CHECK(gas_alone.second > 0.9);
  CHECK(gas.first == Approx(0.9 * tire.first).margin(0.2));
  CHECK(gas_against.first == Approx(-0.9 * tire_against.first).margin(0.2));
  CHECK(gas.second < 0.8 * gas_alone.second);
  CHECK(gas_against.second < 0.8 * gas_alone.second);
}

TEST_CASE("the identified numbers of tire and rig move, and no others", "[fast]") {
  std::set<std::string> keys;
  for (const auto& [key, parameter] : find(make_set())) keys.insert(key);
  const std::set<std::string> expected{"tire.rolling_resistance.A0_N",
                                       "tire.rolling_resistance.A1_N_s_per_m",
                                       "tire.rolling_resistance.B0_per_degC",
                                       "tire.rolling_resistance.B1_s_per_m_degC",
                                       "tire.thermal.heat_capacity_J_per_K",
                                       "tire.thermal.gas_heat_capacity_J_per_K",
                                       "tire.thermal.H_gas_W_per_K",
                                       "tire.thermal.z_W_per_K",
                                       "tire.thermal.f_W_s_per_m_K",
                                       "parasitic.c0_N",
                                       "parasitic.c1_N_s_per_m",
                                       "parasitic.c2_N_s2_per_m2"};
  CHECK(keys == expected);
}

TEST_CASE("defaults are shares of what they change at 80 km/h", "[fast]") {
  const auto set = make_set();
  CHECK(find_change_of_loss(set, "tire.rolling_resistance.A0_N", 273.15) == Approx(0.02).epsilon(0.01));
  CHECK(find_change_of_loss(set, "tire.rolling_resistance.A1_N_s_per_m", 273.15) == Approx(0.02).epsilon(0.01));
  const auto& rr = set.tire.values.rolling_resistance;
  const double fall_over_10_K = 10.0 * (rr.B0_per_K + rr.B1_s_per_m_K * kSpeed_m_s);
  for (const char* key : {"tire.rolling_resistance.B0_per_degC", "tire.rolling_resistance.B1_s_per_m_degC"}) {
    CHECK(find_change_of_loss(set, key, 283.15) == Approx(0.04 * fall_over_10_K).epsilon(0.02));
  }
  const auto base = find(set);
  const auto& thermal = set.tire.values.thermal;
  CHECK(base.at("tire.thermal.heat_capacity_J_per_K").prior_sd_SI == Approx(0.05 * thermal.heat_capacity_J_per_K));
  CHECK(base.at("tire.thermal.gas_heat_capacity_J_per_K").prior_sd_SI ==
        Approx(0.10 * thermal.gas_heat_capacity_J_per_K));
  CHECK(base.at("tire.thermal.H_gas_W_per_K").prior_sd_SI == Approx(0.15 * thermal.H_gas_W_per_K));
}

TEST_CASE("a parasitic loss is uncertain by a twentieth of each of its parts, and each by a hundredth of the whole",
          "[fast]") {
  auto set = make_set();
  const double parts_N[] = {6.0, 3.5, 2.5};  // at 80 km/h
  set.rig->parasitic = {parts_N[0], parts_N[1] / kSpeed_m_s, parts_N[2] / (kSpeed_m_s * kSpeed_m_s)};
  const auto base = find(set);
  double power = 1.0;
  const char* const keys[] = {"parasitic.c0_N", "parasitic.c1_N_s_per_m", "parasitic.c2_N_s2_per_m2"};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(base.at(keys[i]).prior_sd_SI * power == Approx(0.05 * parts_N[i] + 0.12));
    power *= kSpeed_m_s;
  }
}

TEST_CASE("numbers of the class count as known to a tenth to a third, and measured ones to the usual", "[fast]") {
  auto set = make_set();
  const auto usual = find(set);
  set.tire.basis = models::TireBasis::kClass;
  const auto of_class = find(set);
  REQUIRE(of_class.size() == usual.size());
  for (const auto& [key, parameter] : of_class) {
    INFO(key);
    const bool is_of_tire = key.rfind("tire.", 0) == 0;
    CHECK((parameter.prior_sd_SI > 1.9 * usual.at(key).prior_sd_SI) == is_of_tire);
  }
  CHECK(find_change_of_loss(set, "tire.rolling_resistance.A0_N", 273.15) == Approx(0.10).epsilon(0.01));
  CHECK_FALSE(diagnosis::is_tire_origin_open(set));
  set.tire.standard_uncertainties.rolling_resistance.A0_N = 0.123;
  CHECK(find(set).at("tire.rolling_resistance.A0_N").prior_sd_SI == 0.123);
}

TEST_CASE("a file that does not say where its numbers are from leaves open how well they are known", "[fast]") {
  using diagnosis::TireBelief;
  auto set = make_set();
  set.tire.basis = models::TireBasis::kUnknown;
  CHECK(diagnosis::is_tire_origin_open(set));
  auto of_class = set;
  of_class.tire.basis = models::TireBasis::kClass;
  for (const auto& [key, parameter] : find(of_class)) {
    INFO(key);
    CHECK(find(set, TireBelief::kClass).at(key).prior_sd_SI == parameter.prior_sd_SI);
    CHECK(find(set, TireBelief::kIdentified).at(key).prior_sd_SI == find(make_set()).at(key).prior_sd_SI);
  }
  // An uncertainty of one number of the loss speaks for the other numbers of the loss, and not for the heat balance.
  set.tire.standard_uncertainties.rolling_resistance.A0_N = 0.7;
  CHECK(diagnosis::is_tire_origin_open(set));
  const auto wide = find(set, TireBelief::kClass);
  const auto usual = find(set, TireBelief::kIdentified);
  CHECK(wide.at("tire.rolling_resistance.B0_per_degC").prior_sd_SI ==
        usual.at("tire.rolling_resistance.B0_per_degC").prior_sd_SI);
  CHECK(wide.at("tire.thermal.heat_capacity_J_per_K").prior_sd_SI >
        2.0 * usual.at("tire.thermal.heat_capacity_J_per_K").prior_sd_SI);
  set.tire.rig_thermal.begin()->second.rest_conductance_sd_W_per_K = 0.7;
  CHECK_FALSE(diagnosis::is_tire_origin_open(set));
}

TEST_CASE("an uncertainty of the file wins over the default", "[fast]") {
  auto set = make_set();
  auto& sd = set.tire.standard_uncertainties;
  sd.rolling_resistance.A0_N = 0.123;
  sd.thermal.heat_capacity_J_per_K = 77.0;
  set.rig->parasitic_uncertainties.c1_N_s_per_m = 0.011;
  const auto base = find(set);
  CHECK(base.at("tire.rolling_resistance.A0_N").prior_sd_SI == 0.123);
  CHECK(base.at("tire.thermal.heat_capacity_J_per_K").prior_sd_SI == 77.0);
  CHECK(base.at("parasitic.c1_N_s_per_m").prior_sd_SI == 0.011);
  CHECK(base.at("tire.rolling_resistance.A1_N_s_per_m").prior_sd_SI ==
        find(make_set()).at("tire.rolling_resistance.A1_N_s_per_m").prior_sd_SI);
}

TEST_CASE("a tire without conductances is as uncertain in them as the rig's cooling, in proportion to its area",
          "[fast]") {
  auto set = make_set();
  set.rig->tire_cooling = {10.0, 1.2};
  set.rig->tire_cooling_uncertainties = {0.5, 0.09};
  const double own_sd = find(set).at("tire.thermal.z_W_per_K").prior_sd_SI;  // of the tire: the rig's does not count
  set.tire.rig_thermal.clear();
  set.tire.values.thermal.rest_conductance_W_per_K = set.tire.values.thermal.speed_conductance_W_s_per_m_K = 0.0;
  const auto base = find(set);
  const double area_m2 = models::calc_outer_area_m2(set.tire.values.geometry);
  CHECK(base.at("tire.thermal.z_W_per_K").start_SI == Approx(10.0 * area_m2));
  CHECK(base.at("tire.thermal.z_W_per_K").prior_sd_SI == Approx(0.5 * area_m2));
  CHECK(base.at("tire.thermal.f_W_s_per_m_K").prior_sd_SI == Approx(0.09 * area_m2));
  CHECK(own_sd != Approx(0.5 * area_m2));
}

TEST_CASE("priors stand around the values of the files", "[fast]") {
  const auto set = make_set();
  models::Context<double> context = measurements::make_context(set);
  for (const auto& [key, parameter] : find(set)) {
    INFO(key);
    CHECK(parameter.start_SI == estimation::find_parameter(context, key));
  }
}

TEST_CASE("z and f are those of the set's rig, with its uncertainty", "[fast]") {
  auto set = make_set();
  set.tire.standard_uncertainties.thermal.rest_conductance_W_per_K = 9.0;
  auto& on_rig = set.tire.rig_thermal.at(set.rig->thermal_name());
  on_rig.rest_conductance_sd_W_per_K = 0.7;
  on_rig.speed_conductance_sd_W_s_per_m_K = 0.05;
  set.tire.rig_thermal["dyno_1m2"].rest_conductance_sd_W_per_K = 3.0;
  const auto base = find(set);
  CHECK(base.at("tire.thermal.z_W_per_K").start_SI == *on_rig.rest_conductance_W_per_K);
  CHECK(base.at("tire.thermal.z_W_per_K").prior_sd_SI == 0.7);
  CHECK(base.at("tire.thermal.f_W_s_per_m_K").start_SI == *on_rig.speed_conductance_W_s_per_m_K);
  CHECK(base.at("tire.thermal.f_W_s_per_m_K").prior_sd_SI == 0.05);
}

TEST_CASE("further numbers move only where the file gives an uncertainty", "[fast]") {
  auto set = make_set();
  set.tire.standard_uncertainties.rolling_resistance.pressure_exponent = 0.03;
  set.tire.standard_uncertainties.thermal.road_share_of_rest_conductance = 0.1;
  const auto base = find(set);
  CHECK(base.size() == find(make_set()).size() + 2);
  CHECK(base.at("tire.rolling_resistance.pressure_exponent").prior_sd_SI == 0.03);
  CHECK(base.at("tire.thermal.road_share_of_z").prior_sd_SI == 0.1);
}

TEST_CASE("a tire model's own numbers move by what the file gives, or by the share that the model declares", "[fast]") {
  auto set = make_set();
  set.tire.values.own = tests::make_own("two_node");
  set.tire.standard_uncertainties.own = tests::make_own("two_node");
  set.tire.standard_uncertainties.own.values = {0.05, 0.0, 0.0, 0.0};
  const auto base = find(set);
  CHECK(base.size() == find(make_set()).size() + 4);
  CHECK(base.at("tire.two_node.tread_share_of_heat_capacity").prior_sd_SI == 0.05);
  const FreeParameter& conductance = base.at("tire.two_node.conductance_W_per_K");
  const auto& declared = set.tire.values.model().info.parameters;
  CHECK(conductance.start_SI == set.tire.values.own[3]);
  CHECK(conductance.prior_sd_SI == Approx(declared[3].usual_sd * conductance.start_SI));
  set.tire.values.constant.rrc = 0.008;
  set.tire.has_constant = true;
  set.baseline = models::Baseline::kConstantRrc;  // does not use them
  for (const auto& [key, parameter] : find(set)) CHECK(key.rfind("tire.two_node.", 0) != 0);
}

TEST_CASE("with a map over load its lines move, each by its share, and not the lines that it replaces", "[fast]") {
  auto set = make_set();
  const models::SpeedLines<double> lines = set.tire.values.rolling_resistance;
  models::SpeedLines<double> low = lines;
  low.A0_N *= 0.5;
  low.A1_N_s_per_m *= 0.5;
  set.tire.values.load_map = {{low, 3000.0}, {lines, 5400.0}};
  set.tire.standard_uncertainties.load_map.resize(2);
  set.tire.standard_uncertainties.load_map[1].B0_per_K = 3e-4;
  set.tire.standard_uncertainties.rolling_resistance.A0_N = 0.5;  // of a line that the map replaces
  set.tire.standard_uncertainties.rolling_resistance.pressure_exponent = 0.03;
  const auto base = find(set);
  for (const char* table : {"tire.load_map.0.", "tire.load_map.1."}) {
    for (const char* key : {"A0_N", "A1_N_s_per_m", "B0_per_degC", "B1_s_per_m_degC"}) {
      INFO(table << key);
      CHECK(base.count(std::string(table) + key) == 1);
      CHECK(base.count(std::string("tire.rolling_resistance.") + key) == 0);
    }
  }
  CHECK(base.at("tire.load_map.1.B0_per_degC").prior_sd_SI == 3e-4);
  CHECK(find_change_of_loss(set, "tire.load_map.0.A0_N", 273.15, 3000.0) == Approx(0.02).epsilon(0.01));
  CHECK(find_change_of_loss(set, "tire.load_map.1.A0_N", 273.15, 5400.0) == Approx(0.02).epsilon(0.01));
  REQUIRE(base.count("tire.rolling_resistance.pressure_exponent") == 1);  // acts beside the map
}

TEST_CASE("a number that is zero can still move", "[fast]") {
  auto set = make_set();
  set.rig->parasitic.c2_N_s2_per_m2 = 0.0;
  set.tire.rig_thermal.at(set.rig->thermal_name()).rest_conductance_W_per_K = 0.0;
  const auto base = find(set);
  CHECK(base.at("parasitic.c2_N_s2_per_m2").prior_sd_SI > 0.0);
  CHECK(base.at("tire.thermal.z_W_per_K").prior_sd_SI > 0.0);
}
