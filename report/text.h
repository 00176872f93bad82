#pragma once
/// What a person reads in the terminal: 80 columns, plain text.

#include <string>
#include <vector>

#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Label and value lines, values aligned.
std::string format_lines(const std::vector<scenarios::ResultLine>& lines);

/// A table, columns aligned to the right, the first to the left where it holds names.
std::string format_table(const scenarios::ResultTable& table);

/// Header, lines, tables and warnings of a run.
std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome);

}  // namespace rollrig::report
