// Which call is allowed when: the tables of FMI 2.0.5 (sections 3.2.3 and 4.2.4), and the lists of FMI 3.0.2 (sections
// 2.3, 3.2 and 4.2).
#include <array>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>

#include "tests/fmu/importer.h"

using rollrig::tests::Fmi2;
using rollrig::tests::Fmi3;
using rollrig::tests::LoadedFmu;

namespace {

/// A row of the table: one letter a stage, in the order of kStages and kCoStages. "x": the standard allows the call;
/// ".": it does not; "o": it does not, and the FMU allows it all the same, since an importer may try, and no harm is
/// done.
template <class Call>
struct Row {
  const char* function;
  const char* model_exchange;
  const char* co_simulation;
  Call call;
};

enum class Stage { kInstantiated, kInitialization, kEvents, kContinuous, kTerminated, kStepping };
constexpr std::array kStages{Stage::kInstantiated, Stage::kInitialization, Stage::kEvents, Stage::kContinuous,
                             Stage::kTerminated};
constexpr std::array kCoStages{Stage::kInstantiated, Stage::kInitialization, Stage::kStepping, Stage::kTerminated};

void enter(Fmi2& tire, Stage stage) {
  const LoadedFmu& fmu = tire.fmu;
  if (stage == Stage::kInstantiated) return;
  REQUIRE(FMI2(fmu, fmi2EnterInitializationMode)(tire.component) == fmi2OK);
  if (stage == Stage::kInitialization) return;
  REQUIRE(FMI2(fmu, fmi2ExitInitializationMode)(tire.component) == fmi2OK);
  if (stage == Stage::kContinuous) REQUIRE(FMI2(fmu, fmi2EnterContinuousTimeMode)(tire.component) == fmi2OK);
  if (stage == Stage::kTerminated) REQUIRE(FMI2(fmu, fmi2Terminate)(tire.component) == fmi2OK);
}

void enter(Fmi3& tire, Stage stage) {
  const LoadedFmu& fmu = tire.fmu;
  if (stage == Stage::kInstantiated) return;
  REQUIRE(FMI3(fmu, fmi3EnterInitializationMode)(tire.instance, false, 0.0, 0.0, false, 0.0) == fmi3OK);
  if (stage == Stage::kInitialization) return;
  REQUIRE(FMI3(fmu, fmi3ExitInitializationMode)(tire.instance) == fmi3OK);
  if (stage == Stage::kContinuous) REQUIRE(FMI3(fmu, fmi3EnterContinuousTimeMode)(tire.instance) == fmi3OK);
  if (stage == Stage::kTerminated) REQUIRE(FMI3(fmu, fmi3Terminate)(tire.instance) == fmi3OK);
}

/// Makes each call in each stage of an instance that make(is_co_simulation) gives. A call that is refused says why.
template <class Rows, class Make>
void check_calls(const Rows& rows, Make&& make) {
  for (const auto& row : rows) {
    for (const bool is_co_simulation : {false, true}) {
      const std::string letters = is_co_simulation ? row.co_simulation : row.model_exchange;
      REQUIRE(letters.size() == (is_co_simulation ? kCoStages.size() : kStages.size()));
      for (std::size_t i = 0; i < letters.size(); ++i) {
        INFO(row.function << (is_co_simulation ? ", co-simulation" : ", model exchange") << ", stage " << i);
        const auto tire = make(is_co_simulation);
        enter(*tire, is_co_simulation ? kCoStages.at(i) : kStages.at(i));
        const int status = row.call(*tire);
        CHECK((letters[i] == '.') == (status == fmi2Error));
        CHECK(tire->messages.size() == (status == fmi2OK ? 0 : 1));
      }
    }
  }
}

/// A state of the instance itself.
struct Kept2 {
  explicit Kept2(Fmi2& from) : tire(from) {
    REQUIRE(FMI2(tire.fmu, fmi2GetFMUstate)(tire.component, &state) == fmi2OK);
  }
  ~Kept2() { FMI2(tire.fmu, fmi2FreeFMUstate)(tire.component, &state); }
  Fmi2& tire;
  fmi2FMUstate state = nullptr;
};

struct Kept3 {
  explicit Kept3(Fmi3& from) : tire(from) { REQUIRE(FMI3(tire.fmu, fmi3GetFMUState)(tire.instance, &state) == fmi3OK); }
  ~Kept3() { FMI3(tire.fmu, fmi3FreeFMUState)(tire.instance, &state); }
  Fmi3& tire;
  fmi3FMUState state = nullptr;
};

constexpr std::size_t kMostStates = 16;  // of the wheels here

#define CALL2(function, ...) FMI2(tire.fmu, function)(tire.component __VA_OPT__(, ) __VA_ARGS__)
#define CALL3(function, ...) FMI3(tire.fmu, function)(tire.instance __VA_OPT__(, ) __VA_ARGS__)

}  // namespace

