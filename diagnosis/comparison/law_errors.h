#pragma once
/// Forms in which the law of an effect may be wrong.

#include <optional>

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// A fit with further unknowns: the laws of some of its terms are loose. What each of these terms changes in a channel
/// may be wrong by a share of it that depends on the conditions. Nothing where the fit cannot be simulated without one
/// of them.
///
/// Equation  c becomes c (1 + q sum_k e_k f_k), q = max(10 %, law_share of the term),
///           f = 1, (v - 80 km/h)/(40 km/h), 2 (F/F_ref - 1), e^(-t/600 s), (p - p_ref)/(50 kPa), (T - 25 degC)/(10 K)
/// Symbols   c what the term changes in the mean of a block; e_k unknowns, standard normal, of their own for each term
///           and channel; v speed, F load, t time in the run, T air temperature of the block, p cold pressure of the
///           run; F_ref, p_ref to which the tire's law refers; law_share: models::LawError
/// Validity  errors that are small against c; base parameters and the other terms are held while c is found
/// Source    Assumed: the forms, and the 10 % (thresholds.h)
/// Checked   tests/diagnosis/law_errors_test.cpp
std::optional<Fit> loosen_laws(const Study& study, const Fit& fit, const std::vector<const Term*>& terms);

}  // namespace rollrig::diagnosis
