#pragma once
/// What an ideal observer of the same sets would reach: nobody names what the data do not show.

#include <cstddef>
#include <vector>

#include "proof/score.h"

namespace rollrig::proof {

/// Chance that data with noise place the truth among the first `places` effects.
///
/// Equation  P(other ahead) = Phi(-sqrt(m/2)); sum over numbers of others ahead below `places`, others independent
/// Symbols   m expected log Bayes factor of the truth over another effect
/// Validity  Gaussian noise, under which a log Bayes factor has the variance 2 m. Others that look alike are ahead
///           together: then the chance is nearer to 1 or 0 than this
/// Checked   tests/proof/ideal_observer_test.cpp
double calc_chance_among_first(std::size_t places, const std::vector<double>& log_bayes_factors);

/// Fills `ceiling` of the figures for which one follows from d' and log Bayes factors, where all sets of a figure have
/// them: detection at 1 % false alarms (mean of Phi(d' - 2.326)), top-1 set-aware (less than three effects within 3
/// nats of the truth), top-3, pairs (both seen, and told from every single effect).
void add_ceilings(const std::vector<Case>& cases, const ScoreOptions& options, std::vector<Figure>& figures);

}  // namespace rollrig::proof
