// Wrong calls of the FMU: fmi2Error and a message, never a crash.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::LoadedFmu;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A wrong call must give fmi2Error and one message more.
class WrongCalls {
 public:
  explicit WrongCalls(Fmi2& tire) : tire_(tire) {}
  void expect_error(fmi2Status status) {
    CHECK(status == fmi2Error);
    CHECK(tire_.messages.size() == told_ + 1);
    told_ = tire_.messages.size();
  }

 private:
  Fmi2& tire_;
  std::size_t told_ = tire_.messages.size();
};

}  // namespace

TEST_CASE("calls out of order are refused with a message", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation);
  WrongCalls wrong(tire);
  fmi2EventInfo info;
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 1.0, fmi2True));
  wrong.expect_error(FMI2(fmu, fmi2ExitInitializationMode)(tire.component));
  wrong.expect_error(FMI2(fmu, fmi2Terminate)(tire.component));
  // An experiment whose times were refused does not begin at others.
  wrong.expect_error(FMI2(fmu, fmi2SetupExperiment)(tire.component, fmi2False, 0.0, 10.0, fmi2True, 5.0));
  wrong.expect_error(FMI2(fmu, fmi2EnterInitializationMode)(tire.component));
  REQUIRE(FMI2(fmu, fmi2SetupExperiment)(tire.component, fmi2False, 0.0, 0.0, fmi2False, 0.0) == fmi2OK);
  tire.initialize();
  wrong.expect_error(FMI2(fmu, fmi2EnterInitializationMode)(tire.component));
  wrong.expect_error(FMI2(fmu, fmi2SetupExperiment)(tire.component, fmi2False, 0.0, 0.0, fmi2False, 0.0));
  wrong.expect_error(FMI2(fmu, fmi2NewDiscreteStates)(tire.component, &info));  // of model exchange
  wrong.expect_error(FMI2(fmu, fmi2SetTime)(tire.component, 1.0));
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 5.0, 1.0, fmi2True));  // time is 0
  CHECK_THAT(tire.messages.back(), Catch::Contains("fmi2DoStep") && Catch::Contains("0 s"));
  REQUIRE(FMI2(fmu, fmi2Terminate)(tire.component) == fmi2OK);
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 1.0, fmi2True));
  REQUIRE(FMI2(fmu, fmi2Reset)(tire.component) == fmi2OK);
  tire.initialize();
  tire.step(0.0, 1.0);
  CHECK(FMI2(fmu, fmi2DoStep)(nullptr, 0.0, 1.0, fmi2True) == fmi2Error);
}

TEST_CASE("wrong values, variables and types are refused with a message that names them", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation);
  WrongCalls wrong(tire);
  const auto set = [&](const char* name, double value) {
    const unsigned reference = fmu.description().find(name);
    return FMI2(fmu, fmi2SetReal)(tire.component, &reference, 1, &value);
  };
  wrong.expect_error(set("speed_m_s", kNaN));
  CHECK_THAT(tire.messages.back(), Catch::Contains("speed_m_s") && Catch::Contains("nan"));
  wrong.expect_error(set("load_N", -1.0));
  CHECK_THAT(tire.messages.back(), Catch::Contains(">= 0"));
  wrong.expect_error(set("thermal.heat_capacity_J_per_K", 0.0));
  wrong.expect_error(set("liner_temperature_K", 300.0));  // not an input
  wrong.expect_error(FMI2(fmu, fmi2SetReal)(tire.component, nullptr, 1, nullptr));
  const unsigned beyond = 10000;
  double value = 1.0;
  wrong.expect_error(FMI2(fmu, fmi2GetReal)(tire.component, &beyond, 1, &value));
  fmi2Integer whole = 1;
  const unsigned speed = fmu.description().find("speed_m_s");
  wrong.expect_error(FMI2(fmu, fmi2GetInteger)(tire.component, &speed, 1, &whole));
  REQUIRE(set("bounded.cold_limit_degC", 80.0) == fmi2OK);  // wrong beside the other limit alone
  REQUIRE(FMI2(fmu, fmi2EnterInitializationMode)(tire.component) == fmi2OK);
  wrong.expect_error(FMI2(fmu, fmi2ExitInitializationMode)(tire.component));
  CHECK_THAT(tire.messages.back(), Catch::Contains("bounded.hot_limit_degC"));
  REQUIRE(set("bounded.cold_limit_degC", 20.0) == fmi2OK);
  REQUIRE(FMI2(fmu, fmi2ExitInitializationMode)(tire.component) == fmi2OK);
  wrong.expect_error(set("bounded.cold_limit_degC", 10.0));  // too late
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, kNaN, fmi2True));
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 0.0, fmi2True));
  wrong.expect_error(FMI2(fmu, fmi2DoStep)(tire.component, 0.0, 1e300, fmi2True));
  tire.step(0.0, 1.0);
}

