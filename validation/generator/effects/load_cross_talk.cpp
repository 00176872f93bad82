/// The load acts a little along the way of the drum, by a fixed angle or more so as the frame gives way.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/recorder.h"

namespace rollrig::generator::load_cross_talk {

/// Angle d (1 - b + b sqrt(x)), x the load over the reference load: seats that close give way less and less.
void make_bending(Making& of) {
  const double fixed = 1e-3 * of.size;
  const double bending = of.draw("bending_share", uniform(0.0, 0.5));
  trace_rows(of, [=](RunRecord& record, std::size_t row) {
    const double load_N = record.load_N[row];
    const double gives_way = std::sqrt(std::max(0.0, load_N) / record.specimen->reference_load_N);
    const double angle = fixed * (1.0 - bending + bending * gives_way);
    record.force[row] += record.lever * load_N * std::sin(angle);
  });
}

/// One angle at every load.
void make_fixed(Making& of) {
  const double sine = std::sin(1e-3 * of.size);
  trace_rows(
      of, [=](RunRecord& record, std::size_t row) { record.force[row] += record.lever * record.load_N[row] * sine; });
}

const EffectKind kind{
    "load_cross_talk",
    {"mrad", "angle of the load off the vertical at the reference load", 0.0, -5.0, 5.0,
     log_normal(0.08, 0.5, 0.05, 0.8), true},
    {{"bending", "Fz sin(d) with an angle that has a fixed part and one that grows with the root of the load",
      make_bending},
     {"fixed", "Fz sin(d) with a fixed angle", make_fixed}},
    on_rigs,
    on_carriages};

}  // namespace rollrig::generator::load_cross_talk
