#include "validation/generator/problem.h"

#include <edlib.h>
#include <fmt/format.h>

#include <algorithm>

namespace blind {
namespace {

std::string format_problem(const Problem& problem) {
  std::string text = problem.what;
  const auto append = [&text](const char* label, const std::string& content) {
    if (!content.empty()) text += fmt::format("\n  {:<8} {}", label, content);
  };
  append("key", problem.key);
  append("value", problem.value);
  append("allowed", problem.allowed);
  append("nearest", problem.nearest);
  return text;
}

}  // namespace

InputError::InputError(const Problem& problem) : std::runtime_error(format_problem(problem)) {}

std::string find_nearest(const std::string& name, const std::vector<std::string>& known) {
  std::string best;
  int best_distance = std::max(3, static_cast<int>(name.size()) / 2 + 1);  // Assumed: half the letters may differ
  for (const std::string& candidate : known) {
    const EdlibAlignResult result = edlibAlign(name.data(), static_cast<int>(name.size()), candidate.data(),
                                               static_cast<int>(candidate.size()), edlibDefaultAlignConfig());
    if (result.editDistance < best_distance) {
      best_distance = result.editDistance;
      best = candidate;
    }
    edlibFreeAlignResult(result);
  }
  return best;
}

}  // namespace blind
