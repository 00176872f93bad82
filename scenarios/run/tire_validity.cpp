#include "scenarios/run/tire_validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/quantities.h"
#include "sim/core/error.h"

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

/// A line A0 + A1 v of a tire's loss, and its table in the file.
struct NamedLine {
  std::string table;
  models::SpeedLines<double> line;

  double loss_N(double speed_m_s) const { return line.A0_N + line.A1_N_s_per_m * speed_m_s; }
  std::string falling_key() const { return fmt::format("{} A1_N_s_per_m = {:g}", table, line.A1_N_s_per_m); }
};

std::vector<NamedLine> list_lines(const models::TireFile& tire) {
  if (!tire.has_rolling_resistance || !tire.model(models::Baseline::kCombined).info.follows_speed_lines()) return {};
  if (tire.values.load_map.empty()) return {{"[rolling_resistance]", tire.values.rolling_resistance}};
  std::vector<NamedLine> lines;
  for (const models::LoadMapEntry<double>& entry : tire.values.load_map) {
    lines.push_back({fmt::format("[[rolling_resistance.load_map]] of {:g} N", entry.load_N), entry});
  }
  return lines;
}

/// Keys of the tires whose loss falls with speed.
std::string describe_falling_losses(const std::vector<const models::TireFile*>& tires) {
  std::string text;
  for (const models::TireFile* tire : tires) {
    for (const NamedLine& line : list_lines(*tire)) {
      if (line.line.A1_N_s_per_m >= 0.0) continue;
      text += fmt::format("\ntire '{}': {} makes its loss negative above {:.4g} km/h", tire->name, line.falling_key(),
                          -3.6 * line.line.A0_N / line.line.A1_N_s_per_m);
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> list_negative_losses(const models::TireFile& tire) {
  constexpr double kHighest_m_s = 120.0 / 3.6;
  const double highest_m_s = std::max(tire.values.rolling_resistance.lowest_speed_m_s,
                                      tire.validity.has_value() ? tire.validity->highest_speed_m_s : kHighest_m_s);
  std::vector<std::string> found;
  for (const NamedLine& line : list_lines(tire)) {
    if (line.loss_N(highest_m_s) >= 0.0) continue;
    found.push_back(
        fmt::format("{}: the loss is negative above {:.4g} km/h, and the tire is valid to {:.4g} km/h: no "
                    "tire gives energy to the motion",
                    line.falling_key(), -3.6 * line.line.A0_N / line.line.A1_N_s_per_m, 3.6 * highest_m_s));
  }
  return found;
}

void require_loss(const std::vector<const models::TireFile*>& tires, const sim::Recording<double>& recording) {
  namespace quantities = models::quantities;
  constexpr double kRolls_m_s = 1.0;  // below, a wheel may roll to and fro within a row
  constexpr double kRounding = 1e-6;
  const std::vector<double>* speed_m_s = recording.find(quantities::kSpeed);
  if (speed_m_s == nullptr) return;
  const std::string prefix(quantities::kRollingResistance.name());
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const Quantity& channel = recording.channels[i].quantity;
    if (channel.name().rfind(prefix, 0) != 0) continue;
    const std::vector<double>& force_N = recording.values[i];
    double largest_N = 0.0;
    for (const double force : force_N) largest_N = std::max(largest_N, std::abs(force));
    for (std::size_t row = 0; row < force_N.size(); ++row) {
      const double speed = (*speed_m_s)[row];
      if (std::abs(speed) <= kRolls_m_s || force_N[row] * (speed > 0.0 ? 1.0 : -1.0) >= -kRounding * largest_N)
        continue;
      const std::string wheel = std::string(channel.name()).substr(prefix.size());
      const std::vector<double>* liner_K = recording.find(
          intern_quantity(fmt::format("{}{}_degC", std::string(quantities::kLinerTemperature.name()), wheel)));
      const std::string temperature =
          liner_K == nullptr ? "" : fmt::format(", liner temperature {:.4g} degC", (*liner_K)[row] - kZeroCelsius_K);
      throw RunFailure(fmt::format(
          "{} is {:.4g} N at {:.6g} s (speed {:.4g} km/h{}): no tire gives energy to the motion{}", channel.header(),
          force_N[row], recording.time_s[row], 3.6 * speed, temperature, describe_falling_losses(tires)));
    }
  }
}

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

bool has_tire_loss(const RunSpec& spec) {
  const bool has_road_load = spec.vehicle.has_value() && spec.vehicle->road_load.has_value();
  return is_indoors(spec.rig.kind->traits) || !has_road_load;
}

}  // namespace rollrig::scenarios
