#pragma once
/// Whether a cause matters to those who use the simulation.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// What a fitted cause changes, in the readings and in the energy of a run.
/// Equation  floors = rms over blocks of (y_1 - y_0)/floor;  energy = rms over runs of the share of (y_1 - y) in energy
/// Symbols   y_1, y_0 block means by the fit with the cause and by the fit without it, each with base parameters and
///           offsets of its own: the change that recalibration cannot imitate. y as y_1 with the cause switched off and
///           the same base parameters: what the cause does to the loss of the tire, or to a drive. Share:
///           energy_scale.h
/// Checked   tests/diagnosis/materiality_test.cpp
CauseChange measure_change(const Study& study, const Candidate& cause);

/// Whether a change is below the smallest effect of interest, in energy and in the readings. One of them alone is not
/// enough: recalibrated numbers hide what changes the loss, and a mean over a run hides what acts now and then.
/// Readings  0.3 noise floors for each 0.5 %. Assumed: the ratio
bool is_immaterial(const CauseChange& change, double smallest_effect_percent);

/// Makes the first cause a trace (a cause that is too small to matter): takes it from the causes and moves its
/// probability to "none", which then means that nothing acts that matters. Returns the cause as it was.
Cause set_aside_trace(std::vector<Cause>& causes, std::map<std::string, double>& probability);

}  // namespace rollrig::diagnosis
