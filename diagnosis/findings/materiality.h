#pragma once
/// Whether a cause matters to those who use the simulation.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// What a fitted hypothesis changes.
/// Equation  floors: root of the mean square over blocks of (with cause - without)/floor, each fitted by itself, base
///           parameters and offsets among it: what is left when the files' numbers are retuned instead
///           energy: with the cause less without it, base parameters held at the fit with it, as a share of the energy
///           of a run (energy_scale.h): what switching the cause on does to the tire's loss or to a drive
/// Checked   tests/diagnosis/materiality_test.cpp
CauseChange measure_change(const Study& study, const Candidate& cause);

/// Whether a change is smaller than the smallest effect of interest: both in energy and in what is read. Retuned
/// numbers hide what changes the loss, and a mean hides what comes and goes, so that neither alone says that it does
/// not matter. Readings   0.3 noise floors for each 0.5 % (Assumed)
bool is_immaterial(const CauseChange& change, double smallest_effect_percent);

/// A first cause that is too small to matter becomes a trace: it is taken from the causes, and its probability goes to
/// "none", which then says that nothing acts that matters. Returns it as it was.
Cause set_aside_trace(std::vector<Cause>& causes, std::map<std::string, double>& probability);

}  // namespace rollrig::diagnosis
