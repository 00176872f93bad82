#include "estimation/tire_fit/fit_unknowns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "measurements/sample_selection.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

constexpr double kLongEnough_s = 60.0;  // Assumed: at a load or speed, so that it counts

/// How long the loaded tire is at each value of a channel.
std::map<double, double> collect_loaded_seconds(const measurements::MeasurementSet& set, const Quantity& channel) {
  std::map<double, double> seconds;
  for (const measurements::MeasuredRun& run : set.runs) {
    const std::vector<double>& load_N = run.column(models::quantities::kLoad);
    const std::vector<double>& values = run.column(channel);
    for (std::size_t row = 0; row + 1 < load_N.size(); ++row) {
      if (load_N[row] < measurements::kLoadedShare * set.tire.values.rolling_resistance.reference_load_N) continue;
      seconds[values[row]] += run.time_s[row + 1] - run.time_s[row];
    }
  }
  return seconds;
}

/// Whether the loaded tire is at values of a channel, from a least one up, that differ by a tenth. The lowest and the
/// highest for a short time do not count, so that ramps and noise are no values of their own.
bool is_varied(const measurements::MeasurementSet& set, const Quantity& channel, double least = 0.0) {
  constexpr double kDiffers = 1.1;   // Assumed: then the loss differs by more than sensors err
  constexpr double kLeftOut = 0.05;  // Assumed: of the time; a minute at least
  std::map<double, double> seconds = collect_loaded_seconds(set, channel);
  seconds.erase(seconds.begin(), seconds.lower_bound(least));
  double total_s = 0.0;
  for (const auto& [value, at_value_s] : seconds) total_s += at_value_s;
  const auto find_beyond = [left_out_s = std::max(kLongEnough_s, kLeftOut * total_s)](auto at, const auto end) {
    for (double passed_s = 0.0; at != end; ++at) {
      passed_s += at->second;
      if (passed_s >= left_out_s) return at->first;
    }
    return std::nan("");
  };
  return find_beyond(seconds.rbegin(), seconds.rend()) >= kDiffers * find_beyond(seconds.begin(), seconds.end());
}

/// Loads at which the set rolls. Assumed: each at least a minute; near ones (2 %) are one.
std::vector<double> find_loads_N(const measurements::MeasurementSet& set) {
  constexpr double kSameLoad = 0.02;  // Assumed
  const std::map<double, double> seconds_by_load = collect_loaded_seconds(set, models::quantities::kLoad);
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

void add_speed_lines(FitUnknowns& unknowns) {
  constexpr double kNoBound = -std::numeric_limits<double>::infinity();
  const auto& map = unknowns.start.tire.load_map;
  std::vector<std::string> tables{"tire.rolling_resistance."};
  if (!map.empty()) tables.clear();
  for (std::size_t i = 0; i < map.size(); ++i) tables.push_back(fmt::format("tire.load_map.{}.", i));
  for (const std::string& table : tables) {
    for (const Field& line : list_fields<Lines>()) add_free(unknowns, table + line.key, kNoBound, 0.0);
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

/// Speeds and loads of the set, as far as they decide numbers.
struct Variety {
  bool speeds = false;
  bool loads = false;
};

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

/// Nuisances: what the files give with an uncertainty and the fit does not ask for.
void add_nuisances(const measurements::MeasurementSet& set, FitUnknowns& unknowns) {
  std::set<std::string> asked_for;
  for (const Field& line : list_fields<Lines>()) asked_for.insert(line.key);
  for (const FreeParameter& parameter : unknowns.parameters) asked_for.insert(last_part(parameter.key));
  const auto add = [&](const std::string& table, const Field& field, double sd) {
    if (sd > 0.0 && asked_for.count(field.output_key()) == 0) {
      add_in_range(unknowns, table + "." + field.output_key(), field, sd);
    }
  };
  const models::TireParameters<double> uncertainties = set.tire.standard_uncertainties_on(set.rig->cooling_rig());
  for (const std::string& table :
       {std::string("thermal"), std::string("rolling_resistance"), unknowns.start.tire.model().info.id}) {
    models::TireParameters<double>::visit_all(uncertainties,
                                              [&](const std::string& of, const Field& field, const double& sd) {
                                                if (of == table) add("tire." + of, field, sd);
                                              });
  }
  models::ParasiticParameters<double>::visit(
      set.rig->parasitic_uncertainties, [&](const Field& field, const double& sd) { add("parasitic", field, sd); });
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
  Variety variety;
  if (start.has_value()) {
    unknowns.start = make_start_context(set, *start, load_map ? find_loads_N(set) : std::vector<double>{});
    variety = {true, false};  // two speeds at least
    add_speed_lines(unknowns);
  } else {
    unknowns.start = rigs::make_context(set.tire, *set.rig, models::Baseline::kCombined);
    variety = {is_varied(set, models::quantities::kSpeed, measurements::kTrustedSpeed_m_s),
               is_varied(set, models::quantities::kLoad)};
  }
  add_own_numbers(unknowns, variety);
  add_free(unknowns, "tire.thermal.z_W_per_K", 0.0, 0.0);
  if (variety.speeds) add_free(unknowns, "tire.thermal.f_W_s_per_m_K", 0.0, 0.0);
  if (free_H) add_free(unknowns, "tire.thermal.H_gas_W_per_K", 1e-3, 0.0);
  unknowns.asked_for = unknowns.parameters.size();
  add_nuisances(set, unknowns);
  put_correlations(models::list_correlated_pairs(set.tire, set.rig->thermal_name()), unknowns.parameters);
  return unknowns;
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
