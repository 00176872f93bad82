#pragma once
/// Between the ends of a step: the cubic through values and rates at both ends.

namespace rollrig::sim {

/// Equation  y(x) = (1 + 2x)(1 - x)^2 y_0 + x^2 (3 - 2x) y_1 + h (x (1 - x)^2 f_0 + x^2 (x - 1) f_1)
/// Symbols   x share of the step, 0 to 1; h step [s]; y, f value and rate at its start (0) and end (1)
struct HermiteCubic {
  double to_before;
  double to_after;
  double rate_to_before;
  double rate_to_after;

  HermiteCubic(double x, double h_s)
      : to_before((1.0 + 2.0 * x) * (1.0 - x) * (1.0 - x)),
        to_after(x * x * (3.0 - 2.0 * x)),
        rate_to_before(x * (1.0 - x) * (1.0 - x) * h_s),
        rate_to_after(x * x * (x - 1.0) * h_s) {}

  template <class S>
  S interpolate(const S& before, const S& after, const S& rate_before, const S& rate_after) const {
    return to_before * before + to_after * after + rate_to_before * rate_before + rate_to_after * rate_after;
  }
};

}  // namespace rollrig::sim
