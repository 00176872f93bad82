#include "diagnosis/comparison/base_parameters.h"

#include <cmath>
#include <functional>

#include "diagnosis/kinds/measurement_kind.h"

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

/// Whether a key names one of the lines over speed that a map over load replaces.
bool is_replaced_by_map(const std::string& key) {
  constexpr const char* kTable = "tire.rolling_resistance.";
  bool replaced = false;
  models::SpeedLines<double> lines;
  models::SpeedLines<double>::visit(
      lines, [&](const Field& field, double&) { replaced = replaced || key == std::string(kTable) + field.key; });
  return replaced;
}

using Put = std::function<void(const std::string& key, double sd_SI)>;

/// Puts a standard uncertainty where a file gives one.
Put put_given(Uncertainties& uncertainties) {
  return [&uncertainties](const std::string& key, double sd_SI) {
    if (sd_SI > 0.0) uncertainties.given[key] = sd_SI;
  };
}

}  // namespace

void add_loss_law(const models::TireFile& tire, const models::Context<double>& context, Uncertainties& uncertainties) {
  const Put put = put_given(uncertainties);
  if (context.baseline == models::Baseline::kConstantRrc) {
    put("tire.constant.rrc_N_per_kN", tire.standard_uncertainties.constant.rrc);
    uncertainties.usual["tire.constant.rrc_N_per_kN"] = 0.05 * context.tire.constant.rrc;
    return;
  }
  models::RollingResistanceParameters<double>::visit(
      tire.standard_uncertainties.rolling_resistance, [&](const Field& field, const double& member) {
        put(std::string("tire.rolling_resistance.") + field.output_key(), member);
      });
  for (std::size_t i = 0; i < tire.standard_uncertainties.load_map.size(); ++i) {
    models::LoadMapEntry<double>::visit(tire.standard_uncertainties.load_map[i],
                                        [&](const Field& field, const double& member) {
                                          put("tire.load_map." + std::to_string(i) + "." + field.key, member);
                                        });
  }
  auto& usual = uncertainties.usual;
  if (context.tire.load_map.empty()) add_lines("tire.rolling_resistance.", context.tire.rolling_resistance, usual);
  for (std::size_t i = 0; i < context.tire.load_map.size(); ++i) {
    add_lines("tire.load_map." + std::to_string(i) + ".", context.tire.load_map[i], usual);
  }
}

void add_heat_balance(const models::TireFile& tire, const std::string& rig, const models::Context<double>& context,
                      Uncertainties& uncertainties) {
  const Put put = put_given(uncertainties);
  models::TireThermalParameters<double>::visit(tire.standard_uncertainties.thermal,
                                               [&](const Field& field, const double& member) {
                                                 put(std::string("tire.thermal.") + field.output_key(), member);
                                               });
  const auto on_rig = tire.rig_thermal.find(rig);
  if (on_rig != tire.rig_thermal.end()) {
    put("tire.thermal.z_W_per_K", on_rig->second.rest_conductance_sd_W_per_K.value_or(0.0));
    put("tire.thermal.f_W_s_per_m_K", on_rig->second.speed_conductance_sd_W_s_per_m_K.value_or(0.0));
  }
  const auto& thermal = context.tire.thermal;
  auto& usual = uncertainties.usual;
  usual["tire.thermal.heat_capacity_J_per_K"] = 0.05 * thermal.heat_capacity_J_per_K;
  usual["tire.thermal.gas_heat_capacity_J_per_K"] = 0.10 * thermal.gas_heat_capacity_J_per_K;
  usual["tire.thermal.H_gas_W_per_K"] = 0.15 * thermal.H_gas_W_per_K;
  const double cooling_W_per_K = models::calc_cooling_W_per_K(thermal, kReferenceSpeed_m_s);
  usual["tire.thermal.z_W_per_K"] = 0.08 * std::max(thermal.rest_conductance_W_per_K, 0.1 * cooling_W_per_K);
  usual["tire.thermal.f_W_s_per_m_K"] =
      0.08 * std::max(thermal.speed_conductance_W_s_per_m_K, 0.1 * cooling_W_per_K / kReferenceSpeed_m_s);
}

void add_parasitic_loss(const rigs::RigFile& file, Uncertainties& uncertainties) {
  const Put put = put_given(uncertainties);
  models::ParasiticParameters<double>::visit(
      file.parasitic_uncertainties,
      [&](const Field& field, const double& member) { put(std::string("parasitic.") + field.key, member); });
  const auto& rig = file.parasitic;
  const double parasitic_N = models::calc_parasitic_N(rig, kReferenceSpeed_m_s);
  auto& usual = uncertainties.usual;
  usual["parasitic.c0_N"] = 0.05 * rig.c0_N + 0.01 * parasitic_N;
  usual["parasitic.c1_N_s_per_m"] = 0.05 * rig.c1_N_s_per_m + 0.01 * parasitic_N / kReferenceSpeed_m_s;
  usual["parasitic.c2_N_s2_per_m2"] =
      0.05 * rig.c2_N_s2_per_m2 + 0.01 * parasitic_N / (kReferenceSpeed_m_s * kReferenceSpeed_m_s);
}

void add_vehicle(const rigs::VehicleFile& file, Uncertainties& uncertainties) {
  const Put put = put_given(uncertainties);
  rigs::VehicleBody::visit(file.uncertainties, [&](const Field& field, const double& member) {
    put(std::string("vehicle.") + field.key, member);
  });
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
    if (!context.tire.load_map.empty() && is_replaced_by_map(key)) continue;
    const double start = estimation::find_parameter(at, key);
    if (value > 0.0) parameters.push_back({key, start, value});
  }
  return parameters;
}

}  // namespace rollrig::diagnosis
