#include "diagnosis/comparison/information.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig::diagnosis;

namespace {

PredictedOutcome make_outcome(double mean, double sd) {
  return {Eigen::VectorXd::Constant(1, mean), Eigen::MatrixXd::Constant(1, 1, sd * sd)};
}

/// Mutual information of two normal distributions and which of them was drawn from, by quadrature.
double integrate_information_bits(double w, double mean, double sd) {
  const auto density = [](double x, double m, double s) {
    return std::exp(-0.5 * (x - m) * (x - m) / (s * s)) / (s * std::sqrt(2.0 * M_PI));
  };
  const auto gain = [&](double x) {
    const double p = density(x, 0.0, 1.0);
    const double q = density(x, mean, sd);
    const double mixture = w * p + (1.0 - w) * q;
    return (p > 0.0 ? w * p * std::log2(p / mixture) : 0.0) + (q > 0.0 ? (1.0 - w) * q * std::log2(q / mixture) : 0.0);
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(gain, -30.0, 30.0, 12, 1e-9);
}

}  // namespace

TEST_CASE("information lies between nothing and the entropy, below the exact value", "[fast]") {
  for (const double w : {0.5, 0.1}) {
    const std::vector<double> weights{w, 1.0 - w};
    CHECK(calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(0.0, 1.0)}) ==
          Approx(0.0).margin(1e-12));
    CHECK(calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(50.0, 1.0)}) ==
          Approx(-w * std::log2(w) - (1.0 - w) * std::log2(1.0 - w)));
    for (const double mean : {0.5, 1.0, 2.0, 4.0}) {
      for (const double sd : {0.5, 1.0, 3.0}) {
        const double bound = calc_information_bits(weights, {make_outcome(0.0, 1.0), make_outcome(mean, sd)});
        const double exact = integrate_information_bits(w, mean, sd);
        INFO("w " << w << " mean " << mean << " sd " << sd);
        CHECK(bound > 0.0);
        CHECK(bound <= exact + 1e-6);
        CHECK(bound >= 0.25 * exact);  // of use, not merely a bound
      }
    }
  }
}

TEST_CASE("the distance of equal normals is an eighth of the square of how far they are apart", "[fast]") {
  CHECK(4.0 * calc_overlap_distance_nats(make_outcome(0.0, 2.0), make_outcome(6.0, 2.0)) == Approx(4.5));
  CHECK(calc_overlap_distance_nats(make_outcome(1.0, 1.0), make_outcome(1.0, 1.0)) == Approx(0.0).margin(1e-12));
}
