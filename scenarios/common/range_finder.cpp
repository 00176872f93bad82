#include "scenarios/common/range_finder.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/core/error.h"

namespace rollrig::scenarios {
namespace {

bool nearly_equal(double a, double b) {
  constexpr double kSameShare = 0.01;  // Assumed: load and speed control hold to 1 %
  return std::abs(a - b) <= kSameShare * std::max(std::abs(a), std::abs(b));
}

bool same_load(double a_N, double b_N, double skim_limit_N) {
  return (a_N > skim_limit_N) == (b_N > skim_limit_N) && nearly_equal(a_N, b_N);
}

/// Calls visit(value) for every sample that calc_window_mean averages.
template <class Visit>
void visit_window(const std::vector<double>& time_s, const std::vector<double>& values, const Window& window,
                  double interval_s, Visit&& visit) {
  constexpr double kSlack_s = 1e-6;
  const double first_s = window.start_s + 0.5 * interval_s - kSlack_s;
  const double last_s = window.end_s - 0.5 * interval_s + kSlack_s;
  auto i = static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), first_s) - time_s.begin());
  for (; i < time_s.size() && time_s[i] <= last_s; ++i) {
    if (!std::isnan(values[i])) visit(values[i]);
  }
}

}  // namespace

std::vector<LoadRange> find_load_ranges(const std::vector<double>& time_s, const std::vector<double>& load_N,
                                        const std::vector<double>& speed_m_s, double skim_limit_N, double shortest_s) {
  std::vector<LoadRange> ranges;
  std::size_t first = 0;
  const auto close = [&](std::size_t end) {
    const double end_s = time_s[std::min(end, time_s.size() - 1)];
    const LoadRange range{load_N[first] > skim_limit_N, load_N[first], time_s[first], end_s};
    if (range.duration_s() >= shortest_s) ranges.push_back(range);
    first = end;
  };
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const bool same = same_load(load_N[first], load_N[i], skim_limit_N) && nearly_equal(speed_m_s[first], speed_m_s[i]);
    if (!same) close(i);
  }
  if (!time_s.empty()) close(time_s.size());
  return ranges;
}

Window find_last_window(const LoadRange& range, double window_s, double margin_s) {
  const double end_s = range.end_s - margin_s;
  return {std::max(range.start_s + margin_s, end_s - window_s), end_s};
}

int count_window_samples(const std::vector<double>& time_s, const std::vector<double>& values, const Window& window,
                         double interval_s) {
  int count = 0;
  visit_window(time_s, values, window, interval_s, [&count](double) { ++count; });
  return count;
}

double calc_window_mean(const std::vector<double>& time_s, const std::vector<double>& values, const Window& window,
                        double interval_s) {
  double sum = 0.0;
  int count = 0;
  visit_window(time_s, values, window, interval_s, [&](double value) {
    sum += value;
    ++count;
  });
  if (count == 0) {
    throw RunFailure(fmt::format("there is no sample between {} and {} s", window.start_s, window.end_s));
  }
  return sum / count;
}

}  // namespace rollrig::scenarios
