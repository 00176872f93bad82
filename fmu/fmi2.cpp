/// Version 2.0 of the interface.
#include "fmu/fmi2.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "fmu/instance.h"
#include "fmu/model_block.h"

namespace rollrig::fmu {
namespace {

/// Passes a message to the importer's logger. The logger takes a format as printf does, in which "#" begins the
/// reference of a variable. So "%" and "#" are doubled. The format has no arguments, since some loggers ignore them.
void log_fmi2(const fmi2CallbackFunctions* callbacks, const char* name, LogCategory category,
              const std::string& message) {
  if (callbacks == nullptr || callbacks->logger == nullptr) return;
  std::string format;
  for (const char c : message) format.append(c == '%' || c == '#' ? 2 : 1, c);
  callbacks->logger(callbacks->componentEnvironment, name == nullptr ? "" : name,
                    category == LogCategory::kDiscard ? fmi2Discard : fmi2Error,
                    kLogCategories[static_cast<std::size_t>(category)].name, format.c_str());
}

template <class Body>
fmi2Status run_fmi2(fmi2Component component, const char* function, unsigned stages, Body&& body) noexcept {
  if (component == nullptr) return fmi2Error;
  auto& instance = *static_cast<Instance*>(component);
  return instance.run(function, stages, [&] { body(instance); }) ? fmi2OK : fmi2Error;
}

/// All variables are real numbers: a call for a variable of another type is refused.
fmi2Status refuse_type(fmi2Component component, const char* function, unsigned stages, std::size_t count) {
  return run_fmi2(component, function, stages, [&](Instance&) {
    if (count > 0) refuse("there is no variable of this type");
  });
}

void require_first_order(const fmi2Integer* order, std::size_t count) {
  require_given(order, count);
  if (std::all_of(order, order + count, [](fmi2Integer n) { return n == 1; })) return;
  refuse("only first derivatives of inputs are known");
}

/// Answers a question about a step that is still being computed. There is none here: a step is done when fmi2DoStep
/// returns. So `known` is the answer to some questions, and the others are discarded.
template <class Value>
fmi2Status tell_status(fmi2Component component, const char* function, Value* value, bool is_known, const Value& known) {
  const unsigned stages = kOnlyCoSimulation | kStepping | kTerminated;
  const fmi2Status status = run_fmi2(component, function, stages, [&](Instance& instance) {
    require_given(value);
    if (is_known) *value = known;
    if (!is_known) instance.report(LogCategory::kDiscard, function, "a step is done when fmi2DoStep returns");
  });
  return status == fmi2OK && !is_known ? fmi2Discard : status;
}

}  // namespace
}  // namespace rollrig::fmu

using namespace rollrig::fmu;  // NOLINT: C functions of the standard follow

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String,
                              const fmi2CallbackFunctions* callbacks, fmi2Boolean, fmi2Boolean logging_on) {
  // Logged whatever logging_on says: without an instance, nobody could switch messages on.
  const auto fail = [&](const char* why) {
    log_fmi2(callbacks, name, LogCategory::kError, std::string("fmi2Instantiate: ") + why);
    return nullptr;
  };
  try {
    const BlockContent& content = read_own_block();
    if (name == nullptr || *name == '\0') return fail("the instance has no name");
    if (guid == nullptr || content.token != guid) return fail("the GUID is not that of this FMU");
    if (type != fmi2ModelExchange && type != fmi2CoSimulation) return fail("the type is unknown");
    const fmi2CallbackFunctions to = callbacks == nullptr ? fmi2CallbackFunctions{} : *callbacks;
    const auto log = [to, of = std::string(name)](LogCategory category, const std::string& message) {
      log_fmi2(&to, of.c_str(), category, message);
    };
    return new Instance(content.model, 2, type == fmi2CoSimulation, logging_on != fmi2False, log);
  } catch (const std::exception& error) {
    return fail(error.what());
  } catch (...) {
    return nullptr;
  }
}

