// The residuals that a tire fit minimizes, and their derivatives.
#include "estimation/tire_fit/drum_residuals.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/fit_study.h"

using namespace rollrig;

TEST_CASE("a Jacobian of more parameters than one pass takes is the slope of differences", "[fast]") {
  measurements::MeasurementSet set = tests::make_warm_up_set("a50", "source", "quasi_static");
  set.runs.resize(1);
  models::Context<double> context = measurements::make_context(set);
  std::vector<estimation::FreeParameter> parameters;
  estimation::visit_parameters(context, [&](const std::string& table, const Field& field, double& value_SI) {
    if (value_SI != 0.0) parameters.push_back({table + "." + field.output_key(), value_SI});
  });
  const std::size_t count = parameters.size();
  REQUIRE(count > kJetWidth);
  const estimation::DrumResiduals residuals(set, context, parameters, 1);
  const std::size_t rows = residuals.residual_count(), columns = residuals.unknown_count();
  std::vector<double> at(rows), jacobian(rows * columns), above(rows), below(rows);
  residuals.evaluate(residuals.start().data(), at.data(), jacobian.data());
  std::size_t moved = 0;  // of the second pass
  for (std::size_t i = 0; i < count; ++i) {
    INFO(parameters[i].key);
    const double step_SI = 1e-5 * std::abs(parameters[i].start_SI);
    std::vector<double> unknowns = residuals.start();
    unknowns[i] += step_SI;
    residuals.evaluate(unknowns.data(), above.data(), nullptr);
    unknowns[i] -= 2.0 * step_SI;
    residuals.evaluate(unknowns.data(), below.data(), nullptr);
    double slope = 0.0, error = 0.0;  // squares, per relative change
    for (std::size_t row = 0; row < rows; ++row) {
      const double by_differences = (above[row] - below[row]) / 2e-5;
      const double by_jacobian = jacobian[row * columns + i] * std::abs(parameters[i].start_SI);
      slope += by_differences * by_differences;
      error += (by_jacobian - by_differences) * (by_jacobian - by_differences);
    }
    CHECK(std::sqrt(error) <= 1e-3 * std::sqrt(slope) + 1e-4);
    moved += i >= kJetWidth && slope > 1.0 ? 1 : 0;
  }
  CHECK(moved > 0);
}
