#include "models/tire/rolling_resistance.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig;
using models::TireParameters;

namespace {

constexpr double kReferencePressure_Pa = 280e3;
constexpr double kReferenceLoad_N = 5400.0;

/// The source's example in Figure 3.13: A = 55.1434 N, B = 0.0177 at 80 km/h; 64.7752 N, 0.0191 at 120 km/h,
/// with 80 km/h = 22.22 m/s (notes: the source prints 24.24).
TireParameters<double> figure_3_13() {
  TireParameters<double> tire;
  auto& rr = tire.rolling_resistance;
  rr.reference_load_N = kReferenceLoad_N;
  rr.reference_pressure_Pa = kReferencePressure_Pa;
  rr.reference_drum_diameter_m = 2.0;
  rr.pressure_exponent = 0.4;
  const double v80 = 80.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  rr.A1_N_s_per_m = (64.7752 - 55.1434) / (v120 - v80);
  rr.A0_N = 55.1434 - rr.A1_N_s_per_m * v80;
  rr.B1_s_per_m_K = (0.0191 - 0.0177) / (v120 - v80);
  rr.B0_per_K = 0.0177 - rr.B1_s_per_m_K * v80;
  return tire;
}

double loss(const TireParameters<double>& tire, double v, double load, double pressure, double degC) {
  return models::calc_rolling_resistance_N(tire, v, load, pressure, kZeroCelsius_K + degC);
}

}  // namespace

TEST_CASE("the source's example at 30 degC and 80 km/h", "[fast]") {
  // 55.1434 exp(-0.0177 * 30) = 55.1434 * exp(-0.531) = 55.1434 * 0.58802 = 32.43 N
  CHECK(loss(figure_3_13(), 80.0 / 3.6, kReferenceLoad_N, kReferencePressure_Pa, 30.0) == Approx(32.43).margin(0.01));
}

TEST_CASE("the loss goes to zero with the load and in proportion to it", "[fast]") {
  const auto tire = figure_3_13();
  CHECK(loss(tire, 20.0, 0.0, kReferencePressure_Pa, 25.0) == 0.0);
  CHECK(loss(tire, 20.0, 200.0, kReferencePressure_Pa, 25.0) * 27.0 ==
        Approx(loss(tire, 20.0, 5400.0, kReferencePressure_Pa, 25.0)));
}

TEST_CASE("the loss falls with pressure and temperature and rises with speed", "[fast]") {
  const auto tire = figure_3_13();
  double last = 1e9;
  for (double kPa = 200.0; kPa <= 320.0; kPa += 20.0) {
    const double now = loss(tire, 20.0, 5400.0, 1e3 * kPa, 25.0);
    CHECK(now < last);
    last = now;
  }
  for (double degC = -10.0; degC <= 80.0; degC += 10.0) {
    CHECK(loss(tire, 20.0, 5400.0, kReferencePressure_Pa, degC + 1.0) <
          loss(tire, 20.0, 5400.0, kReferencePressure_Pa, degC));
    CHECK(loss(tire, 21.0, 5400.0, kReferencePressure_Pa, degC) >
          loss(tire, 20.0, 5400.0, kReferencePressure_Pa, degC));
  }
}

TEST_CASE("below its lowest speed a law is held, without a jump, and above it nothing changes", "[fast]") {
  const auto free = figure_3_13();
  auto held = free;
  held.rolling_resistance.lowest_speed_m_s = 6.0;
  const auto at = [](const TireParameters<double>& tire, double v) {
    return loss(tire, v, 5400.0, kReferencePressure_Pa, 30.0);
  };
  for (const double v : {6.0, 10.0, 40.0}) CHECK(at(held, v) == at(free, v));
  for (const double v : {0.0, 3.0, 5.999}) CHECK(at(held, v) == at(free, 6.0));
  // A line that crosses zero at 4 m/s: positive all the same.
  held.rolling_resistance.A0_N = -4.0 * held.rolling_resistance.A1_N_s_per_m;
  for (const double v : {0.0, 2.0, 4.0, 6.0}) CHECK(at(held, v) > 0.0);
}

TEST_CASE("the pressure ratio of (4.1) at equal temperature", "[fast]") {
  const auto tire = figure_3_13();
  CHECK(loss(tire, 22.0, 5400.0, 250e3, 40.0) / loss(tire, 22.0, 5400.0, 280e3, 40.0) == Approx(1.0463).margin(1e-4));
}

