#pragma once
/// What an unknown effect is like.

#include <optional>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// The likeliest family of unknown effects (terms/unknown_terms.h), alone or beside a named effect, in words. Nothing
/// where all families together have less than half of the probability of "unknown": then the unknown effect follows no
/// simple function.
/// Checked  tests/diagnosis/unknown_terms_test.cpp
std::optional<Likeness> find_likeness(const Study& study, const Comparison& comparison, double unknown_probability);

}  // namespace rollrig::diagnosis
