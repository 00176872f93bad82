#pragma once
/// What may be true of a measured set: the baseline, alone or with terms on top.

#include <string>
#include <vector>

#include "diagnosis/terms/term.h"

namespace rollrig::diagnosis {

/// A term with the sign of its size, where its prior leaves that open.
struct SignedTerm {
  const Term* term = nullptr;
  int sign = 1;

  bool operator==(const SignedTerm& other) const { return term == other.term && sign == other.sign; }
};

/// Terms in the order of all_terms(), then of all_machine_terms().
struct Hypothesis {
  std::vector<SignedTerm> terms;

  std::vector<std::string> names() const;
  std::string name() const;  // "bearing_warmup", "load_exponent + slow_leak", "none"
  bool operator==(const Hypothesis& other) const { return terms == other.terms; }
  bool contains(const Term& term) const;
  bool has_unknown() const;  // whether one of the terms is an unknown effect
  /// With one more term, in its place.
  Hypothesis with(const SignedTerm& added) const;
};

/// Whether names of effects hold all of some.
bool contains_all(const std::vector<std::string>& names, const std::vector<std::string>& some);

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

/// A point of the prior of an effect's size.
struct SizePoint {
  double weight = 0.0;  // probability of the prior; those of all points add to 1
  double ratio = 0.0;   // size there over the size at `judged_u`, both minus the size at which the effect does nothing
};
/// 801 points of the prior, evenly spaced from -4 to 4 in prior units, without those beyond the range of the size.
std::vector<SizePoint> list_size_points(const models::EffectParameter& size, int sign, double judged_u);

/// The u between which a parameter stays within its range.
struct PriorBounds {
  double lower;
  double upper;
};
PriorBounds bounds_in_prior_units(const models::EffectParameter& parameter, int sign);
/// Those of all own parameters of a hypothesis, in its order.
std::vector<PriorBounds> list_own_bounds(const Hypothesis& hypothesis);

/// Signs that a size may have: 1, or both.
std::vector<int> possible_signs(const models::EffectParameter& size);

}  // namespace rollrig::diagnosis
