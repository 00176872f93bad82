/// Waves behind the contact, setting in exponentially or with a soft square.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

constexpr double kSpeed120_m_s = 120.0 / 3.6;

class StandingWave : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    now.heating_force_N += force_N_ * onset(now.speed_m_s) / onset(kSpeed120_m_s) * std::pow(load, load_power_);
  }

 private:
  double onset(double speed_m_s) const { return std::expm1(std::max(0.0, speed_m_s - critical_m_s_) / scale_m_s_); }

  double force_N_ = size_;
  double critical_m_s_ = note("critical_m_s", draws_.from(normal(26.0, 33.0, 24.0, 32.0)));
  double scale_m_s_ = note("scale_m_s", draws_.uniform(3.0, 8.0));
  double load_power_ = note("load_power", draws_.uniform(0.3, 1.2));
};

/// Square of the speed above the critical one, round the corner with a width s.
class SoftSquare : public Effect {
 public:
  using Effect::Effect;

  void act(const double*, Instant& now) const override {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double above = corner(now.speed_m_s) / corner(kSpeed120_m_s);
    now.heating_force_N += force_N_ * above * above * std::pow(load, load_power_);
  }

 private:
  double corner(double speed_m_s) const { return std::log1p(std::exp((speed_m_s - critical_m_s_) / width_m_s_)); }

  double force_N_ = size_;
  double critical_m_s_ = note("critical_m_s", draws_.from(normal(26.0, 33.0, 24.0, 32.0)));
  double width_m_s_ = note("width_m_s", draws_.uniform(0.5, 2.0));  // Assumed
  double load_power_ = note("load_power", draws_.uniform(0.3, 1.2));
};

}  // namespace

const EffectKind kind_standing_wave{
    "standing_wave",
    {"N", "further loss at 120 km/h and the reference load", 0.0, 0.0, 50.0, log_normal(0.5, 4.0, 0.25, 6.0)},
    {{"exponential", "exp((v - v_c)/s) - 1 above the critical speed, with a power of the load; heats the rubber",
      make_law<StandingWave>},
     {"soft_square", "square of a soft corner s ln(1 + exp((v - v_c)/s)), with a power of the load; heats the rubber",
      make_law<SoftSquare>}}};

}  // namespace rollrig::generator
