#pragma once
/// An importer of FMUs for tests: unpacks one, reads its description, loads its shared object.

#include <map>
#include <string>
#include <vector>

#include "fmu/fmi2.h"
#include "fmu/fmi3.h"
#include "tests/support/temporary_folder.h"

namespace rollrig::tests {

/// The files of a ZIP archive by their paths.
std::map<std::string, std::string> read_zip(const std::string& bytes);

/// What modelDescription.xml says of a variable.
struct Described {
  unsigned reference = 0;
  std::string causality;
  std::string unit;
  double start = 0.0;
  bool has_start = false;
  std::size_t derivative_of = 0;  // version 2: index of the state from 1; version 3: its reference; 0 of none
};

struct Description {
  std::string fmi_version;
  std::string token;
  std::string identifier;
  std::map<std::string, Described> variables;

  unsigned find(const std::string& name) const { return variables.at(name).reference; }
  std::vector<unsigned> list(const std::string& causality) const;
  std::size_t count_states() const;
};

Description read_description(const std::string& xml);

/// An FMU that was made by make_fmu(), unpacked and loaded.
class LoadedFmu {
 public:
  explicit LoadedFmu(const std::string& tire, const std::string& rig = "road", int fmi_version = 2,
                     const std::vector<std::string>& effects = {});
  ~LoadedFmu();
  LoadedFmu(const LoadedFmu&) = delete;
  LoadedFmu& operator=(const LoadedFmu&) = delete;

  const Description& description() const { return description_; }
  const std::string& library() const { return library_; }
  /// A function of the shared object.
  template <class Function>
  Function* find(const char* name) const {
    return reinterpret_cast<Function*>(find_symbol(name));
  }

 private:
  void* find_symbol(const char* name) const;

  TemporaryFolder folder_;
  Description description_;
  std::string library_;
  void* handle_ = nullptr;
};

/// By its name in fmi2.h and fmi3.h.
#define FMI2(fmu, function) (fmu).find<decltype(function)>(#function)
#define FMI3(fmu, function) (fmu).find<decltype(function)>(#function)

/// What an instance told by its logger.
struct Told {
  int status = 0;
  std::string category;
};

/// An instance of version 2, with the messages that it gave.
class Fmi2 {
 public:
  Fmi2(const LoadedFmu& fmu, fmi2Type type, const std::string& name = "tire", bool logging_on = true);
  ~Fmi2();
  Fmi2(const Fmi2&) = delete;
  Fmi2& operator=(const Fmi2&) = delete;

  const LoadedFmu& fmu;
  std::vector<std::string> messages;
  std::vector<Told> told;  // with each of the messages
  fmi2Component component = nullptr;

  void set(const std::string& name, double value);
  double get(const std::string& name);
  /// Of an input, for the next step.
  void set_slope(const std::string& name, double slope_per_s);
  void initialize(double start_s = 0.0);
  void step(double time_s, double step_s);
};

/// An instance of version 3, with the messages that it gave.
class Fmi3 {
 public:
  Fmi3(const LoadedFmu& fmu, bool is_co_simulation, bool logging_on = true);
  ~Fmi3();
  Fmi3(const Fmi3&) = delete;
  Fmi3& operator=(const Fmi3&) = delete;

  const LoadedFmu& fmu;
  std::vector<std::string> messages;
  std::vector<Told> told;
  fmi3Instance instance = nullptr;

  void set(const std::string& name, double value);
  double get(const std::string& name);
  void initialize();
  fmi3Status step(double time_s, double step_s);
};

}  // namespace rollrig::tests
