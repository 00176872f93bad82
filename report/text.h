#pragma once
/// What a person reads in the terminal: tables as wide as the terminal, and sentences of 80
/// columns at most.

#include <string>
#include <vector>

#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Label and value lines, values aligned.
std::string format_lines(const std::vector<scenarios::ResultLine>& lines);

/// Header, lines, tables and warnings of a run.
std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

}  // namespace rollrig::report
