/// Heat takes its time through the wall from tread to liner: conduction through layers, or between two nodes.
#include <cmath>
#include <limits>

#include "validation/generator/effect.h"
#include "validation/generator/plant.h"

namespace blind {
namespace {

class TreadLinerLag : public Effect {
 public:
  TreadLinerLag(double halves_W_per_K, Draws& draws) : halves_W_per_K_(halves_W_per_K) {
    layers_ = static_cast<std::size_t>(draws.whole(3, 6));
    skew_ = draws.uniform(0.0, 0.5);
    tread_share_ = draws.uniform(0.6, 1.0);
    shape = {
        {"layers", static_cast<double>(layers_)}, {"loss_skew_to_tread", skew_}, {"tread_share_of_air", tread_share_}};
  }

  void lay_out(Wall& wall) const override {
    if (std::isinf(halves_W_per_K_)) return;
    // Half a wall of conductance K has its middle at 1/4 and 3/4 of its depth: 2 K lies between them.
    wall.layers = layers_;
    wall.conductance_W_per_K = 1.0 / (1.0 / wall.conductance_W_per_K + 2.0 / halves_W_per_K_);
    wall.loss_skew = skew_;
    wall.tread_share_of_air = tread_share_;
  }

 private:
  double halves_W_per_K_;
  std::size_t layers_ = 6;
  double skew_ = 0.0;
  double tread_share_ = 1.0;
};

/// Two halves of the wall, each at one temperature, and the conductance between them.
class TwoNodes : public Effect {
 public:
  TwoNodes(double between_W_per_K, Draws& draws) : between_W_per_K_(between_W_per_K) {
    skew_ = draws.uniform(0.0, 0.5);
    tread_share_ = draws.uniform(0.6, 1.0);
    shape = {{"loss_skew_to_tread", skew_}, {"tread_share_of_air", tread_share_}};
  }

  void lay_out(Wall& wall) const override {
    if (std::isinf(between_W_per_K_)) return;
    wall.layers = 2;
    wall.conductance_W_per_K =
        0.5 * between_W_per_K_;  // of the whole wall; twice as much lies between its halves' middles
    wall.loss_skew = skew_;
    wall.tread_share_of_air = tread_share_;
  }

 private:
  double between_W_per_K_;
  double skew_ = 0.0;
  double tread_share_ = 1.0;
};

}  // namespace

extern const EffectKind kind_tread_liner_lag;
const EffectKind kind_tread_liner_lag{"tread_liner_lag",
                                      "W/K",
                                      "conductance between the middles of the two halves of the wall",
                                      std::numeric_limits<double>::infinity(),
                                      5.0,
                                      std::numeric_limits<double>::infinity(),
                                      log_normal(30.0, 150.0, 20.0, 230.0),
                                      false,
                                      0.0,
                                      {{"layers",
                                        "conduction through three to six radial layers, each losing at its own "
                                        "temperature, more towards the tread; road and most "
                                        "of the air cool the outermost, the sensor and the gas see the innermost",
                                        make_law<TreadLinerLag>},
                                       {"two_nodes",
                                        "two nodes, each with half of the heat and a loss of its own temperature; road "
                                        "and most of the air cool the tread, the sensor and the gas see the liner",
                                        make_law<TwoNodes>}}};

}  // namespace blind
