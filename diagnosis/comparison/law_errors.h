#pragma once
/// Forms in which the law of an effect may be wrong.

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// A fit with further unknowns: the laws of some of its terms are loose. What each of these terms changes in a channel
/// may be wrong by a share that depends on the conditions.
///
/// Equation  c(x) becomes c(x) (1 + 0.1 sum_k e_k f_k(x)),
///           f = 1, (v - 80 km/h)/(40 km/h), 2 (F/F_ref - 1), e^(-t/600 s), (p - p_ref)/(50 kPa), (T - 25 degC)/(10 K)
/// Symbols   c what the term changes in a block; e_k unknowns, standard normal, of their own for each term and
///           channel; v speed, F load, t time in the run, T air temperature of the block, p cold pressure of the run
/// Validity  linear in the e_k
/// Source    Assumed: the 10 % and the forms
/// Checked   tests/diagnosis/law_errors_test.cpp
Fit loosen_laws(const Study& study, const Fit& fit, const std::vector<const Term*>& terms);

}  // namespace rollrig::diagnosis
