#include "sim/core/quantity.h"

#include <catch2/catch.hpp>

using rollrig::intern_quantity;
using rollrig::Quantity;

TEST_CASE("a quantity's heading is its name and its unit, and is read back", "[fast]") {
  constexpr Quantity torque{"drum_torque", "Nm"};
  CHECK(torque.header() == "drum_torque_Nm");
  CHECK(torque.file_unit().symbol == "N m");
  const Quantity read = intern_quantity("drum_torque_Nm");
  CHECK(read == torque);
  CHECK(read.unit_suffix() == "Nm");
  CHECK(intern_quantity("drum_torque_kNm") != torque);
  CHECK(Quantity("drum_torque", "kN") != torque);
  CHECK((Quantity("drum_torque", "N") < torque && !(torque < Quantity("drum_torque", "N"))));
}

TEST_CASE("a ratio has no unit, a temperature its offset", "[fast]") {
  CHECK(intern_quantity("slip_ratio").header() == "slip_ratio");
  CHECK(intern_quantity("slip_ratio").unit_suffix().empty());
  CHECK(intern_quantity("liner_temperature_degC").file_unit().to_si(25.0) == Approx(298.15));
}

TEST_CASE("text of a quantity made up at run time outlives its maker", "[fast]") {
  Quantity kept;
  {
    const std::string header = std::string("bearing") + "_rise_K";
    kept = intern_quantity(header);
  }
  CHECK(kept.header() == "bearing_rise_K");
}

TEST_CASE("the heading of a file finds what a map holds of its quantity", "[fast]") {
  constexpr Quantity load{"load", "N"};
  rollrig::QuantityMap<double> values{{load, 5400.0}};
  CHECK(values.at("load_N") == 5400.0);
  CHECK(values.count("load_N") == 1);
  CHECK(values.count("load_kN") == 0);
  CHECK(values.count("speed_km_h") == 0);
  values["speed_km_h"] = 25.0;
  CHECK(values.at(Quantity("speed", "km_h")) == 25.0);
  CHECK(rollrig::list_headers({load, {"speed", "km_h"}}, {"time_s"}) ==
        std::vector<std::string>{"time_s", "load_N", "speed_km_h"});
}
