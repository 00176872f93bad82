#include "models/tire/tire_file.h"

#include <boost/algorithm/string/replace.hpp>
#include <catch2/catch.hpp>

#include "tests/support/drum_fixture.h"

using namespace rollrig;

TEST_CASE("a tire that is written is the tire that is read", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.standard_uncertainties.rolling_resistance.A0_N = 0.5;
  tire.values.load_map = {{{30.0, 0.8, 0.010, 1e-4}, 5000.0}, {{44.0, 1.2, 0.012, 2e-4}, 7000.0}};
  tire.standard_uncertainties.load_map.resize(2);
  tire.standard_uncertainties.load_map[1].B0_per_K = 1e-4;
  tire.rig_thermal["other"].speed_conductance_sd_W_s_per_m_K = 0.1;
  const models::TireFile back = models::read_tire(parse_config(models::write_tire(tire), "written"));
  std::vector<double> before, after;
  const auto collect = [](std::vector<double>& into) {
    return [&into](const std::string&, const Field&, const double& value) { into.push_back(value); };
  };
  models::TireParameters<double>::visit_all(tire.values, collect(before));
  models::TireParameters<double>::visit_all(back.values, collect(after));
  REQUIRE(before.size() == after.size());
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i] == Approx(before[i]).epsilon(1e-9));
  CHECK(back.standard_uncertainties.rolling_resistance.A0_N == 0.5);
  CHECK(back.values.load_map[1].A1_N_s_per_m == 1.2);
  CHECK(back.standard_uncertainties.load_map[1].B0_per_K == 1e-4);
  CHECK(back.rig_thermal.at("other").speed_conductance_sd_W_s_per_m_K == 0.1);
  CHECK(back.iso_28580->load_N == 6865.0);
  CHECK(back.sweep_loads_N == tire.sweep_loads_N);
}

TEST_CASE("what the numbers of a tire are from is read and written, where the file says so", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  CHECK(tire.basis == models::TireBasis::kMeasured);
  for (const models::TireBasis basis : {models::TireBasis::kMeasured, models::TireBasis::kClass}) {
    tire.basis = basis;
    CHECK(models::read_tire(parse_config(models::write_tire(tire), "written")).basis == basis);
  }
  tire.basis = models::TireBasis::kUnknown;
  CHECK_THAT(models::write_tire(tire), !Catch::Contains("basis"));
  CHECK(models::read_tire(parse_config(models::write_tire(tire), "written")).basis == models::TireBasis::kUnknown);
}

TEST_CASE("a tire of another model is written and read with that model's own numbers", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  CHECK(tire.values.model().info.id == "combined");
  CHECK(tire.values.own.values.empty());
  CHECK_THAT(models::write_tire(tire), !Catch::Contains("model ="));
  tire.values.own = tests::make_own("two_node");
  tire.standard_uncertainties.own = tests::make_own("two_node");
  tire.standard_uncertainties.own.values = {0.0, 0.05, 0.0, 8.0};
  const std::string text = models::write_tire(tire);
  const models::TireFile back = models::read_tire(parse_config(text, "written"));
  CHECK(back.values.model().info.id == "two_node");
  CHECK(back.values.own.values == tire.values.own.values);
  CHECK(back.standard_uncertainties.own.values == tire.standard_uncertainties.own.values);
  CHECK(&back.parameters_on({"drum_2m"}, models::Baseline::kCombined).model() == &tire.values.model());
  models::TireFile constant = back;
  constant.has_constant = true;
  const auto on_rig = constant.parameters_on({"drum_2m"}, models::Baseline::kConstantRrc);
  CHECK(on_rig.model().info.id == models::kConstantModel);
  CHECK(on_rig.own.values.empty());
}

TEST_CASE("a file of format 1 is read under its old keys, each as the key of format 2", "[fast]") {
  const std::string old_keys = R"(
z_W_per_K = 11.5
z_W_per_K_sd = 0.7
road_share_of_z = 0.35
road_share_of_z_sd = 0.1
f_W_s_per_m_K = 1.25
f_W_s_per_m_K_sd = 0.06
[thermal.rig.drum_67in]
z_W_per_K = 9.5
z_W_per_K_sd = 0.8
f_W_s_per_m_K = 1.75
f_W_s_per_m_K_sd = 0.09
)";
  const std::string before = R"(name = "t"
