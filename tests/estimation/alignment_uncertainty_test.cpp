// The uncertainty of an alignment: the closed forms of the line, and the bias that the first order does not see.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/alignment/alignment_uncertainty.h"
#include "estimation/uncertainty/monte_carlo.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

/// Five tires, off the line by a pattern, on machines whose means have these standard deviations.
AlignmentResult make_line_result(double candidate_sd, double residual) {
  const std::vector<double> x{6.5, 7.5, 8.6, 9.4, 10.7};
  const std::vector<double> pattern{0.4, -1.0, 0.7, 0.6, -0.7};
  std::vector<double> y;
  for (std::size_t i = 0; i < x.size(); ++i) y.push_back(0.93 * x[i] + 0.35 + residual * pattern[i]);
  AlignmentResult result;
  const double reference_sd = candidate_sd;  // of the same kind, so that both have half of the repeats' freedom
  result.fit = fit_line(x, y, {candidate_sd, reference_sd, 20.0});
  result.sigma_l = ScatterEstimate{reference_sd * std::sqrt(3.0), 10.0, 0.0, 0.0};
  result.sigma_m = {candidate_sd * std::sqrt(3.0), 10.0, 0.0, 0.0};
  result.line = make_alignment_line(result.fit, result.sigma_m, result.sigma_l->degrees_of_freedom);
  result.line.A1 = 1.04;
  result.line.B1 = -0.2;
  return result;
}

}  // namespace

TEST_CASE("the budget of a line is that of its closed forms", "[fast]") {
  for (const double residual : {0.002, 0.08}) {  // less, and more, than the repeats say
    const AlignmentResult result = make_line_result(0.03, residual);
    const auto budgets = calc_budgets(make_alignment_model(result));
    INFO("residuals of " << residual);
    CHECK(budgets[0].value == Approx(result.fit.slope));
    CHECK(budgets[0].combined == Approx(result.fit.slope_sd()).epsilon(0.01));
    // also the interval that is stated beside it: where the residuals decide, it is a little wider
    const double stated = result.fit.coverage_factor() * result.fit.slope_sd();
    CHECK(budgets[0].expanded > 0.98 * stated);
    CHECK(budgets[0].expanded < 1.4 * stated);
    if (result.fit.residual_sd < result.fit.repeat_sd) CHECK(budgets[0].expanded < 1.02 * stated);
    CHECK(budgets[1].combined == Approx(1e-3 * result.fit.offset_sd()).epsilon(0.01));
    for (const auto& [i, x] : {std::pair(2, 6.5), {3, 8.6}, {4, 10.7}}) {
      const UncertainValue aligned = align_value(result.line, x, 1);
      CHECK(budgets[static_cast<std::size_t>(i)].value == Approx(1e-3 * aligned.value));
      CHECK(budgets[static_cast<std::size_t>(i)].combined == Approx(1e-3 * aligned.sd).epsilon(0.01));
    }
  }
}

TEST_CASE("an aligned value has the budget of align_value, and fewer measurements a larger one", "[fast]") {
  const AlignmentResult result = make_line_result(0.03, 0.05);
  const auto find_sd = [&](double x, int measurements) {
    const auto budgets = calc_budgets(make_aligned_value_model(result.line, x, measurements));
    const UncertainValue aligned = align_value(result.line, x, measurements);
    CHECK(budgets[0].value == Approx(1e-3 * aligned.value));
    CHECK(budgets[0].combined == Approx(1e-3 * aligned.sd).epsilon(1e-3));
    return budgets[0].combined;
  };
  CHECK(find_sd(9.0, 1) > find_sd(9.0, 4));
  CHECK(find_sd(13.0, 1) > find_sd(9.0, 1));  // beyond the tires
}

TEST_CASE("Monte Carlo shows the bias of A2 by errors of the measured values", "[fast]") {
  const double candidate_sd = 0.25;  // ten times that of a good machine
  const AlignmentResult result = make_line_result(candidate_sd, 0.0);
  const MeasurementModel model = make_alignment_model(result);
  const MonteCarlo trials = run_monte_carlo(model, calc_budgets(model), {40'000, 1, 1});
  const double share =
      result.fit.attenuation * 10.0 / 8.0;  // the errors' standard deviation has ten degrees of freedom
  const double error = 3.0 * trials.results[0].sd / std::sqrt(40'000.0);
  CHECK(1.0 - trials.results[0].mean / result.fit.slope ==
        Approx(share).margin(error / result.fit.slope + 0.1 * share));
  CHECK(share > 4.0 * error);  // so that the check can fail
}
