#pragma once
/// Coastdowns in rollrig's own recordings.

#include <string>

#include "estimation/road_load/coastdown_file.h"

namespace rollrig::estimation {

/// Reads the phases "coastdown 1 +", "coastdown 1 -" ... of a recording as runs; `path` is recording.csv, or the folder
/// that `rollrig run` wrote. Of a manifest beside it come the vehicle, the pressure of the air, wind and slope.
/// Errors   InputError: bad rows, where they are refused, or too many of them; no recording in the folder, no phase of a coastdown, a broken manifest
/// Checked  tests/cli/fit_recording_test.cpp
CoastdownFile read_coastdown_recording(const std::string& path, BadRows bad_rows);

}  // namespace rollrig::estimation
