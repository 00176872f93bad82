#include "cli/command.h"
#include "rollrig/diagnose.h"

namespace rollrig::cli {
CLI::Option* add_smallest_effect(CLI::App& command, double& percent) {
  return command.add_option("--smallest-effect", percent,
                            "Smallest effect of interest, 0 to 100 percent of the tire's loss or of the energy of "
                            "drives; a smaller cause is called a trace [0.5]");
}

void ComparisonOptions::add_to(CLI::App& command) {
  split_names(command.add_option("--without", without, "Effects left out of the comparison: a,b"));
  split_names(command.add_option("--only", only, "The only effects in the comparison: a,b"));
}

void ComparisonOptions::check() const { require_comparable_effects(only, without); }

}  // namespace rollrig::cli
