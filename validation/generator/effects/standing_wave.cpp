/// Waves behind the contact, setting in exponentially or with a soft square.
#include <algorithm>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator::standing_wave {

constexpr double kSpeed120_m_s = 120.0 / 3.6;

void make_exponential(Making& of) {
  const double force_N = of.size;
  const double critical_m_s = of.draw("critical_m_s", normal(26.0, 33.0, 24.0, 32.0));
  const double scale_m_s = of.draw("scale_m_s", uniform(3.0, 8.0));
  const double load_power = of.draw("load_power", uniform(0.3, 1.2));
  const auto onset = [=](double speed_m_s) { return std::expm1(std::max(0.0, speed_m_s - critical_m_s) / scale_m_s); };
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    now.heating_force_N += force_N * onset(now.speed_m_s) / onset(kSpeed120_m_s) * std::pow(load, load_power);
  };
}

/// Square of the speed above the critical one, round the corner with a width s.
void make_soft_square(Making& of) {
  const double force_N = of.size;
  const double critical_m_s = of.draw("critical_m_s", normal(26.0, 33.0, 24.0, 32.0));
  const double width_m_s = of.draw("width_m_s", uniform(0.5, 2.0));  // Assumed
  const double load_power = of.draw("load_power", uniform(0.3, 1.2));
  const auto corner = [=](double speed_m_s) { return std::log1p(std::exp((speed_m_s - critical_m_s) / width_m_s)); };
  of.effect.act = [=](const double*, Instant& now) {
    const double load = std::max(0.0, now.load_N) / now.specimen->reference_load_N;
    const double above = corner(now.speed_m_s) / corner(kSpeed120_m_s);
    now.heating_force_N += force_N * above * above * std::pow(load, load_power);
  };
}

const EffectKind kind{
    "standing_wave",
    {"N", "further loss at 120 km/h and the reference load", 0.0, 0.0, 50.0, log_normal(0.5, 4.0, 0.25, 6.0)},
    {{"exponential", "exp((v - v_c)/s) - 1 above the critical speed, with a power of the load; heats the rubber",
      make_exponential},
     {"soft_square", "square of a soft corner s ln(1 + exp((v - v_c)/s)), with a power of the load; heats the rubber",
      make_soft_square}}};

}  // namespace rollrig::generator::standing_wave
