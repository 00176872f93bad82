#include "estimation/tire_fit/class_priors.h"

#include <cmath>

#include <boost/math/constants/constants.hpp>

#include "models/tire/tire_file.h"
#include "models/tire/tire_model.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Numbers of the model bounded that have no size of their own in which a share could be told. Assumed.
const std::map<std::string, double>& list_bounded() {
  static const std::map<std::string, double> uncertainties{
      {"tire.bounded.speed_rise", 0.3}, {"tire.bounded.speed_rise_of_fall", 0.3}, {"tire.bounded.load_exponent", 0.1}};
  return uncertainties;
}

/// Usual heat capacity of the gas.
double calc_gas_J_per_K(const models::TireParameters<double>& tire) {
  using boost::math::constants::pi;
  constexpr double kCavityShare = 0.6;
  constexpr double kHeatPerGasConstant = 2.5;  // of air at constant volume
  constexpr double kFilled_K = 298.15;
  const models::TireGeometry<double>& g = tire.geometry;
  const double around_rim_m3 = pi<double>() / 4.0 *
                               (g.outer_diameter_m * g.outer_diameter_m - g.rim_diameter_m * g.rim_diameter_m) *
                               g.section_width_m;
  const double pressure_Pa = tire.rolling_resistance.reference_pressure_Pa + kStandardAtmosphere_Pa;
  return kHeatPerGasConstant * pressure_Pa * kCavityShare * around_rim_m3 / kFilled_K;
}

void add_heat_balance(const models::TireParameters<double>& tire, std::map<std::string, double>& sd) {
  constexpr double kPerMass_J_per_kg_K = 0.3 * 1640.0;
  constexpr double kPerArea_W_per_m2_K = 0.3 * 4.1;
  constexpr double kPerArea_W_s_per_m3_K = 0.25 * 1.27;
  constexpr double kGasShare = 0.15;
  const double area_m2 = models::calc_outer_area_m2(tire.geometry);
  sd["tire.thermal.heat_capacity_J_per_K"] = kPerMass_J_per_kg_K * tire.geometry.mass_kg;
  sd["tire.thermal.gas_heat_capacity_J_per_K"] = kGasShare * calc_gas_J_per_K(tire);
  sd["tire.thermal.H_gas_W_per_K"] = kPerArea_W_per_m2_K * area_m2;
  sd["tire.thermal.f_W_s_per_m_K"] = kPerArea_W_s_per_m3_K * area_m2;
}

void add_lines_of_class(const models::SpeedLines<double>& lines, double speed_m_s, std::map<std::string, double>& sd) {
  constexpr double kShare = 0.3;
  constexpr double kReference_m_s = 80.0 / 3.6;
  const double loss_N = std::abs(lines.A0_N + lines.A1_N_s_per_m * speed_m_s);
  const double fall_per_K = std::abs(lines.B0_per_K + lines.B1_s_per_m_K * speed_m_s);
  sd["tire.rolling_resistance.A1_N_s_per_m"] = kShare * loss_N / kReference_m_s;
  sd["tire.rolling_resistance.B1_s_per_m_degC"] = kShare * fall_per_K / kReference_m_s;
}

}  // namespace

std::map<std::string, double> find_class_uncertainties(const models::TireParameters<double>& tire,
                                                       double level_speed_m_s) {
  std::map<std::string, double> sd = list_bounded();
  const models::TireModelInfo& model = tire.model().info;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const models::TireModelParameter& own = model.parameters[i];
    sd.emplace("tire." + model.id + "." + own.field.output_key(), own.usual_sd * std::abs(tire.own[i]));
  }
  add_heat_balance(tire, sd);
  if (model.follows_speed_lines()) add_lines_of_class(tire.rolling_resistance, level_speed_m_s, sd);
  constexpr double kPressureExponent = 0.06;
  sd["tire.rolling_resistance.pressure_exponent"] = kPressureExponent;
  return sd;
}

}  // namespace rollrig::estimation
