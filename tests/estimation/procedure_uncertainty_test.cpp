// The uncertainty of a road load by a procedure: the intervals of the procedure, found another way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/road_load/procedure_uncertainty.h"
#include "estimation/uncertainty/monte_carlo.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

RoadLoadProcedure make_uncertain_procedure(RoadLoadProcedureKind kind, bool sensor_accuracy = true) {
  tests::ProcedureStudy study;
  study.wind_m_s = 1.5;
  study.ambient_K = 288.15;
  study.ambient_pressure_Pa = 98e3;
  study.run_force_sd_N = 3.0;
  study.on_board = kind == RoadLoadProcedureKind::kJ2263;
  const tests::SimulatedProcedure simulated = tests::simulate_procedure(study, 4);
  RoadLoadProcedureOptions options;
  options.kind = kind;
  options.mass_kg = simulated.mass_kg;
  options.rotating_mass_kg = study.rotating_mass_kg;
  if (kind == RoadLoadProcedureKind::kWltp) options.corrected_to_mass_kg = 1900.0;
  options.sensor_accuracy = sensor_accuracy;
  return kind == RoadLoadProcedureKind::kWltp ? evaluate_wltp_coastdowns(simulated.file, options)
                                              : evaluate_traces(simulated.file, options);
}

}  // namespace

TEST_CASE("the budget of a procedure is its standard deviation, and its scatter that of the runs", "[fast]") {
  for (const auto kind : {RoadLoadProcedureKind::kWltp, RoadLoadProcedureKind::kJ2263, RoadLoadProcedureKind::kJ1263}) {
    const RoadLoadProcedure procedure = make_uncertain_procedure(kind);
    const auto budgets = calc_budgets(make_procedure_model(procedure));
    for (int i = 0; i < 3; ++i) {
      const UncertaintyBudget& budget = budgets[static_cast<std::size_t>(i)];
      INFO(static_cast<int>(kind) << ", f" << i);
      CHECK(budget.value == Approx(procedure.road_load(i)).margin(1e-9));
      CHECK(budget.combined == Approx(procedure.sd(i)).epsilon(0.01).margin(1e-12));
      CHECK(budget.contributions.front().contribution == Approx(std::sqrt(procedure.repeatability(i, i))).margin(1e-9));
      CHECK(budget.contributions.size() == 1 + procedure.sensors.size());
    }
  }
}

TEST_CASE("Monte Carlo gives f0, f1 and f2 the variance of their parts", "[fast]") {
  const MeasurementModel model = make_procedure_model(make_uncertain_procedure(RoadLoadProcedureKind::kWltp));
  const auto budgets = calc_budgets(model);
  const MonteCarlo trials = run_monte_carlo(model, budgets, {40'000, 1, 1});
  for (std::size_t i = 0; i < 3; ++i) {
    INFO("f" << i);
    const Contribution& scatter = budgets[i].contributions.front();
    const double nu = scatter.input.degrees_freedom;
    REQUIRE(nu > 4.0);
    const double others = budgets[i].combined * budgets[i].combined - scatter.contribution * scatter.contribution;
    // the variance of Student's t is nu/(nu - 2)
    const double sd = std::sqrt(nu / (nu - 2.0) * scatter.contribution * scatter.contribution + others);
    CHECK(trials.results[i].sd == Approx(sd).epsilon(0.03));
    CHECK(trials.results[i].mean == Approx(budgets[i].value).margin(5.0 * sd / 200.0));
  }
}

TEST_CASE("what a budget of a road load leaves out is said", "[fast]") {
  RoadLoadProcedure procedure = make_uncertain_procedure(RoadLoadProcedureKind::kWltp);
  const auto says = [](const RoadLoadProcedure& of, const std::string& words) {
    const std::vector<std::string> left_out = make_procedure_model(of).left_out;
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const std::string& one) { return one.find(words) != std::string::npos; });
  };
  CHECK(says(procedure, "K0"));
  CHECK_FALSE(says(procedure, "dynamic radius"));
  procedure.tested.most_torque_Nm = 300.0;  // as of a torque meter, its radius given
  CHECK(says(procedure, "dynamic radius"));
}