TEST_CASE("a map over load meets its entries and is straight between them", "[fast]") {
  auto tire = figure_3_13();
  tire.load_map = {{{30.0, 0.8, 0.010, 1e-4}, 5000.0}, {{44.0, 1.2, 0.012, 2e-4}, 7000.0}};
  const double v = 20.0;
  CHECK(loss(tire, v, 5000.0, kReferencePressure_Pa, 0.0) == Approx(30.0 + 0.8 * v));
  CHECK(loss(tire, v, 7000.0, kReferencePressure_Pa, 0.0) == Approx(44.0 + 1.2 * v));
  CHECK(loss(tire, v, 6000.0, kReferencePressure_Pa, 0.0) == Approx(37.0 + 1.0 * v));
  // temperature coefficient half-way: 0.011 + 1.5e-4 * 20 = 0.014
  CHECK(std::log(loss(tire, v, 6000.0, kReferencePressure_Pa, 0.0) /
                 loss(tire, v, 6000.0, kReferencePressure_Pa, 10.0)) == Approx(0.14));
}

TEST_CASE("outside the map the loss goes on in proportion to the load, without a jump", "[fast]") {
  auto tire = figure_3_13();
  tire.load_map = {{{30.0, 0.8, 0.010, 1e-4}, 5000.0}, {{44.0, 1.2, 0.012, 2e-4}, 7000.0}};
  const auto at = [&](double load_N) { return loss(tire, 20.0, load_N, kReferencePressure_Pa, 30.0); };
  CHECK(at(2500.0) == Approx(0.5 * at(5000.0)));
  CHECK(at(14000.0) == Approx(2.0 * at(7000.0)));
  CHECK(at(5000.0 - 1e-6) == Approx(at(5000.0 + 1e-6)));
  CHECK(at(7000.0 - 1e-6) == Approx(at(7000.0 + 1e-6)));
}

TEST_CASE("forces fade through standstill and turn their sign", "[fast]") {
  CHECK(models::calc_standstill_fade(0.0) == 0.0);
  CHECK(models::calc_standstill_fade(1.0) == Approx(1.0));
  CHECK(models::calc_standstill_fade(-1.0) == Approx(-1.0));
  CHECK(models::calc_standstill_fade(0.05) == Approx(0.7616).margin(1e-4));  // tanh 1
}

TEST_CASE("dimensions of the law are right, and a wrong one is caught", "[fast]") {
  const auto tire = models::convert_tire<DimensionedScalar>(figure_3_13());
  using Q = DimensionedScalar;
  const Q speed(20.0, dimension::kSpeed), load(5400.0, dimension::kForce), pressure(280e3, dimension::kPressure),
      temperature(300.0, dimension::kTemperature);
  CHECK(models::calc_rolling_resistance_N(tire, speed, load, pressure, temperature).dimension() == dimension::kForce);
  CHECK_THROWS_AS(models::calc_rolling_resistance_N(tire, load, speed, pressure, temperature), DimensionError);
}

TEST_CASE("derivatives agree with differences", "[fast]") {
  auto tire = models::convert_tire<Jet>(figure_3_13());
  tire.rolling_resistance.A0_N = Jet(tire.rolling_resistance.A0_N.a, 0);
  tire.rolling_resistance.B1_s_per_m_K = Jet(tire.rolling_resistance.B1_s_per_m_K.a, 1);
  const Jet at = models::calc_rolling_resistance_N(tire, Jet(20.0), Jet(5400.0), Jet(270e3), Jet(310.0));
  const auto shifted = [&](double dA0, double dB1) {
    auto plain = figure_3_13();
    plain.rolling_resistance.A0_N += dA0;
    plain.rolling_resistance.B1_s_per_m_K += dB1;
    return loss(plain, 20.0, 5400.0, 270e3, 310.0 - kZeroCelsius_K);
  };
  CHECK(at.v[0] == Approx((shifted(1e-3, 0.0) - shifted(-1e-3, 0.0)) / 2e-3).epsilon(1e-8));
  CHECK(at.v[1] == Approx((shifted(0.0, 1e-7) - shifted(0.0, -1e-7)) / 2e-7).epsilon(1e-6));
}
