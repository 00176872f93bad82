#include "estimation/tire_fit/fit_unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "estimation/tire_fit/class_priors.h"
#include "estimation/tire_fit/set_variety.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

using Lines = models::SpeedLines<double>;

/// The context from which the fit of speed lines starts: the files', with the two-step estimate put in.
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

/// A0 and B0, and with several speeds A1 and B1; at each load of a map.
void add_speed_lines(FitUnknowns& unknowns, bool several_speeds) {
  constexpr double kNoBound = -std::numeric_limits<double>::infinity();
  const auto& map = unknowns.start.tire.load_map;
  std::vector<std::string> tables{"tire.rolling_resistance."};
  if (!map.empty()) tables.clear();
  for (std::size_t i = 0; i < map.size(); ++i) tables.push_back(fmt::format("tire.load_map.{}.", i));
  std::vector<std::string> lines{"A0_N", "A1_N_s_per_m", "B0_per_degC", "B1_s_per_m_degC"};
  if (!several_speeds) lines = {"A0_N", "B0_per_degC"};
  for (const std::string& table : tables) {
    for (const std::string& line : lines) add_free(unknowns, table + line, kNoBound, 0.0);
  }
}

/// Adds a number within the range of its field. A bound that is not allowed itself is kept off by a little.
void add_in_range(FitUnknowns& unknowns, const std::string& key, const Field& field, double sd_SI) {
  constexpr double kOff = 1e-6;  // Assumed: of the way from the bound to the start
  const Unit unit = unit_of_key(field.key);
  const double start_SI = find_parameter(unknowns.start, key);
  const auto find_bound = [&](double bound, bool open) {
    const double bound_SI = unit.to_si(bound);
    return open && std::isfinite(bound_SI) ? bound_SI + kOff * (start_SI - bound_SI) : bound_SI;
  };
  unknowns.parameters.push_back({key, start_SI, sd_SI, find_bound(field.range.lower, field.range.lower_open),
                                 find_bound(field.range.upper, field.range.upper_open)});
}

void add_gas_transfer(FitUnknowns& unknowns) {
  const std::string wanted = "H_gas_W_per_K";
  const auto add = [&](const Field& field, const double&) {
    if (field.output_key() == wanted) add_in_range(unknowns, "tire.thermal." + wanted, field, 0.0);
  };
  models::TireThermalParameters<double>::visit(unknowns.start.tire.thermal, add);
}

bool asks_for(models::FitRole role, const Variety& variety) {
  switch (role) {
    case models::FitRole::kHeld:
      return false;
    case models::FitRole::kFree:
      return true;
    case models::FitRole::kFreeOverSpeeds:
    case models::FitRole::kFreeOverSpeedsWithinLaw:
      return variety.speeds;
    case models::FitRole::kFreeOverLoads:
      return variety.loads;
  }
  return false;
}

std::string make_own_key(const models::TireModelInfo& model, const models::TireModelParameter& own) {
  return "tire." + model.id + "." + own.field.output_key();
}

void add_own_numbers(FitUnknowns& unknowns, const Variety& variety) {
  const models::TireModelInfo& model = unknowns.start.tire.model().info;
  for (const models::TireModelParameter& own : model.parameters) {
    if (asks_for(own.role, variety)) add_in_range(unknowns, make_own_key(model, own), own.field, 0.0);
  }
}

/// Standard uncertainties of the tire's numbers on the rig of the set, by key; 0 where no file gives one.
std::map<std::string, double> list_given(const measurements::MeasurementSet& set) {
  std::map<std::string, double> given;
  const models::TireParameters<double> uncertainties = set.tire.standard_uncertainties_on(set.rig->cooling_rig());
  models::TireParameters<double>::visit_all(uncertainties,
                                            [&](const std::string& table, const Field& field, const double& sd) {
                                              given["tire." + table + "." + field.output_key()] = sd;
                                            });
  return given;
}

/// Numbers of the tire for which the fit does not ask, each within the uncertainty of its file or else of its class.
void add_tire_nuisances(const measurements::MeasurementSet& set, double level_speed_m_s, FitUnknowns& unknowns) {
  std::set<std::string> asked_for;
  for (const FreeParameter& parameter : unknowns.parameters) asked_for.insert(last_part(parameter.key));
  const models::TireParameters<double>& start = unknowns.start.tire;
  const std::map<std::string, double> given = list_given(set);
  const std::map<std::string, double> of_class = find_class_uncertainties(start, level_speed_m_s);
  const auto find_in = [](const std::map<std::string, double>& sds, const std::string& key) {
    const auto found = sds.find(key);
    return found == sds.end() ? 0.0 : found->second;
  };
  for (const std::string& table : {std::string("thermal"), std::string("rolling_resistance"), start.model().info.id}) {
    models::TireParameters<double>::visit_all(start, [&](const std::string& of, const Field& field, const double&) {
      if (of != table || asked_for.count(field.output_key()) == 1) return;
      const std::string key = "tire." + of + "." + field.output_key();
      const double given_sd = find_in(given, key);
      const double sd = given_sd > 0.0 ? given_sd : find_in(of_class, key);
      if (!(sd > 0.0)) return;
      add_in_range(unknowns, key, field, sd);
      if (!(given_sd > 0.0)) unknowns.of_class.insert(key);
    });
  }
}

