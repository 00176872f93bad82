// Tire classes: what a tire file says of them, and what the test of ISO 28580 asks for by class.
#include "models/tire/tire_class.h"

#include <catch2/catch.hpp>

#include "models/tire/conversion_laws.h"
#include "models/tire/tire_file.h"
#include "sim/core/assets.h"
#include "sim/core/config.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

using namespace rollrig;
using models::IsoTestOfClass;
using models::ServiceDescription;
using models::TireClass;

namespace {

ServiceDescription make_service(TireClass tire_class, int load_index, const char* symbol) {
  ServiceDescription service;
  service.tire_class = tire_class;
  service.load_index = load_index;
  service.speed_symbol = symbol;
  return service;
}

/// The key that is refused; empty where the table is read.
std::string find_refused_key(const std::string& table) {
  try {
    const ConfigTable config = parse_config("[service_description]\n" + table, "tire.toml");
    models::read_service_description(*config.find("service_description")->as_table());
  } catch (const InputError& error) {
    return error.problem().key;
  }
  return "";
}

/// The asset of class C1 with its tables [service_description] and [iso_28580] replaced.
models::TireFile read_changed_tire(const std::string& service, const std::string& iso) {
  std::string text = read_text_file(find_asset("tires", "c1_205_55r16"));
  const std::size_t from = text.find("[service_description]");
  const std::size_t to = text.find("[validity]");
  text.replace(from, to - from, service + "\n" + iso + "\n");
  return models::read_tire(parse_config(text, "changed.toml"));
}

}  // namespace

TEST_CASE("the test by class has the figures of the regulation", "[fast]") {
  // K_t as UN R117, Annex 6, 6.2 has it: 0.008 for C1, 0.010 for C2 and C3 up to index 121, 0.006 for C3 above.
  const double large_rim_m = 0.5715;
  const IsoTestOfClass car = models::find_iso_test(make_service(TireClass::kC1, 91, "V"), 0.4064);
  CHECK(car.ambient_coefficient_per_K == 0.008);
  CHECK(car.load_N == Approx(0.8 * 615.0 * 9.80665));
  CHECK(car.pressure_Pa == 210e3);
  CHECK(car.speed_m_s == Approx(80.0 / 3.6));
  CHECK(car.warm_up_s == 1800.0);
  const IsoTestOfClass van = models::find_iso_test(make_service(TireClass::kC2, 121, "N"), 0.4064);
  CHECK(van.ambient_coefficient_per_K == 0.010);
  CHECK(van.load_N == Approx(0.85 * 1450.0 * 9.80665));
  CHECK_FALSE(van.pressure_Pa.has_value());
  const IsoTestOfClass light_truck = models::find_iso_test(make_service(TireClass::kC3, 121, "M"), large_rim_m);
  CHECK(light_truck.ambient_coefficient_per_K == 0.010);
  CHECK(light_truck.warm_up_s == van.warm_up_s);
  CHECK(light_truck.speed_m_s == Approx(80.0 / 3.6));
  const IsoTestOfClass truck = models::find_iso_test(make_service(TireClass::kC3, 122, "K"), large_rim_m);
  CHECK(truck.ambient_coefficient_per_K == 0.006);
  CHECK(truck.speed_m_s == Approx(80.0 / 3.6));
  CHECK(truck.warm_up_s == 180.0 * 60.0);
  CHECK(models::find_iso_test(make_service(TireClass::kC3, 122, "K"), 0.4953).warm_up_s == 150.0 * 60.0);
  CHECK(models::find_iso_test(make_service(TireClass::kC3, 156, "J"), large_rim_m).speed_m_s == Approx(60.0 / 3.6));
}

TEST_CASE("a reinforced tire is tested at a higher pressure", "[fast]") {
  ServiceDescription service = make_service(TireClass::kC1, 94, "W");
  service.is_reinforced = true;
  CHECK(models::find_iso_test(service, 0.4064).pressure_Pa == 250e3);
}

