#pragma once
/// What can be exported, read from where rollrig wrote it.

#include <string>

#include "exports/tree.h"

namespace rollrig::exports {

/// The tree of a result folder (of `rollrig run --out`), of a measurement set, or of a recording.csv alone; numbers are
/// those of the files, in the files' units. A folder that is both is taken as a result, its set.toml as the set.
/// Members   format, source ("result", "measurements" or "recording"), and
///           of a result: recording, result, manifest (text);
///           of a set: set, tire, rig or vehicle, runs (a group a run, with its keys and a recording);
///           of a recording: recording
/// Errors    InputError when it is none of these, or when a file of it is missing or wrong
/// Checked   tests/exports/source_test.cpp
Group read_source(const std::string& path);

}  // namespace rollrig::exports
