/// The load cell is off by a scale and an offset, or by a bent line.
#include <algorithm>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class LoadRecord : public Effect {
 public:
  using Effect::Effect;

  void enter(const double*, Instant& now) const override {
    const double offset_N = offset_share_ * now.specimen->reference_load_N;
    const double more_N = error_ * (offset_N + (1.0 - offset_share_) * now.load_N);
    now.load_N += std::max(more_N, -kLeastLeft * std::max(0.0, now.load_N));  // a tire cannot pull
  }

 private:
  static constexpr double kLeastLeft = 0.97;

  double error_ = 0.01 * size_;
  double offset_share_ =
      note("offset_share", draws_.happens(0.5) ? draws_.uniform(0.0, 0.2) : draws_.uniform(0.6, 1.0));
};

/// Error e x (1 - q + q x) of the load ratio x.
class BentCell : public Effect {
 public:
  using Effect::Effect;

  void enter(const double*, Instant& now) const override {
    const double load = now.load_N / now.specimen->reference_load_N;
    const double more = error_ * (1.0 - bend_ + bend_ * load);
    now.load_N *= 1.0 + std::max(-kMostOff, more);  // a tire cannot pull
  }

 private:
  static constexpr double kMostOff = 0.97;

  double error_ = 0.01 * size_;
  double bend_ = note("bend", draws_.uniform(0.3, 0.8));
};

}  // namespace

const EffectKind kind_load_record{
    "load_record",
    {"percent", "true over recorded load at the reference load, less one", 0.0, -30.0, 30.0,
     log_normal(1.0, 5.0, 0.7, 7.0), true},
    {{"scale_or_offset", "mostly a scale or mostly an offset, never one alone", make_law<LoadRecord>},
     {"bent", "an error that grows with the square of the load beside a scale, nothing without load",
      make_law<BentCell>}}};

}  // namespace rollrig::generator