void fmi2FreeInstance(fmi2Component component) { delete static_cast<Instance*>(component); }

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t count, const fmi2String categories[]) {
  return run_fmi2(component, "fmi2SetDebugLogging", kAnyStage,
                  [&](Instance& instance) { instance.set_logging(on != fmi2False, categories, count); });
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean, fmi2Real, fmi2Real start_s, fmi2Boolean has_stop,
                               fmi2Real stop_s) {
  return run_fmi2(component, "fmi2SetupExperiment", kInstantiated, [&](Instance& instance) {
    instance.set_up(start_s, has_stop != fmi2False ? stop_s : std::numeric_limits<double>::infinity());
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return run_fmi2(component, "fmi2EnterInitializationMode", kInstantiated,
                  [](Instance& instance) { instance.enter_initialization(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return run_fmi2(component, "fmi2ExitInitializationMode", kInitialization,
                  [](Instance& instance) { instance.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component component) {
  return run_fmi2(component, "fmi2Terminate", kAfterStart, [](Instance& instance) { instance.stage = kTerminated; });
}

fmi2Status fmi2Reset(fmi2Component component) {
  return run_fmi2(component, "fmi2Reset", kAnyStage, [](Instance& instance) { instance.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[]) {
  return run_fmi2(component, "fmi2GetReal", kAnyStage,
                  [&](Instance& instance) { instance.get(references, count, values); });
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[]) {
  return run_fmi2(component, "fmi2SetReal", kNotTerminated,
                  [&](Instance& instance) { instance.set(references, count, values, kContinuous); });
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference[], size_t count, fmi2Integer[]) {
  return refuse_type(component, "fmi2GetInteger", kAnyStage, count);
}
fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference[], size_t count, fmi2Boolean[]) {
  return refuse_type(component, "fmi2GetBoolean", kAnyStage, count);
}
fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference[], size_t count, fmi2String[]) {
  return refuse_type(component, "fmi2GetString", kAnyStage, count);
}
fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference[], size_t count, const fmi2Integer[]) {
  return refuse_type(component, "fmi2SetInteger", kNotTerminated & ~kContinuous, count);
}
fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference[], size_t count, const fmi2Boolean[]) {
  return refuse_type(component, "fmi2SetBoolean", kNotTerminated & ~kContinuous, count);
}
fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference[], size_t count, const fmi2String[]) {
  return refuse_type(component, "fmi2SetString", kNotTerminated & ~kContinuous, count);
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return run_fmi2(component, "fmi2GetFMUstate", kAnyStage, [&](Instance& instance) { instance.get_state(state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return run_fmi2(component, "fmi2SetFMUstate", kAnyStage, [&](Instance& instance) { instance.set_state(state); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return run_fmi2(component, "fmi2FreeFMUstate", kAnyStage, [&](Instance&) { free_state(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t* size) {
  return run_fmi2(component, "fmi2SerializedFMUstateSize", kAnyStage,
                  [&](Instance&) { get_serialized_size(state, size); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return run_fmi2(component, "fmi2SerializeFMUstate", kAnyStage,
                  [&](Instance&) { serialize_state(state, bytes, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
  return run_fmi2(component, "fmi2DeSerializeFMUstate", kAnyStage,
                  [&](Instance&) { deserialize_state(bytes, size, state); });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknown[],
                                        size_t unknown_count, const fmi2ValueReference known[], size_t known_count,
                                        const fmi2Real known_direction[], fmi2Real unknown_direction[]) {
  return run_fmi2(component, "fmi2GetDirectionalDerivative", kFromInitialization, [&](Instance& instance) {
    instance.differentiate(unknown, unknown_count, known, known_count, known_direction, unknown_direction);
  });
}

fmi2Status fmi2EnterEventMode(fmi2Component component) {
  return run_fmi2(component, "fmi2EnterEventMode", kEvents | kContinuous,
                  [](Instance& instance) { instance.stage = kEvents; });
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo* info) {
  return run_fmi2(component, "fmi2NewDiscreteStates", kEvents, [&](Instance&) {
    require_given(info);
    *info = {};
  });
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component) {
  return run_fmi2(component, "fmi2EnterContinuousTimeMode", kEvents,
                  [](Instance& instance) { instance.stage = kContinuous; });
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean, fmi2Boolean* enter_event_mode,
                                       fmi2Boolean* terminate) {
  return run_fmi2(component, "fmi2CompletedIntegratorStep", kContinuous, [&](Instance&) {
    require_given(enter_event_mode);
    require_given(terminate);
    *enter_event_mode = *terminate = fmi2False;
  });
}

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time_s) {
  return run_fmi2(component, "fmi2SetTime", kEvents | kContinuous,
                  [&](Instance& instance) { instance.wheel.set_time(time_s); });
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real states[], size_t count) {
  return run_fmi2(component, "fmi2SetContinuousStates", kContinuous,
                  [&](Instance& instance) { instance.set_states(states, count); });
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], size_t count) {
  return run_fmi2(component, "fmi2GetDerivatives", kOnlyModelExchange | kFromInitialization,
                  [&](Instance& instance) { instance.get_rates(derivatives, count); });
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real[], size_t count) {
  return run_fmi2(component, "fmi2GetEventIndicators", kOnlyModelExchange | kFromInitialization, [&](Instance&) {
    if (count > 0) refuse("there are no event indicators");
  });
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real states[], size_t count) {
  return run_fmi2(component, "fmi2GetContinuousStates", kOnlyModelExchange | kFromInitialization,
                  [&](Instance& instance) { instance.get_states(states, count); });
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real nominals[], size_t count) {
  return run_fmi2(component, "fmi2GetNominalsOfContinuousStates", kOnlyModelExchange | kAnyStage,
                  [&](Instance& instance) { instance.get_nominals(nominals, count); });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference references[], size_t count,
                                       const fmi2Integer order[], const fmi2Real values[]) {
  return run_fmi2(component, "fmi2SetRealInputDerivatives",
                  kOnlyCoSimulation | kInstantiated | kInitialization | kStepping, [&](Instance& instance) {
                    require_first_order(order, count);
                    instance.set_slopes(references, count, values);
                  });
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[], size_t count,
                                        const fmi2Integer[], fmi2Real[]) {
  return run_fmi2(component, "fmi2GetRealOutputDerivatives", kOnlyCoSimulation | kStepping | kTerminated,
                  [&](Instance&) {
                    if (count > 0) refuse("derivatives of outputs are not known");
                  });
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time_s, fmi2Real step_s, fmi2Boolean) {
  return run_fmi2(component, "fmi2DoStep", kStepping, [&](Instance& instance) { instance.step(time_s, step_s); });
}

fmi2Status fmi2CancelStep(fmi2Component component) {
  return run_fmi2(component, "fmi2CancelStep", kStepping,
                  [](Instance&) { refuse("a step is done when fmi2DoStep returns"); });
}

fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind, fmi2Status* value) {
  return tell_status(component, "fmi2GetStatus", value, false, fmi2OK);
}
fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value) {
  const double time_s = component == nullptr ? 0.0 : static_cast<Instance*>(component)->wheel.time_s();
  return tell_status(component, "fmi2GetRealStatus", value, kind == fmi2LastSuccessfulTime, time_s);
}
fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind, fmi2Integer* value) {
  return tell_status(component, "fmi2GetIntegerStatus", value, false, 0);
}
fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean* value) {
  return tell_status(component, "fmi2GetBooleanStatus", value, kind == fmi2Terminated, 0);
}
fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind, fmi2String* value) {
  return tell_status(component, "fmi2GetStringStatus", value, false, fmi2String());
}
