#pragma once
/// What `rollrig describe` and `rollrig diagnose --explain` say of a cause.

#include <string>
#include <vector>

#include "models/effect.h"

namespace rollrig::diagnosis {

/// Meaning, usual and allowed values of a parameter, and the value at which the effect is off.
std::string describe_parameter(const models::EffectParameter& parameter);

/// Names that can be explained: every effect, and "none" and "unknown".
std::vector<std::string> explainable_names();

/// Equation, source, own parameters with units and priors, rigs, what reveals the effect, with what it is
/// confused and which tests separate them, as wide as the terminal. Of "none" and "unknown" what they
/// stand for. Throws InputError with the nearest name.
/// Checked tests/diagnosis/explain_test.cpp
std::string explain_effect(const std::string& name);

}  // namespace rollrig::diagnosis
