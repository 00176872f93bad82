// The chance that tests name the cause, against closed forms.
#include "diagnosis/next_test/naming_chance.h"

#include <catch2/catch.hpp>

using namespace rollrig::diagnosis;

namespace {

/// Two hypotheses whose one reading differs by so many of its standard deviations.
OutcomeDraws draw_apart(double distance_sd, const std::string& name) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  return {{{Eigen::VectorXd::Zero(1), one}, {Eigen::VectorXd::Constant(1, distance_sd), one}}, name};
}

const std::vector<double> kEven{0.5, 0.5};
constexpr double kLevel = 0.95;

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

TEST_CASE("the chance of naming one of two is that of their log odds, which are normal", "[fast]") {
  // ln odds of the truth: mean d^2/2, variance d^2; 0.95 is at ln 19.
  for (const double d : {1.5, 2.5, 4.0}) {
    const double chance = find_naming_chances(kEven, {{1.0, draw_apart(d, "one")}}, 8.0, kLevel).front();
    const double expected = normal_cdf((0.5 * d * d - std::log(19.0)) / d);
    const double sd = std::sqrt(expected * (1.0 - expected) / 128.0);
    INFO(d << ": " << chance << " of " << expected);
    CHECK(std::abs(chance - expected) < 3.0 * sd + 0.01);
  }
}

TEST_CASE("a test that tells nothing names nothing, and one that does not fit has no chance", "[fast]") {
  const auto chances =
      find_naming_chances(kEven, {{1.0, draw_apart(0.0, "blind")}, {9.0, draw_apart(9.0, "long")}}, 8.0, kLevel);
  CHECK(chances[0] == 0.0);  // and the other one does not fit after it
  CHECK(chances[1] == 0.0);
}

TEST_CASE("tests that name nothing alone do so together, as far as the hours go", "[fast]") {
  std::vector<PossibleTest> tests;
  for (int i = 0; i < 6; ++i) tests.push_back({1.0, draw_apart(1.6, "test " + std::to_string(i))});
  const double alone = find_naming_chances(kEven, tests, 1.0, kLevel).front();
  const double three = find_naming_chances(kEven, tests, 3.0, kLevel).front();
  const double six = find_naming_chances(kEven, tests, 6.5, kLevel).front();
  // Six readings 1.6 apart are one that is 1.6 sqrt(6) apart.
  const double d = 1.6 * std::sqrt(6.0);
  CHECK(six == Approx(normal_cdf((0.5 * d * d - std::log(19.0)) / d)).margin(0.12));
  CHECK(alone < 0.3);
  CHECK(three > alone + 0.2);
  CHECK(six > three);
}

TEST_CASE("of a short test that tells much and a long one, the long one spoils the chance where both do not fit",
          "[fast]") {
  const std::vector<PossibleTest> tests{
      {2.0, draw_apart(2.0, "a")}, {2.0, draw_apart(2.0, "b")}, {3.5, draw_apart(1.0, "long")}};
  const auto chances = find_naming_chances(kEven, tests, 4.0, kLevel);
  CHECK(chances[0] == Approx(chances[1]).margin(1e-12));  // the same pair in another order
  CHECK(chances[2] < chances[0] - 0.1);
}

TEST_CASE("a hypothesis that is all but certain is named by nothing at all", "[fast]") {
  CHECK(find_naming_chances({0.999, 0.001}, {{1.0, draw_apart(0.0, "blind")}}, 8.0, kLevel).front() ==
        Approx(0.999).margin(1e-12));
}
