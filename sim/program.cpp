#include "sim/program.h"

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

}  // namespace rollrig::sim
