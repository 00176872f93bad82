/// The cavity shrinks under load and grows with speed, and works on its gas.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

constexpr double kReference_N = 5400.0;
constexpr double kFollows_s = 0.5;  // Assumed: about as the load settles

class CavityVolume : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* state) const override {
    state[0] = -shrink_ * std::pow(std::max(0.0, start.first_load_N) / kReference_N, load_power_);
  }

  void enter(const double* state, Instant& now) const override {
    now.volume_factor *= 1.0 + state[0];
    now.volume_rate_per_s += (aim(now) - state[0]) / kFollows_s;
  }

  void rates(const double* state, const Instant& now, double* rates) const override {
    rates[0] = (aim(now) - state[0]) / kFollows_s;
  }

 private:
  double aim(const Instant& now) const {
    const double load = std::max(0.0, now.load_N) / kReference_N;
    const double x = now.speed_m_s / kSpeed80_m_s;
    return shrink_ * (growth_ * x * x - std::pow(load, load_power_));
  }

  double shrink_ = 0.01 * size_;
  double load_power_ = note("load_power", draws_.uniform(0.9, 1.5));
  double growth_ = note("growth_at_80_km_h_over_size", draws_.uniform(0.1, 0.5));
};

/// The segment that the contact cuts off goes with d^(3/2), d = Fz/(s + (1 - s) p/p_ref) the deflection over that at
/// 5.4 kN and the reference pressure.
class SegmentOfContact : public Effect {
 public:
  using Effect::Effect;

  std::size_t state_count() const override { return 1; }

  void start(const RunStart& start, double* state) const override {
    state[0] = -shrink_ * segment(start.first_load_N, start.cold_pressure_kPa);
  }

  void enter(const double* state, Instant& now) const override { now.volume_factor *= 1.0 + state[0]; }

  void act(const double* state, Instant& now) const override { now.volume_rate_per_s += rate_per_s(state, now); }

  void rates(const double* state, const Instant& now, double* rates) const override {
    rates[0] = rate_per_s(state, now);
  }

 private:
  double segment(double load_N, double pressure_kPa) const {
    const double stiffness = carcass_ + (1.0 - carcass_) * pressure_kPa / reference_kPa_;
    return std::pow(std::max(0.0, load_N) / kReference_N / stiffness, 1.5);
  }

  double rate_per_s(const double* state, const Instant& now) const {
    const double x = now.speed_m_s / kSpeed80_m_s;
    const double aim = shrink_ * (growth_ * x * x - segment(now.load_N, now.pressure_kPa));
    return (aim - state[0]) / kFollows_s;
  }

  double shrink_ = 0.01 * size_;
  double carcass_ =
      note("carcass_share", draws_.uniform(0.1, 0.4));  // Assumed: share of the stiffness without pressure
  double growth_ = note("growth_at_80_km_h_over_size", draws_.uniform(0.1, 0.5));
  double reference_kPa_ = specimen_.reference_pressure_kPa;
};

}  // namespace

const EffectKind kind_cavity_volume{
    "cavity_volume",
    {"percent", "smaller volume at 5.4 kN and the reference pressure than without load", 0.0, 0.0, 10.0,
     log_normal(0.15, 1.0, 0.1, 1.4)},
    {{"power",
      "a power of the load, and growth with v^2; the change does work on the gas, which warms or cools by it and comes "
      "back as heat flows; filled without load",
      make_law<CavityVolume>},
     {"segment",
      "the segment that the contact cuts off, deflection^(3/2), where the deflection is load over a stiffness that "
      "follows the pressure; growth with v^2; works on the gas",
      make_law<SegmentOfContact>}}};

}  // namespace rollrig::generator
