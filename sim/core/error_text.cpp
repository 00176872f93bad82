#include "sim/core/error_text.h"

#include <fmt/format.h>

#include "sim/core/text.h"

namespace rollrig {

std::string format_error(const std::string& start, const InputProblem& problem) {
  constexpr std::size_t kLabelColumns = 11;  // two spaces, the label, a space
  std::string text = wrap(start + problem.what, 2).substr(2);
  for (const ProblemPart& part : list_parts(problem)) {
    text += fmt::format("  {:<8} ", part.label);
    text += part.is_copied ? part.content + "\n" : wrap(part.content, kLabelColumns).substr(kLabelColumns);
  }
  return text;
}

}  // namespace rollrig
