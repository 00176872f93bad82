/// Heat takes its time through the wall from tread to liner: conduction through layers, or between two nodes.
#include <cmath>
#include <limits>

#include "validation/generator/effect.h"
#include "validation/generator/plant.h"

namespace rollrig::generator {
namespace {

class TreadLinerLag : public Effect {
 public:
  using Effect::Effect;

  void lay_out(Wall& wall) const override {
    if (std::isinf(halves_W_per_K_)) return;
    // Half a wall of conductance K has its middle at 1/4 and 3/4 of its depth: 2 K lies between them.
    wall.layers = layers_;
    wall.conductance_W_per_K = 1.0 / (1.0 / wall.conductance_W_per_K + 2.0 / halves_W_per_K_);
    wall.loss_skew = skew_;
    wall.tread_share_of_air = tread_share_;
  }

 private:
  double halves_W_per_K_ = size_;
  std::size_t layers_ = static_cast<std::size_t>(note("layers", draws_.whole(3, 6)));
  double skew_ = note("loss_skew_to_tread", draws_.uniform(0.0, 0.5));
  double tread_share_ = note("tread_share_of_air", draws_.uniform(0.6, 1.0));
};

/// Two halves of the wall, each at one temperature, and the conductance between them.
class TwoNodes : public Effect {
 public:
  using Effect::Effect;

  void lay_out(Wall& wall) const override {
    if (std::isinf(between_W_per_K_)) return;
    wall.layers = 2;
    wall.conductance_W_per_K =
        0.5 * between_W_per_K_;  // of the whole wall; twice as much lies between its halves' middles
    wall.loss_skew = skew_;
    wall.tread_share_of_air = tread_share_;
  }

 private:
  double between_W_per_K_ = size_;
  double skew_ = note("loss_skew_to_tread", draws_.uniform(0.0, 0.5));
  double tread_share_ = note("tread_share_of_air", draws_.uniform(0.6, 1.0));
};

}  // namespace

const EffectKind kind_tread_liner_lag{
    "tread_liner_lag",
    {"W/K", "conductance between the middles of the two halves of the wall", std::numeric_limits<double>::infinity(),
     5.0, std::numeric_limits<double>::infinity(), log_normal(30.0, 150.0, 20.0, 230.0)},
    {{"layers",
      "conduction through three to six radial layers, each losing at its own temperature, more towards the tread; road "
      "and most of the air cool the outermost, the sensor and the gas see the innermost",
      make_law<TreadLinerLag>},
     {"two_nodes",
      "two nodes, each with half of the heat and a loss of its own temperature; road and most of the air cool the "
      "tread, the sensor and the gas see the liner",
      make_law<TwoNodes>}}};

}  // namespace rollrig::generator