TEST_CASE("calls of version 2 are allowed in the stages of the standard", "[fast]") {
  const LoadedFmu fmu("a50");
  const std::size_t count = fmu.description().count_states();
  const unsigned speed = fmu.description().find("speed_m_s");
  const unsigned loss = fmu.description().find("rolling_resistance_N");
  std::array<double, kMostStates> numbers{};
  const std::vector<double> warm(count, 300.0);
  fmi2EventInfo info;
  fmi2Boolean flags[2];
  const double one = 1.0;
  const fmi2Integer first_order = 1;
  std::size_t size = 0;
  using Call = std::function<fmi2Status(Fmi2&)>;
  const std::vector<Row<Call>> rows{
      {"fmi2SetDebugLogging", "xxxxx", "xxxx", [&](Fmi2& tire) { return CALL2(fmi2SetDebugLogging, 1, 0, nullptr); }},
      {"fmi2SetupExperiment", "x....", "x...",
       [&](Fmi2& tire) { return CALL2(fmi2SetupExperiment, 0, 0.0, 0.0, 0, 0.0); }},
      {"fmi2EnterInitializationMode", "x....", "x...", [&](Fmi2& tire) { return CALL2(fmi2EnterInitializationMode); }},
      {"fmi2ExitInitializationMode", ".x...", ".x..", [&](Fmi2& tire) { return CALL2(fmi2ExitInitializationMode); }},
      {"fmi2Terminate", "..xx.", "..x.", [&](Fmi2& tire) { return CALL2(fmi2Terminate); }},
      {"fmi2Reset", "xxxxx", "xxxx", [&](Fmi2& tire) { return CALL2(fmi2Reset); }},
      {"fmi2GetReal of an input", "oxxxx", "oxxx",  // start values, as in version 3
       [&](Fmi2& tire) { return CALL2(fmi2GetReal, &speed, 1, numbers.data()); }},
      {"fmi2GetReal of an output", ".xxxx", ".xxx",
       [&](Fmi2& tire) { return CALL2(fmi2GetReal, &loss, 1, numbers.data()); }},
      {"fmi2GetInteger of none", "oxxxx", "oxxx",
       [&](Fmi2& tire) { return CALL2(fmi2GetInteger, nullptr, 0, nullptr); }},
      {"fmi2GetBoolean of none", "oxxxx", "oxxx",
       [&](Fmi2& tire) { return CALL2(fmi2GetBoolean, nullptr, 0, nullptr); }},
      {"fmi2GetString of none", "oxxxx", "oxxx", [&](Fmi2& tire) { return CALL2(fmi2GetString, nullptr, 0, nullptr); }},
      {"fmi2SetReal of an input", "xxxx.", "xxx.", [&](Fmi2& tire) { return CALL2(fmi2SetReal, &speed, 1, &one); }},
      {"fmi2SetReal of a parameter", "xx...", "xx..",
       [&](Fmi2& tire) {
         const unsigned reference = fmu.description().find("steps.longest_s");
         return CALL2(fmi2SetReal, &reference, 1, &one);
       }},
      {"fmi2SetReal of a state", "...x.", "....",
       [&](Fmi2& tire) {
         const unsigned reference = fmu.description().find("liner_temperature_K");
         const double warm_K = 320.0;
         return CALL2(fmi2SetReal, &reference, 1, &warm_K);
       }},
      {"fmi2SetInteger of none", "xxx..", "xxx.",
       [&](Fmi2& tire) { return CALL2(fmi2SetInteger, nullptr, 0, nullptr); }},
      {"fmi2SetBoolean of none", "xxx..", "xxx.",
       [&](Fmi2& tire) { return CALL2(fmi2SetBoolean, nullptr, 0, nullptr); }},
      {"fmi2SetString of none", "xxx..", "xxx.", [&](Fmi2& tire) { return CALL2(fmi2SetString, nullptr, 0, nullptr); }},
      {"fmi2GetFMUstate and fmi2FreeFMUstate", "xxxxx", "xxxx",
       [&](Fmi2& tire) {
         const Kept2 kept(tire);
         return fmi2OK;
       }},
      {"fmi2SetFMUstate", "xxxxx", "xxxx",
       [&](Fmi2& tire) {
         const Kept2 kept(tire);
         return CALL2(fmi2SetFMUstate, kept.state);
       }},
      {"fmi2SerializedFMUstateSize", "xxxxx", "xxxx",
       [&](Fmi2& tire) {
         const Kept2 kept(tire);
         return CALL2(fmi2SerializedFMUstateSize, kept.state, &size);
       }},
      {"fmi2SerializeFMUstate and fmi2DeSerializeFMUstate", "xxxxx", "xxxx",
       [&](Fmi2& tire) {
         Kept2 kept(tire);
         REQUIRE(CALL2(fmi2SerializedFMUstateSize, kept.state, &size) == fmi2OK);
         std::vector<char> bytes(size);
         REQUIRE(CALL2(fmi2SerializeFMUstate, kept.state, bytes.data(), size) == fmi2OK);
         return CALL2(fmi2DeSerializeFMUstate, bytes.data(), size, &kept.state);
       }},
      {"fmi2GetDirectionalDerivative", ".xxxx", ".xxx",
       [&](Fmi2& tire) { return CALL2(fmi2GetDirectionalDerivative, &loss, 1, &speed, 1, &one, numbers.data()); }},
      {"fmi2EnterEventMode", "..xx.", "....", [&](Fmi2& tire) { return CALL2(fmi2EnterEventMode); }},
      {"fmi2NewDiscreteStates", "..x..", "....", [&](Fmi2& tire) { return CALL2(fmi2NewDiscreteStates, &info); }},
      {"fmi2EnterContinuousTimeMode", "..x..", "....", [&](Fmi2& tire) { return CALL2(fmi2EnterContinuousTimeMode); }},
      {"fmi2CompletedIntegratorStep", "...x.", "....",
       [&](Fmi2& tire) { return CALL2(fmi2CompletedIntegratorStep, 1, &flags[0], &flags[1]); }},
      {"fmi2SetTime", "..ox.", "....",  // in event mode until FMI 2.0.1, since then of models without states
       [&](Fmi2& tire) { return CALL2(fmi2SetTime, 1.0); }},
      {"fmi2SetContinuousStates", "...x.", "....",
       [&](Fmi2& tire) { return CALL2(fmi2SetContinuousStates, warm.data(), count); }},
      {"fmi2GetDerivatives", ".xxxx", "....",
       [&](Fmi2& tire) { return CALL2(fmi2GetDerivatives, numbers.data(), count); }},
      {"fmi2GetEventIndicators", ".xxxx", "....",
       [&](Fmi2& tire) { return CALL2(fmi2GetEventIndicators, nullptr, 0); }},
      {"fmi2GetContinuousStates", ".xxxx", "....",
       [&](Fmi2& tire) { return CALL2(fmi2GetContinuousStates, numbers.data(), count); }},
      {"fmi2GetNominalsOfContinuousStates", "xxxxx", "....",
       [&](Fmi2& tire) { return CALL2(fmi2GetNominalsOfContinuousStates, numbers.data(), count); }},
      {"fmi2SetRealInputDerivatives", ".....", "xxx.",
       [&](Fmi2& tire) { return CALL2(fmi2SetRealInputDerivatives, &speed, 1, &first_order, &one); }},
      {"fmi2GetRealOutputDerivatives of none", ".....", "..xx",
       [&](Fmi2& tire) { return CALL2(fmi2GetRealOutputDerivatives, nullptr, 0, nullptr, nullptr); }},
      {"fmi2DoStep", ".....", "..x.", [&](Fmi2& tire) { return CALL2(fmi2DoStep, 0.0, 1.0, 1); }},
      {"fmi2CancelStep", ".....", "....", [&](Fmi2& tire) { return CALL2(fmi2CancelStep); }},
      {"fmi2GetStatus", ".....", "..xx",
       [&](Fmi2& tire) {
         fmi2Status value = fmi2OK;
         return CALL2(fmi2GetStatus, fmi2DoStepStatus, &value);
       }},
      {"fmi2GetRealStatus", ".....", "..xx",
       [&](Fmi2& tire) { return CALL2(fmi2GetRealStatus, fmi2LastSuccessfulTime, numbers.data()); }},
      {"fmi2GetIntegerStatus", ".....", "..xx",
       [&](Fmi2& tire) {
         fmi2Integer value = 0;
         return CALL2(fmi2GetIntegerStatus, fmi2DoStepStatus, &value);
       }},
      {"fmi2GetBooleanStatus", ".....", "..xx",
       [&](Fmi2& tire) { return CALL2(fmi2GetBooleanStatus, fmi2Terminated, &flags[0]); }},
      {"fmi2GetStringStatus", ".....", "..xx", [&](Fmi2& tire) {
         fmi2String value = nullptr;
         return CALL2(fmi2GetStringStatus, fmi2PendingStatus, &value);
       }}};
  check_calls(rows, [&](bool is_co_simulation) {
    return std::make_unique<Fmi2>(fmu, is_co_simulation ? fmi2CoSimulation : fmi2ModelExchange);
  });
}

