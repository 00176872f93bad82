#include "diagnosis/checks/interpolated.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "measurements/spikes.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr std::size_t kFewestRows = 10;
constexpr std::size_t kBeside = 20;       // rows to each side that show the scatter, where they move
constexpr double kChance = 1e-4;          // of a stretch by chance in a column of a set
constexpr double kClear = 3.0;            // scatter of a column that tells something, in limits
constexpr double kShareOfNoise = 0.1;     // of the noise of the sensor, likewise
constexpr double kShareOfScatter = 0.02;  // that a line may have, as of a rounding before
constexpr double kForgotten_s = 300.0;
constexpr double kMostSmooth = 0.5;  // share of smooth rows above which a column tells nothing

/// How far a row lies from lines through its neighbors.
struct Deviation {
  double smallest = std::nan("");  // in limits: smooth up to 1; NaN where it cannot be judged
  double from_line_SI = 0.0;
  bool is_still = false;  // the same number as both neighbors
};

/// Deviation of the middle of an odd number of rows from the polynomial through the others, and its limit.
std::array<double, 2> calc_deviation(const std::vector<double>& time_s, const std::vector<double>& values,
                                     std::size_t middle, std::size_t beside, double step) {
  double expected = 0.0;
  double weights = 1.0;
  for (std::size_t k = middle - beside; k <= middle + beside; ++k) {
    if (k == middle) continue;
    double weight = 1.0;
    for (std::size_t j = middle - beside; j <= middle + beside; ++j) {
      if (j != middle && j != k) weight *= (time_s[middle] - time_s[j]) / (time_s[k] - time_s[j]);
    }
    expected += weight * values[k];
    weights += std::abs(weight);
  }
  return {std::abs(values[middle] - expected), 0.505 * step * weights};
}

