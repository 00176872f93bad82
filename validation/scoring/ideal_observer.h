#pragma once
/// What an ideal observer of the same cases would reach: nobody names what the data do not show.

#include <functional>
#include <optional>
#include <vector>

#include "validation/scoring/case.h"

namespace rollrig::validation {

/// Chances of an ideal observer with one case; none where its upper bound lacks what it takes.
using Chance = std::function<std::optional<double>(const Case&)>;

/// That it raises a gap at 1 % false alarms: Phi(d' - 2.326).
/// Checked  tests/validation/scoring/ideal_observer_test.cpp, as those below
std::optional<double> find_chance_of_detection(const Case& one);
/// 1 where less than three other effects are within 3 nats of the truth, else 0.
std::optional<double> find_chance_of_small_set(const Case& one);
/// 1 where a pair is told from every single effect, else 0.
std::optional<double> find_chance_of_pair(const Case& one, double detectable_d_prime);

/// Mean chance; none where one of the cases has none, or there is no case.
std::optional<double> find_mean_chance(const std::vector<Case>& cases, const Chance& chance);

}  // namespace rollrig::validation
