// The only part of a program that needs the log's library: a tire in another program (fmu/) does without it.
#include <spdlog/spdlog.h>

#include "sim/program.h"

namespace rollrig::sim {

void log_phase(const Phase& phase, double start_s) {
  spdlog::debug("{:10.1f} s  {} ({:.0f} s)", start_s, phase.name, phase.duration_s());
}

}  // namespace rollrig::sim