TEST_CASE("several values are set all, or none", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation);
  const unsigned references[] = {fmu.description().find("speed_m_s"), fmu.description().find("load_N")};
  const double values[] = {10.0, -1.0};
  CHECK(FMI2(fmu, fmi2SetReal)(tire.component, references, 2, values) == fmi2Error);
  CHECK(tire.get("speed_m_s") == 0.0);
}

TEST_CASE("several slopes are set all, or none", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.initialize();
  tire.set("speed_m_s", 20.0);
  tire.set_slope("speed_m_s", 0.5);
  tire.set_slope("load_N", 10.0);
  const double load_N = tire.get("load_N");
  const unsigned references[] = {fmu.description().find("speed_m_s"), fmu.description().find("load_N"),
                                 fmu.description().find("rolling_resistance_N")};  // the last is no input
  const fmi2Integer orders[] = {1, 1, 1};
  const double slopes[] = {1.0, 100.0, 1.0};
  CHECK(FMI2(fmu, fmi2SetRealInputDerivatives)(tire.component, references, 3, orders, slopes) == fmi2Error);
  CHECK(tire.get("acceleration_m_s2") == 0.5);
  tire.step(0.0, 2.0);
  CHECK(tire.get("speed_m_s") == Approx(21.0));
  CHECK(tire.get("load_N") == Approx(load_N + 20.0));
}

TEST_CASE("a step that is refused changes nothing", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2CoSimulation);
  tire.initialize();
  tire.set("speed_m_s", 20.0);
  tire.step(0.0, 60.0);
  tire.set_slope("load_N", -1e4);  // leads below 0
  const double liner_K = tire.get("liner_temperature_K");
  CHECK(FMI2(fmu, fmi2DoStep)(tire.component, 60.0, 10.0, fmi2True) == fmi2Error);
  CHECK(tire.get("liner_temperature_K") == liner_K);
  CHECK(tire.get("time_s") == 60.0);
  CHECK(tire.get("speed_m_s") == 20.0);
  tire.set_slope("load_N", 0.0);
  tire.step(60.0, 10.0);
}

TEST_CASE("times at which rounding would lose a step are refused, and all others are stepped through", "[fast]") {
  const LoadedFmu fmu("a50");
  for (const double time_s : {1.0001e10, -2e10, 1e11, 1e14, 1e300, HUGE_VAL, kNaN}) {
    INFO(time_s);
    Fmi2 tire(fmu, fmi2CoSimulation);
    WrongCalls wrong(tire);
    wrong.expect_error(FMI2(fmu, fmi2SetupExperiment)(tire.component, fmi2False, 0.0, time_s, fmi2False, 0.0));
    CHECK_THAT(tire.messages.back(), Catch::Contains("time") && Catch::Contains("-1e+10 to 1e+10 s"));
  }
  Fmi2 solver(fmu, fmi2ModelExchange);
  solver.initialize();
  CHECK(FMI2(fmu, fmi2SetTime)(solver.component, 1e14) == fmi2Error);
  for (const double start_s : {-1e10, -7e9, 1e9, 9.9999999e9}) {
    INFO(start_s);
    Fmi2 tire(fmu, fmi2CoSimulation);
    tire.initialize(start_s);
    tire.set("speed_m_s", -0.3);  // the shortest steps of the integrator: through standstill at full acceleration
    tire.set("acceleration_m_s2", 1000.0);
    tire.step(start_s, 1e-3);
    CHECK(tire.get("speed_m_s") == Approx(0.7));
    tire.set("acceleration_m_s2", 0.0);
    tire.set("speed_m_s", 20.0);
    tire.step(tire.get("time_s"), 5.0);
    CHECK(tire.get("liner_temperature_K") > tire.get("ambient_temperature_K"));
  }
  const double of_2023_s = 1.7e9;  // since 1970: no step may be done twice or left out there either
  Fmi2 dated(fmu, fmi2CoSimulation);
  dated.initialize(of_2023_s);
  dated.step(of_2023_s, 0.5);
  CHECK(FMI2(fmu, fmi2DoStep)(dated.component, of_2023_s, 0.5, fmi2True) == fmi2Error);
  CHECK(FMI2(fmu, fmi2DoStep)(dated.component, of_2023_s + 1.0, 0.5, fmi2True) == fmi2Error);
  CHECK(FMI2(fmu, fmi2DoStep)(dated.component, of_2023_s, 10.0, fmi2True) == fmi2Error);  // longer than the last one
  CHECK(FMI2(fmu, fmi2DoStep)(dated.component, of_2023_s + 1.0, 60.0, fmi2True) == fmi2Error);
  for (int i = 1; i < 1000; ++i) dated.step(of_2023_s + 0.5 * i, 0.5);
  Fmi2 counted(fmu, fmi2CoSimulation);
  counted.initialize();
  for (int i = 0; i < 100000; ++i) counted.step(1e-3 * i, 1e-3);  // times that are not sums of steps
  Fmi2 late(fmu, fmi2CoSimulation);
  late.initialize(9.99999999e9);
  CHECK(FMI2(fmu, fmi2DoStep)(late.component, 9.99999999e9, 20.0, fmi2True) == fmi2Error);
  CHECK_THAT(late.messages.back(), Catch::Contains("fmi2DoStep") && Catch::Contains("-1e+10 to 1e+10 s"));
  CHECK(FMI2(fmu, fmi2DoStep)(late.component, 9.99999999e9, 1e-7, fmi2True) == fmi2Error);
  CHECK_THAT(late.messages.back(), Catch::Contains("too short for the time"));
  late.step(9.99999999e9, 5.0);
}

