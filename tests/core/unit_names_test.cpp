#include "sim/core/unit_names.h"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace rollrig;

namespace {
/// A value in a unit that a logger names, in the SI unit of a key.
double to_si(const char* text, const char* key, double value) {
  return parse_unit(text, unit_of_key(key)).to_si(value);
}
}  // namespace

TEST_CASE("units that loggers and people write are converted", "[fast]") {
  // 1 mile = 1609.344 m, 1 lbf = 0.45359237 kg x 9.80665 m/s2 (international yard and pound, 1959)
  CHECK(to_si("mph", "speed_km_h", 60.0) == Approx(60.0 * 1609.344 / 3600.0).epsilon(1e-12));
  CHECK(to_si("km/h", "speed_km_h", 36.0) == Approx(10.0).epsilon(1e-12));
  CHECK(to_si("kmh", "speed_km_h", 36.0) == Approx(10.0).epsilon(1e-12));
  CHECK(to_si("m s-1", "speed_km_h", 10.0) == Approx(10.0).epsilon(1e-12));
  CHECK(to_si("kgf", "load_N", 100.0) == Approx(980.665).epsilon(1e-12));
  CHECK(to_si("lbf", "load_N", 1.0) == Approx(0.45359237 * 9.80665).epsilon(1e-12));
  CHECK(to_si("psi", "cavity_pressure_kPa", 1.0) == Approx(6894.757293168).epsilon(1e-9));
  CHECK(to_si("kgf/cm2", "cavity_pressure_kPa", 1.0) == Approx(98066.5).epsilon(1e-12));
  CHECK(to_si("lb-ft", "drum_torque_Nm", 1.0) == Approx(0.3048 * 0.45359237 * 9.80665).epsilon(1e-9));
  CHECK(to_si("N.m", "drum_torque_Nm", 3.0) == Approx(3.0));
  CHECK(to_si("ft", "elevation_m", 1.0) == Approx(0.3048).epsilon(1e-12));
}

TEST_CASE("temperatures have their offset, in whichever way they are written", "[fast]") {
  for (const char* name : {"degC", "°C", "celsius", "C"}) {
    INFO(name);
    CHECK(to_si(name, "ambient_degC", 25.0) == Approx(298.15).epsilon(1e-12));
  }
  for (const char* name : {"degF", "°F", "F"}) {
    INFO(name);
    CHECK(to_si(name, "ambient_degC", 77.0) == Approx(298.15).epsilon(1e-12));
    CHECK(to_si(name, "ambient_degC", -40.0) == Approx(233.15).epsilon(1e-12));
  }
  CHECK(to_si("K", "ambient_degC", 298.15) == Approx(298.15).epsilon(1e-12));
}

TEST_CASE("the suffixes of keys are units as before, and the case of a usual name does not matter", "[fast]") {
  CHECK(to_si("km_h", "speed_km_h", 36.0) == Approx(10.0));
  CHECK(to_si("m_s", "speed_km_h", 10.0) == 10.0);
  CHECK(to_si("kN", "load_N", 5.0) == 5000.0);
  CHECK(to_si("mbar", "cavity_pressure_kPa", 2500.0) == Approx(250e3));
  CHECK(to_si("KPA", "cavity_pressure_kPa", 250.0) == Approx(250e3));
  CHECK(to_si("Bar", "cavity_pressure_kPa", 2.5) == Approx(250e3));
}

TEST_CASE("a unit of another dimension is refused with both dimensions, an unknown one as such", "[fast]") {
  const auto refusal = [](const char* text, const char* key) -> std::string {
    try {
      parse_unit(text, unit_of_key(key));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK_THAT(refusal("kN", "cavity_pressure_kPa"), Catch::Contains("force") && Catch::Contains("pressure"));
  CHECK_THAT(refusal("kg", "load_N"), Catch::Contains("mass") && Catch::Contains("force"));
  CHECK_THAT(refusal("V", "load_N"), Catch::Contains("quantity in") && Catch::Contains("force"));
  CHECK_THAT(refusal("furlongs per tire", "speed_km_h"), Catch::Contains("no unit that is known"));
  CHECK_THAT(refusal("", "speed_km_h"), !Catch::Contains("accepted"));
  for (const char* name : {"psig", "psia", "bar(a)", "barg", "kPa abs"}) {
    INFO(name);
    CHECK_THAT(refusal(name, "cavity_pressure_kPa"), Catch::Contains("gauge or absolute"));
  }
}

TEST_CASE("every usual name of a unit is one of its dimension", "[fast]") {
  for (const char* key : {"load_N", "drum_torque_Nm", "cavity_pressure_kPa", "ambient_degC", "speed_km_h",
                          "elevation_m", "time_s", "mass_kg", "power_W", "exponent"}) {
    const Unit wanted = unit_of_key(key);
    const std::vector<std::string> names = list_unit_names(wanted.dimension);
    CHECK(names.size() >= 3);
    for (const std::string& name : names) {
      INFO(key << " in " << name);
      CHECK(parse_unit(name, wanted).factor > 0.0);
    }
  }
}

TEST_CASE("a text that is too long for a unit is none", "[fast]") {
  const std::string text(50000, 'a');
  CHECK_THROWS_WITH(rollrig::parse_unit(text, rollrig::unit_of_key("p_kPa")), Catch::Contains("is no unit"));
  CHECK_FALSE(rollrig::is_known_unit(text));
}
