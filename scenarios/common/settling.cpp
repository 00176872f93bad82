#include "scenarios/common/settling.h"

#include <algorithm>
#include <cmath>

#include "scenarios/common/drum_bench.h"

namespace rollrig::scenarios {

void prepare_for_settling(double window_s, RunSpec& spec) {
  constexpr double kMostInterval_s = 2.0;  // Assumed: short against warming up
  spec.fidelity = Fidelity::kQuasiStatic;
  spec.sensors.reset();
  spec.sample_interval_s = std::max(spec.sample_interval_s, std::min(kMostInterval_s, 0.1 * window_s));
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