TEST_CASE("an instance is made for the FMU's own description alone", "[fast]") {
  const LoadedFmu fmu("a50");
  const auto make = FMI2(fmu, fmi2Instantiate);
  CHECK(make("tire", fmi2CoSimulation, "{another}", nullptr, nullptr, 0, 0) == nullptr);
  CHECK(make(nullptr, fmi2CoSimulation, fmu.description().token.c_str(), nullptr, nullptr, 0, 0) == nullptr);
  CHECK(make("", fmi2CoSimulation, fmu.description().token.c_str(), nullptr, nullptr, 0, 0) == nullptr);
  CHECK(make("tire", fmi2CoSimulation, nullptr, nullptr, nullptr, 0, 0) == nullptr);
  const fmi2Component tire = make("tire", fmi2CoSimulation, fmu.description().token.c_str(), nullptr, nullptr, 0, 0);
  CHECK(tire != nullptr);  // without callbacks
  FMI2(fmu, fmi2FreeInstance)(tire);
  FMI2(fmu, fmi2FreeInstance)(nullptr);
}

TEST_CASE("a hundred thousand random calls crash nothing and leave a tire that works", "[slow]") {
  const LoadedFmu fmu("a50", "drum_2m", 2, {"slip_loss", "bearing_warmup"});
  for (const fmi2Type type : {fmi2CoSimulation, fmi2ModelExchange}) {
    Fmi2 tire(fmu, type);
    const fmi2Component component = tire.component;
    std::mt19937 random(type == fmi2CoSimulation ? 1 : 2);
    const auto pick = [&random](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    const double numbers[] = {kNaN, HUGE_VAL, -HUGE_VAL, 0.0, -1.0, 1.0, 0.1, 25.0, 300.0, 5000.0, 1e300, 1e-300};
    const auto number = [&] { return numbers[pick(std::size(numbers))]; };
    const std::size_t variables = fmu.description().variables.size();
    fmi2FMUstate states[3] = {};
    std::vector<char> bytes;
    int counts[6] = {};
    std::size_t told = 0;
    for (int call = 0; call < 50000; ++call) {
      unsigned references[4];
      double values[4];
      double results[40] = {};
      fmi2Integer orders[4];
      for (int i = 0; i < 4; ++i) {
        references[i] = static_cast<unsigned>(pick(variables + 3));
        values[i] = number();
        orders[i] = static_cast<fmi2Integer>(pick(3));
      }
      const std::size_t count = pick(5);
      const unsigned* given = pick(20) == 0 ? nullptr : references;
      fmi2FMUstate& state = states[pick(3)];
      fmi2Status status = fmi2OK;
      fmi2EventInfo info;
      fmi2Boolean flags[2];
      double time_s = 0.0;
      FMI2(fmu, fmi2GetRealStatus)(component, fmi2LastSuccessfulTime, &time_s);
      switch (pick(24)) {
        case 0:
          status = FMI2(fmu, fmi2SetupExperiment)(component, fmi2True, number(), number(), fmi2False, number());
          break;
        case 1:
          status = FMI2(fmu, fmi2EnterInitializationMode)(component);
          break;
        case 2:
          status = FMI2(fmu, fmi2ExitInitializationMode)(component);
          break;
        case 3:
          if (pick(10) == 0) status = FMI2(fmu, fmi2Terminate)(component);
          break;
        case 4:
          if (pick(10) == 0) status = FMI2(fmu, fmi2Reset)(component);
          break;
        case 5:
        case 6:
          status = FMI2(fmu, fmi2SetReal)(component, given, count, values);
          break;
        case 7:
          status = FMI2(fmu, fmi2GetReal)(component, given, count, results);
          break;
        case 8:
          status = FMI2(fmu, fmi2GetFMUstate)(component, &state);
          break;
        case 9:
          status = FMI2(fmu, fmi2SetFMUstate)(component, state);
          break;
        case 10:
          status = FMI2(fmu, fmi2FreeFMUstate)(component, &state);
          break;
        case 11: {
          std::size_t size = 0;
          status = FMI2(fmu, fmi2SerializedFMUstateSize)(component, state, &size);
          bytes.resize(size + 1);
          if (status == fmi2OK)
            status = FMI2(fmu, fmi2SerializeFMUstate)(component, state, bytes.data(), pick(2) * size);
          break;
        }
        case 12:
          if (bytes.size() > 1 && pick(2) == 0) bytes[pick(bytes.size())] = static_cast<char>(random());
          status =
              FMI2(fmu, fmi2DeSerializeFMUstate)(component, bytes.data(), bytes.empty() ? 0 : bytes.size() - 1, &state);
          break;
        case 13:
          status =
              FMI2(fmu, fmi2GetDirectionalDerivative)(component, given, count, references, pick(5), values, results);
          break;
        case 14:
          status = FMI2(fmu, fmi2EnterEventMode)(component);
          break;
        case 15:
          status = FMI2(fmu, fmi2NewDiscreteStates)(component, &info);
          break;
        case 16:
          status = FMI2(fmu, fmi2EnterContinuousTimeMode)(component);
          break;
        case 17:
          status = FMI2(fmu, fmi2CompletedIntegratorStep)(component, fmi2True, &flags[0], &flags[1]);
          break;
        case 18:
          status = FMI2(fmu, fmi2SetTime)(component, number());
          break;
        case 19: {
          std::vector<double> continuous(pick(2) == 0 ? 6 : pick(8), 300.0);
          if (!continuous.empty() && pick(2) == 0) continuous[pick(continuous.size())] = number();
          status = FMI2(fmu, fmi2SetContinuousStates)(component, continuous.data(), continuous.size());
          break;
        }
        case 20:
          status = FMI2(fmu, fmi2GetDerivatives)(component, results, pick(8));
          break;
        case 21:
          status = FMI2(fmu, fmi2SetRealInputDerivatives)(component, given, count, orders, values);
          break;
        default:
          status = FMI2(fmu, fmi2DoStep)(component, pick(4) == 0 ? number() : time_s, number(), fmi2True);
      }
      ++counts[status];
      if (status == fmi2Error) REQUIRE(tire.messages.size() > told);
      told = tire.messages.size();
    }
    CHECK(counts[fmi2OK] > 5000);
    CHECK(counts[fmi2Error] > 5000);
    CHECK(counts[fmi2Fatal] == 0);
    for (fmi2FMUstate& state : states) REQUIRE(FMI2(fmu, fmi2FreeFMUstate)(component, &state) == fmi2OK);

    REQUIRE(FMI2(fmu, fmi2Reset)(component) == fmi2OK);
    Fmi2 fresh(fmu, type);
    for (Fmi2* one : {&tire, &fresh}) {
      one->initialize();
      one->set("speed_m_s", 20.0);
    }
    CHECK(tire.get("rolling_resistance_N") == fresh.get("rolling_resistance_N"));
    CHECK(fresh.get("rolling_resistance_N") > 10.0);
  }
}
