#include "sim/core/units.h"

#include <catch2/catch.hpp>

using namespace rollrig;

namespace {
void check_unit(const char* key, const char* symbol, double factor, Dimension dimension) {
  INFO(key);
  const Unit unit = unit_of_key(key);
  CHECK(unit.symbol == symbol);
  CHECK(unit.factor == Approx(factor).epsilon(1e-14));
  CHECK(unit.dimension == dimension);
}
}  // namespace

TEST_CASE("the suffix of a key is its unit", "[fast]") {
  check_unit("drum_torque_Nm", "N m", 1.0, {1, 2, -2, 0});
  check_unit("speed_km_h", "km/h", 1.0 / 3.6, dimension::kSpeed);
  check_unit("pressure_kPa", "kPa", 1e3, dimension::kPressure);
  check_unit("A1_N_s_per_m", "N s/m", 1.0, {1, 0, -1, 0});
  check_unit("f_W_s_per_m_K", "W s/(m K)", 1.0, {1, 1, -2, -1});
  check_unit("c2_N_s2_per_m2", "N s2/m2", 1.0, {1, -1, 0, 0});
  check_unit("B1_s_per_m_degC", "s/(m degC)", 1.0, {0, -1, 1, -1});
  check_unit("B0_per_degC", "1/degC", 1.0, {0, 0, 0, -1});
  check_unit("rrc_N_per_kN", "N/kN", 1e-3, {});
  check_unit("heat_capacity_J_per_K", "J/K", 1.0, {1, 2, -2, -1});
  check_unit("H_gas_W_per_K", "W/K", 1.0, {1, 2, -3, -1});
  check_unit("spin_inertia_kg_m2", "kg m2", 1.0, {1, 2, 0, 0});
  check_unit("B_N_per_km_h", "N/(km/h)", 3.6, {1, 0, -1, 0});
  check_unit("C_N_per_km_h2", "N/(km/h)2", 12.96, {1, -1, 0, 0});
  check_unit("rr_energy_Wh", "Wh", 3600.0, {1, 2, -2, 0});
  check_unit("pressure_exponent", "", 1.0, {});
  check_unit("road_share_of_z", "", 1.0, {});
}

TEST_CASE("of a key that is no name with a unit, the unit is what can be read", "[fast]") {
  check_unit("rrc_N_per_N_per_kN", "N/kN", 1e-3, {});
  check_unit("x_per_per_m", "1/m", 1.0, {0, -1, 0, 0});
  check_unit("N_per", "", 1.0, {});
  check_unit("x_N_per", "", 1.0, {});
  check_unit("per_per", "", 1.0, {});
  check_unit("", "", 1.0, {});
  check_unit("_", "", 1.0, {});
}

TEST_CASE("a temperature has an offset, its difference and its standard deviation have none", "[fast]") {
  CHECK(unit_of_key("ambient_degC").to_si(25.0) == Approx(298.15));
  CHECK(unit_of_key("ambient_degC").from_si(298.15) == Approx(25.0));
  CHECK(unit_of_key("ambient_degC_sd").to_si(2.0) == 2.0);
  CHECK(unit_of_key("rise_dK").to_si(15.0) == 15.0);
  CHECK(unit_of_key("z_W_per_K_sd").symbol == "W/K");
}

TEST_CASE("a name without its unit", "[fast]") {
  CHECK(name_without_unit("drum_torque_Nm") == "drum_torque");
  CHECK(name_without_unit("pressure_exponent") == "pressure_exponent");
  CHECK(name_without_unit("A1_N_s_per_m") == "A1");
}
