#pragma once
/// An instance of the FMU as both versions of the interface see it: a wheel, and the stage that says which calls are
/// allowed. fmi2.cpp and fmi3.cpp turn calls of C into calls of this, and its failures into a status.

#include <functional>
#include <limits>
#include <string>

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

struct Instance {
  using Log = std::function<void(const std::string& message)>;

  Instance(const WheelModel& model, bool is_co_simulation, Log log);

  /// Runs `body` if the stage is one of `stages`. Says why in the log and returns false where it is not, or an
  /// exception comes.
  template <class Body>
  bool run(const char* function, unsigned stages, Body&& body) noexcept {
    try {
      require_stage(stages);
      body();
      return true;
    } catch (const std::exception& error) {
      report(function, error.what());
    } catch (...) {
      report(function, "unknown failure");
    }
    return false;
  }

  void set_up(double start_s, double stop_s);
  void enter_initialization();
  void exit_initialization();
  void reset();
  void get(const unsigned* references, std::size_t count, double* values);
  /// All of the values, or none.
  void set(const unsigned* references, std::size_t count, const double* values);
  /// Slopes of inputs for the next step: all of them, or none.
  void set_slopes(const unsigned* references, std::size_t count, const double* slopes_per_s);
  void step(double time_s, double step_s);
  void differentiate(const unsigned* unknown, std::size_t unknown_count, const unsigned* known, std::size_t known_count,
                     const double* direction, double* derivatives);
  void get_nominals(double* nominals) const;
  /// Saves the present state into `*state`, a SavedState that the importer holds; makes one where it is null.
  void get_state(void** state) const;
  /// Goes on from a SavedState that the importer holds.
  void set_state(void* state);
  /// Throws InputError where there is no room for exactly the states of the wheel.
  void require_states(const void* numbers, std::size_t count) const;

  WarmWheel wheel;
  bool is_co_simulation;
  Log log;
  unsigned stage = kInstantiated;
  double start_s = 0.0;
  double stop_s = std::numeric_limits<double>::infinity();

 private:
  void require_stage(unsigned stages) const;
  void report(const char* function, const char* why) noexcept;
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
