/// Version 3.0 of the interface.
#include "fmu/fmi3.h"

#include <algorithm>
#include <limits>
#include <memory>

#include "fmu/instance.h"
#include "fmu/model_block.h"

namespace rollrig::fmu {
namespace {

/// Passes a message to the importer's logger. In a message, "#" begins the reference of a variable, so it is doubled.
void log_fmi3(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, LogCategory category,
              const std::string& message) {
  if (log == nullptr) return;
  std::string escaped;
  for (const char c : message) escaped.append(c == '#' ? 2 : 1, c);
  log(environment, fmi3Error, kLogCategories[static_cast<std::size_t>(category)].name, escaped.c_str());
}

template <class Body>
fmi3Status run_fmi3(fmi3Instance given, const char* function, unsigned stages, Body&& body) noexcept {
  if (given == nullptr) return fmi3Error;
  auto& instance = *static_cast<Instance*>(given);
  return instance.run(function, stages, [&] { body(instance); }) ? fmi3OK : fmi3Error;
}

/// Refuses a call for something that this FMU does not have: variables of other types, clocks, events, configuration.
/// A call for none of them is no mistake.
fmi3Status refuse_unless_none(fmi3Instance given, const char* function, std::size_t count = 1,
                              unsigned stages = kAnyStage) {
  return run_fmi3(given, function, stages, [&](Instance&) {
    if (count > 0) refuse("this FMU has nothing of this kind");
  });
}

void require_same_count(std::size_t references, std::size_t values) {
  if (references != values) refuse("the number of values is not that of the variables");
}

/// Why it fails is logged whatever logging_on says: without an instance, nobody could switch messages on.
fmi3Instance instantiate(const char* function, bool is_co_simulation, bool event_mode_used, fmi3String name,
                         fmi3String token, bool logging_on, fmi3InstanceEnvironment environment,
                         fmi3LogMessageCallback log) {
  const auto tell = [environment, log](LogCategory category, const std::string& message) {
    log_fmi3(environment, log, category, message);
  };
  try {
    const BlockContent& content = read_own_block();
    if (name == nullptr || *name == '\0') refuse("the instance has no name");
    if (token == nullptr || content.token != token) refuse("the token is not that of this FMU");
    if (event_mode_used) refuse("this FMU has no event mode in co-simulation");
    return new Instance(content.model, 3, is_co_simulation, logging_on, tell);
  } catch (const std::exception& error) {
    tell(LogCategory::kError, std::string(function) + ": " + error.what());
  } catch (...) {
  }
  return nullptr;
}

}  // namespace
}  // namespace rollrig::fmu

using namespace rollrig::fmu;  // NOLINT: C functions of the standard follow

const char* fmi3GetVersion() { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance given, fmi3Boolean on, size_t count, const fmi3String categories[]) {
  return run_fmi3(given, "fmi3SetDebugLogging", kAnyStage,
                  [&](Instance& instance) { instance.set_logging(on, categories, count); });
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String, fmi3Boolean,
                                          fmi3Boolean logging_on, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return instantiate("fmi3InstantiateModelExchange", false, false, name, token, logging_on, environment, log);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String, fmi3Boolean,
                                         fmi3Boolean logging_on, fmi3Boolean event_mode_used, fmi3Boolean,
                                         const fmi3ValueReference[], size_t, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback) {
  return instantiate("fmi3InstantiateCoSimulation", true, event_mode_used, name, token, logging_on, environment, log);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  log_fmi3(environment, log, LogCategory::kError,
           "fmi3InstantiateScheduledExecution: this FMU has no scheduled execution");
  return nullptr;
}

