/// Outside of the catalog: the surface changes: polished from run to run on a rig, patch by patch on a road.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator::surface_texture {

void make_surface_texture(Making& of) {
  constexpr double kRunWay_m = 6e4;
  constexpr double kRoadOverRig = 2.5;  // Assumed: chippings against smooth asphalt
  const double change = 0.01 * of.size;
  const bool on_road = of.specimen.machine->has_vehicle();
  const double wears_in_runs = of.draw("wears_in_runs", uniform(1.5, 4.0));
  const double patch_m = 1e3 * of.draws.uniform(2.0, 8.0);
  of.note("patch_km", 1e-3 * patch_m);
  const double phase = of.draws.uniform(0.0, 6.2831853);
  of.effect.state_count = 1;
  of.effect.start = [](const RunStart& start, double* runs) { runs[0] = static_cast<double>(start.index); };
  of.effect.act = [=](const double* runs, Instant& now) {
    const double patch = std::tanh(2.0 * std::sin(now.distance_m / patch_m * 3.1415927 + phase + 2.1 * runs[0]));
    now.loss_factor *= 1.0 + change * (on_road ? kRoadOverRig * patch : std::expm1(-runs[0] / wears_in_runs));
  };
  of.effect.rates = [=](const double*, const Instant& now, double* rates) {
    rates[0] = on_road ? 0.0 : now.speed_m_s * now.load_N / now.specimen->reference_load_N / kRunWay_m;
  };
}

const EffectKind kind{
    "surface_texture",
    {"percent", "fall of the loss as the surface wears in; on a road patches differ by five times that", 0.0, 0.0, 80.0,
     log_normal(5.0, 15.0, 4.0, 20.0)},
    {{"only", "exponential in runs and way rolled on a rig; on a road rough and smooth patches of some km by turns",
      make_surface_texture}},
    everywhere,
    everywhere,
    true};

}  // namespace rollrig::generator::surface_texture
