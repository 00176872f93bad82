// The uncertainty of laws of rolling resistance: closed forms of single errors, and the fit's own standard deviations.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/rolling_law/rolling_uncertainty.h"
#include "estimation/uncertainty/monte_carlo.h"
#include "sim/core/error.h"
#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

const J2452Law kRollingTruth{-0.42, 0.93, 0.055, 9.0e-5, 3.5e-7};

/// Six speeds at four loads and pressures, with errors of one standard deviation.
RollingTest make_rolling_test(double sd_N, std::uint64_t seed = 3) {
  RandomStream random(seed, "rolling");
  RollingTest test;
  test.path = "points.csv";
  for (const auto& [load_N, pressure_kPa] :
       {std::pair(2000.0, 250.0), std::pair(4000.0, 200.0), std::pair(6000.0, 300.0), std::pair(6000.0, 200.0)}) {
    for (const double km_h : {115.0, 95.0, 75.0, 55.0, 35.0, 15.0}) {
      RollingPoint point{km_h / 3.6, load_N, 1e3 * pressure_kPa, 0.0};
      point.force_N =
          kRollingTruth.calc_force_N(point.pressure_Pa, point.load_N, point.speed_m_s) + sd_N * random.normal();
      test.points.push_back(point);
    }
  }
  return test;
}

struct LawCase {
  RollingTest test;
  J2452Fit fit;
  J2452Reference reference;
  MeasurementModel model;
  std::vector<UncertaintyBudget> budgets;

  explicit LawCase(double sd_N)
      : test(make_rolling_test(sd_N)),
        fit(fit_j2452(test.points)),
        reference(evaluate_reference(fit, {4200.0, 240e3, kReferenceSpeed_m_s},
                                     {"slow", "fast", {1e4, 12.0, 180.0}, {1e4, 23.0, 550.0}})),
        model(make_j2452_model(test, fit, reference)),
        budgets(calc_budgets(model)) {}

  const UncertaintyBudget& budget(const std::string& key) const {
    return *std::find_if(budgets.begin(), budgets.end(), [&](const auto& one) { return one.measurand.key == key; });
  }
  const Contribution& line(const std::string& key, const std::string& input) const {
    const auto& lines = budget(key).contributions;
    const auto found =
        std::find_if(lines.begin(), lines.end(), [&](const auto& one) { return one.input.name == input; });
    REQUIRE(found != lines.end());
    return *found;
  }
};

}  // namespace

TEST_CASE("the scatter of the points contributes what the fit states as standard deviation", "[fast]") {
  const LawCase at(0.3);
  const auto by_scatter = [&](const char* key) { return at.line(key, "scatter of the points").contribution; };
  CHECK(by_scatter("rolling_resistance_N") == Approx(at.reference.force.sd_N).epsilon(0.02));
  CHECK(by_scatter("merf_urban_N") == Approx(at.reference.urban.sd_N).epsilon(0.02));
  CHECK(by_scatter("smerf_N") == Approx(at.reference.combined.sd_N).epsilon(0.02));
  CHECK(by_scatter("alpha") == Approx(at.fit.coefficients[0].sd).epsilon(0.02));
  CHECK(by_scatter("beta") == Approx(at.fit.coefficients[1].sd).epsilon(0.02));
  CHECK(at.line("alpha", "scatter of the points").input.degrees_freedom == 24 - 5);
  CHECK(at.budget("rolling_resistance_N").value == Approx(at.reference.force.value_N).epsilon(1e-6));
}

TEST_CASE("the scatter of sets contributes what the fit states, with the degrees of freedom of the sets", "[fast]") {
  RandomStream random(4, "sets");
  RollingTest test = make_rolling_test(0.1);
  const std::vector<RollingPoint> first = test.points;
  for (std::size_t i = 0; i < 12; ++i) {  // two further loads
    test.points.push_back(first[i]);
    test.points.back().load_N += 1000.0;
    test.points.back().force_N = kRollingTruth.calc_force_N(test.points.back().pressure_Pa, test.points.back().load_N,
                                                            test.points.back().speed_m_s);
  }
  for (std::size_t set = 0; set < 6; ++set) {
    const double factor = 1.0 + 0.02 * random.normal();
    for (std::size_t i = 0; i < 6; ++i) test.points[6 * set + i].force_N *= factor;
  }
  const J2452Fit fit = fit_j2452(test.points, RandomPart::kPointsAndSets);
  REQUIRE(fit.includes_set_scatter());
  const std::vector<UncertaintyBudget> budgets = calc_budgets(make_j2452_model(test, fit, std::nullopt));
  for (std::size_t i = 0; i < 2; ++i) {
    double variance = 0.0;
    int set_lines = 0;
    for (const Contribution& line : budgets[i].contributions) {
      if (line.input.name.rfind("scatter", 0) == 0) variance += line.contribution * line.contribution;
      if (line.input.name != "scatter from set to set") continue;
      CHECK(line.input.degrees_freedom == Approx(6 - 3));
      ++set_lines;
    }
    CHECK(set_lines == 1);
    CHECK(std::sqrt(variance) == Approx(fit.coefficients[i].sd).epsilon(0.05));
  }
}

