/// CPU time and memory of a whole ISO 28580 run (soak, warm-up of 1800 s, skim of 180 s, rows at 1 Hz), and
/// of the parts that decide it. Timed figures belong here, not in tests.
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "rigs/multibody_drum.h"
#include "rigs/quasi_static_drum.h"
#include "tools/virtual_run.h"

namespace {

using namespace rollrig;

scenarios::RunSpec make_spec(const char* fidelity) {
  return tools::make_spec("iso_28580", "a50", {}, {{"fidelity", fidelity}});
}

double find_peak_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void run_scenario(benchmark::State& state, const char* fidelity) {
  const scenarios::RunSpec spec = make_spec(fidelity);
  for (auto _ : state) benchmark::DoNotOptimize(scenarios::run_scenario(spec, {}));
  state.counters["peak_MB"] = find_peak_MB();
}

/// One evaluation of all rates, with the state moved so that nothing is cached.
template <class System>
void evaluate_rates(benchmark::State& state, System& system) {
  const sim::Segment segment{100.0, {{22.0, 0.0}, {5400.0, 0.0}, {298.15, 0.0}, {298.15, 0.0}}};
  std::vector<double> y(system.state_count());
  std::vector<double> rates(system.state_count());
  std::vector<double> integrands(system.integrals().size());
  system.initialize(segment, 0.0, y.data());
  double t = 0.0;
  for (auto _ : state) {
    t += 1e-6;
    system.evaluate(t, y.data(), rates.data(), integrands.data());
    benchmark::DoNotOptimize(rates.data());
  }
}

struct Rig {
  scenarios::RunSpec spec = make_spec("multibody");
  models::Corner<double> corner{rigs::make_context(spec.tire, spec.rig, spec.baseline), {}};
  rigs::RigStart<double> start{298.15, 280e3, 101325.0, {}};
};

void multibody_rates(benchmark::State& state) {
  Rig rig;
  const auto drum = rigs::make_multibody_drum(rig.corner, rig.spec.rig, rig.start, false);
  evaluate_rates(state, *drum);
}

void quasi_static_rates(benchmark::State& state) {
  Rig rig;
  rigs::QuasiStaticDrum<double> drum(rig.corner, rig.start, false, rigs::Detail::kFull);
  evaluate_rates(state, drum);
}

BENCHMARK(quasi_static_rates);
BENCHMARK(multibody_rates);
BENCHMARK_CAPTURE(run_scenario, quasi_static, "quasi_static")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_scenario, multibody, "multibody")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
