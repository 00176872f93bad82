#include "api/effect_options.h"

#include <algorithm>

#include "rollrig/diagnose.h"
#include "sim/core/error.h"

namespace rollrig {
namespace {

void require_comparable(const char* option, const std::vector<std::string>& names) {
  const std::vector<std::string> known = comparable_names();
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    InputProblem problem = unknown_name("effect", name, known);
    problem.file = "command line";
    problem.key = option;
    throw InputError(problem);
  }
}

}  // namespace

void require_apart(const std::vector<std::string>& only, const std::vector<std::string>& without) {
  for (const std::string& name : only) {
    if (std::find(without.begin(), without.end(), name) == without.end()) continue;
    throw InputError({"an effect is asked for and left out", "command line", 0, "--without", name,
                      "effects that --only does not name", ""});
  }
}

void require_comparable_effects(const std::vector<std::string>& only, const std::vector<std::string>& without) {
  require_comparable("--without", without);
  require_comparable("--only", only);
  require_apart(only, without);
}

}  // namespace rollrig
