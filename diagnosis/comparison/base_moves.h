#pragma once
/// How far a fit moves the numbers of the files.

#include <string>
#include <vector>

#include "diagnosis/study.h"
#include "include/rollrig/findings.h"

namespace rollrig::diagnosis {

/// What a fit moves each base parameter by, in its own standard uncertainties, in the order of Study::base.
Eigen::VectorXd calc_base_moves(const Study& study, const Fit& fit);

/// The base parameters of the set, moved by the null's fit and by that with the cause (null: no cause). That which
/// moved furthest, with the cause where there is one, comes first.
std::vector<rollrig::BaseNumber> list_base_numbers(const Study& study, const Candidate* cause);

/// Base parameters that moved further than they do in 1 % of sets whose files are right: "thermal.z_W_per_K by +4.1 of
/// its standard uncertainties"; empty where there are none. Right files have moves that are standard normal at most.
/// Equation  |move| > q(1 - 0.01/(2 n))
/// Symbols   q quantile of the standard normal distribution, n base parameters
/// Source    Bonferroni's inequality
/// Checked   tests/diagnosis/base_moves_test.cpp
std::string describe_far_moves(const Study& study, const Fit& fit);

}  // namespace rollrig::diagnosis
