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
  constexpr double kHeatCapacityShare = 0.3;
  constexpr double kPerArea_W_per_m2_K = 0.3 * 4.1;
  constexpr double kPerArea_W_s_per_m3_K = 0.25 * 1.27;
  constexpr double kGasShare = 0.15;
  const double area_m2 = models::calc_outer_area_m2(tire.geometry);
  sd["tire.thermal.heat_capacity_J_per_K"] = kHeatCapacityShare * find_usual_heat_capacity_J_per_K(tire);
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

/// Numbers of the tire's own model, by the share that the model declares of their usual size.
void add_numbers_of_model(const models::TireParameters<double>& tire, std::map<std::string, double>& sd) {
  constexpr double kUsualArea_m2 = 0.93;  // Assumed: of a passenger car's tire, 225/55 R17
  const models::TireModelInfo& model = tire.model().info;
  for (const models::TireModelParameter& own : model.parameters) {
    const Unit unit = unit_of_key(own.field.key);
    double usual_SI = std::abs(unit.factor * own.usual);
    if (unit.symbol == "W/K") usual_SI *= models::calc_outer_area_m2(tire.geometry) / kUsualArea_m2;
    sd.emplace("tire." + model.id + "." + own.field.output_key(), own.usual_sd * usual_SI);
  }
}

}  // namespace

std::map<std::string, double> find_class_uncertainties(const models::TireParameters<double>& tire,
                                                       double level_speed_m_s) {
  std::map<std::string, double> sd = list_bounded();
  add_numbers_of_model(tire, sd);
  add_heat_balance(tire, sd);
  if (tire.model().info.follows_speed_lines()) add_lines_of_class(tire.rolling_resistance, level_speed_m_s, sd);
  constexpr double kPressureExponent = 0.06;
  sd["tire.rolling_resistance.pressure_exponent"] = kPressureExponent;
  return sd;
}

double find_usual_heat_capacity_J_per_K(const models::TireParameters<double>& tire) {
  constexpr double kPerMass_J_per_kg_K = 1640.0;
  return kPerMass_J_per_kg_K * tire.geometry.mass_kg;
}

}  // namespace rollrig::estimation
