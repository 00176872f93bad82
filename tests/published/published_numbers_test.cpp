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

TEST_CASE("missed: the loss at the start of a warm-up is 25 to 40 % above its end (§6)", "[published]") {
  // At the vehicle's load a50 and a60 are within the range. a40 is above it at both.
  const auto excess = [](const char* tire, const std::vector<std::string>& settings = {}) {
    return number("warm_up", tire, "start_excess_percent", settings, "quasi_static");
  };
  CHECK(excess("a40") == Approx(48.4).margin(0.5));
  CHECK(excess("a50") == Approx(48.3).margin(0.5));
  CHECK(excess("a60") == Approx(41.9).margin(0.5));
  for (const char* tire : {"a50", "a60"}) {
    CHECK(excess(tire, kVehicle) >= 25.0);
    CHECK(excess(tire, kVehicle) <= 40.0);
  }
}

TEST_CASE("RRc at vehicle load is near RRc at ISO load (§4.1.2, missed by a50)", "[published]") {
  // within the sensor's uncertainty, 0.17 N/kN at 5400 N
  const auto difference = [](const char* tire) {
    return number("iso_28580", tire, "rrc_N_per_kN", kVehicle) - number("iso_28580", tire, "rrc_N_per_kN");
  };
  CHECK(std::abs(difference("a40")) < 0.9 / 5.4);
  CHECK(std::abs(difference("a60")) < 0.9 / 5.4);
  CHECK(difference("a50") == Approx(-0.246).margin(0.02));
}

TEST_CASE("RRc is constant over the load sweep as measured (§4.1.3), by the tires' own load exponents", "[published]") {
  const auto span = [](const char* tire, const std::vector<std::string>& settings = {}) {
    return number("load_sweep", tire, "rrc_span_N_per_kN", settings, "quasi_static");
  };
  for (const char* tire : {"a40", "a50", "a60"}) {
    INFO(tire);
    CHECK(span(tire, {"settle_min=0"}) < 0.23);  // 0.17 is published; a60 is above it
    CHECK(span(tire, {"settle_min=0", "tire.bounded.load_exponent=1.0"}) >
          0.17);  // in proportion to the load, as (3.5)
  }
}

TEST_CASE("RRc rises with speed (§4.1.5, missed by a60, against Table 4.5)", "[published]") {
  const auto rise = [](const char* tire) {
    return number("speed_sweep", tire, "rrc_rise_percent", {}, "quasi_static");
  };
  CHECK(rise("a40") > 0.0);
  CHECK(rise("a50") > 0.0);
  CHECK(rise("a60") == Approx(-8.2).margin(0.5));
}

TEST_CASE("the tire warms with the air and with the road, more by the road (§2.2.2.4, missed by 0.5 degC for the road)",
          "[published]") {
  const auto liner = [](double air_degC, double road_degC) {
    return number("warm_up", "a50", "liner_temperature_degC",
                  {"warm_up_min=120", "initial_tire_temperature_degC=20", "ambient_degC=" + std::to_string(air_degC),
                   "surface_temperature_degC=" + std::to_string(road_degC)},
                  "quasi_static");
  };
  const double air_dK = liner(30.0, 20.0) - liner(20.0, 20.0);
  const double road_dK = liner(20.0, 30.0) - liner(20.0, 20.0);
  CHECK(air_dK == Approx(1.5).margin(0.5));     // Yokota et al.: 1 to 2, by which the split is chosen
  CHECK(road_dK == Approx(5.55).margin(0.05));  // 6 to 7: missed, since the loss falls as the tire warms
  CHECK(road_dK > 3.0 * air_dK);
}
