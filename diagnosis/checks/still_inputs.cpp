#include "diagnosis/checks/still_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/checks/plausibility.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

constexpr double kCertainMoves = 10.0;
constexpr double kDoubtfulMoves = 3.0;
constexpr double kFar_K = 5.0;
constexpr double kLongTrip_s = 600.0;

double find_duration_s(const MeasuredRun& run) { return run.time_s.back() - run.time_s.front(); }

double count_moves(const std::vector<double>& values) {
  double moves = 0.0;
  for (std::size_t row = 1; row < values.size(); ++row) moves += values[row] == values[row - 1] ? 0.0 : 1.0;
  return moves;
}

/// How far a soaked tire began from the air of its run; 0 of a tire that was not soaked.
double find_start_difference_K(const MeasuredRun& run) {
  if (run.started_warm || run.rest_before_s.has_value()) return 0.0;
  return std::abs(run.column(quantities::kAmbient).front() - run.initial_tire_temperature_K);
}

std::string show(const Quantity& column, double value) {
  const Unit unit = column.file_unit();
  return fmt::format("{} stands at {:.6g} {}", column.header(), unit.from_si(value), unit.symbol);
}

/// Runs in which a column stands still while it moves in others.
void find_in_some(const MeasurementSet& set, const Quantity& column, const std::vector<std::size_t>& still,
                  double moves_per_s, std::vector<StillInput>& found) {
  for (const std::size_t r : still) {
    const MeasuredRun& run = set.runs[r];
    const double moves = moves_per_s * find_duration_s(run);
    if (moves < kDoubtfulMoves) continue;
    const bool is_ambient = column == quantities::kAmbient;
    const double off_K = is_ambient ? find_start_difference_K(run) : 0.0;
    const bool is_road = models::is_on_road(set.kind->traits);
    StillInput one{column, {r}, "", off_K > kFar_K || (is_road && moves >= kCertainMoves)};
    one.text = fmt::format("{} through all of {}, while it moves in the other runs",
                           show(column, run.column(column)[0]), name_runs(set, {r}));
    if (off_K > kFar_K) one.text += fmt::format(", and the soaked tires began {:.0f} K from it", off_K);
    found.push_back(std::move(one));
  }
}

/// A temperature that is one number on all trips.
void find_in_all(const MeasurementSet& set, std::vector<StillInput>& found) {
  std::set<double> numbers;
  std::set<std::string> sessions;
  double shortest_s = HUGE_VAL;
  double off_K = 0.0;
  double coldest_K = HUGE_VAL;
  double warmest_K = 0.0;
  for (const MeasuredRun& run : set.runs) {
    numbers.insert(run.column(quantities::kAmbient).front());
    sessions.insert(run.session);
    shortest_s = std::min(shortest_s, find_duration_s(run));
    off_K = std::max(off_K, find_start_difference_K(run));
    coldest_K = std::min(coldest_K, run.initial_tire_temperature_K);
    warmest_K = std::max(warmest_K, run.initial_tire_temperature_K);
  }
  if (numbers.size() > 1) return;
  StillInput all{quantities::kAmbient, {}, show(quantities::kAmbient, *numbers.begin()), false};
  for (std::size_t r = 0; r < set.runs.size(); ++r) all.runs.push_back(r);
  all.text += fmt::format(" through all of {}", name_runs(set, all.runs));
  if (sessions.size() > 1 && (off_K > kFar_K || warmest_K - coldest_K >= kFar_K)) {
    all.is_certain = true;
    all.text += fmt::format(", while the tires began at {:.0f} to {:.0f} degC", coldest_K - kZeroCelsius_K,
                            warmest_K - kZeroCelsius_K);
  } else if (shortest_s < kLongTrip_s) {
    return;
  }
  found.push_back(std::move(all));
}

void find_still(const MeasurementSet& set, const Quantity& column, std::vector<StillInput>& found) {
  std::vector<std::size_t> still;
  double moves_per_s = HUGE_VAL;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const double moves = count_moves(set.runs[r].column(column));
    if (moves == 0.0) {
      still.push_back(r);
    } else {
      moves_per_s = std::min(moves_per_s, moves / find_duration_s(set.runs[r]));
    }
  }
  const bool is_road = models::is_on_road(set.kind->traits);
  if (still.size() < set.runs.size()) {
    find_in_some(set, column, still, moves_per_s, found);
  } else if (is_road && column == quantities::kAmbient) {
    find_in_all(set, found);
  }
}

}  // namespace

std::vector<StillInput> find_still_inputs(const MeasurementSet& set) {
  std::vector<StillInput> found;
  find_still(set, quantities::kAmbient, found);
  if (models::is_on_road(set.kind->traits)) find_still(set, quantities::kElevation, found);
  return found;
}

}  // namespace rollrig::diagnosis
