/// Steps of a warm wheel in co-simulation, with new inputs and an output each step; and derivatives of it.
#include <benchmark/benchmark.h>

#include "exports/wheel_of_tire.h"
#include "fmu/warm_wheel.h"
#include "sim/core/assets.h"

namespace {

using namespace rollrig;

fmu::WheelModel make_model() {
  return exports::make_wheel_model(models::read_tire(read_config(find_asset("tires", "a50"))),
                                   rigs::read_rig(read_config(find_asset("rigs", "road"))), {});
}

void step_wheel(benchmark::State& state) {
  fmu::WarmWheel wheel(make_model());
  wheel.initialize(0.0);
  constexpr std::size_t kSpeed = 0;
  constexpr std::size_t kFirstOutput = 6;
  double speed_m_s = 20.0;
  for (auto _ : state) {
    speed_m_s = 40.0 - speed_m_s + 1e-3;
    wheel.set(kSpeed, speed_m_s);
    wheel.advance(0.01);
    benchmark::DoNotOptimize(wheel.get(kFirstOutput));
  }
  state.counters["steps/s"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void differentiate_wheel(benchmark::State& state) {
  fmu::WarmWheel wheel(make_model());
  wheel.set(0, 20.0);
  wheel.initialize(0.0);
  for (auto _ : state) benchmark::DoNotOptimize(wheel.differentiate({6}, {0}, {1.0}));
}

BENCHMARK(step_wheel);
BENCHMARK(differentiate_wheel);

}  // namespace

BENCHMARK_MAIN();