[geometry]
outer_diameter_m = 0.7
section_width_m = 0.2
rim_diameter_m = 0.48
mass_kg = 9.0
wheel_mass_kg = 9.0
spin_inertia_kg_m2 = 1.0
[thermal]
heat_capacity_J_per_K = 17000.0
gas_heat_capacity_J_per_K = 90.0
H_gas_W_per_K = 4.5
)";
  using boost::algorithm::replace_all_copy;
  std::string new_keys = replace_all_copy(old_keys, "road_share_of_z", "road_share_of_conductance_at_rest");
  new_keys = replace_all_copy(new_keys, "\nz_W_per_K", "\nconductance_at_rest_W_per_K");
  new_keys = replace_all_copy(new_keys, "\nf_W_s_per_m_K", "\nconductance_per_speed_W_s_per_m_K");
  for (const std::string& text :
       {"format = \"rollrig-tire/1\"\n" + before + old_keys, "format = \"rollrig-tire/2\"\n" + before + new_keys}) {
    const models::TireFile tire = models::read_tire(parse_config(text, "t.toml"));
    const auto& thermal = tire.values.thermal;
    const auto& sd = tire.standard_uncertainties.thermal;
    CHECK(thermal.rest_conductance_W_per_K == 11.5);
    CHECK(sd.rest_conductance_W_per_K == 0.7);
    CHECK(thermal.road_share_of_rest_conductance == 0.35);
    CHECK(sd.road_share_of_rest_conductance == 0.1);
    CHECK(thermal.speed_conductance_W_s_per_m_K == 1.25);
    CHECK(sd.speed_conductance_W_s_per_m_K == 0.06);
    const models::RigThermal& on_rig = tire.rig_thermal.at("drum_67in");
    CHECK(on_rig.rest_conductance_W_per_K == 9.5);
    CHECK(on_rig.rest_conductance_sd_W_per_K == 0.8);
    CHECK(on_rig.speed_conductance_W_s_per_m_K == 1.75);
    CHECK(on_rig.speed_conductance_sd_W_s_per_m_K == 0.09);
    CHECK_THAT(models::write_tire(tire), Catch::StartsWith("format = \"rollrig-tire/2\"") &&
                                             Catch::Contains("conductance_at_rest_W_per_K_sd = 0.8") &&
                                             !Catch::Contains("z_W_per_K ="));
  }
}

TEST_CASE("values of a rig's own stand in for the general ones on that rig only", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.rig_thermal = {{"here", {5.0, {}, {}, {}}}};
  const auto combined = models::Baseline::kCombined;
  CHECK(tire.parameters_on({"here"}, combined).thermal.rest_conductance_W_per_K == 5.0);
  CHECK(tire.parameters_on({"here"}, combined).thermal.speed_conductance_W_s_per_m_K ==
        tire.values.thermal.speed_conductance_W_s_per_m_K);
  CHECK(tire.parameters_on({"there"}, combined).thermal.rest_conductance_W_per_K ==
        tire.values.thermal.rest_conductance_W_per_K);
}

TEST_CASE("a tire without conductances is cooled by the rig, in proportion to its outer area", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.rig_thermal.clear();
  tire.values.thermal.rest_conductance_W_per_K = tire.values.thermal.speed_conductance_W_s_per_m_K = 0.0;
  models::TireGeometry<double>& geometry = tire.values.geometry;
  geometry.outer_diameter_m = 0.6;  // sidewalls 2 pi (0.09 - 0.04) m2, tread 0.6 pi 0.2 m2
  geometry.rim_diameter_m = 0.4;
  geometry.section_width_m = 0.2;
  const auto combined = models::Baseline::kCombined;
  const auto on_rig = tire.parameters_on({"somewhere", {10.0, 2.0}}, combined).thermal;
  CHECK(on_rig.rest_conductance_W_per_K == Approx(6.9115).epsilon(1e-4));
  CHECK(on_rig.speed_conductance_W_s_per_m_K == Approx(1.3823).epsilon(1e-4));
  CHECK_THROWS_WITH(tire.parameters_on({"somewhere"}, combined),
                    Catch::Contains("rig 'somewhere' has no [tire_cooling]"));
  const std::string text = models::write_tire(tire);  // says nothing of conductances, and is read
  CHECK_THAT(text, !Catch::Contains("\nconductance_"));
  CHECK(models::read_tire(parse_config(text, "cooled.toml")).values.thermal.rest_conductance_W_per_K == 0.0);
  tire.rig_thermal["somewhere"].rest_conductance_W_per_K = 15.0;  // its own come first
  const auto own_at_rest = tire.parameters_on({"somewhere", {10.0, 2.0}}, combined).thermal;
  CHECK(own_at_rest.rest_conductance_W_per_K == 15.0);
  CHECK(own_at_rest.speed_conductance_W_s_per_m_K == Approx(1.3823).epsilon(1e-4));
  const auto alone = tire.parameters_on({"somewhere"}, combined).thermal;  // a rig without cooling
  CHECK(alone.rest_conductance_W_per_K == 15.0);
  CHECK(alone.speed_conductance_W_s_per_m_K == 0.0);
  CHECK(tire.parameters_on({"elsewhere", {10.0, 2.0}}, combined).thermal.rest_conductance_W_per_K ==
        Approx(6.9115).epsilon(1e-4));
}

TEST_CASE("one conductance without the other is refused", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.rig_thermal.clear();
  std::string text = models::write_tire(tire);
  const std::size_t line = text.find("conductance_at_rest_W_per_K");
  text.erase(line, text.find('\n', line) + 1 - line);
  CHECK_THROWS_WITH(models::read_tire(parse_config(text, "half.toml")),
                    Catch::Contains("conductance_at_rest_W_per_K") && Catch::Contains("half.toml"));
}

