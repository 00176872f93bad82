#include "report/readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/blocks.h"

namespace rollrig::report {
namespace {

double to_milliseconds(double time_s) { return std::round(1e3 * time_s) / 1e3; }

/// The rows [first, last) of a recording that belong to a phase.
std::pair<std::size_t, std::size_t> find_rows(const sim::Recording<double>& recording, std::size_t phase) {
  const auto [first, last] = std::equal_range(recording.phase.begin(), recording.phase.end(), phase);
  return {static_cast<std::size_t>(first - recording.phase.begin()),
          static_cast<std::size_t>(last - recording.phase.begin())};
}

/// The first of the rows [first, last) that counts. A row is a mean over its sample, so that the first row of a phase
/// lies across the boundary. It is skipped, unless it is the only one.
std::size_t skip_joint(std::size_t first, std::size_t last) {
  return first > 0 && last - first > 1 ? first + 1 : first;
}

/// Mean over time, least, most and last value of the rows [first, last); null where none is finite.
Json summarize(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t first,
               std::size_t last) {
  double area = 0.0;
  double width_s = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  std::size_t before = last;
  for (std::size_t row = first; row < last; ++row) {
    if (!std::isfinite(values[row])) continue;
    least = std::min(least, values[row]);
    most = std::max(most, values[row]);
    if (before != last) {
      const double step_s = time_s[row] - time_s[before];
      area += 0.5 * (values[row] + values[before]) * step_s;
      width_s += step_s;
    }
    before = row;
  }
  if (before == last) return nullptr;
  const double mean = width_s > 0.0 ? area / width_s : values[before];
  return {rounded(mean), rounded(least), rounded(most), rounded(values[before])};
}

}  // namespace

Json make_row_times(const std::vector<double>& time_s) {
  constexpr double kSame_s = 5e-4;
  Json stretches = Json::array();
  std::size_t first = 0;
  while (first < time_s.size()) {
    const double start_s = to_milliseconds(time_s[first]);
    const double step_s = first + 1 < time_s.size() ? time_s[first + 1] - time_s[first] : 0.0;
    std::size_t end = first + 1;
    while (end < time_s.size() &&
           std::abs(start_s + static_cast<double>(end - first) * step_s - time_s[end]) <= kSame_s) {
      ++end;
    }
    stretches.push_back({start_s, step_s, end - first});
    first = end;
  }
  return stretches;
}

Json make_recorded(const std::vector<double>& time_s, const std::vector<double>& values) {
  constexpr double kShown = 5e-6;       // half of the last of five digits, of the largest value
  constexpr std::size_t kMost = 16000;  // rows; a test of four hours has 14 000
  double size = 0.0;
  for (const double value : values) size = std::isfinite(value) ? std::max(size, std::abs(value)) : size;
  Json rows = Json::array();
  Json y = Json::array();
  for (const std::size_t row : thin(time_s, values, kMost, kShown * size)) {
    rows.push_back(row);
    y.push_back(rounded(values[row]));
  }
  return {{"row", rows}, {"y", y}};
}

Json summarize_phases(const sim::Recording<double>& recording, const std::vector<double>& values) {
  Json phases = Json::array();
  for (std::size_t phase = 0; phase < recording.phases.size(); ++phase) {
    const auto [first, last] = find_rows(recording, phase);
    phases.push_back(summarize(recording.time_s, values, skip_joint(first, last), last));
  }
  return phases;
}

Json summarize_spans(const std::vector<double>& time_s, const std::vector<double>& values,
                     const std::vector<std::pair<double, double>>& spans_s) {
  constexpr double kSame_s = 1e-6;
  const auto find_row = [&time_s](double at_s) {
    return static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), at_s) - time_s.begin());
  };
  Json spans = Json::array();
  for (std::size_t i = 0; i < spans_s.size(); ++i) {
    const double end_s = spans_s[i].second + (i + 1 == spans_s.size() ? kSame_s : -kSame_s);
    const std::size_t first = find_row(spans_s[i].first - kSame_s), last = find_row(end_s);
    spans.push_back(summarize(time_s, values, skip_joint(first, last), last));
  }
  return spans;
}

}  // namespace rollrig::report
