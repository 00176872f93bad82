#pragma once
/// How large the gap is, and how far it shrinks on data that the fit did not see.

#include <functional>

#include "diagnosis/comparison/black_box.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// As subtract_black_box().
using BlackBox =
    std::function<Eigen::VectorXd(const PreparedSet& set, const Eigen::VectorXd& difference, std::size_t run)>;

/// The gap before and after `cause` is added (null: no cause; then nothing shrinks).
///
/// Equation  gap^2 = mean over blocks of (d^2 - expected noise)/floor^2, not below 0; shrinkage = 1 - after/before
/// Symbols   d measured less simulated, less the best offset within the sensor's; floor: noise of a full block
/// Judged    on runs, each left out of both fits in turn; on stretches (a phase of a run), likewise; on the fitted
/// data.
///           A run or a stretch counts where the others say enough: its prediction is uncertain by less than a quarter
///           of what the cause changes there, in squares. The shrinkage that is stated is that of the runs that count,
///           or where none does, of the stretches
/// Interval  2.5 and 97.5 percentiles over 1000 seeded resamples of stretches
/// Energy    root of the mean square, over runs, of the error of their energy (energy_scale.h), noise not subtracted
/// With one run, no run can be left out, and held_out is empty.
/// Black box what `black_box` leaves of each run (black_box.h)
/// Checked   tests/diagnosis/gap_test.cpp
Gap find_gap(const Study& study, const Candidate* cause, const BlackBox& black_box = subtract_black_box);

}  // namespace rollrig::diagnosis
