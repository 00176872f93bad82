#pragma once
/// What a run, a sweep and a campaign of runs have in common.

#include <rollrig/run.h>
#include <rollrig/uncertainty_options.h>

#include "keywords.h"

namespace rollrig::python {

inline void read(Keywords& given, RunInput& input) {
  given.read("scenario_or_file", input.scenario_or_file).read("tire", input.tire).read("rig", input.rig);
  given.read("vehicle", input.vehicle).read("fidelity", input.fidelity).read("baseline", input.baseline);
  given.read("sensors", input.sensors).read("seed", input.seed).read("settings", input.settings);
}

inline UncertaintyOptions read_uncertainty(const py::dict& given) {
  UncertaintyOptions options;
  Keywords keywords(given);
  keywords.read("budget", options.budget).read("monte_carlo_trials", options.monte_carlo_trials);
  keywords.read("seed", options.seed).read("threads", options.threads).require_all_read();
  return options;
}

}  // namespace rollrig::python
