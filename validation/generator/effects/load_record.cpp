/// The load cell is off by a scale and an offset, or by a bent line.
#include <algorithm>

#include "validation/generator/effect.h"

namespace rollrig::generator::load_record {

constexpr double kMostOff = 0.97;  // a tire cannot pull

void make_scale_or_offset(Making& of) {
  const double error = 0.01 * of.size;
  const double offset_share = of.draw("offset_share", of.draws.happens(0.5) ? uniform(0.0, 0.2) : uniform(0.6, 1.0));
  of.effect.enter = [=](const double*, Instant& now) {
    const double offset_N = offset_share * now.specimen->reference_load_N;
    const double more_N = error * (offset_N + (1.0 - offset_share) * now.load_N);
    now.load_N += std::max(more_N, -kMostOff * std::max(0.0, now.load_N));
  };
}

/// Error e x (1 - q + q x) of the load ratio x.
void make_bent(Making& of) {
  const double error = 0.01 * of.size;
  const double bend = of.draw("bend", uniform(0.3, 0.8));
  of.effect.enter = [=](const double*, Instant& now) {
    const double load = now.load_N / now.specimen->reference_load_N;
    const double more = error * (1.0 - bend + bend * load);
    now.load_N *= 1.0 + std::max(-kMostOff, more);
  };
}

const EffectKind kind{
    "load_record",
    {"percent", "true over recorded load at the reference load, less one", 0.0, -30.0, 30.0,
     log_normal(1.0, 5.0, 0.7, 7.0), true},
    {{"scale_or_offset", "mostly a scale or mostly an offset, never one alone", make_scale_or_offset},
     {"bent", "an error that grows with the square of the load beside a scale, nothing without load", make_bent}}};

}  // namespace rollrig::generator::load_record
