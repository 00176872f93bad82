/// Outside of the catalog: for parts of a trip the vehicle drives in the wake of another.
#include <array>
#include <cmath>

#include "validation/generator/effect.h"

namespace rollrig::generator {
namespace {

class Drafting : public Effect {
 public:
  explicit Drafting(const Making& of) : Effect(of), share_(0.01 * of.size) {
    for (double& phase : phases_) phase = of.draws.uniform(0.0, 6.2831853);
    meeting_m_ = 1e3 * of.draws.uniform(3.0, 10.0);
    shape = {{"meeting_km", 1e-3 * meeting_m_}};
  }

  std::size_t state_count() const override { return 1; }
  void start(const RunStart& start, double* run) const override { run[0] = static_cast<double>(start.index); }

  void act(const double* run, Instant& now) const override {
    const double turn = 6.2831853 * now.distance_m / meeting_m_ + 1.7 * run[0];
    const double near =
        0.5 * (1.0 + std::tanh(3.0 * (std::sin(turn + phases_[0]) + 0.5 * std::sin(0.37 * turn + phases_[1]))));
    now.drag_factor *= 1.0 - share_ * near;
  }

 private:
  double share_;
  double meeting_m_ = 1.0;
  std::array<double, 2> phases_{};
};

}  // namespace

const EffectKind kind_drafting{
    "drafting",
    {"percent", "drag saved in the wake", 0.0, 0.0, 80.0, log_normal(10.0, 30.0, 8.0, 40.0)},
    {{"only", "the drag falls and comes back over stretches of some km", make_law<Drafting>}},
    kRoadGrounds,
    kRoadGrounds,
    true};

}  // namespace rollrig::generator
