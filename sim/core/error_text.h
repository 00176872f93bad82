#pragma once
/// Messages about a user's mistake as a person reads them.

#include <string>

#include "sim/core/error.h"

namespace rollrig {

/// The message within 80 columns, `start` before it. Places and values stay whole, to be copied.
std::string format_error(const std::string& start, const InputProblem& problem);

}  // namespace rollrig
