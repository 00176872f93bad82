/// Outside of the catalog: water on the surface for part of the runs: it cools the tread and drags.
#include <algorithm>
#include <array>
#include <cmath>

#include "validation/generator/effect.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

class WetSurface : public Effect {
 public:
  explicit WetSurface(const Making& of) : Effect(of), cooling_W_per_K_(of.size) {
    drag_N_ = note("drag_N_per_W_per_K_at_80_km_h", of.draws.uniform(0.02, 0.08));
    below_dK_ = note("wet_bulb_below_air_dK", of.draws.uniform(2.0, 5.0));
    for (std::size_t i = 0; i < kMostRuns; ++i) {
      start_s_[i] = of.draws.uniform(200.0, 900.0);
      end_s_[i] = start_s_[i] + of.draws.uniform(400.0, 1500.0);
      if (of.draws.happens(0.3)) end_s_[i] = start_s_[i];  // dry
    }
  }

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* run) const override { run[0] = static_cast<double>(start.index); }

  void act(const double* run, Instant& now) const override {
    const double wet = wetness(static_cast<std::size_t>(std::lround(run[0])), now.time_s);
    const double x = now.speed_m_s / kSpeed80_m_s;
    now.tread_heat_W -= wet * cooling_W_per_K_ * std::sqrt(x) * (now.rubber_degC - now.ambient_degC + below_dK_);
    // Assumed: a drum throws its water off, a road keeps it.
    const double film = now.specimen->machine->has_vehicle() ? 6.0 : 1.0;
    now.rig_force_N += film * wet * drag_N_ * cooling_W_per_K_ * std::pow(x, 1.6);
  }

 private:
  static constexpr std::size_t kMostRuns = 6;

  /// Rises and dries within minutes.
  double wetness(std::size_t run, double time_s) const {
    const std::size_t i = std::min(run, kMostRuns - 1);
    if (time_s < start_s_[i] || end_s_[i] <= start_s_[i]) return 0.0;
    const double wet = -std::expm1(-(std::min(time_s, end_s_[i]) - start_s_[i]) / 40.0);
    return wet * std::exp(-std::max(0.0, time_s - end_s_[i]) / 180.0);
  }

  double cooling_W_per_K_;
  double drag_N_ = 0.0;
  double below_dK_ = 0.0;
  std::array<double, kMostRuns> start_s_{};
  std::array<double, kMostRuns> end_s_{};
};

}  // namespace

const EffectKind kind_wet_surface{
    "wet_surface",
    {"W/K", "further cooling of the tread at 80 km/h while wet", 0.0, 0.0, 500.0, log_normal(10.0, 50.0, 8.0, 80.0)},
    {{"only",
      "in most runs wet for some minutes, then drying: cooling towards the wet bulb with sqrt(v), drag with v^1.6, six "
      "times as much on a road",
      make_law<WetSurface>}},
    kEveryGround,
    kEveryGround,
    true};

}  // namespace rollrig::generator
