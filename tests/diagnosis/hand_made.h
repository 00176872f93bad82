#pragma once
/// Diagnoses as they might come out, for tests of what is written and printed.

#include "diagnosis/diagnosis.h"

namespace rollrig::tests {

/// Bearings that warm up, explained, as in the example of formats.md.
inline diagnosis::Diagnosis make_explained() {
  diagnosis::Diagnosis made;
  made.set = "a50-drum-campaign";
  made.verdict = diagnosis::Verdict::kExplained;
  made.probability = {{"none", 0.01}, {"unknown", 0.03}, {"bearing_warmup", 0.94}, {"tire_loss_in_skim", 0.02}};
  diagnosis::Cause cause;
  cause.effects = {"bearing_warmup"};
  cause.probability = 0.94;
  cause.parameters = {{"bearing_warmup.fall_per_K", 0.0192, 0.002, 0.0153, 0.0231, "1/K"},
                      {"bearing_warmup.time_constant_min", 24.0, 4.0, 16.0, 32.0, "min"}};
  made.causes = {cause};
  made.gap.as_calibrated = {6.1, 0.4};
  made.gap.recalibrated = {2.3, 0.2};
  made.gap.shrink_percent = 91.0;
  made.gap.shrink_ci95_percent = {84.0, 96.0};
  made.gap.judged_by = diagnosis::JudgedBy::kRuns;
  made.gap.runs = diagnosis::Shrinkage{{2.3, 0.2}, 91.0, {84.0, 96.0}, diagnosis::GapView{2.1, 0.14}};
  made.gap.stretches = diagnosis::Shrinkage{{2.2, 0.15}, 93.0, {88.0, 97.0}, diagnosis::GapView{1.9, 0.12}};
  made.gap.fitted = diagnosis::Shrinkage{{2.0, 0.1}, 95.0, {92.0, 98.0}, diagnosis::GapView{1.2, 0.05}};
  made.gap.recalibration_percent = 62.0;
  made.gap.black_box_percent = 70.0;
  made.gap.held_out = {"warm-up-80", "warm-up-120", "transient-skim"};
  made.gap.judged_on = made.gap.held_out;
  made.gap.channels = {{"drum_torque_Nm", "N", 1.92, 0.13},
                       {"liner_temperature_degC", "degC", 0.4, 0.1},
                       {"cavity_pressure_kPa", "kPa", 0.3, 0.1}};
  made.where = {{"drum_torque_Nm", "transient-skim", "skim 1", 41.0, 1.9, "N", 14.2, 300.0, 480.0},
                {"drum_torque_Nm", "warm-up-80", "skim", 20.0, -0.6, "N", -6.1, 1800.0, 1980.0}};
  made.balance = {{"drum torque", 88.0}, {"tire heat", 12.0}};
  made.next_tests = {{"drum alone for 30 min, then a cold tire on the hot drum; torque at standstill before and after",
                      {"bearing_warmup", "tire_loss_in_skim"},
                      0.9}};
  made.not_excluded = {"windage", "torque_gain"};
  return made;
}

/// A cause that acts and is too small to matter.
inline diagnosis::Cause make_trace() {
  diagnosis::Cause trace;
  trace.effects = {"torque_gain"};
  trace.probability = 0.92;
  trace.parameters = {{"torque_gain.gain_percent", -0.06, 0.02, -0.1, -0.02, "%"}};
  trace.change = diagnosis::CauseChange{0.12, 0.07};
  return trace;
}

/// Nothing beyond the noise.
inline diagnosis::Diagnosis make_no_gap() {
  diagnosis::Diagnosis made;
  made.set = "clean";
  made.verdict = diagnosis::Verdict::kNoGap;
  made.probability = {{"none", 0.975}, {"unknown", 0.005}, {"bearing_warmup", 0.02}};
  made.gap.as_calibrated = {0.8, 0.8};
  made.gap.recalibrated = {0.3, 0.3};
  made.gap.held_out = {"warm-up-80", "warm-up-120"};
  return made;
}

}  // namespace rollrig::tests