void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance given, fmi3Boolean, fmi3Float64, fmi3Float64 start_s,
                                       fmi3Boolean has_stop, fmi3Float64 stop_s) {
  return run_fmi3(given, "fmi3EnterInitializationMode", kInstantiated, [&](Instance& instance) {
    instance.set_up(start_s, has_stop ? stop_s : std::numeric_limits<double>::infinity());
    instance.enter_initialization();
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance given) {
  return run_fmi3(given, "fmi3ExitInitializationMode", kInitialization,
                  [](Instance& instance) { instance.exit_initialization(); });
}

fmi3Status fmi3EnterEventMode(fmi3Instance given) {
  return run_fmi3(given, "fmi3EnterEventMode", kContinuous, [](Instance& instance) { instance.stage = kEvents; });
}

fmi3Status fmi3Terminate(fmi3Instance given) {
  return run_fmi3(given, "fmi3Terminate", kAfterStart, [](Instance& instance) { instance.stage = kTerminated; });
}

fmi3Status fmi3Reset(fmi3Instance given) {
  return run_fmi3(given, "fmi3Reset", kAnyStage, [](Instance& instance) { instance.reset(); });
}

fmi3Status fmi3GetFloat64(fmi3Instance given, const fmi3ValueReference references[], size_t count, fmi3Float64 values[],
                          size_t value_count) {
  return run_fmi3(given, "fmi3GetFloat64", kAnyStage, [&](Instance& instance) {
    require_same_count(count, value_count);
    instance.get(references, count, values);
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance given, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t value_count) {
  return run_fmi3(given, "fmi3SetFloat64", kNotTerminated, [&](Instance& instance) {
    require_same_count(count, value_count);
    instance.set(references, count, values, kEvents | kContinuous);
  });
}

#define ROLLRIG_DEFINE_FMI3_TYPE(name, type)                                                                     \
  fmi3Status fmi3Get##name(fmi3Instance given, const fmi3ValueReference[], size_t count, type[], size_t) {       \
    return refuse_unless_none(given, "fmi3Get" #name, count);                                                    \
  }                                                                                                              \
  fmi3Status fmi3Set##name(fmi3Instance given, const fmi3ValueReference[], size_t count, const type[], size_t) { \
    return refuse_unless_none(given, "fmi3Set" #name, count, kNotTerminated);                                    \
  }
ROLLRIG_FOR_EACH_FMI3_TYPE(ROLLRIG_DEFINE_FMI3_TYPE)

fmi3Status fmi3GetBinary(fmi3Instance given, const fmi3ValueReference[], size_t count, size_t[], fmi3Binary[], size_t) {
  return refuse_unless_none(given, "fmi3GetBinary", count);
}
fmi3Status fmi3SetBinary(fmi3Instance given, const fmi3ValueReference[], size_t count, const size_t[],
                         const fmi3Binary[], size_t) {
  return refuse_unless_none(given, "fmi3SetBinary", count, kNotTerminated);
}
fmi3Status fmi3GetClock(fmi3Instance given, const fmi3ValueReference[], size_t count, fmi3Clock[]) {
  return refuse_unless_none(given, "fmi3GetClock", count);
}
fmi3Status fmi3SetClock(fmi3Instance given, const fmi3ValueReference[], size_t count, const fmi3Clock[]) {
  return refuse_unless_none(given, "fmi3SetClock", count);
}
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance given, fmi3ValueReference, size_t*) {
  return refuse_unless_none(given, "fmi3GetNumberOfVariableDependencies");
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance given, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
                                       fmi3DependencyKind[], size_t) {
  return refuse_unless_none(given, "fmi3GetVariableDependencies");
}

fmi3Status fmi3GetFMUState(fmi3Instance given, fmi3FMUState* state) {
  return run_fmi3(given, "fmi3GetFMUState", kAnyStage, [&](Instance& instance) { instance.get_state(state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance given, fmi3FMUState state) {
  return run_fmi3(given, "fmi3SetFMUState", kAnyStage, [&](Instance& instance) { instance.set_state(state); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance given, fmi3FMUState* state) {
  return run_fmi3(given, "fmi3FreeFMUState", kAnyStage, [&](Instance&) { free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance given, fmi3FMUState state, size_t* size) {
  return run_fmi3(given, "fmi3SerializedFMUStateSize", kAnyStage, [&](Instance&) { get_serialized_size(state, size); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance given, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return run_fmi3(given, "fmi3SerializeFMUState", kAnyStage,
                  [&](Instance&) { serialize_state(state, reinterpret_cast<char*>(bytes), size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance given, const fmi3Byte bytes[], size_t size, fmi3FMUState* state) {
  return run_fmi3(given, "fmi3DeserializeFMUState", kAnyStage,
                  [&](Instance&) { deserialize_state(reinterpret_cast<const char*>(bytes), size, state); });
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance given, const fmi3ValueReference unknown[], size_t unknown_count,
                                        const fmi3ValueReference known[], size_t known_count, const fmi3Float64 seed[],
                                        size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count) {
  return run_fmi3(given, "fmi3GetDirectionalDerivative", kFromInitialization, [&](Instance& instance) {
    require_same_count(known_count, seed_count);
    require_same_count(unknown_count, sensitivity_count);
    instance.differentiate(unknown, unknown_count, known, known_count, seed, sensitivity);
  });
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance given, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
                                    size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t) {
  return refuse_unless_none(given, "fmi3GetAdjointDerivative");
}
fmi3Status fmi3EnterConfigurationMode(fmi3Instance given) {
  return refuse_unless_none(given, "fmi3EnterConfigurationMode");
}
fmi3Status fmi3ExitConfigurationMode(fmi3Instance given) {
  return refuse_unless_none(given, "fmi3ExitConfigurationMode");
}
fmi3Status fmi3GetIntervalDecimal(fmi3Instance given, const fmi3ValueReference[], size_t count, fmi3Float64[],
                                  fmi3IntervalQualifier[]) {
  return refuse_unless_none(given, "fmi3GetIntervalDecimal", count);
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance given, const fmi3ValueReference[], size_t count, uint64_t[], uint64_t[],
                                   fmi3IntervalQualifier[]) {
  return refuse_unless_none(given, "fmi3GetIntervalFraction", count);
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance given, const fmi3ValueReference[], size_t count, fmi3Float64[]) {
  return refuse_unless_none(given, "fmi3GetShiftDecimal", count);
}
fmi3Status fmi3GetShiftFraction(fmi3Instance given, const fmi3ValueReference[], size_t count, uint64_t[], uint64_t[]) {
  return refuse_unless_none(given, "fmi3GetShiftFraction", count);
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance given, const fmi3ValueReference[], size_t count, const fmi3Float64[]) {
  return refuse_unless_none(given, "fmi3SetIntervalDecimal", count);
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance given, const fmi3ValueReference[], size_t count, const uint64_t[],
                                   const uint64_t[]) {
  return refuse_unless_none(given, "fmi3SetIntervalFraction", count);
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance given, const fmi3ValueReference[], size_t count, const fmi3Float64[]) {
  return refuse_unless_none(given, "fmi3SetShiftDecimal", count);
}
fmi3Status fmi3SetShiftFraction(fmi3Instance given, const fmi3ValueReference[], size_t count, const uint64_t[],
                                const uint64_t[]) {
  return refuse_unless_none(given, "fmi3SetShiftFraction", count);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance given) {
  return run_fmi3(given, "fmi3EvaluateDiscreteStates", kEvents, [](Instance&) {});
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance given, fmi3Boolean* need_update, fmi3Boolean* terminate,
                                    fmi3Boolean* nominals_changed, fmi3Boolean* states_changed,
                                    fmi3Boolean* next_event_defined, fmi3Float64* next_event_s) {
  return run_fmi3(given, "fmi3UpdateDiscreteStates", kEvents, [&](Instance&) {
    for (fmi3Boolean* flag : {need_update, terminate, nominals_changed, states_changed, next_event_defined}) {
      require_given(flag);
      *flag = false;
    }
    require_given(next_event_s);
    *next_event_s = 0.0;
  });
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance given) {
  return run_fmi3(given, "fmi3EnterContinuousTimeMode", kEvents,
                  [](Instance& instance) { instance.stage = kContinuous; });
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance given, fmi3Boolean, fmi3Boolean* enter_event_mode,
                                       fmi3Boolean* terminate) {
  return run_fmi3(given, "fmi3CompletedIntegratorStep", kContinuous, [&](Instance&) {
    require_given(enter_event_mode);
    require_given(terminate);
    *enter_event_mode = *terminate = false;
  });
}

fmi3Status fmi3SetTime(fmi3Instance given, fmi3Float64 time_s) {
  return run_fmi3(given, "fmi3SetTime", kEvents | kContinuous,
                  [&](Instance& instance) { instance.wheel.set_time(time_s); });
}

fmi3Status fmi3SetContinuousStates(fmi3Instance given, const fmi3Float64 states[], size_t count) {
  return run_fmi3(given, "fmi3SetContinuousStates", kContinuous,
                  [&](Instance& instance) { instance.set_states(states, count); });
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance given, fmi3Float64 derivatives[], size_t count) {
  return run_fmi3(given, "fmi3GetContinuousStateDerivatives", kOnlyModelExchange | kFromInitialization,
                  [&](Instance& instance) { instance.get_rates(derivatives, count); });
}

fmi3Status fmi3GetEventIndicators(fmi3Instance given, fmi3Float64[], size_t count) {
  return refuse_unless_none(given, "fmi3GetEventIndicators", count, kOnlyModelExchange | kFromInitialization);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance given, fmi3Float64 states[], size_t count) {
  return run_fmi3(given, "fmi3GetContinuousStates", kOnlyModelExchange | kFromInitialization,
                  [&](Instance& instance) { instance.get_states(states, count); });
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance given, fmi3Float64 nominals[], size_t count) {
  return run_fmi3(given, "fmi3GetNominalsOfContinuousStates", kOnlyModelExchange | kFromInitialization,
                  [&](Instance& instance) { instance.get_nominals(nominals, count); });
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance given, size_t* count) {
  return run_fmi3(given, "fmi3GetNumberOfEventIndicators", kOnlyModelExchange | kAnyStage, [&](Instance&) {
    require_given(count);
    *count = 0;
  });
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance given, size_t* count) {
  return run_fmi3(given, "fmi3GetNumberOfContinuousStates", kOnlyModelExchange | kAnyStage, [&](Instance& instance) {
    require_given(count);
    *count = instance.wheel.state_count();
  });
}

fmi3Status fmi3EnterStepMode(fmi3Instance given) {
  return refuse_unless_none(given,
                            "fmi3EnterStepMode");  // it leaves event mode, which co-simulation does not have here
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance given, const fmi3ValueReference[], size_t count, const int32_t[],
                                    fmi3Float64[], size_t) {
  return refuse_unless_none(given, "fmi3GetOutputDerivatives", count, kOnlyCoSimulation | kStepping | kTerminated);
}

fmi3Status fmi3DoStep(fmi3Instance given, fmi3Float64 time_s, fmi3Float64 step_s, fmi3Boolean,
                      fmi3Boolean* event_needed, fmi3Boolean* terminate, fmi3Boolean* early_return,
                      fmi3Float64* last_successful_s) {
  return run_fmi3(given, "fmi3DoStep", kStepping, [&](Instance& instance) {
    for (fmi3Boolean* flag : {event_needed, terminate, early_return}) require_given(flag);
    require_given(last_successful_s);
    *event_needed = *terminate = *early_return = false;
    *last_successful_s = instance.wheel.time_s();
    instance.step(time_s, step_s);
    *last_successful_s = instance.wheel.time_s();
  });
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance given, fmi3ValueReference, fmi3Float64) {
  return refuse_unless_none(given, "fmi3ActivateModelPartition");
}
