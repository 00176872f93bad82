// Effects on the measured channels after a run: drift of a zero, and a shift in time.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/trace_port.h"

using namespace rollrig;
using models::TracePort;
using tests::run_trace;
using tests::switch_on;

namespace {

constexpr Quantity kTorque = models::quantities::kDrumTorque;
constexpr Quantity kLoss = models::quantities::kLossForce;
constexpr Quantity kLiner = models::quantities::kLinerTemperature;
constexpr Quantity kPressure = models::quantities::kCavityPressure;
constexpr Quantity kSpeed = models::quantities::kSpeed;
constexpr Quantity kLoad = models::quantities::kLoad;
constexpr Quantity kAmbient = models::quantities::kAmbient;

/// Rows at one interval.
std::vector<double> rows_every(double interval_s, double duration_s) {
  std::vector<double> time_s;
  for (int k = 0; k * interval_s <= duration_s + 1e-9; ++k) time_s.push_back(k * interval_s);
  return time_s;
}

/// Means of a channel, from its integral over time, as loggers take them (formats.md).
std::vector<double> means_of(const std::function<double(double)>& integral, const std::vector<double>& time_s,
                             double later_s = 0.0) {
  std::vector<double> means;
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    const double from_s = k == 0 ? time_s[0] : 0.5 * (time_s[k - 1] + time_s[k]);
    const double to_s = k + 1 == time_s.size() ? time_s[k] : 0.5 * (time_s[k] + time_s[k + 1]);
    means.push_back((integral(to_s + later_s) - integral(from_s + later_s)) / (to_s - from_s));
  }
  return means;
}

/// One channel after the effect.
std::vector<double> apply(const models::ActiveEffect& active, const std::vector<double>& time_s,
                          const std::vector<double>& values, const Quantity& quantity = kLiner,
                          tests::Machine kind = tests::kDrum) {
  return tests::apply_trace(active, time_s, {quantity.header(), values}, kind);
}

std::vector<double> shift(double late_s, const std::vector<double>& time_s, const std::vector<double>& values) {
  return apply(switch_on("clock_shift", {late_s}), time_s, values);
}

