/// Outside of the catalog: the surface changes: polished from run to run on a rig, patch by patch on a road.
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

class SurfaceTexture : public Effect {
 public:
  explicit SurfaceTexture(const Making& of) : Effect(of), change_(0.01 * of.size) {
    runs_ = of.draws.uniform(1.5, 4.0);
    patch_m_ = 1e3 * of.draws.uniform(2.0, 8.0);
    phase_ = of.draws.uniform(0.0, 6.2831853);
    shape = {{"wears_in_runs", runs_}, {"patch_km", 1e-3 * patch_m_}};
  }

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* runs) const override { runs[0] = static_cast<double>(start.index); }

  void act(const double* runs, Instant& now) const override {
    const bool on_road = now.specimen->machine->has_vehicle();
    const double patch = std::tanh(2.0 * std::sin(now.distance_m / patch_m_ * 3.1415927 + phase_ + 2.1 * runs[0]));
    now.loss_factor *= 1.0 + change_ * (on_road ? kRoadOverRig * patch : std::expm1(-runs[0] / runs_));
  }

  void rates(const double*, const Instant& now, double* rates) const override {
    const bool on_road = now.specimen->machine->has_vehicle();
    rates[0] = on_road ? 0.0 : now.speed_m_s * now.load_N / now.specimen->reference_load_N / kRunWay_m;
  }

 private:
  static constexpr double kRunWay_m = 6e4;
  static constexpr double kRoadOverRig = 2.5;  // Assumed: chippings against smooth asphalt

  double change_;
  double runs_ = 1.0;
  double patch_m_ = 1.0;
  double phase_ = 0.0;
};

}  // namespace

const EffectKind kind_surface_texture{
    "surface_texture",
    {"percent", "fall of the loss as the surface wears in; on a road patches differ by five times that", 0.0, 0.0, 80.0,
     log_normal(5.0, 15.0, 4.0, 20.0)},
    {{"only", "exponential in runs and way rolled on a rig; on a road rough and smooth patches of some km by turns",
      make_law<SurfaceTexture>}},
    kEveryGround,
    kEveryGround,
    true};

}  // namespace rollrig::generator
