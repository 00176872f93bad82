/// What limits a quasi-static run: its equations written by hand for one tire on one drum, without channels, effects,
/// audits or rows; and the writing of its rows, by the bandwidth of memory. docs/performance.md compares.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "models/tire/drum_curvature.h"
#include "rigs/rig_file.h"
#include "sim/core/units.h"
#include "tools/virtual_run.h"

namespace {

using namespace rollrig;

/// Numbers of a tire on the law "bounded" (models/tire/bounded.cpp) and of the test that enter the equations.
struct Constants {
  double loss_N, speed_rise, fall_per_K, fall_rise, step_speed_m_s, step_power, cold_K, hot_K, width_K;
  double pressure_exponent, reference_pressure_Pa;
  double tread_J_per_K, carcass_J_per_K, gas_J_per_K, tread_share_of_heat, tread_share_of_loss;
  double between_W_per_K, gas_W_per_K, rest_W_per_K, speed_W_s_per_m_K;
  double step_at_80, bounded_at_30_dK;  // what does not change in a run
  double cold_pressure_Pa, ambient_pressure_Pa, ambient_K;

  double calc_step(double speed_m_s) const {
    const double power = std::pow(speed_m_s / step_speed_m_s, step_power);
    return power / (1.0 + power);
  }
  double calc_bounded_dK(double temperature_K) const {
    return width_K * std::log((1.0 + std::exp((temperature_K - cold_K) / width_K)) /
                              (1.0 + std::exp((temperature_K - hot_K) / width_K)));
  }
};

Constants read_constants(const scenarios::RunSpec& spec, double pressure_Pa, double load_N) {
  const models::Context<double> context = rigs::make_context(spec.tire, spec.rig, spec.baseline);
  const models::TireParameters<double>& tire = context.tire;
  const auto own = [&](const char* key) {
    const auto& declared = tire.model().info.parameters;
    for (std::size_t i = 0; i < declared.size(); ++i) {
      if (std::strcmp(declared[i].field.key, key) == 0) return tire.own[i];
    }
    throw std::logic_error(key);
  };
  Constants c{};
  const auto& law = tire.rolling_resistance;
  const double load_factor = std::pow(load_N / law.reference_load_N, own("load_exponent"));
  c.loss_N = own("loss_N") * load_factor * models::calc_curvature_factor(context);
  c.speed_rise = own("speed_rise");
  c.fall_per_K = own("fall_per_degC");
  c.fall_rise = own("speed_rise_of_fall");
  c.step_speed_m_s = own("step_speed_km_h");
  c.step_power = own("step_power");
  c.cold_K = own("cold_limit_degC");
  c.hot_K = own("hot_limit_degC");
  c.width_K = own("limit_width_K");
  c.pressure_exponent = law.pressure_exponent;
  c.reference_pressure_Pa = law.reference_pressure_Pa;
  c.tread_J_per_K = own("tread_share_of_heat_capacity") * tire.thermal.heat_capacity_J_per_K;
  c.carcass_J_per_K = tire.thermal.heat_capacity_J_per_K - c.tread_J_per_K;
  c.gas_J_per_K = tire.thermal.gas_heat_capacity_J_per_K;
  c.tread_share_of_heat = own("tread_share_of_heat");
  c.tread_share_of_loss = own("tread_share_of_loss");
  c.between_W_per_K = own("conductance_W_per_K");
  c.gas_W_per_K = tire.thermal.H_gas_W_per_K;
  c.rest_W_per_K = tire.thermal.rest_conductance_W_per_K;
  c.speed_W_s_per_m_K = tire.thermal.speed_conductance_W_s_per_m_K;
  c.step_at_80 = c.calc_step(80.0 / 3.6);
  c.bounded_at_30_dK = c.calc_bounded_dK(kZeroCelsius_K + 30.0);
  c.cold_pressure_Pa = pressure_Pa;
  c.ambient_pressure_Pa = 101325.0;
  c.ambient_K = kZeroCelsius_K + 25.0;
  return c;
}

using Temperatures = std::array<double, 3>;  // tread, carcass, gas

double calc_loss_N(const Constants& c, const Temperatures& t, double speed_m_s) {
  const double pressure_Pa = (c.cold_pressure_Pa + c.ambient_pressure_Pa) * t[2] / c.ambient_K - c.ambient_pressure_Pa;
  const double above_80 = c.calc_step(speed_m_s) - c.step_at_80;
  const double seen_K = t[1] + c.tread_share_of_loss * (t[0] - t[1]);
  const double warmer_dK = c.calc_bounded_dK(seen_K) - c.bounded_at_30_dK;
  return c.loss_N * std::pow(pressure_Pa / c.reference_pressure_Pa, -c.pressure_exponent) *
         std::exp(c.speed_rise * above_80 - c.fall_per_K * (1.0 + c.fall_rise * above_80) * warmer_dK);
}

Temperatures calc_rates(const Constants& c, const Temperatures& t, double speed_m_s) {
  const double heat_W = calc_loss_N(c, t, speed_m_s) * speed_m_s;
  const double through_W = c.between_W_per_K * (t[0] - t[1]);
  const double to_gas_W = c.gas_W_per_K * (t[1] - t[2]);
  const double outward_W = (c.rest_W_per_K + c.speed_W_s_per_m_K * speed_m_s) * (t[0] - c.ambient_K);
  return {(c.tread_share_of_heat * heat_W - outward_W - through_W) / c.tread_J_per_K,
          ((1.0 - c.tread_share_of_heat) * heat_W + through_W - to_gas_W) / c.carcass_J_per_K,
          to_gas_W / c.gas_J_per_K};
}

/// One step of the classical Runge-Kutta rule while the speed goes along a line.
void step(const Constants& c, double step_s, double from_m_s, double to_m_s, Temperatures& t) {
  const auto moved = [&t](const Temperatures& rate, double by_s) {
    return Temperatures{t[0] + by_s * rate[0], t[1] + by_s * rate[1], t[2] + by_s * rate[2]};
  };
  const double middle_m_s = 0.5 * (from_m_s + to_m_s);
  const Temperatures k1 = calc_rates(c, t, from_m_s);
  const Temperatures k2 = calc_rates(c, moved(k1, 0.5 * step_s), middle_m_s);
  const Temperatures k3 = calc_rates(c, moved(k2, 0.5 * step_s), middle_m_s);
  const Temperatures k4 = calc_rates(c, moved(k3, step_s), to_m_s);
  for (std::size_t i = 0; i < t.size(); ++i) t[i] += step_s / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
}

/// Rolling resistance of a run at the end of its phase "warm-up" [N].
double read_warm_loss_N(const sim::Recording<double>& recording) {
  const std::vector<double>& loss_N = recording.channel("rolling_resistance_N");
  for (std::size_t row = recording.row_count(); row-- > 0;) {
    if (recording.phases[recording.phase[row]].name == "warm-up") return loss_N[row];
  }
  throw std::logic_error("the run has no warm-up");
}

/// Warm-up of the ISO test, 1800 s in steps of 5 s. A soak at the air's temperature changes nothing.
void warm_up_by_hand(benchmark::State& state) {
  const scenarios::RunSpec spec = tools::make_spec("iso_28580", "a50", {}, {{"fidelity", "quasi_static"}});
  const Constants c = read_constants(spec, 250e3, 6865.0);
  constexpr double kStep_s = 5.0;
  constexpr double kSpeed_m_s = 80.0 / 3.6;
  double loss_N = 0.0;
  for (auto _ : state) {
    Temperatures t{c.ambient_K, c.ambient_K, c.ambient_K};
    for (int i = 0; i < 360; ++i) step(c, kStep_s, kSpeed_m_s, kSpeed_m_s, t);
    benchmark::DoNotOptimize(loss_N = calc_loss_N(c, t, kSpeed_m_s));
  }
  constexpr double kSame = 0.01;  // the run-up at skim load is left out by hand
  const double of_run_N = read_warm_loss_N(scenarios::run_scenario(spec, {}).recording);
  if (std::abs(loss_N / of_run_N - 1.0) > kSame) state.SkipWithError("the equations are not those of the program");
  state.counters["loss_N"] = loss_N;
}

/// The tire's part of the multi-cycle test: its 14,206 s in steps of 1 s, up and down between 1 and 26 m/s.
void multi_cycle_by_hand(benchmark::State& state) {
  const scenarios::RunSpec spec = tools::make_spec("sae_j1634", "a50");
  const Constants c = read_constants(spec, 280e3, 5400.0);
  constexpr int kSeconds = 14206;
  double loss_N = 0.0;
  for (auto _ : state) {
    Temperatures t{c.ambient_K, c.ambient_K, c.ambient_K};
    for (int i = 0; i < kSeconds; ++i) {
      const auto speed_m_s = [](int second) { return std::abs(second % 50 - 25.0) + 1.0; };
      step(c, 1.0, speed_m_s(i), speed_m_s(i + 1), t);
    }
    benchmark::DoNotOptimize(loss_N = calc_loss_N(c, t, 20.0));
  }
  state.counters["loss_N"] = loss_N;
}

void rates_by_hand(benchmark::State& state) {
  const scenarios::RunSpec spec = tools::make_spec("iso_28580", "a50");
  const Constants c = read_constants(spec, 250e3, 6865.0);
  Temperatures t{c.ambient_K, c.ambient_K, c.ambient_K};
  for (auto _ : state) {
    t[0] += 1e-6;
    benchmark::DoNotOptimize(calc_rates(c, t, 22.0));
  }
}

/// A recording of so many rows and channels, copied as a whole.
void copy_recording(benchmark::State& state) {
  const auto values = static_cast<std::size_t>(state.range(0) * state.range(1));
  const std::vector<double> from(values, 1.0);
  std::vector<double> to(values);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), values * sizeof(double));
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(values * sizeof(double)));
}

BENCHMARK(rates_by_hand);
BENCHMARK(warm_up_by_hand)->Unit(benchmark::kMillisecond);
BENCHMARK(multi_cycle_by_hand)->Unit(benchmark::kMillisecond);
BENCHMARK(copy_recording)->Args({2231, 15})->Args({14207, 15})->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
