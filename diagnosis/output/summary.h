#pragma once
/// A diagnosis as a test engineer reads it in the terminal.

#include <functional>
#include <string>

#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// A line each, longer ones on several: verdict and probability; the cause with its size; what it cannot be
/// told from, or what it means; where; which equation; the gap in noise floors and in units; shrinkage on
/// runs that the fit did not see; what is not excluded; the next test. Then what N of a torque are, objections and
/// warnings.
/// Checked tests/diagnosis/summary_test.cpp
std::string format_summary(const Findings& findings);

/// Which effects were compared: "only A, B", "all but C"; empty where it was the whole catalog. `name` gives the name
/// of an effect as it is shown.
std::string describe_restriction(const Findings& findings, const std::function<std::string(const std::string&)>& name);
/// "94 %"; neither 0 nor 100 while some doubt is left.
std::string show_probability(double probability);
/// How sure the verdict is: that the first cause acts, that nothing acts which the set would show, or that it is
/// something outside the catalog.
double probability_of_verdict(const Findings& findings);

/// "40 times", of a logarithm of 3.69.
std::string show_factor(double nats);

/// ", on the limit of its range" of an estimate that is there; else empty.
std::string describe_limit(const ParameterEstimate& estimate);

}  // namespace rollrig::diagnosis
