// Version 3.0 of the interface: the same tire, by other functions.
#include "fmu/fmi3.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::LoadedFmu;

#define FMI3(fmu, function) (fmu).find<decltype(function)>(#function)

namespace {

void log_fmi3_message(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
  static_cast<std::vector<std::string>*>(environment)->emplace_back(message);
}

/// An instance of version 3, with the messages that it gave.
struct Fmi3 {
  Fmi3(const LoadedFmu& from, bool is_co_simulation) : fmu(from) {
    const char* token = fmu.description().token.c_str();
    instance = is_co_simulation
                   ? FMI3(fmu, fmi3InstantiateCoSimulation)("tire", token, nullptr, false, false, false, false, nullptr,
                                                            0, &messages, &log_fmi3_message, nullptr)
                   : FMI3(fmu, fmi3InstantiateModelExchange)("tire", token, nullptr, false, false, &messages,
                                                             &log_fmi3_message);
    REQUIRE(instance != nullptr);
  }
  ~Fmi3() { FMI3(fmu, fmi3FreeInstance)(instance); }
  Fmi3(const Fmi3&) = delete;
  Fmi3& operator=(const Fmi3&) = delete;

  void initialize() {
    REQUIRE(FMI3(fmu, fmi3EnterInitializationMode)(instance, false, 0.0, 0.0, false, 0.0) == fmi3OK);
    REQUIRE(FMI3(fmu, fmi3ExitInitializationMode)(instance) == fmi3OK);
  }
  void set(const std::string& name, double value) {
    const unsigned reference = fmu.description().find(name);
    REQUIRE(FMI3(fmu, fmi3SetFloat64)(instance, &reference, 1, &value, 1) == fmi3OK);
  }
  double get(const std::string& name) {
    const unsigned reference = fmu.description().find(name);
    double value = 0.0;
    REQUIRE(FMI3(fmu, fmi3GetFloat64)(instance, &reference, 1, &value, 1) == fmi3OK);
    return value;
  }
  fmi3Status step(double time_s, double step_s) {
    bool flags[3] = {true, true, true};
    double last_s = -1.0;
    const fmi3Status status =
        FMI3(fmu, fmi3DoStep)(instance, time_s, step_s, true, &flags[0], &flags[1], &flags[2], &last_s);
    if (status == fmi3OK) {
      CHECK_FALSE((flags[0] || flags[1] || flags[2]));
      CHECK(last_s == Approx(time_s + step_s));
    }
    return status;
  }

  const LoadedFmu& fmu;
  std::vector<std::string> messages;
  fmi3Instance instance = nullptr;
};

}  // namespace

TEST_CASE("version 3 is the same tire as version 2", "[fast]") {
  const LoadedFmu fmu2("a50", "drum_2m", 2);
  const LoadedFmu fmu3("a50", "drum_2m", 3);
  CHECK(FMI3(fmu3, fmi3GetVersion)() == std::string("3.0"));
  Fmi2 second(fmu2, fmi2CoSimulation);
  Fmi3 third(fmu3, true);
  second.initialize();
  third.initialize();
  for (int i = 0; i < 100; ++i) {
    const double speed_m_s = 20.0 + 10.0 * std::sin(0.1 * i);
    second.set("speed_m_s", speed_m_s);
    third.set("speed_m_s", speed_m_s);
    second.step(i, 1.0);
    REQUIRE(third.step(i, 1.0) == fmi3OK);
  }
  for (const auto& [name, variable] : fmu2.description().variables) {
    INFO(name);
    CHECK(third.get(name) == second.get(name));
    CHECK(fmu3.description().variables.at(name).unit == variable.unit);
  }
}

