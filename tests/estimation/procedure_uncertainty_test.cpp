// The uncertainty of a road load by a procedure: against fits to data that have the errors of a sensor.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/road_load/procedure_uncertainty.h"
#include "estimation/uncertainty/budget.h"
#include "estimation/uncertainty/monte_carlo.h"
#include "tests/support/procedure_study.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

struct UncertainProcedure {
  CoastdownFile file;
  RoadLoadProcedureOptions options;

  RoadLoadProcedure evaluate() const {
    return options.kind == RoadLoadProcedureKind::kWltp ? evaluate_wltp_coastdowns(file, options)
                                                        : evaluate_traces(file, options);
  }
};

UncertainProcedure simulate_uncertain(RoadLoadProcedureKind kind) {
  tests::ProcedureStudy study;
  study.wind_m_s = 1.5;
  study.ambient_K = 288.15;
  study.ambient_pressure_Pa = 98e3;
  study.run_force_sd_N = 3.0;
  study.on_board = kind == RoadLoadProcedureKind::kJ2263;
  const tests::SimulatedProcedure simulated = tests::simulate_procedure(study, 4);
  UncertainProcedure made{simulated.file, {}};
  made.options.kind = kind;
  made.options.mass_kg = simulated.mass_kg;
  made.options.rotating_mass_kg = study.rotating_mass_kg;
  if (kind == RoadLoadProcedureKind::kWltp) made.options.corrected_to_mass_kg = 1900.0;
  return made;
}

constexpr RoadLoadProcedureKind kTraceAndTimes[] = {RoadLoadProcedureKind::kWltp, RoadLoadProcedureKind::kJ2263,
                                                    RoadLoadProcedureKind::kJ1263};

}  // namespace

TEST_CASE("the budget of a procedure is its standard deviation, and its scatter that of the runs", "[fast]") {
  for (const auto kind : kTraceAndTimes) {
    const RoadLoadProcedure procedure = simulate_uncertain(kind).evaluate();
    const auto budgets = calc_budgets(make_procedure_model(procedure));
    const std::vector<int> coefficients =
        kind == RoadLoadProcedureKind::kJ1263 ? std::vector<int>{0, 2} : std::vector<int>{0, 1, 2};
    REQUIRE(budgets.size() == coefficients.size());
    for (std::size_t i = 0; i < budgets.size(); ++i) {
      const int at = coefficients[i];
      INFO(static_cast<int>(kind) << ", f" << at);
      CHECK(budgets[i].value == Approx(procedure.road_load(at)).margin(1e-9));
      CHECK(budgets[i].combined == Approx(procedure.sd(at)).epsilon(1e-6));
      CHECK(budgets[i].contributions.front().contribution ==
            Approx(std::sqrt(procedure.repeatability(at, at))).margin(1e-9));
      CHECK(budgets[i].contributions.size() == 1 + procedure.sensors.size());
    }
  }
}

TEST_CASE("a sensor that is off moves the road load as the same procedure on such data does", "[fast]") {
  for (const auto kind : kTraceAndTimes) {
    UncertainProcedure made = simulate_uncertain(kind);
    const RoadLoadProcedure before = made.evaluate();
    const auto check = [&](const std::string& name, const RoadLoadProcedure& after, double sds) {
      const auto found = std::find_if(before.sensors.begin(), before.sensors.end(),
                                      [&](const SensorContribution& one) { return one.sensor.name == name; });
      REQUIRE(found != before.sensors.end());
      const Eigen::Vector3d stated = sds * found->change;
      const Eigen::Vector3d real = after.road_load - before.road_load;
      for (const double v : {8.0, 20.0, 33.0}) {  // forces: coefficients make up for each other
        const Eigen::Vector3d powers(1.0, v, v * v);
        INFO(name << ", procedure " << static_cast<int>(kind) << ", at " << v << " m/s");
        CHECK(powers.dot(real) == Approx(powers.dot(stated)).epsilon(0.05).margin(0.02));
      }
    };
    UncertainProcedure fast = made;  // 0.5 km/h more than it was
    for (CoastdownRun& run : fast.file.data.runs) {
      for (double& speed_m_s : run.speed_m_s) speed_m_s += 0.5 / 3.6;
    }
    fast.options.speed_from_m_s += 0.5 / 3.6;  // the same samples
    check("vehicle speed", fast.evaluate(), 0.5 / 0.2 * std::sqrt(3.0));
    UncertainProcedure warm = made;
    for (CoastdownRun& run : warm.file.data.runs) {
      for (double& ambient_K : run.conditions.ambient_K) ambient_K += 2.0;
    }
    check("air temperature", warm.evaluate(), 2.0 * std::sqrt(3.0));
    UncertainProcedure heavy = made;
    *heavy.options.mass_kg += 30.0;
    check("mass", heavy.evaluate(), 3.0 * std::sqrt(3.0));
  }
}

TEST_CASE("Monte Carlo gives f0, f1 and f2 the variance of their parts", "[fast]") {
  const MeasurementModel model = make_procedure_model(simulate_uncertain(RoadLoadProcedureKind::kWltp).evaluate());
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
  RoadLoadProcedure procedure = simulate_uncertain(RoadLoadProcedureKind::kWltp).evaluate();
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
