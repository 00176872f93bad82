#pragma once
/// What a person reads in the terminal of a run.

#include <string>

#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Header, lines, tables and warnings of a run.
std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

}  // namespace rollrig::report
