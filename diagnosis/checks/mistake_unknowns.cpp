#include "diagnosis/checks/mistake_unknowns.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/checks/plausibility.h"
#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

using Values = std::vector<double>;

constexpr double kFades_s = 600.0;
constexpr double kLag_s = 60.0;
constexpr double kSpeed_m_s = 22.2;  // 80 km/h

/// What a channel shows at rest, and the two terms of its tolerance: fixed, and a share of the change from rest.
struct Tolerance {
  Values rest;
  double fixed = 0.0;
  double share = 0.0;
};

Tolerance find_tolerance(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel) {
  const std::size_t rows = run.time_s.size();
  if (channel == set.kind->traits.force) {
    const MeasurementKind& kind = kind_of(set);
    constexpr double kLarge = 1e6;
    const double fixed = kind.calc_force_tolerance(set, 0.0);
    return {Values(rows, 0.0), fixed, (kind.calc_force_tolerance(set, kLarge) - fixed) / kLarge};
  }
  if (const std::optional<ReferenceTolerance> reference = find_reference_tolerance(channel)) {
    return {Values(rows, 0.0), reference->fixed_SI, reference->share};
  }
  const models::ChannelFamily& family = models::get_tire_channel(channel).family;
  const bool is_pressure = family.rest == models::ChannelFamily::Rest::kColdPressure;
  const Values rest = is_pressure ? Values(rows, run.cold_pressure_Pa) : run.column(quantities::kAmbient);
  return {rest, family.tolerance_SI, family.share_of_rise};
}

/// Parts in proportion to the change of the channel from rest: as it is, fading, and with speed and load.
void add_moved(const MeasuredRun& run, const Tolerance& tolerance, const Values& simulated,
               std::vector<Values>& unknowns) {
  const Values& speed_m_s = run.column(quantities::kSpeed);
  const Values& load_N = run.column(quantities::kLoad);
  const double largest_N = std::max(1.0, *std::max_element(load_N.begin(), load_N.end()));
  std::vector<Values> moved(4, Values(simulated.size(), 0.0));
  for (std::size_t row = 0; row < simulated.size(); ++row) {
    const double part = tolerance.share * (simulated[row] - tolerance.rest[row]);
    moved[0][row] = part;
    moved[1][row] = part * std::exp((run.time_s.front() - run.time_s[row]) / kFades_s);
    moved[2][row] = part * (speed_m_s[row] / kSpeed_m_s - 1.0);
    moved[3][row] = part * (load_N[row] / largest_N - 0.5);
  }
  for (Values& one : moved) unknowns.push_back(std::move(one));
}

void add_lag(const MeasuredRun& run, const Values& simulated, std::vector<Values>& unknowns) {
  Values lag(simulated.size(), 0.0);
  for (std::size_t row = 1; row < simulated.size(); ++row) {
    lag[row] = kLag_s * (simulated[row] - simulated[row - 1]) / (run.time_s[row] - run.time_s[row - 1]);
  }
  unknowns.push_back(std::move(lag));
}

}  // namespace

Unknowns list_unknowns(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel,
                       const Values& simulated) {
  const Tolerance tolerance = find_tolerance(set, run, channel);
  const Values& speed_m_s = run.column(quantities::kSpeed);
  Unknowns unknowns;
  std::vector<Values> at_rest(3, Values(simulated.size(), tolerance.fixed));
  for (std::size_t row = 0; row < simulated.size(); ++row) {
    at_rest[1][row] *= std::exp((run.time_s.front() - run.time_s[row]) / kFades_s);
    at_rest[2][row] *= speed_m_s[row] / kSpeed_m_s;
  }
  unknowns.scaled = std::move(at_rest);
  if (channel == set.kind->traits.force) unknowns.fixed = kind_of(set).list_unknown_forces(set, run);
  if (unknowns.fixed.empty()) add_moved(run, tolerance, simulated, unknowns.scaled);
  if (channel != set.kind->traits.force) add_lag(run, simulated, unknowns.scaled);
  return unknowns;
}

}  // namespace rollrig::diagnosis
