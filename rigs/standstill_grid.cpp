#include "rigs/standstill_grid.h"

#include <cmath>
#include <utility>
#include <vector>

namespace rollrig::rigs {

sim::Program refine_near_standstill(const sim::Program& program, std::size_t speed_input) {
  constexpr double kBand_m_s = 0.4;   // where tanh(v / 0.05 m/s) is 1 to 1e-7
  constexpr double kStep_m_s = 0.01;  // a fifth of the fade's width
  sim::Program refined = program;
  for (sim::Phase& phase : refined.phases) {
    std::vector<sim::Segment> pieces;
    for (const sim::Segment& segment : phase.segments) {
      const sim::Ramp& speed = segment.inputs[speed_input];
      std::vector<double> cuts_s{0.0};
      if (speed.slope_per_s != 0.0) {
        double first_s = (-kBand_m_s - speed.start) / speed.slope_per_s;
        double second_s = (kBand_m_s - speed.start) / speed.slope_per_s;
        if (first_s > second_s) std::swap(first_s, second_s);
        for (const double cut_s : {first_s, second_s}) {
          if (cut_s > 0.0 && cut_s < segment.duration_s) cuts_s.push_back(cut_s);
        }
      }
      cuts_s.push_back(segment.duration_s);
      for (std::size_t i = 0; i + 1 < cuts_s.size(); ++i) {
        sim::Segment piece = sim::cut_segment(segment, cuts_s[i], cuts_s[i + 1]);
        const bool slow = std::abs(speed.at(0.5 * (cuts_s[i] + cuts_s[i + 1]))) < kBand_m_s;
        if (slow && speed.slope_per_s != 0.0) piece.max_step_s = kStep_m_s / std::abs(speed.slope_per_s);
        pieces.push_back(std::move(piece));
      }
    }
    phase.segments = std::move(pieces);
  }
  return refined;
}

}  // namespace rollrig::rigs
