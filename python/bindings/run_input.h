#pragma once
/// What a run, a sweep and a campaign of runs have in common.

#include <rollrig/run.h>
#include <rollrig/uncertainty_options.h>

#include "keywords.h"

namespace rollrig::python {

inline RunInput read_run_input(const py::dict& given) {
  RunInput input;
  Keywords keywords(given);
  keywords.read("scenario", input.scenario_or_file).read("tire", input.tire).read("rig", input.rig);
  keywords.read("vehicle", input.vehicle).read("fidelity", input.fidelity).read("baseline", input.baseline);
  keywords.read("sensors", input.sensors).read("seed", input.seed).read("settings", input.settings);
  keywords.require_all_read();
  return input;
}

inline UncertaintyOptions read_uncertainty(const py::dict& given) {
  UncertaintyOptions options;
  Keywords keywords(given);
  keywords.read("uncertainty", options.budget).read("monte_carlo", options.monte_carlo_trials);
  keywords.read("seed", options.seed).read("threads", options.threads).require_all_read();
  return options;
}

}  // namespace rollrig::python
