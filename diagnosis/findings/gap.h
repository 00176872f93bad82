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
/// Symbols   d measured minus simulated, minus the offset that fits best under its prior; floor: noise of a full block
/// Judged    in three ways: on runs, each left out of both fits in turn; on stretches (a phase of a run), likewise; on
///           the fitted data. A run or a stretch counts if the cause changes its prediction by 3 sd of the noise or
///           more, and if each prediction is uncertain by at most a quarter of this change, in squares. The shrinkage
///           is that of the runs that count; of the stretches that count if there is no such run, or no gap above the
///           noise in them. With one run, no run can be left out, and held_out is empty
///           Where the runs do not decide about a single effect (their interval holds 0 %) and the stretches confirm
///           it, it is that of the stretches
/// Left out  left_out_nats: sum over the runs (with one run: its stretches), and over the numbers of the files taken
///           together, each left out of both fits in turn, of the logarithm of how much likelier the cause makes it
/// Interval  2.5 and 97.5 percentiles over 1000 seeded resamples of stretches
/// Energy    root of the mean square, over runs, of the error of their energy (energy_scale.h), noise not subtracted
/// Black box what `black_box` leaves of each run (black_box.h)
/// Checked   tests/diagnosis/gap_test.cpp
Gap find_gap(const Study& study, const Candidate* cause, const BlackBox& black_box = subtract_black_box);

}  // namespace rollrig::diagnosis
