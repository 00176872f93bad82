// Version 3.0 of the interface: the same tire, by other functions.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::Fmi3;
using rollrig::tests::LoadedFmu;

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
  expect_error(FMI3(fmu, fmi3EnterInitializationMode)(tire.instance, false, 0.0, 1e14, false, 0.0));
  CHECK_THAT(tire.messages.back(), Catch::Contains("-1e+10 to 1e+10 s"));
  expect_error(FMI3(fmu, fmi3EnterInitializationMode)(tire.instance, false, 0.0, 10.0, true, 5.0));
  CHECK_THAT(tire.messages.back(), Catch::Contains("stop time"));
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
  const auto instantiate_with_events = [&] {  // which the description denies
    const char* token = fmu.description().token.c_str();
    return FMI3(fmu, fmi3InstantiateCoSimulation)("tire", token, nullptr, false, false, true, false, nullptr, 0,
                                                  nullptr, nullptr, nullptr);
  };
  CHECK(instantiate_with_events() == nullptr);
  CHECK(FMI3(fmu, fmi3InstantiateCoSimulation)("tire", "{another}", nullptr, false, false, false, false, nullptr, 0,
                                               nullptr, nullptr, nullptr) == nullptr);
}

TEST_CASE("a hundred thousand random calls of version 3 crash nothing and leave a tire that works", "[slow]") {
  const LoadedFmu fmu("a50", "drum_2m", 3, {"slip_loss", "bearing_warmup"});
  for (const bool is_co_simulation : {true, false}) {
    Fmi3 tire(fmu, is_co_simulation);
    const fmi3Instance instance = tire.instance;
    std::mt19937 random(is_co_simulation ? 3 : 4);
    const auto pick = [&random](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    const double numbers[] = {NAN, HUGE_VAL, -HUGE_VAL, 0.0, -1.0, 1.0, 0.1, 25.0, 300.0, 5000.0, 1e300, 1e-300};
    const auto number = [&] { return numbers[pick(std::size(numbers))]; };
    const std::size_t variables = fmu.description().variables.size();
    const unsigned time = fmu.description().find("time_s");
    fmi3FMUState states[3] = {};
    std::vector<std::uint8_t> bytes;
    int counts[5] = {};
    std::size_t told = 0;
    for (int call = 0; call < 50000; ++call) {
      unsigned references[4];
      double values[4];
      double results[40] = {};
      for (int i = 0; i < 4; ++i) {
        references[i] = static_cast<unsigned>(pick(variables + 3));
        values[i] = number();
      }
      const std::size_t count = pick(5);
      const std::size_t value_count = pick(20) == 0 ? pick(5) : count;
      const unsigned* given = pick(20) == 0 ? nullptr : references;
      fmi3FMUState& state = states[pick(3)];
      fmi3Status status = fmi3OK;
      bool flags[5];
      double last_s = 0.0;
      double time_s = 0.0;
      FMI3(fmu, fmi3GetFloat64)(instance, &time, 1, &time_s, 1);
      switch (pick(24)) {
        case 0:
          status = FMI3(fmu, fmi3EnterInitializationMode)(instance, true, number(), number(), pick(2) == 0, number());
          break;
        case 1:
          status = FMI3(fmu, fmi3EnterInitializationMode)(instance, false, 0.0, 0.0, false, 0.0);
          break;
        case 2:
          status = FMI3(fmu, fmi3ExitInitializationMode)(instance);
          break;
        case 3:
          if (pick(10) == 0) status = FMI3(fmu, fmi3Terminate)(instance);
          break;
        case 4:
          if (pick(10) == 0) status = FMI3(fmu, fmi3Reset)(instance);
          break;
        case 5:
        case 6:
          status = FMI3(fmu, fmi3SetFloat64)(instance, given, count, values, value_count);
          break;
        case 7:
          status = FMI3(fmu, fmi3GetFloat64)(instance, given, count, results, value_count);
          break;
        case 8:
          status = FMI3(fmu, fmi3GetFMUState)(instance, &state);
          break;
        case 9:
          status = FMI3(fmu, fmi3SetFMUState)(instance, state);
          break;
        case 10:
          status = FMI3(fmu, fmi3FreeFMUState)(instance, &state);
          break;
        case 11: {
          std::size_t size = 0;
          status = FMI3(fmu, fmi3SerializedFMUStateSize)(instance, state, &size);
          bytes.resize(size + 1);
          if (status == fmi3OK) {
            status = FMI3(fmu, fmi3SerializeFMUState)(instance, state, bytes.data(), pick(2) * size);
          }
          break;
        }
        case 12:
          if (bytes.size() > 1 && pick(2) == 0) bytes[pick(bytes.size())] = static_cast<std::uint8_t>(random());
          status =
              FMI3(fmu, fmi3DeserializeFMUState)(instance, bytes.data(), bytes.empty() ? 0 : bytes.size() - 1, &state);
          break;
        case 13:
          status = FMI3(fmu, fmi3GetDirectionalDerivative)(instance, given, count, references, 4, values,
                                                           pick(10) == 0 ? 3 : 4, results, value_count);
          break;
        case 14:
          status = FMI3(fmu, fmi3EnterEventMode)(instance);
          break;
        case 15:
          status = FMI3(fmu, fmi3UpdateDiscreteStates)(instance, &flags[0], &flags[1], &flags[2], &flags[3],
                                                       pick(4) == 0 ? nullptr : &flags[4], results);
          break;
        case 16:
          status = FMI3(fmu, fmi3EnterContinuousTimeMode)(instance);
          break;
        case 17:
          status = FMI3(fmu, fmi3CompletedIntegratorStep)(instance, true, &flags[0], &flags[1]);
          break;
        case 18:
          status = FMI3(fmu, fmi3SetTime)(instance, number());
          break;
        case 19: {
          std::vector<double> continuous(pick(2) == 0 ? fmu.description().count_states() : pick(8), 300.0);
          if (!continuous.empty() && pick(2) == 0) continuous[pick(continuous.size())] = number();
          status = FMI3(fmu, fmi3SetContinuousStates)(instance, continuous.data(), continuous.size());
          break;
        }
        case 20:
          status = FMI3(fmu, fmi3GetContinuousStateDerivatives)(instance, results, pick(8));
          break;
        case 21: {
          const char* category = pick(2) == 0 ? "logStatusError" : "none";
          status =
              FMI3(fmu, fmi3SetDebugLogging)(instance, true, pick(3) == 0 ? 0 : 1, pick(10) == 0 ? nullptr : &category);
          break;
        }
        case 22:
          status = FMI3(fmu, fmi3GetInt32)(instance, given, count, nullptr, value_count);
          break;
        default:
          status = FMI3(fmu, fmi3DoStep)(instance, pick(4) == 0 ? number() : time_s, number(), true, &flags[0],
                                         &flags[1], &flags[2], pick(20) == 0 ? nullptr : &last_s);
      }
      ++counts[status];
      if (status == fmi3Error) REQUIRE(tire.messages.size() > told);
      told = tire.messages.size();
    }
    CHECK(counts[fmi3OK] > 5000);
    CHECK(counts[fmi3Error] > 5000);
    CHECK(counts[fmi3OK] + counts[fmi3Error] == 50000);
    for (fmi3FMUState& state : states) REQUIRE(FMI3(fmu, fmi3FreeFMUState)(instance, &state) == fmi3OK);

    REQUIRE(FMI3(fmu, fmi3Reset)(instance) == fmi3OK);
    Fmi3 fresh(fmu, is_co_simulation);
    for (Fmi3* one : {&tire, &fresh}) {
      one->initialize();
      one->set("speed_m_s", 20.0);
    }
    CHECK(tire.get("rolling_resistance_N") == fresh.get("rolling_resistance_N"));
    CHECK(fresh.get("rolling_resistance_N") > 10.0);
  }
}