TEST_CASE("calls of version 3 are allowed in the stages of the standard", "[fast]") {
  const LoadedFmu fmu("a50", "road", 3);
  const std::size_t count = fmu.description().count_states();
  const unsigned speed = fmu.description().find("speed_m_s");
  const unsigned loss = fmu.description().find("rolling_resistance_N");
  std::array<double, kMostStates> numbers{};
  const std::vector<double> warm(count, 300.0);
  bool flags[5];
  const double one = 1.0;
  std::size_t size = 0;
  using Call = std::function<fmi3Status(Fmi3&)>;
  const std::vector<Row<Call>> rows{
      {"fmi3SetDebugLogging", "xxxxx", "xxxx",
       [&](Fmi3& tire) { return CALL3(fmi3SetDebugLogging, true, 0, nullptr); }},
      {"fmi3EnterInitializationMode", "x....", "x...",
       [&](Fmi3& tire) { return CALL3(fmi3EnterInitializationMode, false, 0.0, 0.0, false, 0.0); }},
      {"fmi3ExitInitializationMode", ".x...", ".x..", [&](Fmi3& tire) { return CALL3(fmi3ExitInitializationMode); }},
      {"fmi3EnterEventMode", "...x.", "....", [&](Fmi3& tire) { return CALL3(fmi3EnterEventMode); }},
      {"fmi3Terminate", "..xx.", "..x.", [&](Fmi3& tire) { return CALL3(fmi3Terminate); }},
      {"fmi3Reset", "xxxxx", "xxxx", [&](Fmi3& tire) { return CALL3(fmi3Reset); }},
      {"fmi3GetFloat64 of an input", "xxxxx", "xxxx",
       [&](Fmi3& tire) { return CALL3(fmi3GetFloat64, &speed, 1, numbers.data(), 1); }},
      {"fmi3GetFloat64 of an output", ".xxxx", ".xxx",  // it has no start value
       [&](Fmi3& tire) { return CALL3(fmi3GetFloat64, &loss, 1, numbers.data(), 1); }},
      {"fmi3GetInt32 of none", "xxxxx", "xxxx",
       [&](Fmi3& tire) { return CALL3(fmi3GetInt32, nullptr, 0, nullptr, 0); }},
      {"fmi3GetBinary of none", "xxxxx", "xxxx",
       [&](Fmi3& tire) { return CALL3(fmi3GetBinary, nullptr, 0, nullptr, nullptr, 0); }},
      {"fmi3SetFloat64 of an input", "xxxx.", "xxx.",
       [&](Fmi3& tire) { return CALL3(fmi3SetFloat64, &speed, 1, &one, 1); }},
      {"fmi3SetFloat64 of a parameter", "xx...", "xx..",
       [&](Fmi3& tire) {
         const unsigned reference = fmu.description().find("steps.longest_s");
         return CALL3(fmi3SetFloat64, &reference, 1, &one, 1);
       }},
      {"fmi3SetFloat64 of a state", "..xx.", "....",
       [&](Fmi3& tire) {
         const unsigned reference = fmu.description().find("liner_temperature_K");
         const double warm_K = 320.0;
         return CALL3(fmi3SetFloat64, &reference, 1, &warm_K, 1);
       }},
      {"fmi3SetFloat32 of none", "xxxx.", "xxx.",
       [&](Fmi3& tire) { return CALL3(fmi3SetFloat32, nullptr, 0, nullptr, 0); }},
      {"fmi3SetInt32 of none", "xxxo.", "xxx.",
       [&](Fmi3& tire) { return CALL3(fmi3SetInt32, nullptr, 0, nullptr, 0); }},
      {"fmi3GetFMUState and fmi3FreeFMUState", "xxxxx", "xxxx",
       [&](Fmi3& tire) {
         const Kept3 kept(tire);
         return fmi3OK;
       }},
      {"fmi3SetFMUState", "xxxxx", "xxxx",
       [&](Fmi3& tire) {
         const Kept3 kept(tire);
         return CALL3(fmi3SetFMUState, kept.state);
       }},
      {"fmi3SerializeFMUState and fmi3DeserializeFMUState", "xxxxx", "xxxx",
       [&](Fmi3& tire) {
         Kept3 kept(tire);
         REQUIRE(CALL3(fmi3SerializedFMUStateSize, kept.state, &size) == fmi3OK);
         std::vector<std::uint8_t> bytes(size);
         REQUIRE(CALL3(fmi3SerializeFMUState, kept.state, bytes.data(), size) == fmi3OK);
         return CALL3(fmi3DeserializeFMUState, bytes.data(), size, &kept.state);
       }},
      {"fmi3GetDirectionalDerivative", ".xxxx", ".xxx",
       [&](Fmi3& tire) {
         return CALL3(fmi3GetDirectionalDerivative, &loss, 1, &speed, 1, &one, 1, numbers.data(), 1);
       }},
      {"fmi3EvaluateDiscreteStates", "..x..", "....", [&](Fmi3& tire) { return CALL3(fmi3EvaluateDiscreteStates); }},
      {"fmi3UpdateDiscreteStates", "..x..", "....",
       [&](Fmi3& tire) {
         return CALL3(fmi3UpdateDiscreteStates, &flags[0], &flags[1], &flags[2], &flags[3], &flags[4], numbers.data());
       }},
      {"fmi3EnterContinuousTimeMode", "..x..", "....", [&](Fmi3& tire) { return CALL3(fmi3EnterContinuousTimeMode); }},
      {"fmi3CompletedIntegratorStep", "...x.", "....",
       [&](Fmi3& tire) { return CALL3(fmi3CompletedIntegratorStep, true, &flags[0], &flags[1]); }},
      {"fmi3SetTime", "..ox.", "....", [&](Fmi3& tire) { return CALL3(fmi3SetTime, 1.0); }},  // as in version 2
      {"fmi3SetContinuousStates", "...x.", "....",
       [&](Fmi3& tire) { return CALL3(fmi3SetContinuousStates, warm.data(), count); }},
      {"fmi3GetContinuousStateDerivatives", ".xxxx", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetContinuousStateDerivatives, numbers.data(), count); }},
      {"fmi3GetEventIndicators", ".xxxx", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetEventIndicators, nullptr, 0); }},
      {"fmi3GetContinuousStates", ".xxxx", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetContinuousStates, numbers.data(), count); }},
      {"fmi3GetNominalsOfContinuousStates", ".xxxx", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetNominalsOfContinuousStates, numbers.data(), count); }},
      {"fmi3GetNumberOfEventIndicators", "xoxoo", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetNumberOfEventIndicators, &size); }},
      {"fmi3GetNumberOfContinuousStates", "xoxoo", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetNumberOfContinuousStates, &size); }},
      {"fmi3EnterStepMode", ".....", "....", [&](Fmi3& tire) { return CALL3(fmi3EnterStepMode); }},
      {"fmi3GetOutputDerivatives of none", ".....", "..xx",
       [&](Fmi3& tire) { return CALL3(fmi3GetOutputDerivatives, nullptr, 0, nullptr, nullptr, 0); }},
      {"fmi3DoStep", ".....", "..x.",
       [&](Fmi3& tire) { return CALL3(fmi3DoStep, 0.0, 1.0, true, &flags[0], &flags[1], &flags[2], numbers.data()); }},
      // What is allowed only where the description says that the FMU has it.
      {"fmi3GetAdjointDerivative", ".....", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetAdjointDerivative, &loss, 1, &speed, 1, &one, 1, numbers.data(), 1); }},
      {"fmi3GetNumberOfVariableDependencies", ".....", "....",
       [&](Fmi3& tire) { return CALL3(fmi3GetNumberOfVariableDependencies, loss, &size); }},
      {"fmi3EnterConfigurationMode", ".....", "....", [&](Fmi3& tire) { return CALL3(fmi3EnterConfigurationMode); }},
      {"fmi3ExitConfigurationMode", ".....", "....", [&](Fmi3& tire) { return CALL3(fmi3ExitConfigurationMode); }},
      {"fmi3ActivateModelPartition", ".....", "....",
       [&](Fmi3& tire) { return CALL3(fmi3ActivateModelPartition, 0, 0.0); }}};
  check_calls(rows, [&](bool is_co_simulation) { return std::make_unique<Fmi3>(fmu, is_co_simulation); });
}

