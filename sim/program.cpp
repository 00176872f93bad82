#include "sim/program.h"

#include <spdlog/spdlog.h>

namespace rollrig::sim {

double Phase::duration_s() const {
  double sum_s = 0.0;
  for (const Segment& segment : segments) sum_s += segment.duration_s;
  return sum_s;
}

double Program::duration_s() const {
  double sum_s = 0.0;
  for (const Phase& phase : phases) sum_s += phase.duration_s();
  return sum_s;
}

void log_phase(const Phase& phase, double start_s) {
  spdlog::debug("{:10.1f} s  {} ({:.0f} s)", start_s, phase.name, phase.duration_s());
}

}  // namespace rollrig::sim
