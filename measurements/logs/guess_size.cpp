// Units that no heading states, by the size of the numbers.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "measurements/logs/guess.h"
#include "sim/core/error.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

struct NumberSpan {
  double lowest = 0.0, middle = 0.0, highest = 0.0;
};

NumberSpan find_span(const std::vector<double>& numbers) {
  std::vector<double> sorted;
  for (const double number : numbers) {
    if (!std::isnan(number)) sorted.push_back(number);
  }
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  return {sorted.front(), sorted[sorted.size() / 2], sorted.back()};
}

double find_usual_load_N(const models::TireFile& tire) {
  constexpr double kCar_N = 5000.0;  // Assumed: of a tire whose file states no load
  if (tire.iso_28580.has_value()) return tire.iso_28580->load_N;
  return tire.has_rolling_resistance ? tire.values.rolling_resistance.reference_load_N : kCar_N;
}

double find_usual_pressure_Pa(const models::TireFile& tire) {
  constexpr double kCar_Pa = 250e3;  // Assumed: likewise
  if (tire.iso_28580.has_value()) return tire.iso_28580->pressure_Pa;
  return tire.has_rolling_resistance ? tire.values.rolling_resistance.reference_pressure_Pa : kCar_Pa;
}

/// Whether speeds that are held for long lie at multiples of 5 km/h.
bool holds_round_speeds(const std::vector<double>& speeds_km_h) {
  constexpr double kLong = 0.05;       // Assumed: of the rows
  constexpr double kNear_km_h = 0.15;  // Assumed: how well a speed is held
  std::map<long, std::vector<double>> held;
  std::size_t count = 0;
  for (const double speed_km_h : speeds_km_h) {
    if (!(speed_km_h > 5.0)) continue;
    ++count;
    held[std::lround(2.0 * speed_km_h)].push_back(speed_km_h);
  }
  bool any = false;
  for (const auto& [half_km_h, speeds] : held) {
    if (static_cast<double>(speeds.size()) < kLong * static_cast<double>(count)) continue;
    const double mean = std::accumulate(speeds.begin(), speeds.end(), 0.0) / static_cast<double>(speeds.size());
    if (std::abs(mean - 5.0 * std::round(mean / 5.0)) > kNear_km_h) return false;
    any = true;
  }
  return any;
}

/// Whether numbers may be in a unit. Ranges are Assumed: where tests of tires are made.
bool may_be(const GuessSource& source, const Quantity& target, const GuessedUnit& unit,
            const std::vector<double>& numbers) {
  const NumberSpan raw = find_span(numbers);
  const double factor = std::abs(raw.lowest) > std::abs(raw.highest) ? -1.0 : 1.0;  // a log that counts the other way
  NumberSpan span{unit.convert(raw.lowest, target), unit.convert(raw.middle, target),
                  unit.convert(raw.highest, target)};
  if (target == quantities::kSpeed) {
    if (span.highest < 25.0 || span.highest > 300.0 || unit.written == "mph") return false;
    std::vector<double> speeds_km_h;
    for (const double number : numbers) speeds_km_h.push_back(unit.convert(number, target));
    return holds_round_speeds(speeds_km_h);
  }
  if (target == quantities::kLoad) {
    const double ratio = std::max(span.highest, factor * span.lowest) / find_usual_load_N(source.tire);
    return ratio > 0.35 && ratio < 1.6;
  }
  if (target == quantities::kCavityPressure) {
    const double ratio = 1e3 * span.middle / find_usual_pressure_Pa(source.tire);
    return ratio > 0.5 && ratio < 2.0;
  }
  const std::string symbol = target.file_unit().symbol;
  if (symbol == "degC") {
    const bool is_air = target == quantities::kAmbient;
    if (unit.written == "degF") return raw.lowest >= (is_air ? 48.0 : 60.0) && span.highest < (is_air ? 45.0 : 120.0);
    return span.lowest > -45.0 && span.lowest < 45.0 && span.highest < (is_air ? 60.0 : 120.0);
  }
  return unit.factor == 1.0 && unit.suffix == target.unit_suffix();  // Assumed: that of the set
}

}  // namespace

GuessedUnit guess_unit_by_size(const GuessSource& source, const Quantity& target, const std::string& heading,
                               const std::vector<double>& numbers, std::string& reason) {
  std::vector<GuessedUnit> likely;
  std::string names;
  for (const GuessedUnit& unit : list_units(target)) {
    if (!may_be(source, target, unit, numbers)) continue;
    likely.push_back(unit);
    names += (names.empty() ? "" : ", ") + unit.written;
  }
  const NumberSpan span = find_span(numbers);
  const std::string shown = fmt::format("{:.5g} to {:.5g}", span.lowest, span.highest);
  if (likely.size() == 1) {
    reason += fmt::format("; no unit is stated: {} goes with {}", likely.front().written, shown);
    return likely.front();
  }
  throw source.problem(fmt::format("the unit of '{}', which is taken as {}, cannot be told{}", heading, target.header(),
                                   likely.empty() ? "" : fmt::format(": it may be {}", names)),
                       "--unit", shown, fmt::format("--unit {}=UNIT", target.header()));
}

}  // namespace rollrig::measurements