TEST_CASE("version 3 keeps states and gives rates and derivatives", "[fast]") {
  const LoadedFmu fmu("a50", "road", 3);
  Fmi3 tire(fmu, false);
  tire.initialize();
  REQUIRE(FMI3(fmu, fmi3EnterContinuousTimeMode)(tire.instance) == fmi3OK);
  tire.set("speed_m_s", 25.0);
  std::size_t count = 0;
  REQUIRE(FMI3(fmu, fmi3GetNumberOfContinuousStates)(tire.instance, &count) == fmi3OK);
  std::vector<double> states(count);
  std::vector<double> rates(count);
  REQUIRE(FMI3(fmu, fmi3GetContinuousStates)(tire.instance, states.data(), count) == fmi3OK);
  fmi3FMUState kept = nullptr;
  REQUIRE(FMI3(fmu, fmi3GetFMUState)(tire.instance, &kept) == fmi3OK);
  states.front() += 10.0;
  REQUIRE(FMI3(fmu, fmi3SetContinuousStates)(tire.instance, states.data(), count) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3GetContinuousStateDerivatives)(tire.instance, rates.data(), count) == fmi3OK);
  CHECK(rates.back() == Approx(25.0 * tire.get("rolling_resistance_N")));
  const unsigned known = fmu.description().find("liner_temperature_K");
  const unsigned unknown = fmu.description().find("rolling_resistance_N");
  const double one = 1.0;
  double derivative = 0.0;
  REQUIRE(FMI3(fmu, fmi3GetDirectionalDerivative)(tire.instance, &unknown, 1, &known, 1, &one, 1, &derivative, 1) ==
          fmi3OK);
  CHECK(derivative < 0.0);  // a warmer tire loses less
  std::size_t size = 0;
  REQUIRE(FMI3(fmu, fmi3SerializedFMUStateSize)(tire.instance, kept, &size) == fmi3OK);
  std::vector<std::uint8_t> bytes(size);
  REQUIRE(FMI3(fmu, fmi3SerializeFMUState)(tire.instance, kept, bytes.data(), size) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3FreeFMUState)(tire.instance, &kept) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3DeserializeFMUState)(tire.instance, bytes.data(), size, &kept) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3SetFMUState)(tire.instance, kept) == fmi3OK);
  REQUIRE(FMI3(fmu, fmi3FreeFMUState)(tire.instance, &kept) == fmi3OK);
  CHECK(tire.get("liner_temperature_K") == Approx(states.front() - 10.0));
}

TEST_CASE("version 3 refuses wrong calls with a message", "[fast]") {
  const LoadedFmu fmu("a50", "road", 3);
  Fmi3 tire(fmu, true);
  auto expect_error = [&, told = std::size_t{0}](fmi3Status status) mutable {
    CHECK(status == fmi3Error);
    CHECK(tire.messages.size() == ++told);
  };
  const unsigned speed = fmu.description().find("speed_m_s");
  const double values[] = {NAN, 1.0};
  bool flag = false;
  expect_error(tire.step(0.0, 1.0));
  expect_error(FMI3(fmu, fmi3SetFloat64)(tire.instance, &speed, 1, values, 1));
  CHECK_THAT(tire.messages.back(), Catch::Contains("fmi3SetFloat64") && Catch::Contains("speed_m_s"));
  expect_error(FMI3(fmu, fmi3SetFloat64)(tire.instance, &speed, 1, values, 2));
  expect_error(FMI3(fmu, fmi3GetBoolean)(tire.instance, &speed, 1, &flag, 1));
  expect_error(FMI3(fmu, fmi3EnterConfigurationMode)(tire.instance));
  tire.initialize();
  expect_error(tire.step(1.0, 1.0));
  CHECK(tire.step(0.0, 1.0) == fmi3OK);
  CHECK(FMI3(fmu, fmi3DoStep)(nullptr, 0.0, 1.0, true, &flag, &flag, &flag, nullptr) == fmi3Error);
  CHECK(FMI3(fmu, fmi3InstantiateCoSimulation)("tire", "{another}", nullptr, false, false, false, false, nullptr, 0,
                                               nullptr, nullptr, nullptr) == nullptr);
}
