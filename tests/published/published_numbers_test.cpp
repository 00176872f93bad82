// The source's published numbers on the drum rig, met by virtual tests. What was fitted and what is
// predicted is said in docs/published.md.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/core/file_io.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using tests::make_spec;

namespace {

double number(const std::string& scenario, const std::string& tire, const char* key,
              const std::vector<std::string>& settings = {}, const std::string& fidelity = "multibody") {
  const scenarios::RunSpec spec = make_spec(scenario, tire, settings, fidelity);
  return scenarios::run_scenario(spec, {}).result[key].get<double>();
}

const std::vector<std::string> kVehicle{"load_N=5400", "pressure_kPa=280"};

}  // namespace

TEST_CASE("RRc_ISO of Table 5.1 within 0.5 %, each tire at its own ISO load and 250 kPa", "[published]") {
  for (const auto& [tire, rrc] : {std::pair{"a40", 5.93}, std::pair{"a50", 5.20}, std::pair{"a60", 5.60}}) {
    INFO(tire);
    CHECK(number("iso_28580", tire, "rrc_25degC_2m_N_per_kN") == Approx(rrc).epsilon(0.005));
  }
}

TEST_CASE("the loss at the start of a warm-up is 25 to 40 % above its end (§6)", "[published]") {
  for (const char* tire : {"a40", "a50", "a60"}) {
    const double excess = number("warm_up", tire, "start_excess_percent");
    INFO(tire << " " << excess);
    CHECK(excess >= 25.0);
    CHECK(excess <= 40.0);
  }
}

TEST_CASE("the fall of the loss over 30 to 35 degC (§4.1.6)", "[published]") {
  CHECK(number("warm_up", "a50", "band_drop_percent", kVehicle) == Approx(7.82).margin(0.03));
  CHECK(number("warm_up", "a50", "band_drop_N", kVehicle) == Approx(2.50).margin(0.01));
  CHECK(number("warm_up", "a50", "band_B_per_degC", kVehicle) == Approx(0.0163).margin(5e-5));
  CHECK(number("warm_up", "a60", "band_drop_percent", kVehicle) == Approx(7.12).margin(0.03));
  // a60's -2.37 N (33.3 N at 30 degC) is not reproduced: Table 4.4 and §4.1.5 leave no room for it, see
  // table_4_4_and_4_5/README.md and docs/published.md.
  CHECK(number("warm_up", "a60", "band_B_per_degC", kVehicle) == Approx(0.0148).margin(5e-5));
}

TEST_CASE("RRc at vehicle load is RRc at ISO load within the sensor's uncertainty (§4.1.2, predicted)", "[published]") {
  for (const char* tire : {"a40", "a50", "a60"}) {
    INFO(tire);
    const double iso = number("iso_28580", tire, "rrc_N_per_kN");
    CHECK(std::abs(number("iso_28580", tire, "rrc_N_per_kN", kVehicle) - iso) < 0.9 / 5.4);
  }
}

TEST_CASE("with a load exponent RRc is constant over the load sweep as measured (§4.1.3)", "[published]") {
  for (const auto& [tire, exponent] : {std::pair{"a40", 1.286}, std::pair{"a50", 1.205}, std::pair{"a60", 1.252}}) {
    INFO(tire);
    const std::string set = "effects.load_exponent.exponent=" + std::to_string(exponent);
    CHECK(number("load_sweep", tire, "rrc_span_N_per_kN", {set}) < 0.03);
    CHECK(number("load_sweep", tire, "rrc_span_N_per_kN") > 0.17);  // (3.5) alone
  }
}

TEST_CASE("RRc rises with speed for every tire (§4.1.5)", "[published]") {
  for (const char* tire : {"a40", "a50", "a60"}) {
    INFO(tire);
    CHECK(number("speed_sweep", tire, "rrc_rise_percent", {}, "quasi_static") > 0.0);
  }
}

TEST_CASE("the tire warms with the air and with the road, more by the road (§2.2.2.4; the split is chosen by it)",
          "[published]") {
  const auto liner = [](double air_degC, double road_degC) {
    return number("warm_up", "a50", "liner_temperature_degC",
                  {"warm_up_min=120", "initial_tire_temperature_degC=20", "ambient_degC=" + std::to_string(air_degC),
                   "surface_temperature_degC=" + std::to_string(road_degC)},
                  "quasi_static");
  };
  const double air_dK = liner(30.0, 20.0) - liner(20.0, 20.0);
  const double road_dK = liner(20.0, 30.0) - liner(20.0, 20.0);
  CHECK(air_dK == Approx(1.5).margin(0.5));   // Yokota et al.: 1 to 2
  CHECK(road_dK == Approx(6.5).margin(0.5));  // 6 to 7
}
