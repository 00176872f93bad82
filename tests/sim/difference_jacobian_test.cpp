#include "sim/difference_jacobian.h"

#include <catch2/catch.hpp>

using namespace rollrig;

namespace {

/// Rates of three states; the third acts on the second only where it is told to.
struct Rates {
  bool third_acts = false;
  int evaluations = 0;

  void operator()(const double* y, double* rates) {
    ++evaluations;
    rates[0] = -2.0 * y[0] + 3.0 * y[1];
    rates[1] = 5.0 * y[0] * y[0] + (third_acts ? 7.0 * y[2] : 0.0);
    rates[2] = -y[1];
  }
};

std::vector<double> find_jacobian(sim::DifferenceJacobian& differences, Rates& rates) {
  const std::vector<double> y{2.0, -1.0, 100.0};
  std::vector<double> at(3), jacobian(9);
  rates(y.data(), at.data());
  rates.evaluations = 0;
  differences.fill(y.data(), at.data(), jacobian.data(), rates);
  return jacobian;
}

}  // namespace

TEST_CASE("columns of a Jacobian are derivatives, and a state without effect costs an evaluation only once", "[fast]") {
  sim::DifferenceJacobian differences({1e-6, 1e-6, 1e-6});
  Rates rates;
  const std::vector<double> expected{-2.0, 20.0, 0.0, 3.0, 0.0, -1.0, 0.0, 0.0, 0.0};
  for (const int evaluations : {3, 3}) {  // then one for all states without effect, and two
    const std::vector<double> jacobian = find_jacobian(differences, rates);
    CHECK(rates.evaluations == evaluations);
    for (std::size_t i = 0; i < 9; ++i) CHECK(jacobian[i] == Approx(expected[i]).margin(1e-5));
  }
}

TEST_CASE("a state that begins to have an effect has its column again", "[fast]") {
  sim::DifferenceJacobian differences({1e-6, 1e-6, 1e-6});
  Rates rates;
  find_jacobian(differences, rates);
  rates.third_acts = true;
  CHECK(find_jacobian(differences, rates)[7] == Approx(7.0).margin(1e-5));
  CHECK(rates.evaluations == 4);
  CHECK(find_jacobian(differences, rates)[7] == Approx(7.0).margin(1e-5));
  CHECK(rates.evaluations == 3);
}

TEST_CASE("of many states without effect, all are tried by one evaluation", "[fast]") {
  const std::size_t n = 12;
  sim::DifferenceJacobian differences(std::vector<double>(n, 1e-6));
  const std::vector<double> y(n, 1.0);
  std::vector<double> at(n), jacobian(n * n);
  int evaluations = 0;
  const auto rates = [&](const double* x, double* out) {
    ++evaluations;
    std::fill(out, out + n, 0.0);
    out[0] = -x[0];
  };
  rates(y.data(), at.data());
  for (const int expected : {12, 2}) {
    evaluations = 0;
    differences.fill(y.data(), at.data(), jacobian.data(), rates);
    CHECK(evaluations == expected);
    CHECK(jacobian[0] == Approx(-1.0).margin(1e-6));
  }
}
