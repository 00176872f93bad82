// The uncertainty budget of an ISO 28580 test against closed forms and against simulations.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/uncertainty/uncertainty.h"
#include "measurements/sensor_file.h"
#include "scenarios/common/readings.h"
#include "sim/core/assets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using namespace rollrig::estimation;
using tests::make_spec;
using tests::number;

namespace {

struct IsoRun {
  scenarios::RunSpec spec;
  scenarios::Outcome outcome;
  MeasurementModel model;

  explicit IsoRun(scenarios::RunSpec from)
      : spec(std::move(from)), outcome(scenarios::run_scenario(spec, {})), model(outcome.make_measurement_model()) {}
  IsoRun(const IsoRun&) = delete;

  std::vector<double> values() const {
    std::vector<double> values;
    for (const UncertainInput& input : model.inputs) values.push_back(input.value);
    return values;
  }
  std::size_t place(const std::string& name) const {
    for (std::size_t i = 0; i < model.inputs.size(); ++i) {
      if (model.inputs[i].name == name) return i;
    }
    FAIL("no input " << name);
    return 0;
  }
  double contribution(const std::string& name, std::size_t measurand = 0) const {
    const UncertaintyBudget budget = calc_budgets(model)[measurand];
    for (const Contribution& line : budget.contributions) {
      if (line.input.name == name) return line.contribution;
    }
    FAIL("no line " << name);
    return 0.0;
  }
};

scenarios::RunSpec make_iso(const std::vector<std::string>& settings = {}, bool sensors = false) {
  scenarios::RunSpec spec = make_spec("iso_28580", "a50", settings, "quasi_static");
  if (sensors) spec.sensors = measurements::read_sensor_asset("source");
  return spec;
}

}  // namespace

TEST_CASE("the budget is of the result that is reported, also off the reference conditions", "[fast]") {
  const IsoRun run(make_iso({"ambient_degC=28", "rig.drum.diameter_m=1.7"}));
  const auto budgets = calc_budgets(run.model);
  CHECK(1e3 * budgets[0].value == Approx(number(run.outcome, "rrc_25degC_2m_N_per_kN")).epsilon(1e-12));
  CHECK(1e3 * budgets[1].value == Approx(number(run.outcome, "rrc_N_per_kN")).epsilon(1e-12));
}

TEST_CASE("contributions of the instruments are those of the closed form", "[fast]") {
  const IsoRun run(make_iso({"ambient_degC=28"}));
  const double rrc = 1e-3 * number(run.outcome, "rrc_N_per_kN");
  const double corrected = 1e-3 * number(run.outcome, "rrc_25degC_2m_N_per_kN");
  const double third = 1.0 / std::sqrt(3.0);
  CHECK(run.contribution("load") == Approx(corrected * 0.005 * third).epsilon(1e-4));
  CHECK(run.contribution("gain of torque or force") == Approx(corrected * 0.005 * third).epsilon(1e-6));
  CHECK(run.contribution("ambient temperature") == Approx(rrc * 0.008 * 0.2 * third).epsilon(1e-6));
  CHECK(run.contribution("ambient temperature", 1) == 0.0);
  CHECK(run.contribution("zero of torque or force") == Approx(0.0).margin(1e-12 * corrected));
  // Noise and drift are what the result beside it states with k = 2.
  CHECK(2e3 * run.contribution("noise and drift, load minus skim") ==
        Approx(number(run.outcome, "rrc_uncertainty_N_per_kN")).epsilon(1e-6));
  // A drum that is larger than was believed has a longer lever: as measured, exactly -1 % for +1 %.
  const double relative_m = 0.001 * third / 2.0;
  CHECK(run.contribution("drum diameter", 1) == Approx(rrc * relative_m).epsilon(1e-3));
}

TEST_CASE("the budget of each method is of the RRc that the method gives", "[fast]") {
  for (const char* method : {"torque", "force", "power", "deceleration"}) {
    INFO(method);
    const IsoRun run(make_iso({std::string("method=") + method, "ambient_degC=28", "rig.drum.diameter_m=1.7",
                               "spindle_misalignment_mrad=0.2"}));
    const auto budgets = calc_budgets(run.model);
    CHECK(1e3 * budgets[0].value == Approx(number(run.outcome, "rrc_25degC_2m_N_per_kN")).epsilon(1e-12));
    for (const Json& one : run.outcome.result["methods"]) {
      if (one["name"] == method) CHECK(1e3 * budgets[1].value == Approx(one["rrc_N_per_kN"].get<double>()));
    }
  }
}

