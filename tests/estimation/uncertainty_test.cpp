// Budgets and Monte Carlo against closed forms and the worked examples of JCGM 101:2008 (GUM Supplement 1), 9.2
// and 9.3.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "estimation/uncertainty/common_inputs.h"
#include "estimation/uncertainty/covariance_root.h"
#include "estimation/uncertainty/uncertainty.h"
#include "include/rollrig/error.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

UncertainInput make_input(const std::string& name, double value, double u,
                          Distribution distribution = Distribution::kNormal) {
  UncertainInput input{name, name, value, u};
  input.distribution = distribution;
  return input;
}

/// Y = X1 + X2 + X3 + X4 (9.2.1), every X with mean 0.
MeasurementModel make_sum(Distribution distribution, const std::vector<double>& sds = {1.0, 1.0, 1.0, 1.0}) {
  MeasurementModel model;
  model.measurands = {{"sum", "sum"}};
  for (std::size_t i = 0; i < sds.size(); ++i) {
    model.inputs.push_back(make_input("X" + std::to_string(i + 1), 0.0, sds[i], distribution));
  }
  model.evaluate = [](const std::vector<double>& x) {
    double sum = 0.0;
    for (const double one : x) sum += one;
    return std::vector<double>{sum};
  };
  return model;
}

MonteCarloResult run(const MeasurementModel& model, int trials, int threads = 1) {
  return run_monte_carlo(model, calc_budgets(model), {trials, 7, threads}).results.front();
}

}  // namespace

TEST_CASE("a budget adds variances, and its shares are those of the variance", "[fast]") {
  const auto budget = calc_budgets(make_sum(Distribution::kNormal, {3.0, 4.0}))[0];
  CHECK(budget.combined == Approx(5.0).epsilon(1e-12));
  CHECK(budget.contributions[0].share == Approx(0.36).epsilon(1e-12));
  CHECK(budget.contributions[1].share == Approx(0.64).epsilon(1e-12));
  CHECK(std::isinf(budget.degrees_freedom));
  CHECK(budget.expanded == Approx(9.79982).epsilon(1e-6));  // 1.959964 * 5
}

TEST_CASE("effective degrees of freedom and coverage factor of GUM H.1", "[fast]") {
  // End-gauge calibration, JCGM 100:2008 H.1.6: u_c = 32 nm with these contributions and degrees of freedom gives
  // nu_eff = 16 after truncation, and t_99(16) = 2.92. G.4.1 allows to interpolate as well, which is done here: between
  // t_95(17) = 2.11 and t_95(16) = 2.12, table G.2.
  MeasurementModel model = make_sum(Distribution::kNormal, {25.0, 9.7, 2.9, 16.6});
  const double dofs[]{18.0, 25.6, 50.0, 2.0};
  for (std::size_t i = 0; i < 4; ++i) model.inputs[i].degrees_freedom = dofs[i];
  const auto budget = calc_budgets(model)[0];
  CHECK(budget.combined == Approx(31.6).epsilon(5e-3));
  CHECK(std::floor(budget.degrees_freedom) == 16.0);
  CHECK(calc_coverage_factor(16.0) == Approx(2.12).margin(0.005));
  CHECK(budget.coverage_factor < calc_coverage_factor(16.0));
  CHECK(budget.coverage_factor > calc_coverage_factor(17.0));
  // Table G.2 of the GUM
  CHECK(calc_coverage_factor(1.0) == Approx(12.71).margin(0.005));
  CHECK(calc_coverage_factor(10.0) == Approx(2.23).margin(0.005));
  CHECK(calc_coverage_factor(0.3) == Approx(12.71).margin(0.005));
  CHECK(calc_coverage_factor(std::numeric_limits<double>::infinity()) == Approx(1.960).margin(0.0005));
}

TEST_CASE("inputs of one name are one line of the budget", "[fast]") {
  MeasurementModel model = make_sum(Distribution::kNormal, {3.0, 4.0, 12.0});
  model.inputs[0].name = model.inputs[2].name = "scatter";
  const auto budget = calc_budgets(model)[0];
  REQUIRE(budget.contributions.size() == 2);
  CHECK(budget.contributions[0].contribution == Approx(std::hypot(3.0, 12.0)).epsilon(1e-12));
  CHECK(budget.combined == Approx(13.0).epsilon(1e-12));
}