void add_rig_nuisances(const measurements::MeasurementSet& set, FitUnknowns& unknowns) {
  models::ParasiticParameters<double>::visit(
      set.rig->parasitic_uncertainties, [&](const Field& field, const double& sd) {
        if (sd > 0.0) add_in_range(unknowns, std::string("parasitic.") + field.output_key(), field, sd);
      });
}

/// Holds at its usual value what is free within the law only. Returns "key = value" of each.
std::vector<std::string> hold_at_usual(FitUnknowns& unknowns) {
  std::vector<std::string> held;
  auto& parameters = unknowns.parameters;
  const models::TireModelInfo& model = unknowns.start.tire.model().info;
  for (const models::TireModelParameter& own : model.parameters) {
    const std::string key = make_own_key(model, own);
    const auto at =
        std::find_if(parameters.begin(), parameters.end(), [&](const FreeParameter& p) { return p.key == key; });
    if (own.role != models::FitRole::kFreeOverSpeedsWithinLaw || at == parameters.end()) continue;
    if (static_cast<std::size_t>(at - parameters.begin()) < unknowns.asked_for) --unknowns.asked_for;
    parameters.erase(at);
    find_parameter(unknowns.start, key) = unit_of_key(own.field.key).to_si(own.usual);
    held.push_back(fmt::format("{} = {:.4g}", own.field.key, own.usual));
  }
  return held;
}

}  // namespace

FitUnknowns choose_unknowns(const measurements::MeasurementSet& set, const std::optional<TwoStepEstimate>& start,
                            bool load_map, bool free_H) {
  FitUnknowns unknowns;
  Variety variety = find_variety(set);
  double level_speed_m_s = 0.0;
  if (start.has_value()) {
    unknowns.start = make_start_context(set, *start, load_map ? find_loads_N(set) : std::vector<double>{});
    variety.speeds = !start->slopes_held;
    level_speed_m_s = start->mean_speed_m_s();
    add_speed_lines(unknowns, variety.speeds);
  } else {
    unknowns.start = rigs::make_context(set.tire, *set.rig, models::Baseline::kCombined);
  }
  add_own_numbers(unknowns, variety);
  add_free(unknowns, "tire.thermal.z_W_per_K", 0.0, 0.0);
  if (variety.speeds) add_free(unknowns, "tire.thermal.f_W_s_per_m_K", 0.0, 0.0);
  if (free_H) add_gas_transfer(unknowns);
  unknowns.asked_for = unknowns.parameters.size();
  add_tire_nuisances(set, level_speed_m_s, unknowns);
  add_rig_nuisances(set, unknowns);
  put_correlations(models::list_correlated_pairs(set.tire, set.rig->thermal_name()), unknowns.parameters);
  return unknowns;
}

std::vector<double> list_first_values(const FitUnknowns& unknowns) {
  constexpr double kFactor = 2.0;  // Assumed
  const double usual_J_per_K = find_usual_heat_capacity_J_per_K(unknowns.start.tire);
  std::vector<double> first;
  for (const FreeParameter& parameter : unknowns.parameters) {
    first.push_back(parameter.start_SI);
    const bool guessed = unknowns.of_class.count(parameter.key) == 1;
    if (!guessed || parameter.key != "tire.thermal.heat_capacity_J_per_K") continue;
    first.back() = std::clamp(parameter.start_SI, usual_J_per_K / kFactor, usual_J_per_K * kFactor);
  }
  return first;
}

std::optional<models::TireModelMistake> find_law_mistake(const FitUnknowns& unknowns,
                                                         const std::vector<double>& found) {
  models::Context<double> at = unknowns.start;
  const models::TireModelInfo& model = at.tire.model().info;
  if (model.find_mistake == nullptr) return std::nullopt;
  for (std::size_t i = 0; i < unknowns.parameters.size(); ++i) {
    find_parameter(at, unknowns.parameters[i].key) = found[i];
  }
  return model.find_mistake(at.tire.own);
}

std::string go_back_within_law(FitUnknowns& unknowns, const models::TireModelMistake& mistake) {
  const std::string what = fmt::format("the data ask for numbers that the tire's law refuses: {} ({} {})", mistake.what,
                                       mistake.key, mistake.allowed);
  const std::vector<std::string> held = hold_at_usual(unknowns);
  if (held.empty()) throw RunFailure(what);
  return fmt::format("{}. The fit was done again with {}", what, fmt::join(held, ", "));
}

}  // namespace rollrig::estimation