TEST_CASE("in the initialization, states, rates and derivatives are those of the start", "[fast]") {
  const LoadedFmu fmu("a50", "drum_2m", 2, {"slip_loss", "bearing_warmup", "rim_heat"});
  const std::size_t count = fmu.description().count_states();
  Fmi2 tire(fmu, fmi2ModelExchange);
  enter(tire, Stage::kInitialization);
  tire.set("speed_m_s", 20.0);
  tire.set("drive_force_N", 400.0);
  tire.set("ambient_temperature_K", 280.0);
  std::array<double, kMostStates> states{};
  std::array<double, kMostStates> rates{};
  REQUIRE(CALL2(fmi2GetContinuousStates, states.data(), count) == fmi2OK);
  REQUIRE(CALL2(fmi2GetDerivatives, rates.data(), count) == fmi2OK);

  // Derivatives of all unknowns by each input are the slopes of differences.
  std::vector<unsigned> unknown = fmu.description().list("output");
  for (const unsigned rate : fmu.description().list("local")) unknown.push_back(rate);
  const auto read = [&] {
    std::vector<double> values(unknown.size());
    REQUIRE(CALL2(fmi2GetReal, unknown.data(), unknown.size(), values.data()) == fmi2OK);
    return values;
  };
  for (const unsigned known : fmu.description().list("input")) {
    const double one = 1.0;
    std::vector<double> derivatives(unknown.size());
    REQUIRE(CALL2(fmi2GetDirectionalDerivative, unknown.data(), unknown.size(), &known, 1, &one, derivatives.data()) ==
            fmi2OK);
    double at = 0.0;
    REQUIRE(CALL2(fmi2GetReal, &known, 1, &at) == fmi2OK);
    const double step = 1e-4 * std::max(1.0, std::abs(at));
    const auto read_at = [&](double value) {
      REQUIRE(CALL2(fmi2SetReal, &known, 1, &value) == fmi2OK);
      return read();
    };
    const std::vector<double> above = read_at(at + step);
    const std::vector<double> below = read_at(at - step);
    read_at(at);
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      INFO("input " << known << ", unknown " << unknown[i]);
      const double rounding = 1e-14 * std::abs(above[i]) / step;
      CHECK(derivatives[i] ==
            Approx((above[i] - below[i]) / (2.0 * step)).epsilon(1e-5).margin(1e-9 + 100.0 * rounding));
    }
  }
  // A state is no known there: it follows from parameters and inputs.
  const unsigned liner = fmu.description().find("liner_temperature_K");
  const double one = 1.0;
  double derivative = 0.0;
  CHECK(CALL2(fmi2GetDirectionalDerivative, unknown.data(), 1, &liner, 1, &one, &derivative) == fmi2Error);

  // They are what the start then has, and what the end still has.
  REQUIRE(CALL2(fmi2ExitInitializationMode) == fmi2OK);
  for (const bool is_at_end : {false, true}) {
    if (is_at_end) REQUIRE(CALL2(fmi2Terminate) == fmi2OK);
    std::array<double, kMostStates> later{};
    REQUIRE(CALL2(fmi2GetContinuousStates, later.data(), count) == fmi2OK);
    CHECK(later == states);
    REQUIRE(CALL2(fmi2GetDerivatives, later.data(), count) == fmi2OK);
    CHECK(later == rates);
  }
  CHECK(rates[0] != 0.0);
}

TEST_CASE("a single state is set as all of them are", "[fast]") {
  const LoadedFmu fmu("a50");
  Fmi2 tire(fmu, fmi2ModelExchange);
  enter(tire, Stage::kContinuous);
  tire.set("speed_m_s", 25.0);
  const double cold_N = tire.get("rolling_resistance_N");
  tire.set("tread_temperature_K", 330.0);
  CHECK(tire.get("tread_temperature_K") == 330.0);
  CHECK(tire.get("liner_temperature_K") < 330.0);
  CHECK(tire.get("rolling_resistance_N") < cold_N);
  const unsigned references[] = {fmu.description().find("tread_temperature_K"), fmu.description().find("load_N")};
  const double values[] = {340.0, -1.0};
  CHECK(CALL2(fmi2SetReal, references, 2, values) == fmi2Error);
  CHECK(tire.get("tread_temperature_K") == 330.0);
}
