/// Outside of the catalog: water on the surface for part of the runs: it cools the tread and drags.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::wet_surface {

/// A spell of water, which rises and dries within minutes.
struct Spell {
  double start_s = 0.0;
  double end_s = 0.0;

  double wetness(double time_s) const {
    if (time_s < start_s || end_s <= start_s) return 0.0;
    const double wet = -std::expm1(-(std::min(time_s, end_s) - start_s) / 40.0);
    return wet * std::exp(-std::max(0.0, time_s - end_s) / 180.0);
  }
};

void make_wet_surface(Making& of) {
  const double cooling_W_per_K = of.size;
  const double drag_N = of.draw("drag_N_per_W_per_K_at_80_km_h", uniform(0.02, 0.08));
  const double below_dK = of.draw("wet_bulb_below_air_dK", uniform(2.0, 5.0));
  std::array<Spell, 6> by_run;
  for (Spell& spell : by_run) {
    spell.start_s = of.draws.uniform(200.0, 900.0);
    spell.end_s = spell.start_s + of.draws.uniform(400.0, 1500.0);
    if (of.draws.happens(0.3)) spell.end_s = spell.start_s;  // dry
  }
  // Assumed: a drum throws its water off, a road keeps it.
  const double film = of.specimen.machine->has_vehicle() ? 6.0 : 1.0;
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* run) { run[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* run, Instant& now) {
    const auto index = std::min(static_cast<std::size_t>(std::lround(run[0])), by_run.size() - 1);
    const double wet = by_run[index].wetness(now.time_s);
    const double x = now.speed_m_s / kSpeed80_m_s;
    now.tread_heat_W -= wet * cooling_W_per_K * std::sqrt(x) * (now.rubber_degC - now.ambient_degC + below_dK);
    now.rig_force_N += film * wet * drag_N * cooling_W_per_K * std::pow(x, 1.6);
  };
}

const EffectKind kind{
    "wet_surface",
    {"W/K", "further cooling of the tread at 80 km/h while wet", 0.0, 0.0, 500.0, log_normal(10.0, 50.0, 8.0, 80.0)},
    {{"only",
      "in most runs wet for some minutes, then drying: cooling towards the wet bulb with sqrt(v), drag with v^1.6, six "
      "times as much on a road",
      make_wet_surface}},
    everywhere,
    everywhere,
    true};

}  // namespace rollrig::generator::wet_surface