double worst(const std::vector<double>& a, const std::vector<double>& b, std::size_t first, std::size_t end) {
  double largest = 0.0;
  for (std::size_t k = first; k < end; ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

constexpr double kLag_s = 24.0;  // of the gas behind the rubber
/// Integral of a warm-up that starts at 0.
double integral_of_warm_up(double t) { return t < 0.0 ? 0.0 : 20.0 * (t + kLag_s * (std::exp(-t / kLag_s) - 1.0)); }

constexpr double kRadius_m = 0.8535;  // of the drum of tests/support/uneven_machines.h
const double kNoReading = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("the torque's zero starts to drift at its rate and comes to rest by rate times time constant", "[fast]") {
  const std::vector<double> time_s = rows_every(10.0, 36000.0);
  const std::vector<double> zeros(time_s.size(), 0.0);
  const auto drift_Nm = apply(switch_on("torque_zero_drift", {1.8, 60.0, 0.0}), time_s, zeros, kTorque);
  constexpr double kSize_Nm = 1.8 * kRadius_m;
  CHECK(drift_Nm[0] == 0.0);
  CHECK(drift_Nm[1] == Approx(kSize_Nm * 10.0 / 3600.0).epsilon(2e-3));
  CHECK(drift_Nm[360] == Approx(kSize_Nm * (1.0 - std::exp(-1.0))));
  CHECK(drift_Nm.back() == Approx(kSize_Nm).epsilon(1e-4));
  const auto other_way = apply(switch_on("torque_zero_drift", {-1.8, 60.0, 0.0}), time_s, zeros, kTorque);
  CHECK(other_way[360] == -drift_Nm[360]);
}

TEST_CASE("the zero's drift is one force, on the drum's torque by its radius, on the dyno as it is", "[fast]") {
  const std::vector<double> time_s{1000.0, 1600.0, 2200.0};  // counted from the run's start
  const std::vector<double> values{30.0, kNoReading, 32.0};
  const auto drift = switch_on("torque_zero_drift", {3.0, 1000.0, 0.0});
  auto context = tests::make_context_on(tests::kDrum);
  context.surface_curvature_per_m = 1.0 / 0.85;
  TracePort<double> port;
  port.time_s = time_s;
  port.channels = {{kTorque, values}, {kLiner, values}, {kPressure, values}};
  run_trace(drift, context, port);
  const auto on_dyno = apply(drift, time_s, values, kLoss, tests::kDyno);
  CHECK(on_dyno[0] == 30.0);
  CHECK(on_dyno[2] - 32.0 == Approx(1.0).epsilon(0.02));  // 20 min of 3 N/h, long before it comes to rest
  CHECK(port.channels[0].values[2] - 32.0 == Approx(0.85 * (on_dyno[2] - 32.0)));
  CHECK(std::isnan(on_dyno[1]));
  CHECK(port.channels[1].values[2] == 32.0);
  CHECK(port.channels[2].values[2] == 32.0);
}

TEST_CASE("a kelvin of ambient moves the zero like its minutes of drift, and none at no rate", "[fast]") {
  const std::vector<double> time_s{0.0, 1.0, 2.0};
  const std::vector<double> ambient_K{298.15, 300.15, 297.15};
  const std::vector<double> zeros(3, 0.0);
  const auto drift = [&](double rate_N_per_h, double ambient_min_per_K) {
    return tests::apply_trace(switch_on("torque_zero_drift", {rate_N_per_h, 60.0, ambient_min_per_K}), time_s,
                              {kTorque.header(), zeros}, tests::kDrum, {{kAmbient.header(), ambient_K}});
  };
  const auto in_time = drift(1.2, 0.0);
  const auto both = drift(1.2, 5.0);
  CHECK(both[0] == 0.0);
  CHECK(both[1] - in_time[1] == Approx(kRadius_m * 0.02 * 5.0 * 2.0));  // 1.2 N/h are 0.02 N a minute
  CHECK(both[2] - in_time[2] == Approx(kRadius_m * -0.02 * 5.0 * 1.0));
  CHECK(drift(0.0, 5.0) == zeros);
}

TEST_CASE("a late clock writes what was, an early one what will be", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 60.0);
  const auto line = means_of([](double t) { return 300.0 * t + 0.5 * 0.02 * t * t; }, time_s);
  const auto late = shift(2.5, time_s, line);
  const auto early = shift(-2.5, time_s, line);
  for (std::size_t k = 3; k + 1 < time_s.size(); ++k) CHECK(late[k] - line[k] == Approx(-0.05).epsilon(1e-9));
  for (std::size_t k = 0; k < time_s.size(); ++k) CHECK(early[k] - line[k] == Approx(0.05).epsilon(1e-9));
  for (std::size_t k = 0; k < 2; ++k) CHECK(late[k] == Approx(300.0).epsilon(1e-12));  // it waited before the run
  CHECK(shift(0.0, time_s, line) == line);
}

TEST_CASE("a shift by whole rows moves rows, and where nothing moves at the ends no heat is lost", "[fast]") {
  const std::vector<double> time_s = rows_every(2.0, 80.0);
  std::vector<double> values(time_s.size(), 25.0);
  for (std::size_t k = 15; k < 25; ++k) values[k] = 25.0 + 3.0 * std::sin(static_cast<double>(k * k));
  const auto moved = shift(6.0, time_s, values);
  for (std::size_t k = 4; k + 1 < values.size(); ++k) CHECK(moved[k] == Approx(values[k - 3]).epsilon(1e-13));
  for (const double late_s : {-3.7, 0.3, 5.1}) {
    const auto shifted = shift(late_s, time_s, values);
    double more = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) more += shifted[k] - values[k];
    CHECK(more == Approx(0.0).margin(1e-11));
  }
}

TEST_CASE("a shifted warm-up has the means of the shifted channel, to third order in the rows' interval", "[fast]") {
  for (const double part : {-0.7, 0.1, 0.3}) {  // of an interval, beyond whole ones
    std::vector<double> errors;
    for (const double interval_s : {4.0, 2.0, 1.0}) {
      const double late_s = std::copysign(8.0, part) + part * interval_s;
      const std::vector<double> time_s = rows_every(interval_s, 240.0);
      const auto shifted = shift(late_s, time_s, means_of(integral_of_warm_up, time_s));
      const auto first = static_cast<std::size_t>(32.0 / interval_s);  // clear of the kink at the start
      const auto end = time_s.size() - first;
      errors.push_back(worst(shifted, means_of(integral_of_warm_up, time_s, -late_s), first, end));
    }
    CHECK(errors[2] < 1e-4);
    CHECK(errors[1] < errors[0] / 6.0);
    CHECK(errors[2] < errors[1] / 6.0);
  }
}

