#pragma once
/// A short drum set that the checks let through, mistakes in its columns, and what the checks say of a set.

#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/checks/set_checks.h"
#include "sim/core/error.h"
#include "sim/core/units.h"
#include "tests/support/drum_sets.h"

namespace rollrig::tests {

inline const char* const kChannels[] = {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"};

inline const measurements::MeasurementSet& short_set() {
  static const measurements::MeasurementSet set = simulate_campaign(make_short_campaign());
  return set;
}

/// The numbers of a column, as a file has them, replaced by factor x + offset.
inline measurements::MeasurementSet rescale(measurements::MeasurementSet set, const std::string& column, double factor,
                                            double offset = 0.0) {
  const Unit unit = unit_of_key(column);
  for (measurements::MeasuredRun& run : set.runs) {
    for (double& value : run.columns.at(column)) value = unit.to_si(factor * unit.from_si(value) + offset);
  }
  return set;
}

/// The headings of two columns exchanged. A file has no empty field in a given column, so those take 20.
inline void exchange(measurements::MeasuredRun& run, const std::string& a, const std::string& b) {
  const std::vector<double> was_a = run.columns.at(a);
  const std::vector<double> was_b = run.columns.at(b);
  const auto read_as = [](const std::string& from, const std::string& to, double value) {
    const bool given = to == "speed_km_h" || to == "load_N" || to == "ambient_degC";
    const double number = unit_of_key(from).from_si(value);
    return unit_of_key(to).to_si(given && std::isnan(number) ? 20.0 : number);
  };
  for (std::size_t row = 0; row < was_a.size(); ++row) {
    run.columns.at(a)[row] = read_as(b, a, was_b[row]);
    run.columns.at(b)[row] = read_as(a, b, was_a[row]);
  }
}

inline measurements::MeasurementSet exchange_everywhere(measurements::MeasurementSet set, const std::string& a,
                                                        const std::string& b) {
  for (measurements::MeasuredRun& run : set.runs) exchange(run, a, b);
  return set;
}

inline std::string join(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

/// All that is said of a set, whether it is refused or warned of.
struct Answer {
  bool stopped = false;  // refused or implausible: no cause is named
  std::string text;
};
inline Answer answer_to(const measurements::MeasurementSet& set) {
  try {
    const diagnosis::SetChecks checks = diagnosis::check_set(set);
    return {checks.is_implausible(), join(checks.warnings)};
  } catch (const InputError& error) {
    return {true, error.what()};
  }
}

}  // namespace rollrig::tests
