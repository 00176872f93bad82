#pragma once
/// Messages for a person.

#include <string>

#include "sim/core/text.h"

namespace rollrig::cli {

/// A message as lines for a terminal: all but the first are indented.
inline std::string wrap_message(const std::string& text) { return wrap(text, 2).substr(2); }

}  // namespace rollrig::cli
