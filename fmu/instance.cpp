#include "fmu/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/core/error.h"

namespace rollrig::fmu {
namespace {

const char* name_stage(unsigned stage) {
  switch (stage) {
    case kInstantiated:
      return "before the initialization";
    case kInitialization:
      return "in the initialization";
    case kStepping:
      return "between steps of co-simulation";
    case kEvents:
      return "in event mode";
    case kContinuous:
      return "in continuous-time mode";
    default:
      return "after termination";
  }
}

std::vector<std::size_t> widen(const unsigned* references, std::size_t count) {
  require_given(references, count);
  return {references, references + count};
}

/// Calls set(variable, value) for each variable. Where it throws, those that were set get back what get(variable) was.
template <class Get, class Set>
void set_all_or_none(const std::vector<std::size_t>& variables, const double* values, Get&& get, Set&& set) {
  std::size_t done = 0;
  std::vector<double> former;
  try {
    for (; done < variables.size(); ++done) {
      former.push_back(get(variables[done]));
      set(variables[done], values[done]);
    }
  } catch (...) {
    while (done-- > 0) set(variables[done], former[done]);
    throw;
  }
}

void require_times(double start_s, double stop_s) {
  require_time(start_s);
  if (stop_s >= start_s) return;
  throw InputError({"the stop time is before the start time, or not a number", "", 0, "stop time",
                    fmt::format("{:g}", stop_s), fmt::format(">= {:g} s", start_s), ""});
}

double find_rounding_s(double time_s) {
  const double distance_s = std::abs(time_s);
  return 4.0 * (std::nextafter(distance_s, HUGE_VAL) - distance_s);
}

/// How far the time that an importer says may be from that of the wheel: importers add up their steps in other ways.
/// Less than a step, so that none is done twice or left out, unless the step is lost in the rounding of the time.
double find_slack_s(double time_s, double step_s) {
  return std::max(find_rounding_s(time_s), std::min(1e-9 * std::max(1.0, std::abs(time_s)), 0.5 * step_s));
}

/// The same from one step of the importer to the next, over which its sum and the wheel's do not drift apart.
double find_slack_between_steps_s(double time_s, double step_s) {
  return std::max(find_rounding_s(time_s), std::min(1e-9, 0.5 * step_s));
}

SavedState& to_saved_state(void* state) {
  require_given(state);
  return *static_cast<SavedState*>(state);
}

void keep(SavedState&& saved, void** state) {
  if (*state == nullptr) *state = new SavedState;
  *static_cast<SavedState*>(*state) = std::move(saved);
}

}  // namespace

void refuse(const char* why) { throw InputError({why, "", 0, "", "", "", ""}); }

void require_given(const void* pointer, std::size_t count) {
  if (pointer != nullptr || count == 0) return;
  refuse("a pointer is null");
}

Instance::Instance(const WheelModel& model, int fmi_version, bool is_for_co_simulation, bool logging_on, Log to)
    : wheel(model),
      is_co_simulation(is_for_co_simulation),
      log_(std::move(to)),
      is_logged_(count_log_categories(fmi_version), logging_on) {}

void Instance::require_stage(unsigned stages) const {
  if ((stages & kOnlyModelExchange) != 0 && is_co_simulation) refuse("this call is one of model exchange");
  if ((stages & kOnlyCoSimulation) != 0 && !is_co_simulation) refuse("this call is one of co-simulation");
  if ((stage & stages) != 0) return;
  throw InputError({fmt::format("this call is not allowed {}", name_stage(stage)), "", 0, "", "", "", ""});
}

void Instance::report(LogCategory category, const char* function, const char* why) noexcept {
  try {
    if (is_logged_[static_cast<std::size_t>(category)]) log_(category, fmt::format("{}: {}", function, why));
  } catch (...) {  // out of memory: the status alone says it
  }
}

void Instance::set_logging(bool on, const char* const* categories, std::size_t count) {
  std::vector<bool> switched = is_logged_;
  if (count == 0) switched.assign(switched.size(), on);
  require_given(categories, count);
  for (std::size_t i = 0; i < count; ++i) {
    require_given(categories[i]);
    std::size_t at = 0;
    while (at < switched.size() && std::strcmp(kLogCategories[at].name, categories[i]) != 0) ++at;
    if (at == switched.size()) {
      throw InputError(
          {"there is no such category of messages", "", 0, "", categories[i], "a name of LogCategories", ""});
    }
    switched[at] = on;
  }
  is_logged_ = switched;
}

void Instance::set_up(double start, double stop) {
  were_times_refused = true;  // unless they are in order
  require_times(start, stop);
  start_s = start;
  stop_s = stop;
  were_times_refused = false;
}

void Instance::enter_initialization() {
  if (were_times_refused) refuse("the times of the experiment were refused: set it up with others first");
  stage = kInitialization;
}

void Instance::exit_initialization() {
  wheel.initialize(start_s);
  stage = is_co_simulation ? kStepping : kEvents;
}

void Instance::reset() {
  wheel.reset();
  next_start_s_.reset();
  stage = kInstantiated;
  start_s = 0.0;
  stop_s = std::numeric_limits<double>::infinity();
  were_times_refused = false;
}

template <class Body>
void Instance::with_initialized_wheel(Body&& body) {
  if (stage != kInitialization) return body();
  struct Undo {
    WarmWheel& wheel;
    ~Undo() { wheel.undo_initialize(); }
  } undo{wheel};
  wheel.initialize(start_s);
  body();
}

void Instance::get(const unsigned* references, std::size_t count, double* values) {
  require_given(values, count);
  const std::vector<std::size_t> variables = widen(references, count);
  with_initialized_wheel([&] {
    for (std::size_t i = 0; i < count; ++i) values[i] = wheel.get(variables[i]);
  });
}

void Instance::set(const unsigned* references, std::size_t count, const double* values, unsigned stages_for_states) {
  require_given(values, count);
  const bool may_set_states = (stage & stages_for_states) != 0;
  const auto is_state = [&](std::size_t variable) { return may_set_states && wheel.is_state(variable); };
  set_all_or_none(
      widen(references, count), values,
      [&](std::size_t variable) { return is_state(variable) ? wheel.get(variable) : wheel.get_if_settable(variable); },
      [&](std::size_t variable, double value) {
        is_state(variable) ? wheel.set_state(variable, value) : wheel.set(variable, value);
      });
}

void Instance::set_slopes(const unsigned* references, std::size_t count, const double* slopes_per_s) {
  require_given(slopes_per_s, count);
  set_all_or_none(
      widen(references, count), slopes_per_s,
      [this](std::size_t variable) { return wheel.get_slope_if_input(variable); },
      [this](std::size_t variable, double slope_per_s) { wheel.set_input_slope(variable, slope_per_s); });
}

void Instance::step(double time_s, double step_s) {
  const double expected_s = next_start_s_.value_or(wheel.time_s());
  const double slack_s =
      next_start_s_.has_value() ? find_slack_between_steps_s(expected_s, step_s) : find_slack_s(expected_s, step_s);
  if (!(std::abs(time_s - expected_s) <= slack_s)) {
    throw InputError({"the step does not begin where the last one ended", "", 0, "time", fmt::format("{:.17g}", time_s),
                      fmt::format("{:.17g} s", expected_s), ""});
  }
  if (time_s + step_s > stop_s + slack_s) {
    throw InputError({"the step leads beyond the stop time", "", 0, "step", fmt::format("{:.17g}", step_s),
                      fmt::format("up to {:.17g} s", stop_s - time_s), ""});
  }
  wheel.advance(step_s);
  next_start_s_ = time_s + step_s;
}

void Instance::differentiate(const unsigned* unknown, std::size_t unknown_count, const unsigned* known,
                             std::size_t known_count, const double* direction, double* derivatives) {
  require_given(direction, known_count);
  require_given(derivatives, unknown_count);
  std::vector<double> found;
  with_initialized_wheel([&] {
    found = wheel.differentiate(widen(unknown, unknown_count), widen(known, known_count),
                                {direction, direction + known_count},
                                stage == kInitialization ? WarmWheel::Moment::kStart : WarmWheel::Moment::kPresent);
  });
  std::copy(found.begin(), found.end(), derivatives);
}

void Instance::get_states(double* states, std::size_t count) {
  require_states(states, count);
  with_initialized_wheel([&] { wheel.get_states(states); });
}

void Instance::get_rates(double* rates, std::size_t count) {
  require_states(rates, count);
  with_initialized_wheel([&] { wheel.get_rates(rates); });
}

void Instance::set_states(const double* states, std::size_t count) {
  require_states(states, count);
  wheel.set_states(states);
}

void Instance::get_nominals(double* nominals, std::size_t count) const {
  require_states(nominals, count);
  for (std::size_t i = 0; i < wheel.state_count(); ++i) {
    nominals[i] = wheel.variables()[wheel.first_state() + i].nominal;
  }
}

void Instance::get_state(void** state) const {
  require_given(state);
  keep({wheel.take_snapshot(), static_cast<int>(stage), start_s, stop_s}, state);
}

void Instance::set_state(void* state) {
  const SavedState& saved = to_saved_state(state);
  const unsigned wanted = static_cast<unsigned>(saved.stage);
  const unsigned possible = kAnyStage & ~(is_co_simulation ? kEvents | kContinuous : kStepping);
  const bool is_one = wanted != 0 && (wanted & (wanted - 1)) == 0 && (wanted & possible) != 0;
  const bool has_states = (wanted & (kAfterStart | kTerminated)) != 0;
  if (!is_one || has_states == saved.wheel.states.empty()) refuse("the state is one of another kind of instance");
  require_times(saved.start_s, saved.stop_s);
  wheel.restore(saved.wheel);
  next_start_s_.reset();
  start_s = saved.start_s;
  stop_s = saved.stop_s;
  were_times_refused = false;
  stage = wanted;
}

void Instance::require_states(const void* numbers, std::size_t count) const {
  if (count != wheel.state_count()) {
    throw InputError({"the number of states is wrong", "", 0, "", fmt::format("{}", count),
                      fmt::format("{}", wheel.state_count()), ""});
  }
  require_given(numbers, count);
}

void free_state(void** state) noexcept {
  if (state == nullptr) return;
  delete static_cast<SavedState*>(*state);
  *state = nullptr;
}

void get_serialized_size(void* state, std::size_t* size) {
  require_given(size);
  *size = count_bytes(to_saved_state(state));
}

void serialize_state(void* state, char* bytes, std::size_t size) {
  require_given(bytes);
  const std::vector<char> made = serialize(to_saved_state(state));
  if (size < made.size()) refuse("there is too little room for the state");
  std::copy(made.begin(), made.end(), bytes);
}

void deserialize_state(const char* bytes, std::size_t size, void** state) {
  require_given(state);
  keep(deserialize(bytes, size), state);
}

}  // namespace rollrig::fmu