TEST_CASE("beside a kink and a step a shift errs by no more than it says", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 40.0);
  double kink = 0.0;
  double overshoot = 0.0;
  double far = 0.0;
  for (double at_s = 20.0; at_s < 21.0; at_s += 0.125) {
    const auto step = [&](double t) { return std::max(t - at_s, 0.0); };
    const auto ramp = [&](double t) { return 0.5 * step(t) * step(t); };
    for (double late_s = -3.0; late_s <= 3.0; late_s += 0.125) {
      const auto of_ramp = shift(late_s, time_s, means_of(ramp, time_s));
      kink = std::max(kink, worst(of_ramp, means_of(ramp, time_s, -late_s), 4, 36));
      const auto of_step = shift(late_s, time_s, means_of(step, time_s));
      for (std::size_t k = 4; k < 36; ++k) {
        overshoot = std::max({overshoot, -of_step[k], of_step[k] - 1.0});
        const double from_step_s = time_s[k] - late_s - at_s;
        if (std::abs(from_step_s) > 3.0) far = std::max(far, std::abs(of_step[k] - (from_step_s > 0.0 ? 1.0 : 0.0)));
      }
    }
  }
  CHECK(kink < 1.0 / 16.0 + 1e-9);
  CHECK(overshoot < 0.08);
  CHECK(far < 1e-12);
}

TEST_CASE("rows without a sample stay so, and the others bridge them by straight lines", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 60.0);
  const auto line = means_of([](double t) { return 300.0 * t + 0.5 * 0.02 * t * t; }, time_s);
  auto gappy = line;
  for (const std::size_t k : {0u, 20u, 30u, 31u, 32u, 33u, 60u}) gappy[k] = kNoReading;
  const auto shifted = shift(4.25, time_s, gappy);
  for (std::size_t k = 0; k < line.size(); ++k) {
    CHECK(std::isnan(shifted[k]) == std::isnan(gappy[k]));
    if (k > 6 && !std::isnan(shifted[k])) CHECK(shifted[k] == Approx(line[k] - 0.02 * 4.25).epsilon(1e-9));
  }
  // to the bit where there is no shift, in short and in empty records
  const auto unshifted = shift(0.0, time_s, gappy);
  for (std::size_t k = 0; k < line.size(); ++k) CHECK((std::isnan(gappy[k]) || unshifted[k] == gappy[k]));
  CHECK(std::isnan(shift(3.0, {0.0, 1.0, 2.0}, {kNoReading, kNoReading, kNoReading})[1]));
  CHECK(shift(3.0, {0.0}, {5.0}) == std::vector<double>{5.0});
  CHECK(shift(3.0, {}, {}).empty());
}

TEST_CASE("rows of uneven intervals keep a straight line straight, under a shift longer than they are", "[fast]") {
  const std::vector<double> time_s{0.0, 1.0, 3.0, 3.5, 7.0, 8.0, 8.25, 12.0, 13.0, 14.0, 20.0};
  const auto line = means_of([](double t) { return 250e3 * t + 0.5 * 30.0 * t * t; }, time_s);
  const auto early = shift(-5.0, time_s, line);
  for (std::size_t k = 0; k < line.size(); ++k) CHECK(early[k] == Approx(line[k] + 150.0).epsilon(1e-12));
  CHECK(shift(100.0, time_s, line).back() == Approx(250e3));
}

TEST_CASE("only temperature and pressure are shifted", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 10.0);
  const auto values = means_of(integral_of_warm_up, time_s);
  const auto late = switch_on("clock_shift", {2.0});
  CHECK(apply(late, time_s, values, kTorque) == values);
  CHECK(apply(late, time_s, values, kLoss, tests::kDyno) == values);
  CHECK(apply(late, time_s, values, kPressure) == apply(late, time_s, values, kLiner));
  CHECK(apply(late, time_s, values, kPressure) != values);
}

TEST_CASE("the derivative by the shift is that from either side, at no shift and at whole rows too", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 120.0);
  const auto values = means_of(integral_of_warm_up, time_s);
  const auto context = models::convert_context<Jet>(tests::make_context_on(tests::kDrum));
  for (const double late_s : {0.0, 1.0, 2.3, -4.5}) {
    TracePort<Jet> port;
    port.time_s = time_s;
    port.context = &context;
    port.channels = {{kLiner, std::vector<Jet>(values.begin(), values.end())}};
    const Jet parameter(late_s, 0);
    models::find_effect("clock_shift").hooks<Jet>().trace(models::EffectView<Jet>(&parameter, nullptr), port);
    const double h = 1e-4;
    const auto here = shift(late_s, time_s, values);
    const auto more = shift(late_s + h, time_s, values);
    const auto less = shift(late_s - h, time_s, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      CHECK(port.channels[0].values[k].a == here[k]);
      CHECK(port.channels[0].values[k].v[0] == Approx((more[k] - here[k]) / h).margin(1e-3));
      CHECK(port.channels[0].values[k].v[0] == Approx((here[k] - less[k]) / h).margin(1e-3));
    }
  }
}

