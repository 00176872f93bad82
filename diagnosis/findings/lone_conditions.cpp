#include "diagnosis/findings/lone_conditions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

/// Values of one condition in a run, and how near two of them count as the same.
struct Condition {
  const char* word;
  std::vector<double> values;
  double near = 0.0;
  double near_share = 0.0;  // of the larger
};

double mean_within(const std::vector<double>& values, const RunPhase& phase) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(phase.first);
  const auto last = values.begin() + static_cast<std::ptrdiff_t>(phase.last);
  return std::accumulate(first, last, 0.0) / static_cast<double>(phase.last - phase.first);
}

/// Share of the rows in which the speed changes.
double find_changing_share(const measurements::MeasuredRun& run) {
  std::size_t changing = 0;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double acceleration_m_s2 = measurements::find_acceleration(run, row);
    changing += std::abs(acceleration_m_s2) > measurements::kSteadyAcceleration_m_s2 ? 1 : 0;
  }
  return static_cast<double>(changing) / static_cast<double>(run.time_s.size());
}

/// The conditions of a run, in the same order for every run.
std::vector<Condition> list_conditions(const PreparedRun& run) {
  const measurements::MeasuredRun& measured = run.measured;
  const auto find = [&](const Quantity& quantity) {
    const auto at = measured.columns.find(quantity);
    return at == measured.columns.end() ? nullptr : &at->second;
  };
  constexpr double kChangingShare = 0.02;  // Assumed: below it the speed only changes between steady phases
  Condition loads{"load", {}, 0.0, 0.1};
  Condition speeds{"speed", {}, 10.0 / 3.6};
  Condition air{"air temperature", {}, 5.0};
  for (const RunPhase& phase : run.phases) {
    if (phase.last <= phase.first) continue;
    if (const auto* load_N = find(models::quantities::kLoad)) loads.values.push_back(mean_within(*load_N, phase));
    speeds.values.push_back(mean_within(measured.column(models::quantities::kSpeed), phase));
    air.values.push_back(mean_within(measured.column(models::quantities::kAmbient), phase));
  }
  return {loads,
          speeds,
          {"pressure", {measured.cold_pressure_Pa}, 10e3},
          {"start temperature", {measured.initial_tire_temperature_K}, 5.0},
          air,
          {"speed changes", {find_changing_share(measured) > kChangingShare ? 1.0 : 0.0}, 0.5}};
}

/// Whether a run has a value near this one.
bool holds(const Condition& condition, double value) {
  return std::any_of(condition.values.begin(), condition.values.end(), [&](double other) {
    return std::abs(other - value) <=
           std::max(condition.near, condition.near_share * std::max(std::abs(value), std::abs(other)));
  });
}

}  // namespace

std::vector<std::string> find_lone_conditions(const PreparedSet& set, std::size_t run) {
  const std::vector<Condition> own = list_conditions(set.runs()[run]);
  std::vector<std::vector<Condition>> others;
  for (std::size_t r = 0; r < set.runs().size(); ++r) {
    if (r != run) others.push_back(list_conditions(set.runs()[r]));
  }
  std::vector<std::string> alone;
  for (std::size_t c = 0; c < own.size(); ++c) {
    const bool is_held = std::all_of(own[c].values.begin(), own[c].values.end(), [&](double value) {
      return std::any_of(others.begin(), others.end(),
                         [&](const std::vector<Condition>& other) { return holds(other[c], value); });
    });
    if (!is_held) alone.emplace_back(own[c].word);
  }
  return alone;
}

}  // namespace rollrig::diagnosis
