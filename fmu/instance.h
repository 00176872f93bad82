#pragma once
/// An instance of the FMU as both versions of the interface see it: a wheel, and the stage that says which calls are
/// allowed. fmi2.cpp and fmi3.cpp turn calls of C into calls of this, and its failures into a status.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fmu/log_categories.h"
#include "fmu/saved_state.h"
#include "fmu/warm_wheel.h"

namespace rollrig::fmu {

/// Each a bit, so that several make a set.
enum Stage : unsigned {
  kInstantiated = 1,
  kInitialization = 2,
  kStepping = 4,  // of co-simulation
  kEvents = 8,    // of model exchange, as is the next
  kContinuous = 16,
  kTerminated = 32
};
constexpr unsigned kAfterStart = kStepping | kEvents | kContinuous;
constexpr unsigned kNotTerminated = kInstantiated | kInitialization | kAfterStart;
constexpr unsigned kAnyStage = kNotTerminated | kTerminated;
/// Stages in which there are outputs, states and rates.
constexpr unsigned kFromInitialization = kInitialization | kAfterStart | kTerminated;
/// Added to stages: the call is one of this kind of instance alone.
constexpr unsigned kOnlyModelExchange = 64;
constexpr unsigned kOnlyCoSimulation = 128;

struct Instance {
  using Log = std::function<void(LogCategory, const std::string& message)>;

  Instance(const WheelModel& model, int fmi_version, bool is_co_simulation, bool logging_on, Log log);

  /// Runs `body` if the stage is one of `stages`. Says why in the log and returns false where it is not, or an
  /// exception comes.
  template <class Body>
  bool run(const char* function, unsigned stages, Body&& body) noexcept {
    try {
      require_stage(stages);
      body();
      return true;
    } catch (const std::exception& error) {
      report(LogCategory::kError, function, error.what());
    } catch (...) {
      report(LogCategory::kError, function, "unknown failure");
    }
    return false;
  }
  /// Puts a message into the log if its category is on.
  void report(LogCategory category, const char* function, const char* why) noexcept;
  /// Switches categories of messages, all of them where `count` is 0.
  void set_logging(bool on, const char* const* categories, std::size_t count);

  void set_up(double start_s, double stop_s);
  void enter_initialization();
  void exit_initialization();
  void reset();
  void get(const unsigned* references, std::size_t count, double* values);
  /// All of the values, or none. States may be set in a stage of `stages_for_states`.
  void set(const unsigned* references, std::size_t count, const double* values, unsigned stages_for_states);
  /// Slopes of inputs for the next step: all of them, or none.
  void set_slopes(const unsigned* references, std::size_t count, const double* slopes_per_s);
  void step(double time_s, double step_s);
  void differentiate(const unsigned* unknown, std::size_t unknown_count, const unsigned* known, std::size_t known_count,
                     const double* direction, double* derivatives);
  void get_states(double* states, std::size_t count);
  void get_rates(double* rates, std::size_t count);
  void set_states(const double* states, std::size_t count);
  void get_nominals(double* nominals, std::size_t count) const;
  /// Saves the present state into `*state`, a SavedState that the importer holds; makes one where it is null.
  void get_state(void** state) const;
  /// Goes on from a SavedState that the importer holds.
  void set_state(void* state);

  WarmWheel wheel;
  bool is_co_simulation;
  unsigned stage = kInstantiated;
  bool were_times_refused = false;  // by set_up(), and none were accepted since
  double start_s = 0.0;
  double stop_s = std::numeric_limits<double>::infinity();

 private:
  std::optional<double> next_start_s_;  // of the next step, as the importer reckons time; none before the first step
  void require_stage(unsigned stages) const;
  /// Throws InputError where there is no room for exactly the states of the wheel.
  void require_states(const void* numbers, std::size_t count) const;
  /// Runs `body` with the wheel initialized: in the initialization, as it would be at the start. Parameters may still
  /// be set after that.
  template <class Body>
  void with_initialized_wheel(Body&& body);

  Log log_;
  std::vector<bool> is_logged_;  // by category
};

/// Throws InputError.
[[noreturn]] void refuse(const char* why);
/// Throws InputError for a null pointer where there should be `count` values.
void require_given(const void* pointer, std::size_t count = 1);

/// `state` is a SavedState that the importer holds. It is null after free_state().
void free_state(void** state) noexcept;
void get_serialized_size(void* state, std::size_t* size);
/// Throws InputError where `size` is less than the state needs.
void serialize_state(void* state, char* bytes, std::size_t size);
/// Throws InputError where the bytes are not those of serialize_state().
void deserialize_state(const char* bytes, std::size_t size, void** state);

}  // namespace rollrig::fmu
