#pragma once
/// What may be true of a measured set: the baseline, with none, one or two effects on top.

#include <string>
#include <vector>

#include "models/effect.h"

namespace rollrig::diagnosis {

/// An effect that acts, with the sign of its size where its prior leaves that open.
struct ActingEffect {
  const models::Effect* effect = nullptr;
  int sign = 1;

  bool operator==(const ActingEffect& other) const { return effect == other.effect && sign == other.sign; }
};

/// Effects in the order of the registry.
struct Hypothesis {
  std::vector<ActingEffect> effects;

  std::vector<std::string> ids() const;
  std::string name() const;  // "bearing_warmup", "load_exponent + slow_leak", "none"
  bool operator==(const Hypothesis& other) const { return effects == other.effects; }
  bool contains(const models::Effect& effect) const;
  /// With one more effect, in its place.
  Hypothesis with(const ActingEffect& added) const;
};

/// A parameter in units of its prior: u is standard normal before any measurement.
/// Equation  log scale: x = s exp(m + h u), linear: x = m + h u; m, h the middle and half the width of the prior's
///           interval from low to high (of the logarithms), s the sign
struct PriorUnits {
  double value_SI = 0.0;
  double derivative_SI = 0.0;  // dx/du
  bool allowed = true;         // within the parameter's range
};
PriorUnits from_prior_units(const models::EffectParameter& parameter, double u, int sign);
/// The u of a value in SI units, held to 3 on either side.
double to_prior_units(const models::EffectParameter& parameter, double value_SI);

/// The u between which a parameter stays within its range.
struct PriorBounds {
  double lower;
  double upper;
};
PriorBounds bounds_in_prior_units(const models::EffectParameter& parameter, int sign);

/// Signs that an effect's size may have: 1, or both.
std::vector<int> possible_signs(const models::Effect& effect);

}  // namespace rollrig::diagnosis
