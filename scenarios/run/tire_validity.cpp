#include "scenarios/run/tire_validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/quantities.h"

namespace rollrig::scenarios {
namespace {

struct Extremes {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
};

/// Over the channel of a quantity, and over those of each wheel: "load_N", "load_front_left_N".
Extremes find_extremes(const sim::Recording<double>& recording, const Quantity& quantity) {
  Extremes found;
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const Quantity& channel = recording.channels[i].quantity;
    if (channel.name().rfind(quantity.name(), 0) != 0 || channel.unit_suffix() != quantity.unit_suffix()) continue;
    for (const double value : recording.values[i]) {
      if (std::isnan(value)) continue;
      found.lowest = std::min(found.lowest, value);
      found.highest = std::max(found.highest, value);
    }
  }
  return found;
}

}  // namespace

std::vector<std::string> list_validity_warnings(const std::string& tire, const models::TireValidity& range,
                                                const sim::Recording<double>& recording) {
  namespace quantities = models::quantities;
  std::vector<std::string> warnings;
  const auto warn = [&](const Quantity& quantity, const std::string& found, double lowest, double highest) {
    const Unit unit = quantity.file_unit();
    warnings.push_back(
        fmt::format("{} {} is beyond the range of tire '{}', whose file is valid from {:.4g} to {:.4g} {}: its loss is "
                    "extrapolated",
                    found, unit.symbol, tire, unit.from_si(lowest), unit.from_si(highest), unit.symbol));
  };
  const auto compare_range = [&](const Quantity& quantity, const char* what, double lowest, double highest) {
    const Extremes found = find_extremes(recording, quantity);
    if (found.highest < found.lowest) return;  // it is not recorded
    constexpr double kRounding = 1e-6;
    if (found.lowest >= lowest - kRounding && found.highest <= highest * (1.0 + kRounding)) return;
    const Unit unit = quantity.file_unit();
    warn(quantity,
         fmt::format("{} from {:.4g} to {:.4g}", what, unit.from_si(found.lowest), unit.from_si(found.highest)), lowest,
         highest);
  };
  compare_range(quantities::kSpeed, "speed", 0.0, range.highest_speed_m_s);
  compare_range(quantities::kLinerTemperature, "liner temperature", range.lowest_K, range.highest_K);
  const double load_N = find_extremes(recording, quantities::kLoad).highest;
  constexpr double kDynamic = 0.05;  // Assumed: by which the load of a wheel that is driven exceeds that at rest
  if (load_N > 0.0 &&
      (load_N < range.lowest_load_N * (1.0 - kDynamic) || load_N > range.highest_load_N * (1.0 + kDynamic))) {
    warn(quantities::kLoad, fmt::format("load up to {:.4g}", load_N), range.lowest_load_N, range.highest_load_N);
  }
  return warnings;
}

}  // namespace rollrig::scenarios
