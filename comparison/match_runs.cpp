#include "comparison/match_runs.h"

#include <algorithm>
#include <cmath>

namespace rollrig::comparison {
namespace {

using measurements::MeasuredRun;
namespace quantities = models::quantities;

/// Mean of a column, of what it has; 0 where the run does not record it.
double calc_column_mean(const MeasuredRun& run, const Quantity& quantity) {
  if (!run.has(quantity)) return 0.0;
  double sum = 0.0, count = 0.0;
  for (const double value : run.column(quantity)) {
    if (!std::isfinite(value)) continue;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

bool is_close(double a, double b, double limit) { return std::abs(a - b) <= limit; }

bool are_alike(const MeasuredRun& a, const MeasuredRun& b) {
  const RunConditions of_a = find_conditions(a);
  const RunConditions of_b = find_conditions(b);
  return is_close(of_a.speed_m_s, of_b.speed_m_s, 1.0 / kKmhPerMs) &&
         is_close(of_a.load_N, of_b.load_N, 0.02 * of_a.load_N) &&
         is_close(a.cold_pressure_Pa, b.cold_pressure_Pa, 3e3) && is_close(of_a.ambient_K, of_b.ambient_K, 3.0) &&
         is_close(a.initial_tire_temperature_K, b.initial_tire_temperature_K, 3.0) &&
         is_close(of_a.duration_s, of_b.duration_s, 0.1 * of_a.duration_s);
}

/// The only run of a list that is like another and not taken; none where there is no such run or a second one.
std::optional<std::size_t> find_only(const MeasuredRun& like, const std::vector<MeasuredRun>& runs,
                                     const std::vector<bool>& is_taken) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (is_taken[i] || !are_alike(like, runs[i])) continue;
    if (found.has_value()) return std::nullopt;
    found = i;
  }
  return found;
}

}  // namespace

RunConditions find_conditions(const MeasuredRun& run) {
  return {calc_column_mean(run, quantities::kSpeed), calc_column_mean(run, quantities::kLoad),
          calc_column_mean(run, quantities::kAmbient), run.time_s.back() - run.time_s.front()};
}

std::vector<std::optional<std::size_t>> match_runs(const std::vector<MeasuredRun>& reference,
                                                   const std::vector<MeasuredRun>& other) {
  std::vector<std::optional<std::size_t>> matches(reference.size());
  std::vector<bool> is_taken(other.size(), false);
  std::vector<bool> is_matched(reference.size(), false);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const auto same =
        std::find_if(other.begin(), other.end(), [&](const MeasuredRun& run) { return run.id == reference[i].id; });
    if (same == other.end()) continue;
    matches[i] = static_cast<std::size_t>(same - other.begin());
    is_taken[*matches[i]] = is_matched[i] = true;
  }
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (is_matched[i]) continue;
    const std::optional<std::size_t> alike = find_only(reference[i], other, is_taken);
    if (!alike.has_value()) continue;
    // Nor may a second run of the reference be like it.
    if (find_only(other[*alike], reference, is_matched) == i) matches[i] = alike;
  }
  return matches;
}

}  // namespace rollrig::comparison
