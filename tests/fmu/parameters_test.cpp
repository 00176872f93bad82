// Each parameter of an FMU acts: what its description names and the equations do not use is found here.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "rollrig/assets.h"
#include "rollrig/error.h"
#include "rollrig/fmu.h"
#include "tests/fmu/importer.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig::tests;

namespace {

constexpr const char* kBody = R"(format = "rollrig-tire/2"
name = "trial"
[geometry]
outer_diameter_m = 0.67
section_width_m = 0.235
rim_diameter_m = 0.48
mass_kg = 10.5
wheel_mass_kg = 14.0
spin_inertia_kg_m2 = 1.35
[stiffness]
vertical_N_per_m = 220000.0
vertical_damping_N_s_per_m = 300.0
slip_stiffness_N = 75000.0
relaxation_length_m = 0.3
[thermal]
heat_capacity_J_per_K = 17000.0
gas_heat_capacity_J_per_K = 73.0
H_gas_W_per_K = 4.0
conductance_at_rest_W_per_K = 12.0
conductance_per_speed_W_s_per_m_K = 1.0
)";
constexpr const char* kReference = R"([rolling_resistance]
reference_load_N = 5000.0
reference_pressure_kPa = 250.0
reference_drum_diameter_m = 2.0
pressure_exponent = 0.4
)";
constexpr const char* kLines = R"(lowest_speed_km_h = 20.0
A0_N = 50.0
A1_N_s_per_m = 0.6
B0_per_degC = 0.008
B1_s_per_m_degC = 0.0001
)";
constexpr const char* kLoadMap = R"([[rolling_resistance.load_map]]
load_N = 3000.0
A0_N = 30.0
A1_N_s_per_m = 0.3
B0_per_degC = 0.008
B1_s_per_m_degC = 0.0001
[[rolling_resistance.load_map]]
load_N = 6000.0
A0_N = 62.0
A1_N_s_per_m = 0.7
B0_per_degC = 0.009
B1_s_per_m_degC = 0.0001
)";
constexpr const char* kTwoNode = R"([two_node]
tread_share_of_heat_capacity = 0.45
tread_share_of_heat = 0.7
tread_share_of_loss = 0.6
conductance_W_per_K = 60.0
)";
constexpr const char* kBounded = R"([bounded]
tread_share_of_heat_capacity = 0.45
tread_share_of_heat = 0.7
tread_share_of_loss = 0.6
conductance_W_per_K = 60.0
loss_N = 45.0
speed_rise = 0.4
fall_per_degC = 0.015
speed_rise_of_fall = 0.1
load_exponent = 1.1
step_speed_km_h = 70.0
step_power = 4.0
cold_limit_degC = 10.0
hot_limit_degC = 70.0
limit_width_K = 5.0
)";
constexpr const char* kConstant = "[constant]\nrrc_N_per_kN = 8.0\n";

/// A tire of each law.
struct Law {
  const char* model;
  std::string tables;
};
const std::vector<Law> kLaws{{"combined", std::string(kReference) + kLines},
                             {"combined", std::string(kReference) + kLines + kLoadMap},
                             {"constant_rrc", std::string(kReference) + kLines + kConstant},
                             {"two_node", std::string(kReference) + kLines + kTwoNode},
                             {"bounded", std::string(kReference) + kBounded}};

std::string write_tire(const TemporaryFolder& folder, const Law& law) {
  std::string text = kBody;
  text.insert(text.find("[geometry]"), std::string("model = \"") + law.model + "\"\n");
  write_file(folder.file("trial.toml"), text + law.tables);
  return folder.file("trial.toml");
}

/// Names with commas between them.
std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream rest(text);
  for (std::string name; std::getline(rest >> std::ws, name, ',');) names.push_back(name);
  return names;
}