TEST_CASE("speed symbols have the speeds of product sheets, and rise in order", "[fast]") {
  // EPREL product sheets: 530585 J, 511829 K, 383836 M, 1266198 R, 610323 S, 610243 T, 583464 H
  const std::vector<std::pair<const char*, double>> known{{"J", 100.0}, {"K", 110.0}, {"M", 130.0}, {"R", 170.0},
                                                          {"S", 180.0}, {"T", 190.0}, {"H", 210.0}};
  for (const auto& [symbol, speed_km_h] : known) CHECK(models::find_symbol_speed_km_h(symbol) == speed_km_h);
  double last_km_h = 0.0;
  for (const std::string& symbol : models::list_speed_symbols()) {
    const double speed_km_h = *models::find_symbol_speed_km_h(symbol);
    CHECK(speed_km_h > last_km_h);
    last_km_h = speed_km_h;
  }
  CHECK_FALSE(models::find_symbol_speed_km_h("I").has_value());
  CHECK_FALSE(models::find_symbol_speed_km_h("").has_value());
}

TEST_CASE("a class that contradicts its numbers is refused, with the number", "[fast]") {
  CHECK(find_refused_key("class = \"C1\"\nload_index = 91\nspeed_symbol = \"v\"\n").empty());
  CHECK(find_refused_key("class = \"C2\"\nload_index = 109\nspeed_symbol = \"T\"\n").empty());
  CHECK(find_refused_key("class = \"C3\"\nload_index = 121\nspeed_symbol = \"M\"\n").empty());
  const auto ends_with = [](const std::string& key, const std::string& end) {
    return key.size() >= end.size() && key.compare(key.size() - end.size(), end.size(), end) == 0;
  };
  CHECK(ends_with(find_refused_key("class = \"C4\"\nload_index = 91\n"), "class"));
  CHECK(ends_with(find_refused_key("class = \"C1\"\nload_index = 59\n"), "load_index"));
  CHECK(ends_with(find_refused_key("class = \"C1\"\nload_index = 91.5\n"), "load_index"));
  CHECK(ends_with(find_refused_key("class = \"C1\"\nload_index = 91\nspeed_symbol = \"I\"\n"), "speed_symbol"));
  CHECK(ends_with(find_refused_key("class = \"C2\"\nload_index = 122\nspeed_symbol = \"N\"\n"), "load_index"));
  CHECK(ends_with(find_refused_key("class = \"C2\"\nload_index = 104\nspeed_symbol = \"M\"\n"), "speed_symbol"));
  CHECK(ends_with(find_refused_key("class = \"C3\"\nload_index = 156\n"), "speed_symbol"));
  CHECK(ends_with(find_refused_key("class = \"C3\"\nload_index = 118\nspeed_symbol = \"R\"\n"), "class"));
  // Load index and symbol do not tell a passenger car from a van.
  const auto mistake = models::find_class_mistake(make_service(TireClass::kC3, 91, "V"));
  REQUIRE(mistake.has_value());
  CHECK(mistake->what == "a tire with load index 91 and speed symbol V is of class C1 or C2, not C3");
  CHECK(mistake->allowed.find("\"C1\" of passenger cars") != std::string::npos);
  CHECK(ends_with(find_refused_key("class = \"C2\"\nload_index = 104\nreinforced = true\n"), "reinforced"));
}

TEST_CASE("a class that the load index hardly goes with is doubted, as far as the symbol leaves it open", "[fast]") {
  const auto light = models::doubt_class_by_index(make_service(TireClass::kC3, 91, ""));
  REQUIRE(light.has_value());
  CHECK(light->find("of class C1 or C2, unless its speed symbol is M or a lower one") != std::string::npos);
  CHECK(light->find("begins at load index 122") != std::string::npos);
  CHECK(models::doubt_class_by_index(make_service(TireClass::kC3, 121, "")).has_value());
  CHECK(!models::doubt_class_by_index(make_service(TireClass::kC3, 122, "")).has_value());
  CHECK(!models::doubt_class_by_index(make_service(TireClass::kC3, 118, "L")).has_value());
  CHECK(!models::doubt_class_by_index(make_service(TireClass::kC3, 0, "")).has_value());  // not known
  CHECK(!models::doubt_class_by_index(make_service(TireClass::kC2, 109, "")).has_value());
  CHECK(models::doubt_class_by_index(make_service(TireClass::kC1, 122, "V")).has_value());
  CHECK(!models::doubt_class_by_index(make_service(TireClass::kC1, 121, "V")).has_value());
}

