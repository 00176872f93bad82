#pragma once
/// What `rollrig diagnose --explain` says of a cause.

#include <string>
#include <vector>

namespace rollrig::diagnosis {

/// Names that can be explained: every effect, and "none" and "unknown".
std::vector<std::string> explainable_names();

/// Equation, source, own parameters with units and priors, rigs, what reveals the effect, with what it is
/// confused and which test splits them, as wide as the terminal. Of "none" and "unknown" what they
/// stand for. Throws InputError with the nearest name.
/// Checked tests/diagnosis/explain_test.cpp
std::string explain_effect(const std::string& name);

}  // namespace rollrig::diagnosis