TEST_CASE("a tire with the bounded law has no lines over speed in its file, and comes back from it", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.values.own = tests::make_own("bounded");
  tire.standard_uncertainties.own = {tire.values.own.model, std::vector<double>(tire.values.own.values.size())};
  const std::string text = models::write_tire(tire);
  CHECK_THAT(text, !Catch::Contains("A0_N") && Catch::Contains("speed_rise = 0.3"));
  const models::TireFile back = models::read_tire(parse_config(text, "bounded.toml"));
  CHECK(back.values.own.values == tire.values.own.values);
  CHECK(back.values.rolling_resistance.reference_load_N == tire.values.rolling_resistance.reference_load_N);
  std::string with_line = text;
  with_line.replace(with_line.find("pressure_exponent"), 0, "A0_N = 30.0\n");
  CHECK_THROWS_WITH(models::read_tire(parse_config(with_line, "bounded.toml")), Catch::Contains("A0_N"));
}

TEST_CASE("a file of the bounded law is refused if its loss would rise with heat or fall with speed", "[fast]") {
  models::TireFile tire = tests::read_combined_tire();
  tire.values.own = tests::make_own("bounded");
  tire.standard_uncertainties.own = {tire.values.own.model, std::vector<double>(tire.values.own.values.size())};
  const std::string text = models::write_tire(tire);
  const auto read_with = [&text](const std::string& key, const std::string& value) {
    std::string changed = text;
    const std::size_t at = changed.find(key + " = ");
    changed.replace(at, changed.find('\n', at) - at, key + " = " + value);
    return models::read_tire(parse_config(changed, "bounded.toml"));
  };
  CHECK_NOTHROW(read_with("speed_rise", "0.3"));
  CHECK_THROWS_WITH(read_with("hot_limit_degC", "20.0"),
                    Catch::Contains("hot_limit_degC") && Catch::Contains("more than cold_limit_degC = 25"));
  CHECK_THROWS_WITH(read_with("limit_width_K", "12.0"), Catch::Contains("limit_width_K") && Catch::Contains("11.25"));
  // theta less that at 30 degC goes from -6 K to 39 K: s = 0.3 is enough up to 0.016/K x 39 K x c.
  CHECK_NOTHROW(read_with("speed_rise_of_fall", "0.4"));
  CHECK_THROWS_WITH(read_with("speed_rise_of_fall", "0.6"),
                    Catch::Contains("[bounded] speed_rise\n") && Catch::Contains("fall with speed"));
  CHECK_NOTHROW(read_with("speed_rise_of_fall", "-2.5"));
  CHECK_THROWS_WITH(read_with("speed_rise_of_fall", "-3.5"), Catch::Contains("fall with speed"));
  // S at 80 km/h is 0.735 here: at standstill a c above 1/0.735 would have the loss rise with heat.
  for (const char* too_far : {"1.37", "-3.8"}) {
    CHECK_THROWS_WITH(read_with("speed_rise_of_fall", too_far), Catch::Contains("rise with temperature"));
  }
}

TEST_CASE("tables that a use does not need may be absent, and what it needs is named", "[fast]") {
  const char* text = R"(format = "rollrig-tire/1"
name = "road"
[geometry]
outer_diameter_m = 0.7
section_width_m = 0.2
rim_diameter_m = 0.48
mass_kg = 9.0
wheel_mass_kg = 9.0
spin_inertia_kg_m2 = 1.0
[constant]
rrc_N_per_kN = 9.0
rrc_N_per_kN_sd = 2.5
)";
  const models::TireFile tire = models::read_tire(parse_config(text, "road.toml"));
  CHECK(tire.values.constant.rrc == Approx(0.009));
  CHECK(tire.standard_uncertainties.constant.rrc == Approx(0.0025));
  CHECK_THROWS_WITH(tire.parameters_on({"drum_2m"}, models::Baseline::kCombined),
                    Catch::Contains("has no table") && Catch::Contains("road.toml"));
  // Against a constant coefficient effects take values of the class, and what the file has stays.
  const models::TireParameters<double> filled = tire.parameters_with_class_values(4000.0, 260e3);
  CHECK(filled.geometry.mass_kg == 9.0);
  CHECK(filled.constant.rrc == Approx(0.009));
  CHECK(filled.rolling_resistance.reference_load_N == 4000.0);
  CHECK(filled.rolling_resistance.reference_pressure_Pa == 260e3);
  CHECK(filled.thermal.heat_capacity_J_per_K > 9.0 * 1000.0);
  CHECK(filled.stiffness.vertical_N_per_m > 0.0);
  const models::TireFile whole = tests::read_combined_tire();
  models::TireFile with_constant = whole;
  with_constant.has_constant = true;
  CHECK(with_constant.parameters_with_class_values(4000.0, 260e3).thermal.rest_conductance_W_per_K ==
        whole.values.thermal.rest_conductance_W_per_K);
  CHECK_THROWS_WITH(whole.parameters_with_class_values(4000.0, 260e3), Catch::Contains("[constant]"));
}
