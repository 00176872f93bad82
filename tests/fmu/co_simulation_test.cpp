// The FMU in co-simulation against `rollrig run`; many at once; states that are kept.
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <thread>

#include "rollrig/run.h"
#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::LoadedFmu;

namespace {

constexpr double kZero_K = 273.15;
const std::vector<std::string> kSettings{"cycle=udds", "wheels=1"};

/// One wheel of a car on a dynamometer through the city cycle.
struct CityRun {
  explicit CityRun(const std::string& tire, const std::string& rig) {
    const rollrig::RunResult result =
        rollrig::Run({"drive_cycle", tire, rig, "source_car", "quasi_static", "", "", "", kSettings}).carry_out();
    recording = result.make_recording();
    for (const rollrig::ResultValue& value : result.records.front().records.front()) {
      if (value.name == "rr_energy_Wh") lost_J = 3600.0 * value.number.value();
    }
    REQUIRE(lost_J > 0.0);
  }
  const std::vector<double>& channel(const std::string& name) const {
    for (const rollrig::Channel& channel : recording.channels) {
      if (channel.name == name) return channel.values;
    }
    FAIL("no channel " << name);
    return recording.time_s;
  }

  rollrig::Recording recording;
  double lost_J = 0.0;
};

/// Puts an instance where the run begins.
void begin(Fmi2& tire, const CityRun& run) {
  tire.set("start.cold_pressure_kPa", run.channel("cavity_pressure_kPa").front());
  tire.set("start.tire_temperature_degC", run.channel("ambient_degC").front());
  tire.set("load_N", run.channel("load_N").front());
  for (const char* input : {"ambient_temperature_K", "surface_temperature_K"}) {
    tire.set(input, run.channel("ambient_degC").front() + kZero_K);
  }
  tire.initialize();
}

/// Steps of a second, through which the speed goes straight, to row `row`.
void step_to(Fmi2& tire, const CityRun& run, std::size_t row) {
  const std::vector<double>& speed_km_h = run.channel("speed_km_h");
  tire.set("speed_m_s", speed_km_h[row - 1] / 3.6);
  tire.set_slope("speed_m_s", (speed_km_h[row] - speed_km_h[row - 1]) / 3.6);
  tire.step(static_cast<double>(row - 1), 1.0);
}

}  // namespace

TEST_CASE("an FMU follows rollrig run through the city cycle to a millionth", "[fast]") {
  // a50's tread is recorded at instants; all else in the recording is a mean. On the road as on rollers.
  for (const char* rig : {"dyno_1m2", "road"}) {
    INFO(rig);
    const CityRun run("a50", rig);
    const LoadedFmu fmu("a50", rig);
    Fmi2 tire(fmu, fmi2CoSimulation);
    begin(tire, run);
    const std::vector<double>& tread_degC = run.channel("tread_temperature_degC");
    double largest_K = 0.0;
    for (std::size_t row = 1; row < tread_degC.size(); ++row) {
      step_to(tire, run, row);
      largest_K = std::max(largest_K, std::abs(tire.get("tread_temperature_K") - kZero_K - tread_degC[row]));
    }
    CHECK(tread_degC.back() > tread_degC.front() + 2.0);
    CHECK(largest_K < 1e-6 * (tread_degC.back() - tread_degC.front()));
    CHECK(tire.get("tire_loss_J") == Approx(run.lost_J).epsilon(1e-6));
  }
}

TEST_CASE("at equal grids, an FMU gives the temperatures of rollrig run to rounding", "[fast]") {
  const CityRun run("a50", "dyno_1m2");
  const LoadedFmu fmu("a50", "dyno_1m2");
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.set("steps.longest_s", 5.0);  // a run's at constant speed; on ramps, rows are a second apart
  begin(tire, run);
  const std::vector<double>& speed_km_h = run.channel("speed_km_h");
  for (std::size_t row = 0; row + 1 < speed_km_h.size();) {
    std::size_t end = row + 1;  // a stretch at constant speed is one segment of the run
    while (end + 1 < speed_km_h.size() && speed_km_h[row] == speed_km_h[end] &&
           speed_km_h[end] == speed_km_h[end + 1]) {
      ++end;
    }
    const double length_s = static_cast<double>(end - row);
    tire.set("speed_m_s", speed_km_h[row] / 3.6);
    tire.set_slope("speed_m_s", (speed_km_h[end] - speed_km_h[row]) / 3.6 / length_s);
    tire.step(static_cast<double>(row), length_s);
    row = end;
  }
  const double tread_degC = tire.get("tread_temperature_K") - kZero_K;
  CHECK(tread_degC == Approx(run.channel("tread_temperature_degC").back()).epsilon(1e-9));
  CHECK(tire.get("tire_loss_J") == Approx(run.lost_J).epsilon(1e-9));
}

