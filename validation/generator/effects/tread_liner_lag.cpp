/// Heat takes its time through the wall from tread to liner: conduction through layers, or between two nodes.
#include <cmath>
#include <limits>

#include "validation/generator/effect.h"
#include "validation/generator/plant.h"

namespace rollrig::generator::tread_liner_lag {

void make_layers(Making& of) {
  const double halves_W_per_K = of.size;
  const auto layers = static_cast<std::size_t>(of.note("layers", of.draws.whole(3, 6)));
  const double skew = of.draw("loss_skew_to_tread", uniform(0.0, 0.5));
  const double tread_share = of.draw("tread_share_of_air", uniform(0.6, 1.0));
  of.effect.lay_out = [=](Wall& wall) {
    if (std::isinf(halves_W_per_K)) return;
    // Half a wall of conductance K has its middle at 1/4 and 3/4 of its depth: 2 K lies between them.
    wall = {layers, 1.0 / (1.0 / wall.conductance_W_per_K + 2.0 / halves_W_per_K), skew, tread_share};
  };
}

/// Two halves of the wall, each at one temperature, and the conductance between them.
void make_two_nodes(Making& of) {
  const double between_W_per_K = of.size;
  const double skew = of.draw("loss_skew_to_tread", uniform(0.0, 0.5));
  const double tread_share = of.draw("tread_share_of_air", uniform(0.6, 1.0));
  of.effect.lay_out = [=](Wall& wall) {
    if (std::isinf(between_W_per_K)) return;
    // Of the whole wall; twice as much lies between its halves' middles.
    wall = {2, 0.5 * between_W_per_K, skew, tread_share};
  };
}

const EffectKind kind{
    "tread_liner_lag",
    {"W/K", "conductance between the middles of the two halves of the wall", std::numeric_limits<double>::infinity(),
     5.0, std::numeric_limits<double>::infinity(), log_normal(30.0, 150.0, 20.0, 230.0)},
    {{"layers",
      "conduction through three to six radial layers, each losing at its own temperature, more towards the tread; road "
      "and most of the air cool the outermost, the sensor and the gas see the innermost",
      make_layers},
     {"two_nodes",
      "two nodes, each with half of the heat and a loss of its own temperature; road and most of the air cool the "
      "tread, the sensor and the gas see the liner",
      make_two_nodes}}};

}  // namespace rollrig::generator::tread_liner_lag
