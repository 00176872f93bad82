#pragma once
/// How far a test is from steady state: the same test is simulated as it is, and with the tire held under load.

#include <optional>
#include <string>
#include <vector>

#include "scenarios/common/drum_program.h"
#include "scenarios/common/readings.h"

namespace rollrig::scenarios {

/// Makes the run quasi-static, without sensors, and with few rows.
void prepare_for_settling(double window_s, RunSpec& spec);
std::vector<double> simulate_tire_losses_N(const RunSpec& spec, const DrumConditions& conditions,
                                           const DrumProgram& program);

/// For how long the load of a held test is kept. Assumed: the slowest tire of the assets, of class C3, and one of five
/// times its heat capacity have settled to 0.1 %
constexpr double kHeld_s = 12.0 * 3600.0;

/// F_r of the tire alone in each cycle of a test, as it is and held under load; empty where that cannot be simulated.
/// Equation  F_r = F_rr(load) - F_rr(skim), F_rr the loss of the tire with every effect, averaged as the test is, and
///           simulated quasi-static: without noise and errors of the machine
struct SettlingTest {
  std::vector<double> loss_N;
  std::vector<double> held_loss_N;

  /// How far the loss of a cycle is above that in steady state, as a fraction of it; empty where it is not known.
  /// Equation  F_r / F_r,held - 1
  std::optional<double> find_unsettled(std::size_t cycle, std::size_t held_cycle) const;
};

/// Simulates what `plan` makes of the settings of a test, and of those of the same test with kHeld_s under load.
template <class Settings>
SettlingTest simulate_settling(const Settings& settings, const Settings& held, RunSpec spec,
                               DrumProgram (*plan)(const Settings&, const RunSpec&)) {
  const auto simulate = [&](const Settings& test) {
    return simulate_tire_losses_N(spec, test.conditions, plan(test, spec));
  };
  prepare_for_settling(settings.conditions.window_s, spec);
  try {
    return {simulate(settings), simulate(held)};
  } catch (const RunFailure&) {
    return {};  // the run itself says what fails, where it fails too
  } catch (const InputError&) {
    return {};  // a window that has no sample with the rows of this simulation
  }
}

/// Whether the recording alone shows that a tire has settled under the load of a cycle, so that nothing need be
/// simulated for it.
/// Equation  |F_3 / F_steady - 1| <= limit, F_steady = F_3 + (F_3 - F_1) q^2 / (1 - q^2), q = (T_3 - T_2) / (T_2 - T_1)
/// Symbols   F loss, T liner temperature, at three times in equal distances, the last one the window of the cycle; q
///           decay from one time to the next, read off T, because the noise of a torque sensor would hide it
/// Validity  of a tire whose tread and carcass differ, F_steady is too far away by a factor of 1.2 to 3: what is not
///           shown to have settled, may have
/// Source    Aitken's extrapolation, exact for an exponential decay
bool is_shown_to_settle(const sim::Recording<double>& recording, const RunSpec& spec, const Cycle& cycle, double limit);

/// A cycle that is meant to be in steady state, and how far it is from it.
struct SteadyCycle {
  Cycle cycle;
  std::optional<double> unsettled;  // see SettlingTest

  void visit(ResultSheet& visit) const {
    cycle.visit(visit);
    visit_unsettled(visit, unsettled);
  }

  static void visit_unsettled(ResultSheet& visit, const std::optional<double>& unsettled) {
    visit(Result{"unsettled_percent", "unsettled", ".2f",
                 "how far F_r is above that of the same test with 12 h under load, both simulated without sensors; "
                 "absent where that cannot be simulated",
                 Column::kSecond}
              .or_left_out(),
          unsettled);
  }
};

constexpr double kSettled = 0.002;  // Assumed: well below the uncertainty of RRc

/// A warning where a test is further from steady state than `limit`, or it cannot be told how far it is. `too_short` is
/// the duration that is to be longer.
std::optional<std::string> warn_of_unsettled(const std::vector<std::optional<double>>& unsettled, double limit,
                                             const std::string& too_short);
/// The same of sweeps, with kSettled and their settle_min.
std::optional<std::string> warn_of_unsettled(const std::vector<SteadyCycle>& cycles);

}  // namespace rollrig::scenarios
