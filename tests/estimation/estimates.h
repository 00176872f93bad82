#pragma once
/// Estimates of a fitted tire by key, for tests.

#include <algorithm>
#include <stdexcept>
#include <string>

#include "estimation/tire_fit/fit_tire.h"

namespace rollrig::tests {

inline const estimation::Estimate& estimate_of(const estimation::TireFit& fit, const std::string& key) {
  for (const estimation::Estimate& estimate : fit.estimates) {
    if (estimate.key == key) return estimate;
  }
  throw std::invalid_argument(key);
}

/// How many numbers a fit asks for, without those that it holds by a prior.
inline std::ptrdiff_t count_asked_for(const estimation::TireFit& fit) {
  return std::count_if(fit.estimates.begin(), fit.estimates.end(), [](const auto& at) { return !at.nuisance; });
}

}  // namespace rollrig::tests
