#pragma once
/// Runs of a test that somebody planned, as rollrig_validation plan writes them.

#include <string>
#include <vector>

#include "validation/generator/measurement_set.h"

namespace rollrig::generator {

/// The plan of one set: plan.json (rollrig-blind-plan/1) and a CSV of given columns for each of its runs.
struct TestPlan {
  std::string set_sha256;  // of the files of the set that it is for
  std::vector<RunPlan> runs;
};

/// Reads the plan in `folder`. What is not in a plan is drawn as for any run, by the seed of the set: the air swings
/// about the planned temperature, and the tire starts at that of the air. Loads on the road are `road_load_N`.
/// Errors  InputError: no plan, a plan of another kind of set, columns or rows that no run can have
TestPlan read_test_plan(const std::string& folder, const SetOrder& order, double road_load_N);

}  // namespace rollrig::generator
