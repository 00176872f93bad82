/// CPU time of vehicles on rollers and on the road: city cycle, the source's whole multi-cycle test, coastdown.
/// Timed figures belong here, not in tests.
#include <benchmark/benchmark.h>

#include "scenarios/common/vehicle_bench.h"
#include "tools/virtual_run.h"

namespace {

using namespace rollrig;

void run_scenario(benchmark::State& state, const char* scenario, const char* fidelity,
                  const std::vector<std::string>& settings) {
  const scenarios::RunSpec spec = tools::make_spec(scenario, "a50", settings, {{"fidelity", fidelity}});
  scenarios::Outcome outcome;
  for (auto _ : state) outcome = scenarios::run_scenario(spec, {});
  state.counters["mechanical_closure"] = outcome.recording.audit.calc_closure(sim::EnergyTerm::Ledger::kMechanical);
}

/// Conditions of the source's test on a rig.
scenarios::VehicleConditions make_conditions(const scenarios::RunSpec& spec, int wheels) {
  scenarios::VehicleConditions conditions;
  conditions.wheels = wheels;
  conditions.pressure_Pa = 280e3;
  conditions.complete(spec);
  return conditions;
}

void drive(benchmark::State& state, const scenarios::RunSpec& spec, const scenarios::VehicleConditions& conditions,
           const scenarios::VehicleProgram& program) {
  scenarios::Outcome outcome;
  for (auto _ : state) scenarios::simulate_vehicle(spec, conditions, program, {}, outcome);
  state.counters["mechanical_closure"] = outcome.recording.audit.calc_closure(sim::EnergyTerm::Ledger::kMechanical);
}

void city_cycle(benchmark::State& state, const char* fidelity) {
  const scenarios::RunSpec spec = tools::make_spec("sae_j1634", "a50", {}, {{"fidelity", fidelity}});
  const scenarios::VehicleConditions conditions = make_conditions(spec, 1);
  scenarios::VehicleProgram program(conditions, 1.0, 20.0 / 3.6);
  program.drive(scenarios::read_speed_trace("udds"), "city");
  drive(state, spec, conditions, program);
}

/// One coastdown from 130 km/h to standstill, four wheels, tires at 23 degC.
void coastdown(benchmark::State& state, const char* fidelity, const char* scenario) {
  const scenarios::RunSpec spec = tools::make_spec(scenario, "a50", {}, {{"fidelity", fidelity}});
  const scenarios::VehicleConditions conditions = make_conditions(spec, 4);
  scenarios::VehicleProgram program(conditions, 1.0, 0.0);
  program.start_at(130.0 / 3.6);
  program.coast("coastdown", 0.05, 3600.0, 0.0, 0.0);
  drive(state, spec, conditions, program);
}

const std::vector<std::string> kSource{"variant=source", "wheels=1"};

BENCHMARK_CAPTURE(city_cycle, quarter_multibody, "multibody")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(city_cycle, quarter_quasi_static, "quasi_static")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, multi_cycle_quarter_multibody, "sae_j1634", "multibody", kSource)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, multi_cycle_quarter_quasi_static, "sae_j1634", "quasi_static", kSource)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coastdown, rollers_multibody, "multibody", "dyno_setting")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coastdown, road_multibody, "multibody", "coastdown")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
