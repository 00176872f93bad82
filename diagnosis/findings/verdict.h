#pragma once
/// From a comparison to named causes: what cannot be told apart, what is adequate, what stays possible.

#include <map>
#include <string>
#include <vector>

#include "diagnosis/comparison/model_comparison.h"
#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// Own parameters with their intervals, which end where their ranges end. The discrepancy covers a law that is wrong
/// here and there; that it may be wrong by a share everywhere alike widens the size.
std::vector<ParameterEstimate> estimate_parameters(const Study& study, const Candidate& candidate);

/// Inclusion probability of every effect in the comparison, of "none" and of "unknown".
std::map<std::string, double> find_probabilities(const Study& study, const Comparison& comparison);

/// Causes from the most probable down; but that of the lead (choose_lead()) comes first where the most probable one is
/// a part of it. A cause is named after the lead, a further one after the likeliest hypothesis that is left. Hypotheses
/// whose expected log Bayes factor against that is below 3 on this set belong to the same cause; those that the set has
/// told from it already, posterior below e^-3 of that one's (the same prediction, but with parameters that are most
/// unusual), are not listed beside it. Of a set of more than three the unlikeliest are left out, as long as all of them
/// together hold a tenth of it at most. The first cause is held adequate unless
/// - a free discrepancy on top of it is likelier than it alone,
/// - its size, estimated from each run by itself, scatters by more than noise and 30 % of the size explain (chance
///   below 0.001); only runs that determine the size to within 30 % count,
/// - its size or a shape lies more than 3 standard deviations out in its prior,
/// - the measurement asks for a size more than 2 standard deviations beyond its range,
/// - with it, a number of the files would have to be wrong (base_moves.h).
std::vector<Cause> find_causes(const Study& study, const Comparison& comparison);

/// Moves so much of a cause's probability to "none" or "unknown".
void move_probability(const Cause& cause, double moved, const std::string& to,
                      std::map<std::string, double>& probability);

/// Adds what the runs or stretches left out say against the first cause, and moves the probability of a cause with
/// objections to "unknown": a true cause fails one of the tests in 1 of 20 sets or fewer, what merely looks like one
/// often.
void weigh_objections(const Gap& gap, std::vector<Cause>& causes, std::map<std::string, double>& probability);

/// Effects that are not named and may act all the same: detectable at less than 5 standard deviations at the middle of
/// their prior, or with a probability of at least e^-3 times that of "none" or of the most probable cause, whichever is
/// larger.
std::vector<std::string> find_not_excluded(const Study& study, const Comparison& comparison,
                                           const std::vector<Cause>& causes);

/// No gap if "none" is likelier than "unknown" and than the first cause; if that has more than three effects, and so
/// names nothing, than each of its effects. Otherwise unexplained if "unknown" is at least as probable as the first
/// cause, else explained. Objections count through the probabilities that weigh_objections() has moved.
Verdict find_verdict(const std::map<std::string, double>& probability, const std::vector<Cause>& causes);

}  // namespace rollrig::diagnosis