TEST_CASE("the pressure follows a load step with the time constant of the load, and nothing is lost after it",
          "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 60.0);
  std::vector<double> load_N(time_s.size(), 500.0);
  for (std::size_t row = 20; row < load_N.size(); ++row) load_N[row] = 5400.0;
  const std::vector<double> speed_m_s(time_s.size(), 20.0);
  const std::vector<double> pressure_Pa(time_s.size(), 280e3);
  const auto lacking_Pa_s = [&](double contraction_percent, double settling_s) {
    const auto read_Pa = tests::apply_trace(
        switch_on("cavity_volume", {contraction_percent, 1.0, 0.0, 0.0, settling_s}), time_s,
        {kPressure.header(), pressure_Pa}, tests::kDrum, {{kLoad.header(), load_N}, {kSpeed.header(), speed_m_s}});
    CHECK(read_Pa[18] == 280e3);  // as long as nothing has changed
    CHECK(read_Pa.back() == Approx(280e3).epsilon(1e-6));
    double sum = 0.0;
    for (std::size_t row = 0; row < read_Pa.size(); ++row) sum += 280e3 - read_Pa[row];
    return sum;  // rows of 1 s
  };
  // The area between a step and a first-order answer to it is the step times the time constant, whatever the rows.
  const double step_Pa = 1.4 * 0.01 * (5400.0 - 500.0) / 5400.0 * (280e3 + 101325.0);  // adiabatic, to first order
  CHECK(lacking_Pa_s(1.0, 0.7) == Approx(0.7 * step_Pa).epsilon(1e-6));
  CHECK(lacking_Pa_s(1.0, 0.2) == Approx(0.2 * step_Pa).epsilon(1e-6));
  CHECK(lacking_Pa_s(1.0, 3.0) == Approx(3.0 * step_Pa).epsilon(1e-5));
  CHECK(lacking_Pa_s(-0.5, 0.7) == Approx(-0.35 * step_Pa).epsilon(1e-6));
}

TEST_CASE("while the speed rises, the pressure is late by the time constant of the cavity", "[fast]") {
  const std::vector<double> time_s = rows_every(1.0, 80.0);
  const std::vector<double> load_N(time_s.size(), 5400.0);
  std::vector<double> speed_m_s;
  for (const double at_s : time_s) speed_m_s.push_back(10.0 + 0.2 * at_s);
  const std::vector<double> pressure_Pa(time_s.size(), 280e3);
  const auto read_Pa = tests::apply_trace(switch_on("cavity_volume", {1.0, 1.0, 0.4, 0.0, 0.8}), time_s,
                                          {kPressure.header(), pressure_Pa}, tests::kDrum,
                                          {{kLoad.header(), load_N}, {kSpeed.header(), speed_m_s}});
  // A larger cavity has less pressure: what lags behind is still higher, by slope times time constant, less what the
  // slope has grown by meanwhile.
  const auto slope_per_s = [](double speed) { return 0.004 * 2.0 * speed * 0.2 / std::pow(120.0 / 3.6, 2); };
  const double late = 0.8 * (slope_per_s(speed_m_s[60]) - 0.8 * slope_per_s(0.2));
  CHECK((read_Pa[60] - 280e3) / (280e3 + 101325.0) == Approx(1.4 * late).epsilon(2e-3));
}

TEST_CASE("trace effects keep the dimensions of the channels", "[fast]") {
  using Q = DimensionedScalar;
  const auto context = models::convert_context<Q>(tests::make_context_on(tests::kDrum));
  const Dimension torque = dimension::kForce * dimension::kLength;
  for (const double size : {0.0, 3.0, -3.0}) {
    for (const char* id : {"torque_zero_drift", "clock_shift", "torque_gain", "load_cross_talk", "pressure_record"}) {
      INFO(id);
      TracePort<Q> port;
      port.time_s = {0.0, 1.0, 3.0};
      for (const auto& [channel, of] :
           std::vector<std::pair<Quantity, Dimension>>{{kTorque, torque},
                                                       {kLoss, dimension::kForce},
                                                       {kAmbient, dimension::kTemperature},
                                                       {models::quantities::kLoad, dimension::kForce},
                                                       {kLiner, dimension::kTemperature},
                                                       {kPressure, dimension::kPressure}}) {
        port.channels.push_back({channel, {Q(1.0, of), Q(2.0, of), Q(4.0, of)}});
      }
      CHECK_NOTHROW(run_trace(switch_on(id, {size}), context, port));
      CHECK((*port.find(kTorque))[1].dimension() == torque);
      CHECK((*port.find(kLoss))[1].dimension() == dimension::kForce);
      CHECK((*port.find(kLiner))[1].dimension() == dimension::kTemperature);
      CHECK((*port.find(kPressure))[1].dimension() == dimension::kPressure);
    }
  }
}
