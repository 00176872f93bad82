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

/// Run files and inputs of tests that follow each other, by file name: run-<n>.toml and a CSV for each of their runs,
/// in order, and the files of tire and machine.
std::map<std::string, std::string> write_test_files(const measurements::MeasurementSet& set,
                                                    const std::vector<ProposedTest>& tests);
/// What a person does in each run of a test, in stages, and beside the runs; so many runs are done before.
std::string describe_runs(const ProposedTest& test, std::size_t before, const rigs::MachineKind& kind);
/// A set.toml of these tests, whose runs name files that are not there yet.
std::string write_set_to_fill(const measurements::MeasurementSet& set, const std::vector<ProposedTest>& tests);

}  // namespace rollrig::diagnosis
