#include "rigs/standstill_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rollrig::rigs {

namespace {

constexpr double kBand_m_s = 0.4;  // where tanh(v / 0.05 m/s) is 1 to 1e-7
// Assumed: a quarter of the fade's width, where Simpson's rule finds the mean of tanh to 1e-6.
constexpr double kStep_m_s = 0.0125;

/// When a segment enters or leaves the band, in order, between its start and its end, both of which are listed too.
std::vector<double> list_cuts_s(const sim::Ramp& speed, double duration_s) {
  std::vector<double> cuts_s{0.0};
  double first_s = (-kBand_m_s - speed.start) / speed.slope_per_s;
  double second_s = (kBand_m_s - speed.start) / speed.slope_per_s;
  if (first_s > second_s) std::swap(first_s, second_s);
  for (const double cut_s : {first_s, second_s}) {
    if (cut_s > 0.0 && cut_s < duration_s) cuts_s.push_back(cut_s);
  }
  cuts_s.push_back(duration_s);
  return cuts_s;
}

bool touches_band(const sim::Ramp& speed, double duration_s) {
  const auto [least, most] = std::minmax({speed.start, speed.at(duration_s)});
  return least < kBand_m_s && most > -kBand_m_s;
}

}  // namespace

sim::Program refine_near_standstill(sim::Program program, std::size_t speed_input) {
  for (sim::Phase& phase : program.phases) {
    std::vector<sim::Segment> pieces;
    pieces.reserve(phase.segments.size());
    for (sim::Segment& segment : phase.segments) {
      const sim::Ramp speed = segment.inputs[speed_input];
      if (speed.slope_per_s == 0.0 || !touches_band(speed, segment.duration_s)) {
        pieces.push_back(std::move(segment));
        continue;
      }
      const std::vector<double> cuts_s = list_cuts_s(speed, segment.duration_s);
      for (std::size_t i = 0; i + 1 < cuts_s.size(); ++i) {
        sim::Segment piece = sim::cut_segment(segment, cuts_s[i], cuts_s[i + 1]);
        const bool slow = std::abs(speed.at(0.5 * (cuts_s[i] + cuts_s[i + 1]))) < kBand_m_s;
        if (slow) piece.max_step_s = kStep_m_s / std::abs(speed.slope_per_s);
        pieces.push_back(std::move(piece));
      }
    }
    phase.segments = std::move(pieces);
  }
  return program;
}

}  // namespace rollrig::rigs
