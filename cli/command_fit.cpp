#include "cli/command.h"

namespace rollrig::cli {
void add_fit_command(CLI::App&, Action&) {}
}  // namespace rollrig::cli