TEST_CASE("a tire file with a class needs no more than its RRc", "[fast]") {
  const models::TireFile tire = read_changed_tire("[service_description]\nclass = \"C1\"\nload_index = 91\n",
                                                  "[iso_28580]\nrrc_N_per_kN = 8.4\n");
  REQUIRE(tire.iso_28580.has_value());
  CHECK(tire.iso_28580->load_N == Approx(0.8 * 615.0 * 9.80665));
  CHECK(tire.iso_28580->pressure_Pa == 210e3);
  CHECK(tire.list_class_doubts().empty());
  // what the file states has precedence, and is doubted
  const models::TireFile stated =
      read_changed_tire("[service_description]\nclass = \"C1\"\nload_index = 91\n",
                        "[iso_28580]\nrrc_N_per_kN = 8.4\nload_N = 5200\nambient_coefficient_per_degC = 0.006\n");
  CHECK(stated.iso_28580->load_N == 5200.0);
  CHECK(stated.list_class_doubts().size() == 2);
  // and what is written is read again
  const models::TireFile again = models::read_tire(parse_config(models::write_tire(stated), "again.toml"));
  CHECK(again.service->load_index == 91);
  CHECK(again.iso_28580->load_N == Approx(5200.0));
}

TEST_CASE("without a class, load and pressure are required as before", "[fast]") {
  CHECK_THROWS_AS(read_changed_tire("", "[iso_28580]\nrrc_N_per_kN = 8.4\n"), InputError);
  const models::TireFile old =
      read_changed_tire("", "[iso_28580]\nrrc_N_per_kN = 8.4\nload_N = 4825\npressure_kPa = 210\n");
  CHECK_FALSE(old.service.has_value());
  CHECK(old.iso_28580->warm_up_s == 1800.0);
  CHECK(old.iso_28580->speed_m_s == Approx(80.0 / 3.6));
  CHECK(old.list_class_doubts().empty());
}

TEST_CASE("a van's tire needs the pressure of its maximum load", "[fast]") {
  const std::string service = "[service_description]\nclass = \"C2\"\nload_index = 109\nspeed_symbol = \"T\"\n";
  CHECK_THROWS_AS(read_changed_tire(service, "[iso_28580]\nrrc_N_per_kN = 6.2\n"), InputError);
  const models::TireFile tire =
      read_changed_tire(service + "maximum_load_pressure_kPa = 475\n", "[iso_28580]\nrrc_N_per_kN = 6.2\n");
  CHECK(tire.iso_28580->pressure_Pa == 475e3);
  CHECK(tire.iso_28580->ambient_coefficient_per_K == 0.010);
}

TEST_CASE("a tire of commercial vehicles that is called C1 is doubted", "[fast]") {
  models::TireFile tire = read_changed_tire("[service_description]\nclass = \"C1\"\nload_index = 91\n",
                                            "[iso_28580]\nrrc_N_per_kN = 8.4\n");
  tire.designation = "205/75 R16C";
  CHECK(tire.list_class_doubts().size() == 1);
}

TEST_CASE("a coefficient that no tire has is refused in a tire file, with the unit that it may be in", "[fast]") {
  const auto find_allowed = [](const char* rrc) {
    try {
      const std::string table = "[iso_28580]\nload_N = 4825\npressure_kPa = 210\nrrc_N_per_kN = ";
      read_changed_tire("", table + rrc + "\n");
    } catch (const InputError& error) {
      return error.problem().allowed;
    }
    return std::string();
  };
  CHECK(find_allowed("0.84") == "2 to 30 N/kN, which is kg/t; 0.84 in percent is 8.4 N/kN");
  CHECK(find_allowed("84") == "2 to 30 N/kN, which is kg/t; 84 in 0.1 N/kN is 8.4 N/kN");
  CHECK(find_allowed("8.4").empty());
}

TEST_CASE("a truck tire with a pressure in psi is doubted", "[fast]") {
  const auto count = [](const char* pressure_kPa) {
    const std::string service = "[service_description]\nclass = \"C3\"\nload_index = 156\nspeed_symbol = \"L\"\n";
    return read_changed_tire(service + "maximum_load_pressure_kPa = " + pressure_kPa + "\n",
                             "[iso_28580]\nrrc_N_per_kN = 5.5\n")
        .list_class_doubts()
        .size();
  };
  CHECK(count("123") == 1);  // 850 kPa
  for (const char* of_tire : {"525", "850"}) CHECK(count(of_tire) == 0);
}
