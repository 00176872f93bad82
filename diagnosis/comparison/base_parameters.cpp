#include "diagnosis/comparison/base_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "models/tire/tire_model.h"

namespace rollrig::diagnosis {
namespace {

using estimation::FreeParameter;

constexpr double kReferenceSpeed_m_s = 80.0 / 3.6;

void add_lines(const std::string& table, const models::SpeedLines<double>& lines, std::map<std::string, double>& sd) {
  const double loss_N = std::abs(lines.A0_N + lines.A1_N_s_per_m * kReferenceSpeed_m_s);
  const double fall_per_K = std::abs(lines.B0_per_K + lines.B1_s_per_m_K * kReferenceSpeed_m_s);
  sd[table + "A0_N"] = 0.02 * loss_N;
  sd[table + "A1_N_s_per_m"] = 0.02 * loss_N / kReferenceSpeed_m_s;
  sd[table + "B0_per_degC"] = 0.04 * fall_per_K;
  sd[table + "B1_s_per_m_degC"] = 0.04 * fall_per_K / kReferenceSpeed_m_s;
}

void add_heat_balance(const models::TireThermalParameters<double>& thermal, std::map<std::string, double>& sd) {
  const double cooling_W_per_K = models::calc_cooling_W_per_K(thermal, kReferenceSpeed_m_s);
  sd["tire.thermal.heat_capacity_J_per_K"] = 0.05 * thermal.heat_capacity_J_per_K;
  sd["tire.thermal.gas_heat_capacity_J_per_K"] = 0.10 * thermal.gas_heat_capacity_J_per_K;
  sd["tire.thermal.H_gas_W_per_K"] = 0.15 * thermal.H_gas_W_per_K;
  sd["tire.thermal.z_W_per_K"] = 0.08 * std::max(thermal.rest_conductance_W_per_K, 0.1 * cooling_W_per_K);
  sd["tire.thermal.f_W_s_per_m_K"] =
      0.08 * std::max(thermal.speed_conductance_W_s_per_m_K, 0.1 * cooling_W_per_K / kReferenceSpeed_m_s);
}

void put_given(const std::string& key, double sd_SI, Uncertainties& uncertainties) {
  if (sd_SI > 0.0) uncertainties.given[key] = sd_SI;
}

/// Puts the standard uncertainties of a table that a file gives.
template <class Group>
void add_given(const std::string& table, const Group& sd, Uncertainties& uncertainties) {
  Group::visit(sd,
               [&](const Field& field, double sd_SI) { put_given(table + field.output_key(), sd_SI, uncertainties); });
}

}  // namespace

void add_tire(const models::TireFile& tire, const models::CoolingRig& rig, const models::Context<double>& context,
              bool heat_is_seen, Uncertainties& uncertainties) {
  const models::TireModelInfo& model = context.tire.model().info;
  const auto enters = [&](const std::string& table) {
    return model.uses(table) && (heat_is_seen || table != "thermal");
  };
  auto& usual = uncertainties.usual;
  const auto& map = context.tire.load_map;
  if (enters("rolling_resistance") && model.has_speed_lines && map.empty()) {
    add_lines("tire.rolling_resistance.", context.tire.rolling_resistance, usual);
  }
  for (std::size_t i = 0; i < map.size() && enters("load_map"); ++i)
    add_lines(fmt::format("tire.load_map.{}.", i), map[i], usual);
  if (enters("constant")) usual["tire.constant.rrc_N_per_kN"] = 0.05 * context.tire.constant.rrc;
  if (enters("thermal")) add_heat_balance(context.tire.thermal, usual);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const models::TireModelParameter& own = model.parameters[i];
    usual["tire." + model.id + "." + own.field.output_key()] = own.usual_sd * std::abs(context.tire.own[i]);
  }
  const models::TireParameters<double> given = tire.standard_uncertainties_on(rig);
  models::TireParameters<double>::visit_all(given, [&](const std::string& table, const Field& field, double sd_SI) {
    const bool has_map_instead =
        table == "rolling_resistance" && usual.count(std::string("tire.load_map.0.") + field.key) == 1;
    if (enters(table) && !has_map_instead) put_given("tire." + table + "." + field.output_key(), sd_SI, uncertainties);
  });
  uncertainties.correlated = models::list_correlated_pairs(tire, rig.name);
}

void add_parasitic_loss(const rigs::RigFile& file, Uncertainties& uncertainties) {
  add_given("parasitic.", file.parasitic_uncertainties, uncertainties);
  const auto& rig = file.parasitic;
  const double parasitic_N = models::calc_parasitic_N(rig, kReferenceSpeed_m_s);
  auto& usual = uncertainties.usual;
  usual["parasitic.c0_N"] = 0.05 * rig.c0_N + 0.01 * parasitic_N;
  usual["parasitic.c1_N_s_per_m"] = 0.05 * rig.c1_N_s_per_m + 0.01 * parasitic_N / kReferenceSpeed_m_s;
  usual["parasitic.c2_N_s2_per_m2"] =
      0.05 * rig.c2_N_s2_per_m2 + 0.01 * parasitic_N / (kReferenceSpeed_m_s * kReferenceSpeed_m_s);
}

void add_vehicle(const rigs::VehicleFile& file, Uncertainties& uncertainties) {
  add_given("vehicle.", file.uncertainties, uncertainties);
  uncertainties.usual["vehicle.mass_kg"] = 0.03 * file.body.mass_kg;
  uncertainties.usual["vehicle.rotating_mass_kg"] = 0.3 * file.body.rotating_mass_kg;
  uncertainties.usual["vehicle.drag_area_m2"] = 0.05 * file.body.drag_area_m2;
}

std::vector<FreeParameter> find_base_parameters(const measurements::MeasurementSet& set,
                                                const models::Context<double>& context) {
  const Uncertainties uncertainties = kind_of(set).find_uncertainties(set, context);
  std::map<std::string, double> sd = uncertainties.given;
  for (const auto& [key, value] : uncertainties.usual) sd.emplace(key, value);
  models::Context<double> at = context;
  std::vector<FreeParameter> parameters;
  for (const auto& [key, value] : sd) {
    const double start = estimation::find_parameter(at, key);
    if (value > 0.0) parameters.push_back({key, start, value});
  }
  estimation::put_correlations(uncertainties.correlated, parameters);
  return parameters;
}

}  // namespace rollrig::diagnosis
