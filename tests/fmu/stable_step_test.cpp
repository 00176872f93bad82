// An FMU whose parameters let heat flow far faster than in the file: its integrator takes steps short enough for it.
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "rollrig/error.h"
#include "rollrig/fmu.h"
#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::LoadedFmu;

namespace {

using Parameters = std::vector<std::pair<const char*, double>>;

/// All outputs after each of 60 steps of a second: from standstill to 20 m/s, and on at that speed.
std::vector<double> drive_fast_heat(const LoadedFmu& fmu, const Parameters& parameters) {
  Fmi2 tire(fmu, fmi2CoSimulation);
  for (const auto& [name, value] : parameters) tire.set(name, value);
  tire.set("start.tire_temperature_degC", 60.0);
  tire.initialize();
  const std::vector<unsigned> outputs = fmu.description().list("output");
  std::vector<double> seen;
  for (int second = 0; second < 60; ++second) {
    const bool accelerates = second >= 10 && second < 20;
    tire.set("acceleration_m_s2", accelerates ? 2.0 : 0.0);
    tire.set("drive_force_N", second >= 50 ? -1500.0 : 0.0);
    tire.step(second, 1.0);
    std::vector<double> values(outputs.size());
    REQUIRE(FMI2(fmu, fmi2GetReal)(tire.component, outputs.data(), outputs.size(), values.data()) == fmi2OK);
    seen.insert(seen.end(), values.begin(), values.end());
  }
  return seen;
}

/// The largest difference of two drives, relative to the value.
double find_largest_difference(const std::vector<double>& of, const std::vector<double>& exact) {
  REQUIRE(of.size() == exact.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    REQUIRE(std::isfinite(of[i]));
    largest = std::max(largest, std::abs(of[i] - exact[i]) / std::max(1.0, std::abs(exact[i])));
  }
  return largest;
}

std::vector<std::string> list_all_effects(const std::string& rig) {
  std::vector<std::string> all;
  try {
    rollrig::make_fmu({"a50", rig, {"clock_shift"}});
    FAIL("an effect that no wheel has was not refused");
  } catch (const rollrig::InputError& error) {
    std::istringstream rest(error.problem().allowed);
    for (std::string name; std::getline(rest >> std::ws, name, ',');) all.push_back(name);
  }
  return all;
}

}  // namespace

TEST_CASE("an FMU stays stable where heat flows far faster than in the file", "[fast]") {
  const LoadedFmu fmu("a50", "road");
  const std::vector<Parameters> fast{
      {{"thermal.H_gas_W_per_K", 240.0}},        {{"thermal.H_gas_W_per_K", 300.0}},
      {{"thermal.H_gas_W_per_K", 4e4}},          {{"thermal.gas_heat_capacity_J_per_K", 0.5}},
      {{"thermal.heat_capacity_J_per_K", 40.0}}, {{"thermal.H_gas_W_per_K", 60.0}, {"steps.longest_s", 10.0}}};
  for (const Parameters& parameters : fast) {
    INFO(parameters.front().first << " = " << parameters.front().second);
    Parameters fine = parameters;
    fine.emplace_back("steps.longest_s", 1e-3);
    // A step of 2 over the fastest rate leaves a third of a fast rise. Times of a second are many such steps.
    CHECK(find_largest_difference(drive_fast_heat(fmu, parameters), drive_fast_heat(fmu, fine)) < 1e-3);
  }
}

TEST_CASE("an FMU with all effects stays stable, from standstill on", "[fast]") {
  for (const char* rig : {"road", "dyno_1m2"}) {
    const LoadedFmu fmu("a50", rig, 2, list_all_effects(rig));
    const Parameters fast{{"thermal.H_gas_W_per_K", 300.0}};
    Parameters fine = fast;
    fine.emplace_back("steps.longest_s", 1e-3);
    CHECK(find_largest_difference(drive_fast_heat(fmu, fast), drive_fast_heat(fmu, fine)) < 1e-3);
  }
}

TEST_CASE("a parameter that no step of an FMU can follow is named, with what is allowed", "[fast]") {
  const LoadedFmu fmu("a50", "road");
  // Heat flows at 1e6 W/K / (1 J/K); steps of 1e-4 s follow 2e4 per second.
  for (const char* same : {"thermal.gas_heat_capacity_J_per_K", "thermal.heat_capacity_J_per_K"}) {
    INFO(same);
    Fmi2 tire(fmu, fmi2CoSimulation);
    tire.set("thermal.H_gas_W_per_K", 1e6);
    tire.set(same, 1.0);
    tire.initialize();
    const double before_K = tire.get("gas_temperature_K");
    CHECK(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 1.0, fmi2True) == fmi2Error);
    REQUIRE_FALSE(tire.messages.empty());
    const std::string& said = tire.messages.back();
    CHECK_THAT(said, Catch::Contains("steps of the integrator would have to be shorter than 0.0001 s"));
    CHECK_THAT(said, Catch::Contains("thermal.H_gas_W_per_K") || Catch::Contains(same));
    CHECK_THAT(said, Catch::Contains("at most about") || Catch::Contains("at least about"));
    CHECK(tire.get("gas_temperature_K") == before_K);
    CHECK(tire.get("time_s") == 0.0);

    REQUIRE(FMI2(fmu, fmi2Reset)(tire.component) == fmi2OK);
    tire.set("thermal.H_gas_W_per_K", 1e4);
    tire.set(same, 1.0);
    tire.initialize();
    tire.step(0.0, 1.0);
    CHECK(std::isfinite(tire.get("gas_temperature_K")));
  }
}
