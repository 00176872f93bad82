#pragma once
/// Messages about a user's mistake: what they are made of, and how a person reads them.

#include <string>
#include <vector>

#include "include/rollrig/error.h"

namespace rollrig {

/// One labeled line of a message.
struct ProblemPart {
  const char* label;
  std::string content;
  bool is_copied = false;  // a place or a value, which a person copies: not to be broken
};

/// What a message says below its first sentence, in order.
std::vector<ProblemPart> list_parts(const InputProblem& problem);

/// The known name nearest to `name` by edit distance, or an empty string when none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

/// An InputProblem for a name that is not among the known ones.
InputProblem unknown_name(const std::string& kind, const std::string& name, const std::vector<std::string>& known);

/// The message within 80 columns, `start` before it. Places and values stay whole, to be copied; so do lines below the
/// first one of what is wrong, such as a table.
std::string format_error(const std::string& start, const InputProblem& problem);

}  // namespace rollrig
