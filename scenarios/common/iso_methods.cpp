#include "scenarios/common/iso_methods.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "estimation/drum_deceleration/deceleration_fit.h"

namespace rollrig::scenarios {
namespace {

constexpr double kSpeedChange_s = 5.0;      // Assumed: from the test speed to the band and back
constexpr double kHoldBeforeCoast_s = 5.0;  // Assumed: the motor settles; too short to be taken for a range of the test
constexpr double kLongestCoast_s = 3600.0;

double calc_power_W(const sim::Recording<double>& recording, const RunSpec& spec, const Window& window) {
  return calc_mean(recording, spec, window, quantities::kMotorPower);
}

std::string name_coast(const std::string& name) { return "coast, " + name; }

/// Deceleration at a speed, from the rows of one phase.
estimation::DecelerationFit fit_coast(const sim::Recording<double>& recording, const std::string& phase,
                                      double speed_m_s, double band_m_s) {
  estimation::Coast coast;
  const std::vector<double>& speeds_m_s = recording.channel(quantities::kSpeed);
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    if (recording.phases[recording.phase[row]].name != phase) continue;
    coast.time_s.push_back(recording.time_s[row]);
    coast.speed_m_s.push_back(speeds_m_s[row]);
  }
  coast.smooth_m_s = coast.speed_m_s;
  const estimation::DecelerationFit fit = estimation::fit_deceleration(coast, speed_m_s, band_m_s, {});
  if (fit.available) return fit;
  throw RunFailure(
      fmt::format("phase '{}' gives no deceleration at {:.4g} km/h ({} samples): {}; a shorter "
                  "sample_interval_s may help",
                  phase, kKmhPerMs * speed_m_s, coast.time_s.size(), fit.why));
}

}  // namespace

double calc_coasting_mass_kg(const RunSpec& spec, double load_N) {
  const double lever_m = spec.rig.lever_m();
  const double radius_m = calc_loaded_radius_m(spec.tire.values, load_N);
  return spec.rig.inertia() / (lever_m * lever_m) + calc_spin_mass_kg(spec.tire.values, radius_m);
}

std::string CoastOfTest::name() const {
  const char* load = is_loaded ? "loaded" : "skim";
  return cycle_place == 0 ? load : fmt::format("{} {}", load, cycle_place);
}

MethodReadings read_method(const std::string& method, const sim::Recording<double>& recording, const RunSpec& spec,
                           const CycleOfTest& at, double band_m_s) {
  const Cycle& cycle = at.cycle;
  if (method == kForceMethod) return {method, cycle.loaded.spindle_force_N, cycle.skim.spindle_force_N};
  if (method == kPowerMethod) {
    return {method, calc_power_W(recording, spec, cycle.loaded.window),
            calc_power_W(recording, spec, cycle.skim.window)};
  }
  if (method == kDecelerationMethod) {
    const auto fit = [&](bool is_loaded) {
      return fit_coast(recording, name_coast(CoastOfTest{at.place, is_loaded}.name()), cycle.loaded.speed_m_s,
                       band_m_s);
    };
    const estimation::DecelerationFit loaded = fit(true), skim = fit(false);
    return {method, loaded.value_m_s2, skim.value_m_s2, loaded.sd_m_s2, skim.sd_m_s2};
  }
  const double lever_m = spec.rig.lever_m();
  return {method, cycle.loaded.force_N * lever_m, cycle.skim.force_N * lever_m};
}

const std::vector<std::string>& list_iso_methods() {
  static const std::vector<std::string> names{kTorqueMethod, kForceMethod, kPowerMethod, kDecelerationMethod};
  return names;
}

double find_coast_band_m_s(const RunSpec& spec, const DrumConditions& conditions) {
  constexpr double kUsual_m_s = 5.0 / kKmhPerMs;
  constexpr double kSamplesAside = 10.0;
  constexpr double kLargestShare = 0.25;
  constexpr double kUsualRrc = 0.01;
  const double rrc = spec.tire.iso_28580.has_value() ? spec.tire.iso_28580->rrc : kUsualRrc;
  const double lever_m = spec.rig.lever_m();
  const double deceleration_m_s2 = rrc * *conditions.load_N * lever_m * lever_m / spec.rig.inertia();
  const double wanted_m_s = std::max(kUsual_m_s, kSamplesAside * spec.sample_interval_s * deceleration_m_s2);
  return std::min(wanted_m_s, kLargestShare * conditions.speed_m_s);
}

void add_coast(DrumProgram& program, const CoastOfTest& coast, double speed_m_s, double band_m_s) {
  const std::string name = coast.name();
  program.change_speed("speed up, " + name, kSpeedChange_s, speed_m_s + band_m_s);
  program.change_speed("hold, " + name, kHoldBeforeCoast_s, speed_m_s + band_m_s);
  program.coast(name_coast(name), speed_m_s - band_m_s, kLongestCoast_s);
  program.change_speed("back to test speed, " + name, kSpeedChange_s, speed_m_s);
}

}  // namespace rollrig::scenarios
