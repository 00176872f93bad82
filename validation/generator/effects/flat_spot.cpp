/// A flat from standing, rolled out by distance, the faster the warmer the rubber.
#include <array>
#include <cmath>

#include "sim/core/units.h"
#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class FlatSpot : public Effect {
 public:
  explicit FlatSpot(const Making& of) : Effect(of), excess_(0.01 * of.size) {
    const double distance_km = note("distance_km_at_35_degC", of.draws.from(log_normal(4.0, 15.0, 3.0, 20.0)));
    const double apart = note("distances_apart", of.draws.uniform(1.2, 1.8));
    const double set_h = note("set_time_h", of.draws.from(log_normal(0.7, 4.0, 0.4, 6.0)));
    doubling_K_ = note("doubling_K", of.draws.uniform(20.0, 45.0));
    distance_m_ = {1e3 * distance_km / apart, 1e3 * distance_km * apart};
    set_s_ = 3600.0 * set_h;
  }

  std::size_t state_count() const override { return 2; }

  void start(const RunStart& start, double* flat) const override {
    flat[0] = flat[1] = start.recovered_in_rest(set_s_);
  }

  void act(const double* flat, Instant& now) const override {
    now.loss_factor *= 1.0 + 0.5 * excess_ * (flat[0] * flat[0] + flat[1] * flat[1]);
  }

  void rates(const double* flat, const Instant& now, double* rates) const override {
    const double pace = std::exp2((now.rubber_degC - 35.0) / doubling_K_);
    for (std::size_t i = 0; i < 2; ++i) rates[i] = -0.5 * flat[i] * pace * now.speed_m_s / distance_m_[i];
  }

 private:
  double excess_;
  double doubling_K_ = 30.0;
  double set_s_ = 3600.0;
  std::array<double, 2> distance_m_{};
};

/// One depth d, d' = -d^2 v/s_0, faster in warm rubber by Arrhenius' law; the loss is in proportion to it.
class SecondOrderSpot : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* flat) const override { flat[0] = start.recovered_in_rest(set_s_); }

  void act(const double* flat, Instant& now) const override { now.loss_factor *= 1.0 + excess_ * flat[0]; }

  void rates(const double* flat, const Instant& now, double* rates) const override {
    const double pace = std::exp(activation_K_ * (1.0 / 308.15 - 1.0 / (now.rubber_degC + kZeroCelsius_K)));
    rates[0] = -flat[0] * std::abs(flat[0]) * pace * now.speed_m_s / distance_m_;
  }

 private:
  static constexpr double kHalf = 0.69314718;  // ln 2

  double excess_ = 0.01 * size_;
  // Half is gone when it is of a first-order decay.
  double distance_m_ = kHalf * 1e3 * note("distance_km_at_35_degC", draws_.from(log_normal(4.0, 15.0, 3.0, 20.0)));
  double set_s_ = 3600.0 * note("set_time_h", draws_.from(log_normal(0.7, 4.0, 0.4, 6.0)));
  double activation_K_ = note("activation_K", draws_.uniform(15e3, 35e3) / kGasConstant_J_per_mol_K);
};

}  // namespace

const EffectKind kind_flat_spot{
    "flat_spot",
    {"percent", "higher loss after long standing", 0.0, 0.0, 100.0, log_normal(1.0, 8.0, 0.6, 12.0)},
    {{"two_depths", "square of a depth of two parts, each rolled out over its own distance, faster in warm rubber",
      make_law<FlatSpot>},
     {"second_order",
      "one depth, rolled out over distance by a law of second order, 1/(1 + s/s_0), with Arrhenius' law of the "
      "temperature; loss in proportion to it",
      make_law<SecondOrderSpot>}},
    kEveryGround,
    kRigGrounds};

}  // namespace rollrig::generator