/// Median deviation of a column from the lines between neighbors, where it moves.
double find_scatter(const MeasurementSet& set, const Quantity& column) {
  std::vector<double> deviations;
  for (const MeasuredRun& run : set.runs) {
    if (!run.has(column)) continue;
    const std::vector<double>& values = run.column(column);
    for (std::size_t row = 1; row + 1 < values.size(); ++row) {
      const double off = calc_deviation(run.time_s, values, row, 1, 0.0)[0];
      if (off > 0.0) deviations.push_back(off);
    }
  }
  if (deviations.empty()) return 0.0;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

std::vector<Deviation> calc_deviations(const MeasuredRun& run, const Quantity& column, double step) {
  const std::vector<double>& values = run.column(column);
  std::vector<Deviation> deviations(values.size());
  for (std::size_t row = 1; row + 1 < values.size(); ++row) {
    const auto [off, limit] = calc_deviation(run.time_s, values, row, 1, step);
    const bool is_still = values[row - 1] == values[row] && values[row] == values[row + 1];
    deviations[row].is_still = is_still;
    if (std::isnan(off) || is_still) continue;
    deviations[row] = {off / limit, off, false};
    if (row < 2 || row + 2 >= values.size()) continue;
    const auto [cubic_off, cubic_limit] = calc_deviation(run.time_s, values, row, 2, step);
    if (!std::isnan(cubic_off)) deviations[row].smallest = std::min(off / limit, cubic_off / cubic_limit);
  }
  return deviations;
}

/// Rows of a column by run, and how many smooth ones in a row do not happen by chance.
struct Column {
  Quantity quantity = models::quantities::kSpeed;
  double step = 0.0;      // of its numbers, or what scatters like one
  double noise_sd = 0.0;  // of its sensor; 0 for a given one
  std::vector<std::vector<Deviation>> of_run;
  double least_rows = 0.0;  // infinite where the column tells nothing
};

Column make_column(const MeasurementSet& set, const Quantity& quantity) {
  Column column;
  column.quantity = quantity;
  column.step = std::max(find_step(set, quantity), kShareOfScatter * find_scatter(set, quantity));
  const auto sensor = set.sensors.find(quantity);
  if (sensor != set.sensors.end()) column.noise_sd = sensor->second.noise_sd;
  double judged = 0.0;
  double smooth = 1.0;
  for (const MeasuredRun& run : set.runs) {
    column.of_run.push_back(run.has(quantity) ? calc_deviations(run, quantity, column.step) : std::vector<Deviation>{});
    for (const Deviation& at : column.of_run.back()) {
      judged += std::isnan(at.smallest) ? 0.0 : 1.0;
      smooth += at.smallest <= 1.0 ? 1.0 : 0.0;
    }
  }
  const double share = smooth / (judged + 1.0);
  column.least_rows = share > kMostSmooth
                          ? HUGE_VAL
                          : std::max(static_cast<double>(kFewestRows), std::log(judged / kChance) / -std::log(share));
  return column;
}

/// Whether the rows beside a stretch scatter as a measurement does.
bool scatters_beside(const Column& column, const std::vector<Deviation>& rows, const SmoothRows& stretch) {
  constexpr double kOfNoise = 1.2247;  // sqrt(3/2), from the mean of two neighbors
  std::vector<double> deviations;
  const auto collect = [&deviations](const Deviation& at, std::size_t most) {
    if (!std::isnan(at.smallest) && deviations.size() < most) deviations.push_back(at.from_line_SI);
  };
  for (std::size_t row = stretch.first; row-- > 0;) collect(rows[row], kBeside);
  const std::size_t before = deviations.size();
  for (std::size_t row = stretch.last + 1; row < rows.size(); ++row) collect(rows[row], before + kBeside);
  if (deviations.size() < kFewestRows) return false;
  const auto middle = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle >= std::max(kClear * 1.01 * column.step, kShareOfNoise * kOfNoise * column.noise_sd);
}

/// The row after the last of a stretch of smooth rows from `first` on, and how many of them are smooth: a slow line has
/// a few rows at one number.
std::pair<std::size_t, double> find_end(const std::vector<Deviation>& rows, std::size_t first) {
  constexpr std::size_t kMostStill = 5;
  std::size_t end = first;
  double smooth = 0.0;
  for (std::size_t row = first; row < rows.size() && row - end <= kMostStill; ++row) {
    if (rows[row].smallest <= 1.0) {
      end = row + 1;
      smooth += 1.0;
    } else if (!rows[row].is_still) {
      break;
    }
  }
  return {end, smooth};
}

/// Stretches of smooth rows of a column in a run, with the rows at their ends.
std::vector<SmoothRows> find_smooth_rows(const MeasurementSet& set, const Column& column, std::size_t r) {
  std::vector<SmoothRows> stretches;
  const std::vector<Deviation>& rows = column.of_run[r];
  for (std::size_t first = 0, end = 0; first < rows.size(); first = end + 1) {
    double smooth = 0.0;
    std::tie(end, smooth) = find_end(rows, first);
    if (smooth < column.least_rows) continue;
    const SmoothRows stretch{first - 1, end};
    const std::vector<double>& values = set.runs[r].column(column.quantity);
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(stretch.first);
    const auto [low, high] = std::minmax_element(begin, values.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1);
    const bool moves = *high - *low > kClear * column.step;
    if (moves && scatters_beside(column, rows, stretch)) stretches.push_back(stretch);
  }
  return stretches;
}

/// A stretch with the columns that are smooth in it.
struct Found {
  SmoothRows rows;
  std::vector<Quantity> given;
  std::vector<Quantity> measured;
};

bool have_common_rows(const SmoothRows& a, const SmoothRows& b) { return a.first <= b.last && b.first <= a.last; }

void note(const Quantity& quantity, std::vector<Quantity>& quantities) {
  if (std::find(quantities.begin(), quantities.end(), quantity) == quantities.end()) quantities.push_back(quantity);
}

/// Widens what was found by a column's stretches that overlap it.
void widen(const Column& column, const std::vector<SmoothRows>& stretches, std::vector<Found>& found) {
  for (Found& one : found) {
    for (const SmoothRows& stretch : stretches) {
      if (!have_common_rows(stretch, one.rows)) continue;
      one.rows = {std::min(one.rows.first, stretch.first), std::max(one.rows.last, stretch.last)};
      note(column.quantity, one.given);
    }
  }
}

/// Joins stretches that overlap.
void join_overlapping(std::vector<Found>& found) {
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.rows.first < b.rows.first; });
  std::vector<Found> joined;
  for (Found& one : found) {
    if (joined.empty() || !have_common_rows(joined.back().rows, one.rows)) {
      joined.push_back(std::move(one));
      continue;
    }
    joined.back().rows.last = std::max(joined.back().rows.last, one.rows.last);
    for (const Quantity& quantity : one.given) note(quantity, joined.back().given);
    for (const Quantity& quantity : one.measured) note(quantity, joined.back().measured);
  }
  found = std::move(joined);
}

