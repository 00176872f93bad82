/// The load cell is off by a scale and an offset.
#include <algorithm>

#include "blind/effect.h"

namespace blind {
namespace {

class LoadRecord : public Effect {
 public:
  LoadRecord(double percent, Draws& draws) : error_(0.01 * percent) {
    offset_share_ = draws.happens(0.5) ? draws.uniform(0.0, 0.2) : draws.uniform(0.6, 1.0);
    shape = {{"offset_share", offset_share_}};
  }

  void enter(const double*, Instant& now) const override {
    const double offset_N = offset_share_ * now.specimen->reference_load_N;
    const double more_N = error_ * (offset_N + (1.0 - offset_share_) * now.load_N);
    now.load_N += std::max(more_N, -kLeastLeft * std::max(0.0, now.load_N));  // a tire cannot pull
  }

 private:
  static constexpr double kLeastLeft = 0.97;

  double error_;
  double offset_share_ = 0.0;
};

}  // namespace

extern const EffectKind kind_load_record;
const EffectKind kind_load_record{"load_record",
                                  "percent",
                                  "true over recorded load at the reference load, less one",
                                  0.0,
                                  -30.0,
                                  30.0,
                                  log_normal(1.0, 5.0, 0.7, 7.0),
                                  true,
                                  0.0,
                                  "mostly a scale or mostly an offset, never one alone",
                                  [](double size, Draws& draws, const Specimen&) -> std::unique_ptr<Effect> {
                                    return std::make_unique<LoadRecord>(size, draws);
                                  },
                                  kRigGrounds,
                                  kRigGrounds};

}  // namespace blind
