#include <edlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>

#include "sim/core/error.h"
#include "sim/core/visible.h"

namespace rollrig {
namespace {

int find_edit_distance(const std::string& a, const std::string& b) {
  const EdlibAlignResult result =
      edlibAlign(a.data(), static_cast<int>(a.size()), b.data(), static_cast<int>(b.size()), edlibDefaultAlignConfig());
  const int distance = result.editDistance;
  edlibFreeAlignResult(result);
  return distance;
}

}  // namespace

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

}  // namespace rollrig
