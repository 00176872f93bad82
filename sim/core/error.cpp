#pragma GCC visibility push(default)  // include/rollrig has it
#include "sim/core/error.h"
#pragma GCC visibility pop

#include <algorithm>

#include <fmt/format.h>

#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace rollrig {
namespace {

std::string format_problem(const InputProblem& problem) {
  std::string text = problem.what;
  for (const ProblemPart& part : list_parts(problem)) text += fmt::format("\n  {:<8} {}", part.label, part.content);
  return text;
}

}  // namespace

std::vector<ProblemPart> list_parts(const InputProblem& problem) {
  constexpr std::size_t kLongestValue = 1000;  // Assumed: characters; longer than any path that people use
  const std::string where =
      problem.line > 0 && !problem.file.empty() ? fmt::format("{}, line {}", problem.file, problem.line) : problem.file;
  std::vector<ProblemPart> parts{{"where", where, true},
                                 {"key", problem.key},
                                 {"value", shorten(problem.value, kLongestValue), true},
                                 {"allowed", problem.allowed},
                                 {"nearest", problem.nearest}};
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const ProblemPart& part) { return part.content.empty(); }),
              parts.end());
  for (ProblemPart& part : parts) part.content = show_on_one_line(part.content);
  return parts;
}

InputError::InputError(InputProblem problem)
    : std::runtime_error(format_problem(problem)), problem_(std::move(problem)) {}

std::string format_error(const std::string& start, const InputProblem& problem) {
  constexpr std::size_t kLabelColumns = 11;                                        // two spaces, the label, a space
  const std::size_t end = std::min(problem.what.find('\n'), problem.what.size());  // below it, lines as they are to be
  std::string text = wrap(start + problem.what.substr(0, end), 2).substr(2);
  if (end < problem.what.size()) text += problem.what.substr(end + 1) + "\n";
  for (const ProblemPart& part : list_parts(problem)) {
    text += fmt::format("  {:<8} ", part.label);
    text += part.is_copied ? part.content + "\n" : wrap(part.content, kLabelColumns).substr(kLabelColumns);
  }
  return text;
}

}  // namespace rollrig
