#include "diagnosis/comparison/base_parameters.h"

#include <fmt/format.h>

#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/resimulation.h"
#include "models/tire/tire_model.h"

namespace rollrig::diagnosis {
namespace {

using estimation::FreeParameter;

constexpr double kReferenceSpeed_m_s = 80.0 / 3.6;

using Deviations = std::map<std::string, double>;

void add_lines(const std::string& table, const models::SpeedLines<double>& lines, const TireShares& shares,
               Deviations& sd) {
  const double loss_N = std::abs(lines.A0_N + lines.A1_N_s_per_m * kReferenceSpeed_m_s);
  const double fall_per_K = std::abs(lines.B0_per_K + lines.B1_s_per_m_K * kReferenceSpeed_m_s);
  sd[table + "A0_N"] = shares.loss * loss_N;
  sd[table + "A1_N_s_per_m"] = shares.loss * loss_N / kReferenceSpeed_m_s;
  sd[table + "B0_per_degC"] = shares.fall * fall_per_K;
  sd[table + "B1_s_per_m_degC"] = shares.fall * fall_per_K / kReferenceSpeed_m_s;
}

void add_heat_balance(const models::TireThermalParameters<double>& thermal, const TireShares& shares, Deviations& sd) {
  const double cooling_W_per_K = models::calc_cooling_W_per_K(thermal, kReferenceSpeed_m_s);
  sd["tire.thermal.heat_capacity_J_per_K"] = shares.heat_capacity * thermal.heat_capacity_J_per_K;
  sd["tire.thermal.gas_heat_capacity_J_per_K"] = shares.gas_heat_capacity * thermal.gas_heat_capacity_J_per_K;
  sd["tire.thermal.H_gas_W_per_K"] = shares.gas_transfer * thermal.H_gas_W_per_K;
  sd["tire.thermal.z_W_per_K"] = shares.conductance * std::max(thermal.rest_conductance_W_per_K, 0.1 * cooling_W_per_K);
  sd["tire.thermal.f_W_s_per_m_K"] =
      shares.conductance * std::max(thermal.speed_conductance_W_s_per_m_K, 0.1 * cooling_W_per_K / kReferenceSpeed_m_s);
}

/// Of all numbers that the tire's model uses.
Deviations assume_tire(const models::TireParameters<double>& tire, bool heat_is_seen, const TireShares& shares) {
  const models::TireModelInfo& model = tire.model().info;
  Deviations sd;
  if (model.uses("rolling_resistance") && model.has_speed_lines && tire.load_map.empty())
    add_lines("tire.rolling_resistance.", tire.rolling_resistance, shares, sd);
  for (std::size_t i = 0; i < tire.load_map.size() && model.uses("load_map"); ++i)
    add_lines(fmt::format("tire.load_map.{}.", i), tire.load_map[i], shares, sd);
  if (model.uses("constant")) sd["tire.constant.rrc_N_per_kN"] = shares.coefficient * tire.constant.rrc;
  if (model.uses("thermal") && heat_is_seen) add_heat_balance(tire.thermal, shares, sd);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const models::TireModelParameter& own = model.parameters[i];
    sd["tire." + model.id + "." + own.field.output_key()] = shares.own * own.usual_sd * std::abs(tire.own[i]);
  }
  return sd;
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
  for (const auto& [key, sd] : assume_tire(context.tire, heat_is_seen, kIdentifiedTire)) usual[key] = sd;
  const models::TireParameters<double> given = tire.standard_uncertainties_on(rig);
  models::TireParameters<double>::visit_all(given, [&](const std::string& table, const Field& field, double sd_SI) {
    const bool has_map_instead =
        table == "rolling_resistance" && usual.count(std::string("tire.load_map.0.") + field.key) == 1;
    if (enters(table) && !has_map_instead) put_given("tire." + table + "." + field.output_key(), sd_SI, uncertainties);
  });
  uncertainties.correlated = models::list_correlated_pairs(tire, rig.name);
  const bool is_open = tire.basis == models::TireBasis::kUnknown;
  if (tire.basis == models::TireBasis::kMeasured) return;
  for (const auto& [key, sd] : assume_tire(context.tire, heat_is_seen, kClassTire)) {
    const bool is_of_heat = key.rfind("tire.thermal.", 0) == 0;
    if (uncertainties.given.count(key) > 0 || (is_open && tire.gives_uncertainty_of(is_of_heat))) continue;
    uncertainties.of_class[key] = sd;
    uncertainties.is_origin_open = is_open;
  }
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

namespace {

struct Known {
  double sd_SI = 0.0;
  rollrig::SdSource source = rollrig::SdSource::kUsual;
};

/// What holds for each number: an uncertainty of the file before all, then one of the class where it is believed.
std::map<std::string, Known> choose_known(const Uncertainties& all, TireBelief belief) {
  const bool is_class = belief == TireBelief::kClass || !all.is_origin_open;
  std::map<std::string, Known> chosen;
  for (const auto& [key, sd] : all.given) chosen[key] = {sd, rollrig::SdSource::kFile};
  for (const auto& [key, sd] : all.of_class) {
    if (is_class) chosen.emplace(key, Known{sd, rollrig::SdSource::kClass});
  }
  for (const auto& [key, sd] : all.usual) chosen.emplace(key, Known{sd, rollrig::SdSource::kUsual});
  return chosen;
}

}  // namespace

std::vector<FreeParameter> find_base_parameters(const measurements::MeasurementSet& set,
                                                const models::Context<double>& context, TireBelief belief) {
  const Uncertainties uncertainties = kind_of(set).find_uncertainties(set, context);
  models::Context<double> at = context;
  std::vector<FreeParameter> parameters;
  for (const auto& [key, known] : choose_known(uncertainties, belief)) {
    const double start = estimation::find_parameter(at, key);
    if (known.sd_SI > 0.0) parameters.push_back({key, start, known.sd_SI});
  }
  estimation::put_correlations(uncertainties.correlated, parameters);
  return parameters;
}

std::map<std::string, rollrig::SdSource> find_sd_sources(const measurements::MeasurementSet& set,
                                                         const models::Context<double>& context, TireBelief belief) {
  std::map<std::string, rollrig::SdSource> sources;
  for (const auto& [key, known] : choose_known(kind_of(set).find_uncertainties(set, context), belief)) {
    sources[key] = known.source;
  }
  return sources;
}

bool is_tire_origin_open(const measurements::MeasurementSet& set) {
  return kind_of(set).find_uncertainties(set, measurements::make_context(set)).is_origin_open;
}

}  // namespace rollrig::diagnosis