TEST_CASE("what each method alone rests on contributes as its closed form says", "[fast]") {
  const double third = 1.0 / std::sqrt(3.0);
  const double relative = 0.001 * third / 2.0;  // of the diameter of 2 m
  const IsoRun force(make_iso({"method=force", "force_cell_angle_accuracy_mrad=0.3"}));
  const double load_N = number(force.outcome, "load_N");
  const double rrc = calc_budgets(force.model)[1].value;
  const double radius_m = models::calc_loaded_radius_m(force.spec.tire.values, load_N);
  const double skim_radius_m = models::calc_loaded_radius_m(force.spec.tire.values, 200.0);
  // L sin d on both readings, each times 1 + r/R
  CHECK(force.contribution("angle of the force cell to the load", 1) ==
        Approx(3e-4 * third * (load_N * (1.0 + radius_m) - 200.0 * (1.0 + skim_radius_m)) / load_N).epsilon(1e-3));
  // A larger drum lowers 1 + r/R.
  CHECK(force.contribution("drum diameter", 1) == Approx(rrc * relative * radius_m / (1.0 + radius_m)).epsilon(0.01));
  // A zero cancels but for the two radii.
  const double offset_N = force.model.inputs[force.place("zero of the spindle force")].standard_uncertainty;
  REQUIRE(offset_N > 0.0);
  CHECK(force.contribution("zero of the spindle force", 1) ==
        Approx(offset_N * (skim_radius_m - radius_m) / load_N).epsilon(1e-3));

  const IsoRun power(make_iso({"method=power"}));
  // The speed is that of the shaft times the radius: P/(omega R), as T/R.
  CHECK(power.contribution("drum diameter", 1) == Approx(calc_budgets(power.model)[1].value * relative).epsilon(1e-3));
  CHECK(power.contribution("zero of the power", 1) == Approx(0.0).margin(1e-12));
  CHECK(power.contribution("gain of the power", 1) ==
        Approx(calc_budgets(power.model)[1].value * 0.005 * third).epsilon(1e-6));

  const IsoRun deceleration(make_iso({"method=deceleration", "inertia_accuracy_percent=1"}));
  CHECK(deceleration.contribution("inertias of drum and wheel", 1) ==
        Approx(calc_budgets(deceleration.model)[1].value * 0.01 * third).epsilon(1e-6));
  CHECK(deceleration.contribution("zero of the speed", 1) == 0.0);
}

TEST_CASE("power over speed: a speed that is off by 1 % moves the RRc by that and by what the tire does", "[fast]") {
  const IsoRun power(make_iso({"method=power"}));
  const IsoRun torque(make_iso());
  const auto moved = [](const IsoRun& run) {
    std::vector<double> x = run.values();
    const double before = run.model.evaluate(x)[1];
    x[run.place("speed")] *= 1.01;
    return run.model.evaluate(x)[1] / before;
  };
  CHECK(moved(power) == Approx(moved(torque) / 1.01).epsilon(1e-6));
}

TEST_CASE("an accuracy that is given is used, and no longer assumed", "[fast]") {
  const IsoRun run(make_iso({"load_accuracy_percent=0.1", "ambient_accuracy_K=0.5", "pressure_accuracy_kPa=2"}));
  const double rrc = 1e-3 * number(run.outcome, "rrc_N_per_kN");
  const double third = 1.0 / std::sqrt(3.0);
  CHECK(run.contribution("load") == Approx(rrc * 0.001 * third).epsilon(1e-4));
  CHECK(run.contribution("ambient temperature") == Approx(rrc * 0.008 * 0.5 * third).epsilon(1e-6));
  CHECK(run.model.inputs[run.place("pressure as set")].standard_uncertainty == Approx(2e3 * third).epsilon(1e-12));
  CHECK_FALSE(run.model.inputs[run.place("load")].is_from_limits);
  CHECK(run.model.inputs[run.place("speed")].is_from_limits);
}

