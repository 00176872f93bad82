#include "sim/held_steps.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rollrig::sim {

namespace {

bool is_held(const Segment& segment) {
  return std::all_of(segment.inputs.begin(), segment.inputs.end(),
                     [](const Ramp& input) { return input.slope_per_s == 0.0; });
}

/// Whether two segments start with the same inputs.
bool has_same_inputs(const Segment& a, const Segment& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                    [](const Ramp& x, const Ramp& y) { return x.start == y.start; });
}

/// Appends the parts of a segment in which no input changes; in each, steps are equally long. The last change was
/// `since_change_s` before the segment.
void append_held_parts(const Segment& segment, double since_change_s, const StepGrowth& growth,
                       std::vector<Segment>& parts) {
  double from_s = 0.0;
  while (from_s < segment.duration_s) {
    const double step_s = growth.find_longest_s(since_change_s + from_s);
    const double longer_at_s = growth.steps_before_doubling * step_s - since_change_s;
    const bool grows = step_s < growth.most_s && longer_at_s > from_s && longer_at_s < segment.duration_s;
    const double to_s = grows ? longer_at_s : segment.duration_s;
    parts.push_back(cut_segment(segment, from_s, to_s));
    parts.back().max_step_s = step_s;
    from_s = to_s;
  }
}

}  // namespace

double StepGrowth::find_longest_s(double since_change_s) const {
  constexpr double kRounding = 1.0 - 1e-9;
  double step_s = first_s;
  while (step_s < most_s && since_change_s >= kRounding * steps_before_doubling * step_s) step_s *= 2.0;
  return std::min(step_s, most_s);
}

void lengthen_held_steps(const StepGrowth& growth, const InputChanges& changes, Phase& phase) {
  if (!(growth.first_s > 0.0)) throw std::invalid_argument("the first steps must be longer than 0 s");
  std::vector<Segment> parts;
  parts.reserve(phase.segments.size());
  double since_change_s = 0.0;
  for (Segment& segment : phase.segments) {
    if (const std::optional<double> step_s = changes.find_step_s(segment); step_s.has_value()) {
      since_change_s = 0.0;
      segment.max_step_s = std::min(*step_s, growth.first_s);
      parts.push_back(std::move(segment));
      continue;
    }
    if (!parts.empty() && !changes.continues(parts.back(), segment)) since_change_s = 0.0;
    append_held_parts(segment, since_change_s, growth, parts);
    since_change_s += segment.duration_s;
  }
  phase.segments = std::move(parts);
  phase.max_step_s = growth.most_s;
}

Program lengthen_held_steps(Program program, double most_s, double steps_before_doubling) {
  for (Phase& phase : program.phases) {
    if (phase.until.has_value()) continue;
    const StepGrowth growth{phase.max_step_s, std::max(phase.max_step_s, most_s), steps_before_doubling};
    const auto find_step_s = [&growth](const Segment& segment) -> std::optional<double> {
      if (segment.max_step_s > 0.0) return segment.max_step_s;
      if (is_held(segment)) return std::nullopt;
      return growth.first_s;
    };
    lengthen_held_steps(growth, {find_step_s, has_same_inputs}, phase);
  }
  return program;
}

}  // namespace rollrig::sim
