// Drum curvature, inflation gas, parasitic loss.
#include <catch2/catch.hpp>
#include <cmath>

#include "models/parasitic_loss.h"
#include "models/tire/drum_curvature.h"
#include "models/tire/inflation_gas.h"

using namespace rollrig;
using models::calc_drum_correction;

TEST_CASE("from the 2 m drum to 1.2 m rollers a50 gains 8.45 %", "[fast]") {
  // notes: factor 1.0845. (3.1) with R1 = 1, R2 = 0.6, r_T = 0.3588: sqrt((1/0.6) 0.9588/1.3588) = 1.0845
  CHECK(calc_drum_correction(1.0, 1.0 / 0.6, 0.3588) == Approx(1.0845).margin(5e-5));
}

TEST_CASE("drum correction: one on the same drum, reciprocal back, chained over a third", "[fast]") {
  CHECK(calc_drum_correction(0.8, 0.8, 0.35) == 1.0);
  CHECK(calc_drum_correction(1.0, 1.5, 0.35) * calc_drum_correction(1.5, 1.0, 0.35) == Approx(1.0));
  CHECK(calc_drum_correction(1.0, 1.5, 0.35) * calc_drum_correction(1.5, 0.0, 0.35) ==
        Approx(calc_drum_correction(1.0, 0.0, 0.35)));
}

TEST_CASE("a flatter surface loses less, and the flat road is the limit of a large drum", "[fast]") {
  CHECK(calc_drum_correction(1.0, 0.5, 0.35) < 1.0);
  CHECK(calc_drum_correction(1.0, 1e-9, 0.35) == Approx(calc_drum_correction(1.0, 0.0, 0.35)));
  CHECK(calc_drum_correction(1.0, 0.0, 0.3588) == Approx(1.0 / std::sqrt(1.3588)));
}

TEST_CASE("gauge pressure of a sealed cavity", "[fast]") {
  const models::Inflation<double> cold{250e3, 298.15, 101325.0};
  CHECK(models::calc_gauge_pressure_Pa(cold, 298.15, 1.0, 1.0) == Approx(250e3));
  // absolute 351.325 kPa rises by 15/298.15: 17.675 kPa
  CHECK(models::calc_gauge_pressure_Pa(cold, 313.15, 1.0, 1.0) == Approx(267.675e3).epsilon(1e-6));
  // the gauge pressure itself is not in proportion to temperature
  CHECK(models::calc_gauge_pressure_Pa(cold, 313.15, 1.0, 1.0) / 250e3 > 313.15 / 298.15);
  CHECK(models::calc_gauge_pressure_Pa(cold, 298.15, 0.99, 1.0) < 250e3);
  CHECK(models::calc_gauge_pressure_Pa(cold, 298.15, 1.0, 1.01) < 250e3);
  CHECK(models::calc_gauge_pressure_Pa(cold, 298.15, 0.99, 0.99) == Approx(250e3));
}

TEST_CASE("parasitic loss at standstill and at 80 km/h", "[fast]") {
  const models::ParasiticParameters<double> p{6.0, 0.15, 0.004};
  CHECK(models::calc_parasitic_N(p, 0.0) == 6.0);
  // 6 + 0.15 * 22.222 + 0.004 * 493.83 = 6 + 3.3333 + 1.9753 = 11.3086 N
  CHECK(models::calc_parasitic_N(p, 80.0 / 3.6) == Approx(11.3086).margin(1e-4));
}