/// All outputs and rates during a short drive with these parameters; empty where they are refused.
std::vector<double> drive(Fmi2& tire, const std::map<std::string, double>& parameters) {
  const LoadedFmu& fmu = tire.fmu;
  REQUIRE(FMI2(fmu, fmi2Reset)(tire.component) == fmi2OK);
  for (const auto& [name, value] : parameters) {
    const unsigned reference = fmu.description().find(name);
    if (FMI2(fmu, fmi2SetReal)(tire.component, &reference, 1, &value) != fmi2OK) return {};
  }
  const std::pair<const char*, double> inputs[]{
      {"load_N", 4500.0}, {"ambient_temperature_K", 283.15}, {"surface_temperature_K", 291.15}};
  for (const auto& [name, value] : inputs) tire.set(name, value);
  if (FMI2(fmu, fmi2SetupExperiment)(tire.component, fmi2False, 0.0, 0.0, fmi2False, 0.0) != fmi2OK ||
      FMI2(fmu, fmi2EnterInitializationMode)(tire.component) != fmi2OK ||
      FMI2(fmu, fmi2ExitInitializationMode)(tire.component) != fmi2OK) {
    return {};
  }
  std::vector<unsigned> watched = fmu.description().list("output");
  for (const unsigned rate : fmu.description().list("local")) watched.push_back(rate);
  std::vector<double> seen;
  double time_s = 0.0;
  for (const auto& [speed_m_s, acceleration_m_s2, force_N, length_s] :
       {std::array<double, 4>{0.0, 0.5, 400.0, 20.0}, {30.0, 0.0, 300.0, 300.0}, {30.0, -1.0, -1500.0, 25.0}}) {
    tire.set("speed_m_s", speed_m_s);
    tire.set("acceleration_m_s2", acceleration_m_s2);
    tire.set("drive_force_N", force_N);
    for (int i = 0; i < 2; ++i) {
      if (FMI2(fmu, fmi2DoStep)(tire.component, time_s, 0.5 * length_s, fmi2True) != fmi2OK) return {};
      time_s += 0.5 * length_s;
      std::vector<double> values(watched.size());
      const auto get = FMI2(fmu, fmi2GetReal);
      if (get(tire.component, watched.data(), watched.size(), values.data()) != fmi2OK) return {};
      seen.insert(seen.end(), values.begin(), values.end());
    }
  }
  return seen;
}

/// Parameters whose names begin so, and of which no other value changes anything.
std::vector<std::string> list_idle_parameters(const LoadedFmu& fmu, const std::string& prefix = "") {
  Fmi2 tire(fmu, fmi2CoSimulation);
  const std::vector<double> usual = drive(tire, {});
  REQUIRE_FALSE(usual.empty());
  std::vector<std::string> idle;
  for (const auto& [name, variable] : fmu.description().variables) {
    if (variable.causality != "parameter" || name.rfind(prefix, 0) != 0) continue;
    const double start = variable.start;
    bool acts = false;
    for (const double value : {1.1 * start, 0.9 * start, start + 0.01, start + 1.0}) {
      if (acts || value == start) continue;
      const std::vector<double> changed = drive(tire, {{name, value}});
      acts = !changed.empty() && changed != usual;
    }
    if (!acts) idle.push_back(name);
  }
  return idle;
}

/// Models that a tire may have: those that a refusal of another one names.
std::set<std::string> list_models(const TemporaryFolder& folder) {
  try {
    rollrig::make_fmu({write_tire(folder, {"a_law_that_is_none", ""}), "road", {}});
    FAIL("an unknown model was not refused");
  } catch (const rollrig::InputError& error) {
    const std::vector<std::string> names = split_list(error.problem().allowed);
    return {names.begin(), names.end()};
  }
  return {};
}

/// Effects that an FMU of such a tire may have: those that a refusal of another one names.
std::vector<std::string> list_acting_effects(const std::string& tire, const std::string& rig) {
  try {
    rollrig::make_fmu({tire, rig, {"clock_shift"}});
    FAIL("an effect that no wheel has was not refused");
  } catch (const rollrig::InputError& error) {
    REQUIRE(error.problem().value == "clock_shift");
    return split_list(error.problem().allowed);
  }
  return {};
}

}  // namespace

