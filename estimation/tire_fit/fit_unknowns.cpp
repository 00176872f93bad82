#include "estimation/tire_fit/fit_unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "measurements/sample_selection.h"
#include "models/tire/tire_model.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

/// Loads at which the set rolls. Assumed: each at least a minute; near ones (2 %) are one.
std::vector<double> find_loads_N(const measurements::MeasurementSet& set) {
  constexpr double kSameLoad = 0.02;      // Assumed
  constexpr double kLongEnough_s = 60.0;  // Assumed
  std::map<double, double> seconds_by_load;
  for (const measurements::MeasuredRun& run : set.runs) {
    const std::vector<double>& load_N = run.column(models::quantities::kLoad);
    for (std::size_t row = 0; row + 1 < load_N.size(); ++row) {
      if (load_N[row] < measurements::kLoadedShare * set.tire.values.rolling_resistance.reference_load_N) continue;
      seconds_by_load[load_N[row]] += run.time_s[row + 1] - run.time_s[row];
    }
  }
  std::vector<double> loads_N;
  double group_s = 0.0;
  for (const auto& [load_N, seconds] : seconds_by_load) {
    const bool same = !loads_N.empty() && load_N - loads_N.back() <= kSameLoad * load_N;
    if (!same) {
      if (!loads_N.empty() && group_s < kLongEnough_s) loads_N.pop_back();
      loads_N.push_back(load_N);
      group_s = 0.0;
    }
    group_s += seconds;
  }
  if (!loads_N.empty() && group_s < kLongEnough_s) loads_N.pop_back();
  return loads_N;
}

using Lines = models::SpeedLines<double>;

/// The context from which the fit starts: the files', with the two-step estimate put in.
models::Context<double> make_start_context(const measurements::MeasurementSet& set, const TwoStepEstimate& start,
                                           const std::vector<double>& map_loads_N) {
  models::Context<double> context = rigs::make_context(set.tire, *set.rig, models::Baseline::kCombined);
  Lines& lines = context.tire.rolling_resistance;
  lines = start;
  context.tire.thermal.rest_conductance_W_per_K = std::max(0.0, start.rest_conductance_W_per_K);
  context.tire.thermal.speed_conductance_W_s_per_m_K = std::max(0.0, start.speed_conductance_W_s_per_m_K);
  if (start.H_gas_W_per_K.has_value()) context.tire.thermal.H_gas_W_per_K = std::max(0.1, *start.H_gas_W_per_K);
  context.tire.load_map.clear();
  for (const double load_N : map_loads_N) {
    const double share = load_N / context.tire.rolling_resistance.reference_load_N;
    context.tire.load_map.push_back({lines, load_N});
    context.tire.load_map.back().A0_N *= share;
    context.tire.load_map.back().A1_N_s_per_m *= share;
  }
  return context;
}

void add_free(FitUnknowns& unknowns, const std::string& key, double lower_SI, double sd_SI) {
  unknowns.parameters.push_back({key, find_parameter(unknowns.start, key), sd_SI, lower_SI});
}

/// Nuisances: what the files give with an uncertainty and the fit does not ask for.
void add_nuisances(const measurements::MeasurementSet& set, FitUnknowns& unknowns) {
  std::set<std::string> asked_for;
  for (const Field& line : list_fields<Lines>()) asked_for.insert(line.key);
  for (const FreeParameter& parameter : unknowns.parameters) asked_for.insert(last_part(parameter.key));
  const auto add = [&](const std::string& key, double sd) {
    if (sd > 0.0 && asked_for.count(last_part(key)) == 0) add_free(unknowns, key, 0.0, sd);
  };
  for (const std::string& table :
       {std::string("thermal"), std::string("rolling_resistance"), unknowns.start.tire.model().info.id}) {
    models::TireParameters<double>::visit_all(set.tire.standard_uncertainties,
                                              [&](const std::string& of, const Field& field, const double& sd) {
                                                if (of == table) add("tire." + of + "." + field.output_key(), sd);
                                              });
  }
  models::ParasiticParameters<double>::visit(
      set.rig->parasitic_uncertainties,
      [&](const Field& field, const double& sd) { add(std::string("parasitic.") + field.key, sd); });
}

}  // namespace

FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const TwoStepEstimate& start, bool load_map,
                            bool free_H) {
  constexpr double kNoBound = -std::numeric_limits<double>::infinity();
  FitUnknowns unknowns;
  unknowns.start = make_start_context(set, start, load_map ? find_loads_N(set) : std::vector<double>{});
  const auto& map = unknowns.start.tire.load_map;
  std::vector<std::string> tables{"tire.rolling_resistance."};
  if (!map.empty()) tables.clear();
  for (std::size_t i = 0; i < map.size(); ++i) tables.push_back(fmt::format("tire.load_map.{}.", i));
  for (const std::string& table : tables) {
    for (const Field& line : list_fields<Lines>()) add_free(unknowns, table + line.key, kNoBound, 0.0);
  }
  add_free(unknowns, "tire.thermal.z_W_per_K", 0.0, 0.0);
  add_free(unknowns, "tire.thermal.f_W_s_per_m_K", 0.0, 0.0);
  if (free_H) add_free(unknowns, "tire.thermal.H_gas_W_per_K", 1e-3, 0.0);
  unknowns.asked_for = unknowns.parameters.size();
  add_nuisances(set, unknowns);
  return unknowns;
}

}  // namespace rollrig::estimation