TEST_CASE("speed and pressure act as in a simulation with others", "[fast]") {
  const IsoRun run(make_iso());
  std::vector<double> x = run.values();
  x[run.place("speed")] += 3.0 / 3.6;  // many times the uncertainty, off the points of the fit
  x[run.place("pressure as set")] -= 4e3;
  const auto other = tests::run("iso_28580", "a50", {"speed_km_h=83", "pressure_kPa=246"});
  const double before = number(run.outcome, "rrc_N_per_kN");
  const double after = number(other, "rrc_N_per_kN");
  REQUIRE(std::abs(after - before) > 0.01);
  CHECK(1e3 * run.model.evaluate(x)[1] - before == Approx(after - before).epsilon(0.01));
}

TEST_CASE("with three measurement cycles and sensors, the scatter of the torque is that of the cycles", "[fast]") {
  const IsoRun run(make_iso({"measurement_cycles=4", "warm_up_min=90"}, true));
  const UncertainInput& repeat = run.model.inputs[0];
  CHECK(repeat.evaluation == Evaluation::kTypeA);
  CHECK(repeat.degrees_freedom == Approx(18.0 / 8.0));  // 2 (n - 1)^2/(3 n - 4), n = 4
  CHECK(run.model.left_out.size() == 1);
  const IsoRun one(make_iso({"measurement_cycles=2"}, true));
  CHECK(one.model.inputs[0].evaluation == Evaluation::kTypeB);
  CHECK(one.model.left_out.size() == 2);
}

TEST_CASE("a tire that still warms up does not count as scatter from cycle to cycle", "[fast]") {
  // Without noise, the sensors' cycles differ by the warm-up alone.
  scenarios::RunSpec spec = make_iso({"measurement_cycles=4"}, true);
  for (auto& [quantity, sensor] : *spec.sensors) sensor.noise_sd = sensor.drift_sd = 0.0;
  const IsoRun run(std::move(spec));
  const Json& cycles = run.outcome.result["cycles"];
  const double trend_N_per_kN =
      std::abs(cycles.back()["rrc_N_per_kN"].get<double>() - cycles.front()["rrc_N_per_kN"].get<double>());
  REQUIRE(trend_N_per_kN > 0.03);
  const double lever_m = 1.0;  // of the 2 m drum
  const double scatter_N_per_kN =
      1e3 * run.model.inputs[0].standard_uncertainty / lever_m / number(run.outcome, "load_N");
  CHECK(scatter_N_per_kN < 0.3 * trend_N_per_kN);
}

TEST_CASE("noise from cycle to cycle comes back as its standard uncertainty, on average over seeds", "[slow]") {
  double squares = 0.0;
  constexpr unsigned kSeeds = 10;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    scenarios::RunSpec spec = make_iso({"measurement_cycles=30", "warm_up_min=120"}, true);
    spec.seed = seed;
    const IsoRun run(spec);
    squares += std::pow(run.model.inputs[0].standard_uncertainty, 2) / kSeeds;
  }
  const IsoRun one(make_iso({"warm_up_min=120"}, true));
  const double expected = one.model.inputs[0].standard_uncertainty;
  CHECK(std::sqrt(squares) == Approx(expected).epsilon(0.1));  // 10 estimates of 19 degrees of freedom: sd 5 %
}

TEST_CASE("the GUM holds for an ISO test: Monte Carlo agrees", "[fast]") {
  const IsoRun run(make_iso());
  const Uncertainty uncertainty = calc_uncertainty(run.model, {100'000, 1, 2});
  const MonteCarloResult& result = uncertainty.monte_carlo->results[0];
  CHECK(result.mean == Approx(uncertainty.budgets[0].value).epsilon(1e-4));
  CHECK(result.sd == Approx(uncertainty.budgets[0].combined).epsilon(0.01));
}

TEST_CASE("a flat belt has no drum diameter in its budget", "[fast]") {
  scenarios::RunSpec spec = make_spec("iso_28580", "a50", {}, "quasi_static");
  spec.rig = rigs::read_rig(read_config(find_asset("rigs", "flat_belt")));
  const IsoRun run(std::move(spec));
  CHECK(run.contribution("drum diameter") == 0.0);
  CHECK(1e3 * calc_budgets(run.model)[0].value == Approx(number(run.outcome, "rrc_25degC_2m_N_per_kN")).epsilon(1e-12));
}
