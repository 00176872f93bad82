#pragma once
/// Runs of a scenario: a test on a rig from beginning to end.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "progress.h"
#include "result.h"
#include "uncertainty_options.h"

#pragma GCC visibility push(default)
namespace rollrig {

/// What is to be run. An empty member leaves what the run file says, or the default. Errors name a member as the
/// command line's option: tire as "--tire".
struct RunInput {
  std::string scenario_or_file;  // "iso_28580", or a run file (.toml)
  std::string tire;              // name of an asset, or a path; likewise rig, vehicle, sensors
  std::string rig;
  std::string vehicle;
  std::string fidelity;               // "multibody", "quasi_static"
  std::string baseline;               // "combined", "constant_rrc"
  std::string sensors;                // "none" for none
  std::string seed;                   // of the sensors' random numbers
  std::vector<std::string> settings;  // "key=value" in the unit of the key: a setting of the scenario, or
                                      // tire.<table>.<key>, rig..., vehicle..., effects.<id>.<parameter>
};

/// A phase of the procedure.
struct Phase {
  std::string name;
  double start_s = 0.0;
  double end_s = 0.0;
};

/// What was recorded: given quantities as instants, others as means over the sample.
struct Recording {
  std::vector<double> time_s;
  std::vector<Phase> phases;
  std::vector<std::size_t> phase;  // of each row, index into phases
  std::vector<Channel> channels;
};

/// Results, tables and recording of a run. Its files: result.json, recording.csv, manifest.json.
struct RunResult : Report {
  std::vector<ResultValue> values;
  std::vector<ResultRecords> records;
  std::vector<std::string> warnings;
  double mechanical_closure = 0.0;  // of the energy audit: what does not close, over the work done
  double thermal_closure = 0.0;
  std::function<Recording()> make_recording;
  std::function<FolderFiles()> make_set_files;  // the run as a measurement set; empty for a scenario that writes none
};

/// A run with all that it names, read, checked and planned, so that whatever is wrong is said before it is carried out.
/// Copies share it; any number of threads may use it.
class Run {
 public:
  /// Throws InputError.
  explicit Run(const RunInput& input);

  /// Name of the scenario.
  const std::string& scenario() const;
  /// Whether the scenario can write a measurement set, and whether virtual sensors are there for it.
  bool writes_set() const;
  bool has_sensors() const;
  /// Whether there is a test report of the scenario, and whether its results have an uncertainty budget.
  bool has_test_report() const;
  bool has_uncertainty() const;

  /// Throws InputError where an uncertainty is asked for and has_uncertainty() is false, or the number of trials is out
  /// of range.
  void check(const UncertaintyOptions& uncertainty) const;

  /// Throws RunFailure, Interrupted, and InputError where an uncertainty is asked for that the results do not have, or
  /// the number of trials is out of range.
  RunResult carry_out(const Progress& progress = {}, const UncertaintyOptions& uncertainty = {}) const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

/// The scenarios of which there is a test report, and those whose results have an uncertainty budget.
std::vector<std::string> list_scenarios_with_test_report();
std::vector<std::string> list_scenarios_with_uncertainty();

}  // namespace rollrig
#pragma GCC visibility pop
