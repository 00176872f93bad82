/// Diagnoses a measurement set without the command line: reads it (or makes it in memory), looks at the
/// verdict as data, prints the ten lines. Usage: diagnose <folder of a set>
#include "diagnosis/diagnosis.h"

#include <fmt/format.h>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "sim/core/error.h"

namespace {

namespace diagnosis = rollrig::diagnosis;
namespace measurements = rollrig::measurements;

/// What a program can do with a diagnosis: decide.
void decide(const diagnosis::Diagnosis& found) {
  switch (found.verdict) {
    case diagnosis::Verdict::kNoGap:
      fmt::print("The simulation may be used as it is.\n");
      return;
    case diagnosis::Verdict::kExplained:
      for (const diagnosis::ParameterEstimate& parameter : found.causes.front().parameters) {
        fmt::print("Switch on {} = {:.4g} {} (95 %: {:.4g} to {:.4g})\n", parameter.name, parameter.value,
                   parameter.unit, parameter.low_95, parameter.high_95);
      }
      return;
    case diagnosis::Verdict::kUnexplained:
      if (!found.next_test.empty()) fmt::print("Measure first: {}\n", found.next_test.front().test);
      return;
  }
}

int run(const std::string& folder) {
  // A set may as well be filled in by hand: tire, rig, sensors, and for each run its columns in SI units.
  const measurements::MeasurementSet set = measurements::read_measurement_set(folder);
  diagnosis::DiagnosisOptions options;
  options.threads = 2;  // the answer does not depend on it
  options.progress = [](double done, const std::string& stage) {
    fmt::print(stderr, "{:3.0f} % {}\n", 100.0 * done, stage);
  };
  const diagnosis::Diagnosis found = diagnosis::diagnose(set, options);
  fmt::print("{}\n", diagnosis::format_summary(found));
  decide(found);
  // The document of --json, for another program:
  const rollrig::Json json = diagnosis::make_diagnosis_json(found);
  fmt::print("verdict {}\n", json["verdict"].get<std::string>());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: diagnose <folder of a measurement set>\n");
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const rollrig::InputError& error) {  // the set: file, line, key, what is allowed
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  } catch (const rollrig::RunFailure& error) {  // no fit converged
    fmt::print(stderr, "run failed: {}\n", error.what());
    return 3;
  }
}
