#pragma once
/// The proposed next test as files that `rollrig run` takes.

#include <map>
#include <string>

#include "diagnosis/diagnosis.h"

namespace rollrig::diagnosis {

/// For diagnosis.plan, by file name: run-1.toml (rollrig-run/1; scenario "follow_drum",
/// "follow_roller" or "follow_road", by the set's kind) and a CSV of its inputs for each of its runs, tire.toml and
/// rig.toml (of the road: vehicle.toml) of the set, plan.txt for a person. Nothing where no test is proposed.
/// Rows of a CSV that lie on a straight line between their neighbors are left out.
/// Checked  tests/diagnosis/plan_files_test.cpp
std::map<std::string, std::string> write_plan(const measurements::MeasurementSet& set, const Diagnosis& diagnosis);

}  // namespace rollrig::diagnosis