std::vector<Found> find_in_run(const MeasurementSet& set, const std::vector<Column>& given,
                               const std::vector<Column>& measured, std::size_t r) {
  std::vector<Found> found;
  for (const Column& column : measured) {
    for (const SmoothRows& stretch : find_smooth_rows(set, column, r))
      found.push_back({stretch, {}, {column.quantity}});
  }
  if (found.empty()) return found;
  for (const Column& column : given) widen(column, find_smooth_rows(set, column, r), found);
  join_overlapping(found);
  return found;
}

void add_found(const MeasurementSet& set, std::size_t r, const Found& one, Interpolated& interpolated) {
  const MeasuredRun& run = set.runs[r];
  const double from_s = run.time_s[one.rows.first];
  const double to_s = run.time_s[one.rows.last];
  const bool inputs_unknown = !one.given.empty();
  const bool ends = inputs_unknown && to_s - from_s > kForgotten_s;
  const std::size_t last = ends ? run.time_s.size() - 1 : one.rows.last;
  for (const Quantity& channel : inputs_unknown ? measurements::measured_channels(*set.kind) : one.measured) {
    if (run.has(channel)) interpolated.rows.push_back({r, channel, one.rows.first, last});
  }
  std::vector<Quantity> all = one.given;
  all.insert(all.end(), one.measured.begin(), one.measured.end());
  const char* left_out = "Its samples there are left out";
  if (inputs_unknown) {
    left_out = "What was measured there is left out, and the state of the tires is carried on with these inputs";
  }
  if (ends)
    left_out = "What was measured from there to the end of the run is left out, as the state of the tires is unknown";
  interpolated.warnings.push_back(
      fmt::format("{} of run {} follow{} smooth lines from {:.0f} to {:.0f} s and scatter{} elsewhere: interpolated, "
                  "not measured. {}",
                  fmt::join(list_headers(all), ", "), run.id, all.size() == 1 ? "s" : "", from_s, to_s,
                  all.size() == 1 ? "s" : "", left_out));
}

}  // namespace

double find_step(const MeasurementSet& set, const Quantity& column) {
  constexpr int kMostDecimals = 6;
  constexpr double kSame = 1e-4;  // of the step
  const Unit unit = column.file_unit();
  double largest = 0.0;
  int decimals = 0;
  for (const MeasuredRun& run : set.runs) {
    if (!run.has(column)) continue;
    for (const double value : run.column(column)) {
      if (!std::isfinite(value)) continue;
      const double number = unit.from_si(value);
      largest = std::max(largest, std::abs(number));
      while (decimals <= kMostDecimals) {
        const double scaled = number * std::pow(10.0, decimals);
        if (std::abs(scaled - std::round(scaled)) <= kSame) break;
        ++decimals;
      }
    }
  }
  const double step = decimals <= kMostDecimals ? std::pow(10.0, -decimals) : 1e-9 * largest;
  return step * unit.factor;
}

Interpolated find_interpolated(const MeasurementSet& set) {
  std::vector<Column> given;
  std::vector<Column> measured;
  for (const rigs::Column& column : set.kind->columns.given) given.push_back(make_column(set, column.quantity));
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    measured.push_back(make_column(set, channel));
  }
  Interpolated interpolated;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    for (const Found& one : find_in_run(set, given, measured, r)) add_found(set, r, one, interpolated);
  }
  return interpolated;
}

}  // namespace rollrig::diagnosis
