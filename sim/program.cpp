#include "sim/program.h"

namespace rollrig::sim {

Segment cut_segment(const Segment& segment, double from_s, double to_s) {
  Segment part = segment;
  part.duration_s = to_s - from_s;
  for (Ramp& ramp : part.inputs) ramp.start = ramp.at(from_s);
  return part;
}

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
