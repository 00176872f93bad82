#include <algorithm>

#include "cli/command.h"
#include "rollrig/diagnose.h"

namespace rollrig::cli {
namespace {

void require_effects(const char* option, const std::vector<std::string>& names) {
  const std::vector<std::string> ids = comparable_names();
  for (const std::string& name : names) {
    if (std::find(ids.begin(), ids.end(), name) != ids.end()) continue;
    InputProblem problem = unknown_name("effect", name, ids);
    problem.file = "command line";
    problem.key = option;
    throw InputError(problem);
  }
}

}  // namespace

CLI::Option* add_smallest_effect(CLI::App& command, double& percent) {
  return command.add_option("--smallest-effect", percent,
                            "Smallest effect of interest, 0 to 100 percent of the tire's loss or of the energy of "
                            "drives; a smaller cause is called a trace [0.5]");
}

void ComparisonOptions::add_to(CLI::App& command) {
  command.add_option("--without", without, "Effects left out of the comparison: a,b")->delimiter(',');
  command.add_option("--only", only, "The only effects in the comparison: a,b")->delimiter(',');
}

void ComparisonOptions::check() const {
  require_effects("--without", without);
  require_effects("--only", only);
  check_apart();
}

void ComparisonOptions::check_apart() const {
  for (const std::string& name : only) {
    if (std::find(without.begin(), without.end(), name) == without.end()) continue;
    throw usage_error("an effect is asked for and left out", "--without", name, "effects that --only does not name");
  }
}

}  // namespace rollrig::cli