TEST_CASE("an error that all points share moves the law as its equation says", "[fast]") {
  const LawCase at(0.0);
  const double force_N = at.reference.force.value_N;
  const double root3 = std::sqrt(3.0);
  const auto by = [&](const char* input) { return at.line("rolling_resistance_N", input).contribution; };
  CHECK(by("gain of torque or force") == Approx(0.005 * force_N / root3));
  // Loads that are read high belong to a lower law: F ~ Z^beta.
  CHECK(by("gain of the load") == Approx(0.93 * 0.005 * force_N / root3).epsilon(1e-3));
  // F ~ P^alpha near the reference, which lies amid the pressures
  CHECK(by("pressure") == Approx(0.42 * 1.0 / 240.0 * force_N / root3).epsilon(0.05));
  // dF/dv = P^alpha Z^beta (b + 2 c v)
  const double slope_N = std::pow(240.0, -0.42) * std::pow(4200.0, 0.93) * (9.0e-5 + 2.0 * 3.5e-7 * 80.0);
  CHECK(by("speed") == Approx(0.1 * slope_N / root3).epsilon(1e-3));
  CHECK(at.line("beta", "gain of torque or force").contribution == Approx(0.0).margin(1e-9));
  CHECK(at.line("beta", "gain of the load").contribution == Approx(0.0).margin(1e-9));
}

TEST_CASE("Monte Carlo and the GUM agree on a law whose points alone are uncertain", "[fast]") {
  LawCase at(0.3);
  for (UncertainInput& input : at.model.inputs) {
    if (input.name != "scatter of the points") input.standard_uncertainty = 0.0;
  }
  const auto budgets = calc_budgets(at.model);
  const MonteCarlo trials = run_monte_carlo(at.model, budgets, {4000, 1, 1});
  for (std::size_t i = 0; i < budgets.size(); ++i) {
    INFO(budgets[i].measurand.key);
    const double expanded = budgets[i].expanded;
    CHECK(budgets[i].degrees_freedom == Approx(19.0));
    CHECK(trials.results[i].low == Approx(budgets[i].value - expanded).margin(0.08 * expanded));
    CHECK(trials.results[i].high == Approx(budgets[i].value + expanded).margin(0.08 * expanded));
    // Student's t of 19 degrees of freedom has a standard deviation of sqrt(19/17)
    CHECK(trials.results[i].sd == Approx(std::sqrt(19.0 / 17.0) * budgets[i].combined).epsilon(0.05));
  }
}

TEST_CASE("Monte Carlo shows that an interval is shorter than the GUM has it where a rectangular error leads",
          "[fast]") {
  // The parasitic loss, +-0.1 N, makes most of the variance: no trial can be farther off than that by it.
  LawCase at(0.01);
  for (UncertainInput& input : at.model.inputs) {
    if (input.name.rfind("gain", 0) == 0) input.standard_uncertainty = 0.0;
  }
  const auto budgets = calc_budgets(at.model);
  const UncertaintyBudget& budget = budgets.back();
  REQUIRE(budget.measurand.key == "smerf_N");
  const auto is_parasitic = [](const Contribution& line) {
    return line.input.name == "parasitic loss that was subtracted";
  };
  REQUIRE(std::find_if(budget.contributions.begin(), budget.contributions.end(), is_parasitic)->share > 0.8);
  const MonteCarlo trials = run_monte_carlo(at.model, budgets, {4000, 1, 1});
  const MonteCarloResult& smerf = trials.results.back();
  CHECK(smerf.sd == Approx(budget.combined).epsilon(0.03));
  CHECK(smerf.high - smerf.low < 0.95 * 2.0 * budget.expanded);
  CHECK(smerf.verdict == GumVerdict::kDiffers);
}

TEST_CASE("a law through all of its points has no uncertainty", "[fast]") {
  RollingTest test = make_rolling_test(0.1);
  test.points = {test.points[2], test.points[8], test.points[14], test.points[20]};
  const MultipointFit fit = fit_multipoint(test.points, MultipointForm::kBilinear);
  REQUIRE(fit.statistics.freedom == 0);
  CHECK_THROWS_WITH(make_multipoint_model(test, fit, std::nullopt),
                    Catch::Contains("as many coefficients as points") && Catch::Contains("points.csv"));
}

TEST_CASE("a multipoint law has the fit's own scatter, and no error of a speed that it does not have", "[fast]") {
  RollingTest test = make_rolling_test(0.3);
  std::vector<RollingPoint> at_80;
  for (const RollingPoint& point : test.points) {
    if (std::abs(point.speed_m_s - 75.0 / 3.6) < 0.01) at_80.insert(at_80.end(), {point, point});
  }
  RandomStream random(8, "repeats");
  for (RollingPoint& point : at_80) point.force_N += 0.2 * random.normal();
  test.points = at_80;
  const MultipointFit fit = fit_multipoint(test.points, MultipointForm::kBilinear);
  const ReferenceCondition at{4500.0, 230e3, fit.speed_m_s};
  const MultipointReference reference{at, fit.estimate_force(at.load_N, at.pressure_Pa)};
  const auto budgets = calc_budgets(make_multipoint_model(test, fit, reference));
  CHECK(budgets[0].value == Approx(reference.force.value_N));
  double scatter_N = 0.0;
  for (const Contribution& line : budgets[0].contributions) {
    if (line.input.name == "scatter of the points") scatter_N = line.contribution;
    CHECK(line.input.name != "speed");
  }
  CHECK(scatter_N == Approx(reference.force.sd_N));  // linear in the forces
  CHECK(budgets[1].value == Approx(budgets[0].value / 4500.0));
}
