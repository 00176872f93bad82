#include "scenarios/common/settling.h"

#include <algorithm>
#include <cmath>

#include "scenarios/common/drum_bench.h"

namespace rollrig::scenarios {

void prepare_for_settling(double window_s, RunSpec& spec) {
  constexpr double kLeastInterval_s = 0.2;  // Assumed: so that 12 h stay within some 10^5 rows
  constexpr double kMostInterval_s = 2.0;   // Assumed: short against warming up
  spec.fidelity = Fidelity::kQuasiStatic;
  spec.sensors.reset();
  spec.sample_interval_s =
      std::max(spec.sample_interval_s, std::clamp(0.1 * window_s, kLeastInterval_s, kMostInterval_s));
}

std::vector<double> simulate_tire_losses_N(const RunSpec& spec, const DrumConditions& conditions,
                                           const DrumProgram& program) {
  Outcome outcome;
  simulate_on_drum(spec, conditions, program, {}, outcome);
  const auto mean_N = [&](const Reading& reading) {
    return calc_mean(outcome.recording, spec, reading.window, quantities::kRollingResistance);
  };
  std::vector<double> losses_N;
  for (const Cycle& cycle : find_cycles(outcome.recording, spec, conditions)) {
    losses_N.push_back(mean_N(cycle.loaded) - mean_N(cycle.skim));
  }
  return losses_N;
}

bool is_shown_to_settle(const sim::Recording<double>& recording, const RunSpec& spec, const Cycle& cycle,
                        double limit) {
  constexpr double kFast_s = 180.0;  // Assumed: load, gas, and tread against carcass have settled
  constexpr double kSlowest = 0.85;  // Assumed: of q; beyond it, 2.6 times what was seen is extrapolated
  const Window& end = cycle.loaded.window;
  const std::vector<LoadRange> ranges = find_test_ranges(recording, spec);
  const auto own = std::find_if(ranges.begin(), ranges.end(), [&end](const LoadRange& range) {
    return range.start_s <= end.start_s && end.end_s <= range.end_s;
  });
  if (own == ranges.end()) return false;
  const double window_s = end.end_s - end.start_s;
  const double start_s = own->start_s + kFast_s;
  const double step_s = 0.5 * (end.start_s - start_s);
  if (step_s < window_s) return false;
  const auto mean = [&](double from_s, const Quantity& quantity) {
    return calc_mean(recording, spec, {from_s, from_s + window_s}, quantity);
  };
  const auto loss_N = [&](double from_s) {
    return mean(from_s, spec.rig.kind->traits.force) / spec.rig.lever_m() - cycle.parasitic_N;
  };
  const double middle_K = mean(start_s + step_s, quantities::kLinerTemperature);
  const double decay = (mean(end.start_s, quantities::kLinerTemperature) - middle_K) /
                       (middle_K - mean(start_s, quantities::kLinerTemperature));
  if (!(std::abs(decay) <= kSlowest)) return false;
  const double end_N = loss_N(end.start_s);
  const double steady_N = end_N + (end_N - loss_N(start_s)) * decay * decay / (1.0 - decay * decay);
  return std::abs(end_N / steady_N - 1.0) <= limit;
}

std::optional<double> SettlingTest::find_unsettled(std::size_t cycle, std::size_t held_cycle) const {
  if (cycle >= loss_N.size() || held_cycle >= held_loss_N.size()) return std::nullopt;
  if (!(held_loss_N[held_cycle] > 0.0)) return std::nullopt;
  return loss_N[cycle] / held_loss_N[held_cycle] - 1.0;
}

std::optional<std::string> warn_of_unsettled(const std::vector<std::optional<double>>& unsettled, double limit,
                                             const std::string& too_short) {
  double most = 0.0;
  for (const std::optional<double>& one : unsettled) {
    if (!one.has_value()) return "how far RRc is from that in steady state cannot be simulated";
    if (std::abs(*one) > std::abs(most)) most = *one;
  }
  if (std::abs(most) <= limit) return std::nullopt;
  return fmt::format("RRc is {}{:.1f} % {} that in steady state, as simulated: {}",
                     unsettled.size() > 1 ? "up to " : "", 1e2 * std::abs(most), most > 0.0 ? "above" : "below",
                     too_short);
}

std::optional<std::string> warn_of_unsettled(const std::vector<SteadyCycle>& cycles) {
  std::vector<std::optional<double>> unsettled;
  for (const SteadyCycle& cycle : cycles) unsettled.push_back(cycle.unsettled);
  return warn_of_unsettled(unsettled, kSettled, "settle_min is too short");
}

}  // namespace rollrig::scenarios
