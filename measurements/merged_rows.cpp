#include "measurements/merged_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rollrig::measurements {
namespace {

constexpr double kAfterChange_s = 120.0;  // Assumed: five time constants of the gas
constexpr double kBeforeChange_s = 10.0;  // Assumed: clocks of a test are no more apart
constexpr double kShortest_s = 10.0;      // Assumed: as the blocks of a diagnosis
constexpr double kShareOfTime = 0.1;      // Assumed: a curve with that time as time constant is off by 4e-4 of its rest
constexpr double kSlack_s = 1e-6;

/// Columns of a run in which a change counts.
std::vector<const std::vector<double>*> find_held_columns(const MeasuredRun& run, const MachineKind& kind) {
  std::vector<const std::vector<double>*> held;
  for (const rigs::Column& column : kind.columns.all_given()) {
    const bool is_temperature = column.quantity.file_unit().dimension == dimension::kTemperature;
    if (run.has(column.quantity) && !is_temperature) held.push_back(&run.column(column.quantity));
  }
  return held;
}

bool holds_value(double a, double b) {
  constexpr double kSame = 1e-7;  // files hold nine digits
  return std::abs(a - b) <= kSame * (1.0 + std::abs(b)) || (std::isnan(a) && std::isnan(b));
}

/// Rows [first, last) without a change.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
};

std::vector<Stretch> find_stretches(const MeasuredRun& run, const MachineKind& kind) {
  const auto held = find_held_columns(run, kind);
  std::vector<Stretch> stretches;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const bool goes_on = row > 0 && std::all_of(held.begin(), held.end(), [row](const std::vector<double>* column) {
                           return holds_value((*column)[row], (*column)[row - 1]);
                         });
    if (!goes_on) stretches.push_back({row, row});
    stretches.back().last = row + 1;
  }
  return stretches;
}

/// First rows of merged rows, and one past the last row.
std::vector<std::size_t> find_first_rows(const MeasuredRun& run, const MachineKind& kind,
                                         const std::vector<std::size_t>& cuts, double longest_s) {
  std::vector<std::size_t> firsts;
  for (const Stretch& stretch : find_stretches(run, kind)) {
    const double changed_s = run.time_s[stretch.first];
    const double from_s = changed_s + kAfterChange_s;
    const double until_s = run.time_s[stretch.last - 1] - kBeforeChange_s;
    double end_s = changed_s;  // of the merged row that is open
    for (std::size_t row = stretch.first; row < stretch.last; ++row) {
      const double now_s = run.time_s[row];
      const bool is_cut = std::binary_search(cuts.begin(), cuts.end(), row);
      const bool stands_alone = now_s < from_s || now_s > until_s;
      if (!stands_alone && !is_cut && now_s < end_s - kSlack_s) continue;
      firsts.push_back(row);
      end_s =
          stands_alone ? now_s : now_s + std::min(longest_s, std::max(kShortest_s, kShareOfTime * (now_s - changed_s)));
    }
  }
  firsts.push_back(run.time_s.size());
  return firsts;
}

/// The mean of the rows of each merged row that have a value.
std::vector<double> average(const std::vector<double>& values, const std::vector<std::size_t>& firsts) {
  std::vector<double> means;
  for (std::size_t i = 0; i + 1 < firsts.size(); ++i) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t row = firsts[i]; row < firsts[i + 1]; ++row) {
      if (std::isnan(values[row])) continue;
      sum += values[row];
      count += 1.0;
    }
    means.push_back(count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
  }
  return means;
}

}  // namespace

MergedRun merge_steady_rows(const MeasuredRun& run, const MachineKind& kind, std::vector<std::size_t> cuts,
                            double longest_s) {
  std::sort(cuts.begin(), cuts.end());
  MergedRun merged{run, {}};
  std::vector<std::size_t> firsts;
  if (is_of_vehicle(kind.traits)) {
    for (std::size_t row = 0; row <= run.time_s.size(); ++row) firsts.push_back(row);
  } else {
    firsts = find_first_rows(run, kind, cuts, longest_s);
  }
  for (std::size_t i = 0; i + 1 < firsts.size(); ++i)
    merged.row_of.insert(merged.row_of.end(), firsts[i + 1] - firsts[i], i);
  if (firsts.size() == run.time_s.size() + 1) return merged;
  merged.run.time_s = average(run.time_s, firsts);
  for (auto& [quantity, column] : merged.run.columns) column = average(run.column(quantity), firsts);
  std::vector<double>& bounds_s = merged.run.mean_bounds_s;
  bounds_s.assign(1, run.time_s.front());
  for (std::size_t i = 1; i + 1 < firsts.size(); ++i) {
    bounds_s.push_back(0.5 * (run.time_s[firsts[i] - 1] + run.time_s[firsts[i]]));
  }
  bounds_s.push_back(run.time_s.back());
  return merged;
}

}  // namespace rollrig::measurements
