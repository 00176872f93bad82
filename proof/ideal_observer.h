#pragma once
/// What an ideal observer of the same sets would reach: nobody names what the data do not show.

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "proof/case.h"

namespace rollrig::proof {

/// Chance that data with noise place the truth among the first `places` effects.
///
/// Equation  P(other ahead) = Phi(-sqrt(m/2)); sum over numbers of others ahead below `places`, others independent
/// Symbols   m expected log Bayes factor of the truth over another effect
/// Validity  Gaussian noise, under which a log Bayes factor has the variance 2 m. Others that look alike are ahead
///           together: then the chance is nearer to 1 or 0 than this. Others are those that the ceiling compares, the
///           effects that banks draw there
/// Checked   tests/proof/ideal_observer_test.cpp
double calc_chance_among_first(std::size_t places, const std::vector<double>& log_bayes_factors);

/// Chances of an ideal observer with one set; none where the ceiling of the set lacks what it takes.
using Chance = std::function<std::optional<double>(const Case&)>;

/// That it raises a gap at 1 % false alarms: Phi(d' - 2.326).
std::optional<double> find_chance_of_detection(const Case& one);
/// 1 where less than three other effects are within 3 nats of the truth, else 0.
std::optional<double> find_chance_of_small_set(const Case& one);
/// That the truth is among the first `places`.
std::optional<double> find_chance_among_first(const Case& one, std::size_t places);
/// 1 where a pair is told from every single effect, else 0.
std::optional<double> find_chance_of_pair(const Case& one, double detectable_d_prime);

/// Mean chance; none where one of the cases has none, or there is no case.
std::optional<double> find_mean_chance(const std::vector<Case>& cases, const Chance& chance);

}  // namespace rollrig::proof