TEST_CASE("JCGM 101 9.2.2: four normal inputs, for which the GUM is exact", "[fast]") {
  const MonteCarloResult result = run(make_sum(Distribution::kNormal), 200'000);
  // Table 2: u = 2.0, interval +-3.92. Five standard deviations of 200,000 trials.
  CHECK(result.mean == Approx(0.0).margin(5 * 2.0 / std::sqrt(2e5)));
  CHECK(result.sd == Approx(2.0).margin(5 * 2.0 / std::sqrt(4e5)));
  CHECK(result.low == Approx(-3.92).margin(5 * result.low_sd));
  CHECK(result.high == Approx(3.92).margin(5 * result.high_sd));
  CHECK(result.tolerance == Approx(0.05));
  CHECK(result.verdict == GumVerdict::kAgrees);
}

TEST_CASE("JCGM 101 9.2.3: four rectangular inputs, whose interval is a little shorter", "[fast]") {
  // 9.2.3.4: the ends are +-2 sqrt(3) (2 - (3/5)^(1/4)) = +-3.88, those of the GUM +-3.92: within the tolerance of
  // 0.05.
  const MonteCarloResult result = run(make_sum(Distribution::kRectangular), 200'000);
  const double exact = 2.0 * std::sqrt(3.0) * (2.0 - std::pow(0.6, 0.25));
  CHECK(exact == Approx(3.88).margin(0.005));
  CHECK(result.low == Approx(-exact).margin(5 * result.low_sd));
  CHECK(result.high == Approx(exact).margin(5 * result.high_sd));
  CHECK(std::abs(result.high) < 3.92);
}

TEST_CASE("JCGM 101 9.2.4: a rectangular input that dominates, of which the GUM is wrong", "[fast]") {
  // 9.2.4: X4 has a standard deviation of 10. GUM: u = 10.1, +-19.9. Table 4, Monte Carlo: 10.1, +-17.0.
  const MeasurementModel model = make_sum(Distribution::kRectangular, {1.0, 1.0, 1.0, 10.0});
  CHECK(calc_budgets(model)[0].combined == Approx(10.1).margin(0.05));
  CHECK(calc_budgets(model)[0].expanded == Approx(19.9).margin(0.05));
  const MonteCarloResult result = run(model, 100'000);
  CHECK(result.sd == Approx(10.1).margin(0.1));
  CHECK(result.low == Approx(-17.0).margin(0.1));
  CHECK(result.high == Approx(17.0).margin(0.1));
  CHECK(result.verdict == GumVerdict::kDiffers);
}

TEST_CASE("JCGM 101 9.3: calibration of a mass, where first order lacks more than a quarter", "[fast]") {
  // (34): dm = (m_Rc + dm_Rc) [1 + (a - a0)(1/rho_W - 1/rho_R)] - m_nom, mg. Table 6: GUM to first order 1.2340,
  // 0.0539, [1.1285, 1.3395]; Monte Carlo 1.2340, 0.0754, [1.0834, 1.3825]; not validated.
  MeasurementModel model;
  model.measurands = {{"mass", "dm"}};
  model.inputs = {make_input("m_Rc", 100000.000, 0.050), make_input("dm_Rc", 1.234, 0.020),
                  make_input("a", 1.20, 0.10 / std::sqrt(3.0), Distribution::kRectangular),
                  make_input("rho_W", 8e3, 1e3 / std::sqrt(3.0), Distribution::kRectangular),
                  make_input("rho_R", 8e3, 0.05e3 / std::sqrt(3.0), Distribution::kRectangular)};
  model.evaluate = [](const std::vector<double>& x) {
    return std::vector<double>{(x[0] + x[1]) * (1.0 + (x[2] - 1.2) * (1.0 / x[3] - 1.0 / x[4])) - 100000.0};
  };
  const auto budget = calc_budgets(model)[0];
  CHECK(budget.combined == Approx(0.0539).margin(5e-5));
  CHECK(budget.value - budget.expanded == Approx(1.1285).margin(1.5e-4));
  CHECK(budget.value + budget.expanded == Approx(1.3395).margin(1.5e-4));
  const MonteCarloResult result = run(model, 200'000);
  CHECK(result.mean == Approx(1.2340).margin(1e-3));
  CHECK(result.sd == Approx(0.0754).margin(5e-4));
  CHECK(result.low == Approx(1.0834).margin(5 * result.low_sd));
  CHECK(result.high == Approx(1.3825).margin(5 * result.high_sd));
  CHECK(result.tolerance == Approx(5e-4));  // 0.054 = 54e-3
  CHECK(result.verdict == GumVerdict::kDiffers);
}

TEST_CASE("too few trials do not decide whether the GUM holds, and say how many would", "[fast]") {
  const MonteCarloResult few = run(make_sum(Distribution::kNormal), 1000);
  CHECK(few.verdict == GumVerdict::kUndecided);
  CHECK(few.trials_wanted > 1e5);
  CHECK(few.trials_wanted < 1e7);
  // The scatter that is stated of an end is that over seeds: 40 seeds tell a standard deviation to about 11 %.
  const MeasurementModel model = make_sum(Distribution::kNormal);
  double squares = 0.0, stated = 0.0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto result = run_monte_carlo(model, calc_budgets(model), {2000, seed, 1}).results[0];
    squares += std::pow(result.high - 3.92, 2) / 40.0;
    stated += result.high_sd / 40.0;
  }
  CHECK(std::sqrt(squares) == Approx(stated).epsilon(0.4));
}

TEST_CASE("Student's t of a mean of repeated observations is drawn with its own tails", "[fast]") {
  MeasurementModel model = make_sum(Distribution::kStudentT, {2.0});
  model.inputs[0].degrees_freedom = 4.0;
  const MonteCarloResult result = run(model, 100'000);
  CHECK(result.high == Approx(2.0 * 2.776).margin(5 * result.high_sd));  // GUM table G.2: t_95(4) = 2.78
  CHECK(calc_budgets(model)[0].expanded == Approx(2.0 * 2.776).epsilon(1e-3));
  CHECK(result.verdict != GumVerdict::kDiffers);
}

TEST_CASE("errors with one estimated standard deviation have a joint t distribution, one line and its freedom",
          "[fast]") {
  // Their sum over three has sqrt(3) times Student's t of four degrees of freedom; independent t of each would have
  // shorter tails.
  MeasurementModel model;
  model.measurands = {{"sum", "force_N"}};
  model.inputs = make_scatter_inputs(3, 4.0, "scatter", "residuals");
  model.evaluate = [](const std::vector<double>& x) {
    const std::vector<double> errors = take_scatter(x, 0, 3);
    return std::vector<double>{errors[0] + errors[1] + errors[2]};
  };
  const MonteCarloResult result = run(model, 100'000);
  CHECK(result.high == Approx(std::sqrt(3.0) * 2.776).margin(5 * result.high_sd));  // GUM table G.2: t_95(4) = 2.78
  const UncertaintyBudget budget = calc_budgets(model)[0];
  CHECK(budget.contributions.size() == 1);
  CHECK(budget.degrees_freedom == Approx(4.0));
  CHECK(budget.expanded == Approx(std::sqrt(3.0) * 2.776).epsilon(1e-3));
  CHECK(result.verdict != GumVerdict::kDiffers);
}

TEST_CASE("the root of a covariance gives it back, also where a number has no variance", "[fast]") {
  Eigen::Matrix3d covariance;
  covariance << 4.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 9.0;
  const Eigen::MatrixXd root = calc_covariance_root(covariance);
  CHECK((root * root.transpose() - covariance).norm() == Approx(0.0).margin(1e-12));
  CHECK(root.row(1).norm() == 0.0);
}

TEST_CASE("Monte Carlo gives the same bits for any number of threads, and others for another seed", "[fast]") {
  const MeasurementModel model = make_sum(Distribution::kRectangular, {1.0, 2.0});
  const MonteCarloResult one = run(model, 5000, 1);
  const MonteCarloResult four = run(model, 5000, 4);
  CHECK(one.mean == four.mean);
  CHECK(one.sd == four.sd);
  CHECK(one.low == four.low);
  CHECK(one.high == four.high);
  CHECK(run_monte_carlo(model, calc_budgets(model), {5000, 8, 1}).results[0].mean != one.mean);
}

TEST_CASE("trials that fail are counted, and too many of them are no result", "[fast]") {
  MeasurementModel model = make_sum(Distribution::kNormal, {1.0});
  const auto sum = model.evaluate;
  double limit = 1.96;
  model.evaluate = [&](const std::vector<double>& x) {
    if (std::abs(x[0]) > limit) throw RunFailure("out of range");
    return sum(x);
  };
  const auto budgets = calc_budgets(model);
  const MonteCarlo some = run_monte_carlo(model, budgets, {10'000, 1, 1});
  CHECK(some.failed == Approx(500).margin(120));  // 5 %
  limit = 1.0;                                    // 32 %
  CHECK_THROWS_AS(run_monte_carlo(model, budgets, {1000, 1, 1}), RunFailure);
}

TEST_CASE("the numerical tolerance is half of the second digit", "[fast]") {
  // 7.9.2, examples: 0.00035 g -> 0.000005 g; 2 K with two digits (2.0) -> 0.05 K
  CHECK(calc_numerical_tolerance(0.00035) == Approx(0.000005));
  CHECK(calc_numerical_tolerance(2.0) == Approx(0.05));
  CHECK(calc_numerical_tolerance(99.6) == Approx(5.0));  // 1.0e2
  CHECK(calc_numerical_tolerance(10.0) == Approx(0.5));
}

TEST_CASE("uncertainties of temperatures are differences, in the unit of the key", "[fast]") {
  MeasurementModel model;
  model.measurands = {{"coefficient", "rrc_N_per_kN"}};
  model.inputs = {make_input("air", 298.15, 0.5)};
  model.inputs[0].key = "ambient_degC";
  model.evaluate = [](const std::vector<double>& x) {
    return std::vector<double>{0.005 * (1 + 0.008 * (x[0] - 298.15))};
  };
  const Json budget = make_uncertainty_json(calc_uncertainty(model, {}))["budgets"][0];
  CHECK(budget["value"].get<double>() == Approx(5.0));
  CHECK(budget["contributions"][0]["value"].get<double>() == Approx(25.0));
  CHECK(budget["contributions"][0]["standard_uncertainty"].get<double>() == Approx(0.5));
  CHECK(budget["contributions"][0]["sensitivity"].get<double>() == Approx(0.04));  // N/kN per K
  CHECK(budget["combined_standard_uncertainty"].get<double>() == Approx(0.02));
  CHECK(budget["effective_degrees_of_freedom"].is_null());
}