TEST_CASE("a hundred instances in threads of their own give what one gives alone", "[fast]") {
  const LoadedFmu fmu("a50", "dyno_1m2");
  const unsigned speed = fmu.description().find("speed_m_s");
  const unsigned wanted[] = {fmu.description().find("tread_temperature_K"), fmu.description().find("tire_loss_J")};
  // Found before the threads, in which Catch may not be used.
  const auto set_real = FMI2(fmu, fmi2SetReal);
  const auto get_real = FMI2(fmu, fmi2GetReal);
  const auto do_step = FMI2(fmu, fmi2DoStep);
  const auto drive = [&](fmi2Component tire) {
    std::vector<double> values(2);
    bool is_good = true;
    for (int i = 0; i < 200; ++i) {
      const double speed_m_s = 15.0 + 10.0 * std::sin(0.1 * i);
      is_good = is_good && set_real(tire, &speed, 1, &speed_m_s) == fmi2OK;
      is_good = is_good && do_step(tire, i, 1.0, fmi2True) == fmi2OK;
    }
    is_good = is_good && get_real(tire, wanted, 2, values.data()) == fmi2OK;
    return is_good ? values : std::vector<double>();
  };
  Fmi2 alone(fmu, fmi2CoSimulation);
  alone.initialize();
  const std::vector<double> expected = drive(alone.component);
  REQUIRE(expected.size() == 2);
  std::vector<std::unique_ptr<Fmi2>> tires;
  for (int i = 0; i < 100; ++i) {
    tires.push_back(std::make_unique<Fmi2>(fmu, fmi2CoSimulation, "tire " + std::to_string(i)));
    tires.back()->initialize();
  }
  std::vector<std::vector<double>> found(tires.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < tires.size(); ++i) {
    threads.emplace_back([&, i] { found[i] = drive(tires[i]->component); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<double>& values : found) CHECK(values == expected);
}

TEST_CASE("an FMU goes on from a state that was kept, in memory or as bytes", "[fast]") {
  const LoadedFmu fmu("a50", "road");
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.set("thermal.gas_heat_capacity_J_per_K", 70.0);
  tire.initialize();
  tire.set("speed_m_s", 25.0);
  tire.step(0.0, 100.0);
  fmi2FMUstate state = nullptr;
  REQUIRE(FMI2(fmu, fmi2GetFMUstate)(tire.component, &state) == fmi2OK);
  std::size_t size = 0;
  REQUIRE(FMI2(fmu, fmi2SerializedFMUstateSize)(tire.component, state, &size) == fmi2OK);
  std::vector<char> bytes(size);
  REQUIRE(FMI2(fmu, fmi2SerializeFMUstate)(tire.component, state, bytes.data(), size) == fmi2OK);
  tire.step(100.0, 50.0);
  const double expected_K = tire.get("liner_temperature_K");
  tire.set("speed_m_s", 0.0);

  REQUIRE(FMI2(fmu, fmi2SetFMUstate)(tire.component, state) == fmi2OK);
  tire.step(100.0, 50.0);
  CHECK(tire.get("liner_temperature_K") == expected_K);
  CHECK(FMI2(fmu, fmi2FreeFMUstate)(tire.component, &state) == fmi2OK);
  CHECK(state == nullptr);

  Fmi2 other(fmu, fmi2CoSimulation, "another, with other parameters");
  REQUIRE(FMI2(fmu, fmi2DeSerializeFMUstate)(other.component, bytes.data(), size, &state) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2SetFMUstate)(other.component, state) == fmi2OK);
  CHECK(other.get("thermal.gas_heat_capacity_J_per_K") == 70.0);
  other.step(100.0, 50.0);
  CHECK(other.get("liner_temperature_K") == expected_K);

  // It knows the stop time as well.
  Fmi2 short_run(fmu, fmi2CoSimulation, "until 30 s");
  REQUIRE(FMI2(fmu, fmi2SetupExperiment)(short_run.component, 0, 0.0, 10.0, 1, 30.0) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2GetFMUstate)(short_run.component, &state) == fmi2OK);
  std::vector<char> experiment(size);
  std::size_t experiment_size = 0;
  REQUIRE(FMI2(fmu, fmi2SerializedFMUstateSize)(short_run.component, state, &experiment_size) == fmi2OK);
  REQUIRE(experiment_size <= size);
  REQUIRE(FMI2(fmu, fmi2SerializeFMUstate)(short_run.component, state, experiment.data(), experiment_size) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2DeSerializeFMUstate)(other.component, experiment.data(), experiment_size, &state) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2SetFMUstate)(other.component, state) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2EnterInitializationMode)(other.component) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2ExitInitializationMode)(other.component) == fmi2OK);
  CHECK(other.get("time_s") == 10.0);
  other.step(10.0, 20.0);
  CHECK(FMI2(fmu, fmi2DoStep)(other.component, 30.0, 1.0, fmi2True) == fmi2Error);

  bytes[size / 2] = static_cast<char>(bytes[size / 2] + 1);
  CHECK(FMI2(fmu, fmi2DeSerializeFMUstate)(other.component, bytes.data(), size, &state) == fmi2Error);
  CHECK(FMI2(fmu, fmi2DeSerializeFMUstate)(other.component, bytes.data(), size - 8, &state) == fmi2Error);
  CHECK(FMI2(fmu, fmi2FreeFMUstate)(other.component, &state) == fmi2OK);
}
