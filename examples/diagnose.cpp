/// Diagnoses a measurement set, looks at the verdict as data, prints the ten lines.
/// Usage: diagnose <folder of a set>
#include <rollrig/rollrig.h>

#include <cstdio>

namespace {

/// What a program can do with a diagnosis: decide.
void decide(const rollrig::Diagnosis& found) {
  switch (found.verdict) {
    case rollrig::Verdict::kNoGap:
      std::puts("The simulation may be used as it is.");
      return;
    case rollrig::Verdict::kExplained:
      for (const rollrig::ParameterEstimate& at : found.causes.front().parameters) {
        std::printf("Switch on %s = %.4g %s (95 %%: %.4g to %.4g)\n", at.name.c_str(), at.value, at.unit.c_str(),
                    at.low_95, at.high_95);
      }
      return;
    case rollrig::Verdict::kUnexplained:
      if (!found.next_tests.empty()) std::printf("Measure first: %s\n", found.next_tests.front().test.c_str());
      return;
  }
}

int diagnose(const std::string& folder) {
  const rollrig::MeasurementSet set(folder);
  rollrig::DiagnosisOptions options;
  options.threads = 2;  // the answer does not depend on it
  options.progress = [](double done, const std::string& stage) {
    std::fprintf(stderr, "%3.0f %% %s\n", 100.0 * done, stage.c_str());
  };
  const rollrig::Diagnosis found = rollrig::diagnose(set, options);
  std::printf("%s\n", found.text.c_str());
  decide(found);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: diagnose <folder of a measurement set>\n", stderr);
    return 2;
  }
  try {
    return diagnose(argv[1]);
  } catch (const rollrig::InputError& error) {  // the set: file, line, key, what is allowed
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  } catch (const rollrig::RunFailure& error) {  // no fit converged
    std::fprintf(stderr, "run failed: %s\n", error.what());
    return 3;
  }
}
