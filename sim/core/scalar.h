#pragma once
/// The scalars for which models and effects are written once and instantiated three times.

#include <ceres/jet.h>

#include <cmath>
#include <tuple>

#include "sim/core/dimension.h"

namespace rollrig {

/// Parameters that one forward pass differentiates with respect to: the twelve base parameters of
/// shared identification and up to four of an effect's own.
constexpr int kJetWidth = 16;

/// Value and derivatives with respect to kJetWidth parameters.
using Jet = ceres::Jet<double, kJetWidth>;

/// The plain value, for branches and for output.
inline double value_of(double x) { return x; }
inline double value_of(const Jet& x) { return x.a; }
inline double value_of(const DimensionedScalar& x) { return x.value(); }

/// Something for each of the scalars: std::get<Of<S>> is that of S.
template <template <class> class Of>
using ForEachScalar = std::tuple<Of<double>, Of<Jet>, Of<DimensionedScalar>>;

/// A constant of an equation, given in SI units with its dimension.
template <class S>
S quantity(double si_value, Dimension dimension);
template <>
inline double quantity<double>(double si_value, Dimension) {
  return si_value;
}
template <>
inline Jet quantity<Jet>(double si_value, Dimension) {
  return Jet(si_value);
}
template <>
inline DimensionedScalar quantity<DimensionedScalar>(double si_value, Dimension dimension) {
  return {si_value, dimension};
}

/// The zero from which a sum starts, whatever its dimension.
template <class S>
S zero() {
  return S(0.0);
}
template <>
inline DimensionedScalar zero<DimensionedScalar>() {
  return {};
}

/// max(x, 0) with a derivative of zero on the clipped side.
template <class S>
S positive_part(const S& x) {
  return value_of(x) > 0.0 ? x : zero<S>();
}

}  // namespace rollrig
