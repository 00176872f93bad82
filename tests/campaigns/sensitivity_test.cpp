// Sensitivity of functions whose indices are known in closed form.
#include "campaigns/sensitivity.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "campaigns/design.h"
#include "include/rollrig/error.h"

namespace {

using namespace rollrig::campaigns;

const double kPi = std::acos(-1.0);

/// Results of a function at the items of a design.
ItemResults evaluate(const DesignInput& input, const std::function<double(const std::vector<double>&)>& function) {
  const auto design = make_design(input);
  ItemResults results;
  for (std::size_t i = 0; i < design->count_items(); ++i) {
    std::vector<double> x;
    for (const std::string& value : design->calc_values(i)) x.push_back(std::strtod(value.c_str(), nullptr));
    results.push_back(function(x));
  }
  return results;
}

std::vector<Factor> make_factors(double low, double high) {
  std::vector<Factor> factors;
  for (const char* key : {"x1", "x2", "x3"}) factors.push_back({key, Factor::Kind::kUniform, {}, low, high});
  return factors;
}

double ishigami(const std::vector<double>& x) {
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

}  // namespace

// Ishigami, Homma, Proc. ISUMA 1990: with a = 7, b = 0.1
TEST_CASE("Sobol' indices of the Ishigami function lie in their intervals", "[fast]") {
  const double v = 49.0 / 8.0 + 0.1 * std::pow(kPi, 4) / 5.0 + 0.01 * std::pow(kPi, 8) / 18.0 + 0.5;
  const double v1 = 0.5 * std::pow(1.0 + 0.1 * std::pow(kPi, 4) / 5.0, 2);
  const double v2 = 49.0 / 8.0;
  const double v13 = 0.01 * std::pow(kPi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const double first[] = {v1 / v, v2 / v, 0.0};
  const double total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const DesignInput input{kSobolIndices, make_factors(-kPi, kPi), 1024, seed};
    const SobolIndices indices = calc_sobol_indices(evaluate(input, ishigami), 3, seed);
    CHECK(indices.points == 1024);
    CHECK(indices.mean == Approx(3.5).epsilon(0.03));
    CHECK(indices.variance == Approx(v).epsilon(0.05));
    for (std::size_t f = 0; f < 3; ++f) {
      CHECK(indices.first[f].low_95 <= first[f]);
      CHECK(indices.first[f].high_95 >= first[f]);
      CHECK(indices.total[f].low_95 <= total[f]);
      CHECK(indices.total[f].high_95 >= total[f]);
      CHECK(indices.first[f].high_95 - indices.first[f].low_95 < 0.25);
      CHECK(indices.total[f].high_95 - indices.total[f].low_95 < 0.25);
    }
  }
}

TEST_CASE("points that lack a result are left out", "[fast]") {
  const DesignInput input{kSobolIndices, make_factors(0.0, 1.0), 64, 4};
  ItemResults results = evaluate(input, [](const std::vector<double>& x) { return 2.0 * x[0] + x[1]; });
  results[7] = std::nan("");  // of the second point
  const SobolIndices indices = calc_sobol_indices(results, 3, 4);
  CHECK(indices.points == 63);
  CHECK(indices.total[0].value == Approx(0.8).margin(0.1));
  CHECK(indices.total[2].value == 0.0);
  for (double& result : results) result = 3.0;
  CHECK_THROWS_AS(calc_sobol_indices(results, 3, 4), rollrig::InputError);
  results[5] = 4.0;  // f(A) of the second point; in many resamples no point differs
  const SobolIndices of_one = calc_sobol_indices(results, 3, 4);
  for (const Index& index : of_one.first) CHECK((std::isfinite(index.low_95) && std::isfinite(index.high_95)));
  for (double& result : results) result = std::nan("");
  CHECK_THROWS_AS(calc_sobol_indices(results, 3, 4), rollrig::InputError);
}

TEST_CASE("elementary effects of a plane are its slopes, without spread", "[fast]") {
  const DesignInput input{kMorris, make_factors(0.0, 2.0), 8, 5};
  const auto plane = [](const std::vector<double>& x) { return 10.0 + 3.0 * x[0] - 2.0 * x[1]; };
  const MorrisMeasures measures = calc_morris_measures(evaluate(input, plane), 3, 5);
  CHECK(measures.points == 8);
  CHECK(measures.mean[0] == Approx(3.0));  // half of the range is 1
  CHECK(measures.mean[1] == Approx(-2.0));
  CHECK(measures.mean_size[1].value == Approx(2.0));
  CHECK(measures.mean_size[1].low_95 == Approx(2.0));
  CHECK(measures.mean_size[2].value == 0.0);
  CHECK(measures.deviation[0] == Approx(0.0).margin(1e-9));
}

TEST_CASE("effects that depend on other factors have a spread", "[fast]") {
  const DesignInput input{kMorris, make_factors(0.0, 1.0), 40, 6};
  const auto saddle = [](const std::vector<double>& x) { return (x[0] - 0.5) * (x[1] - 0.5); };
  const MorrisMeasures measures = calc_morris_measures(evaluate(input, saddle), 3, 6);
  CHECK(measures.deviation[0] > 0.1);
  CHECK(std::fabs(measures.mean[0]) < measures.mean_size[0].value);
  CHECK(measures.deviation[2] == 0.0);
}