TEST_CASE("each parameter of an FMU acts, whatever the tire's law", "[slow]") {
  const TemporaryFolder folder;
  std::set<std::string> models;
  for (const Law& law : kLaws) models.insert(law.model);
  CHECK(models == list_models(folder));
  for (const Law& law : kLaws) {
    for (const char* rig : {"road", "drum_2m"}) {
      INFO(law.model << " on " << rig);
      const LoadedFmu fmu(write_tire(folder, law), rig);
      CHECK(list_idle_parameters(fmu) == std::vector<std::string>());
    }
  }
}

TEST_CASE("an effect that needs a table that the tire lacks is refused before any step", "[slow]") {
  const TemporaryFolder folder;
  std::string other = kReference;
  other.replace(other.find("5000.0"), 6, "4000.0").replace(other.find("250.0"), 5, "230.0");
  for (const char* rig : {"road", "drum_2m", "dyno_1m2"}) {
    const std::string lacking = write_tire(folder, {"constant_rrc", kConstant});
    std::vector<std::string> refused;
    std::vector<std::string> needing;
    const std::vector<std::string> all = list_acting_effects(lacking, rig);
    for (const std::string& effect : all) {
      INFO(effect << " on " << rig);
      const auto drive_with = [&](const std::string& reference) {
        const LoadedFmu fmu(write_tire(folder, {"constant_rrc", kConstant + reference}), rig, 2, {effect});
        Fmi2 tire(fmu, fmi2CoSimulation);
        std::map<std::string, double> parameters{{"start.cold_pressure_kPa", 240.0}};
        for (const auto& [name, variable] : fmu.description().variables) {
          if (name.rfind("effects.", 0) != 0) continue;  // some do nothing at their start
          parameters[name] = variable.start != 0.0 ? 0.95 * variable.start : 0.05;
        }
        return drive(tire, parameters);
      };
      const std::vector<double> usual = drive_with(std::string(kReference) + kLines);
      REQUIRE_FALSE(usual.empty());
      if (drive_with(other + kLines) != usual) needing.push_back(effect);
      try {
        const std::vector<double> without = drive_with("");
        CHECK(without == usual);
      } catch (const rollrig::InputError& error) {
        CHECK_THAT(error.what(), Catch::Contains("[rolling_resistance]") && Catch::Contains("trial.toml"));
        CHECK(error.problem().value == effect);
        refused.push_back(effect);
      }
    }
    CHECK(refused == needing);
    CHECK(refused.size() > 5);
    CHECK(refused.size() < all.size());
  }
}

TEST_CASE("each parameter of an effect in an FMU acts", "[slow]") {
  const TemporaryFolder folder;
  for (const char* rig : {"road", "drum_2m", "dyno_1m2"}) {
    for (const std::size_t law : {2u, 4u}) {
      INFO(kLaws[law].model << " on " << rig);
      const std::string tire = write_tire(folder, kLaws[law]);
      std::vector<std::string> all = list_acting_effects(tire, rig);
      const auto rim = std::find(all.begin(), all.end(), "rim_heat");  // takes the heat that brake_heat gives the gas
      REQUIRE(rim != all.end());
      all.erase(rim);
      std::vector<std::string> idle = list_idle_parameters(LoadedFmu(tire, rig, 2, all), "effects.");
      const bool is_reference_drum = rig == std::string("drum_2m");  // whose factor is 1, to any power
      for (const std::string& name : idle) {
        INFO(name);
        CHECK((is_reference_drum && name == "effects.curvature_exponent.exponent"));
      }
      CHECK(list_idle_parameters(LoadedFmu(tire, rig, 2, {"rim_heat"}), "effects.").empty());
    }
  }
}
