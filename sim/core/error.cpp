#pragma GCC visibility push(default)  // include/rollrig has it
#include "sim/core/error.h"
#pragma GCC visibility pop

#include <algorithm>

#include <edlib.h>
#include <fmt/format.h>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>

#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace rollrig {
namespace {

std::string format_problem(const InputProblem& problem) {
  std::string text = problem.what;
  for (const ProblemPart& part : list_parts(problem)) text += fmt::format("\n  {:<8} {}", part.label, part.content);
  return text;
}

int find_edit_distance(const std::string& a, const std::string& b) {
  const EdlibAlignResult result =
      edlibAlign(a.data(), static_cast<int>(a.size()), b.data(), static_cast<int>(b.size()), edlibDefaultAlignConfig());
  const int distance = result.editDistance;
  edlibFreeAlignResult(result);
  return distance;
}

}  // namespace

std::vector<ProblemPart> list_parts(const InputProblem& problem) {
  const std::string where =
      problem.line > 0 && !problem.file.empty() ? fmt::format("{}, line {}", problem.file, problem.line) : problem.file;
  std::vector<ProblemPart> parts{{"where", where, true},
                                 {"key", problem.key},
                                 {"value", problem.value, true},
                                 {"allowed", problem.allowed},
                                 {"nearest", problem.nearest}};
  parts.erase(std::remove_if(parts.begin(), parts.end(), [](const ProblemPart& part) { return part.content.empty(); }),
              parts.end());
  for (ProblemPart& part : parts) part.content = show_on_one_line(part.content);
  return parts;
}

InputError::InputError(InputProblem problem)
    : std::runtime_error(format_problem(problem)), problem_(std::move(problem)) {}

std::string nearest_name(const std::string& name, const std::vector<std::string>& known) {
  if (name.empty()) return {};
  const std::string lower = boost::algorithm::to_lower_copy(name);
  std::string best;
  int best_distance =
      std::max(3, static_cast<int>(name.size()) / 2 + 1);  // Assumed: half the letters may differ, or two
  for (const std::string& candidate : known) {
    const std::string other = boost::algorithm::to_lower_copy(candidate);
    // A name without its unit, or cut short, is nearer than any edit.
    const bool cut_short = lower.size() >= 3 && other.rfind(lower, 0) == 0;
    const int distance = cut_short ? 0 : find_edit_distance(lower, other);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

InputProblem unknown_name(const std::string& kind, const std::string& name, const std::vector<std::string>& known) {
  return {fmt::format("unknown {} '{}'", kind, show_on_one_line(name)),
          "",
          0,
          "",
          name,
          boost::algorithm::join(known, ", "),
          nearest_name(name, known)};
}

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
