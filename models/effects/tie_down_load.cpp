/// The restraint of a vehicle on rollers presses its wheels down.
#include "models/effect.h"

namespace rollrig::models {
namespace {

struct TieDownLoad {
  enum Parameter { kLoad };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "tie_down_load";
    info.summary = "The tie-downs press every wheel onto its roller with more than the recorded load";
    info.equation = "Fz <- Fz + dF, where Fz > 0";
    info.source = "source §3.4.2 (vehicle held by tie-downs); 50 to 400 N a wheel: effects.md";
    info.parameters = {
        {"added_load_N", between(-1000.0, 3000.0), {50.0, 400.0, Prior::Scale::kLog}, "dF, of one wheel", 0.0}};
    info.acts_on = {RigKind::kDyno};
    info.visible_in = {"loss_force_N", "liner_temperature_degC", "cavity_pressure_kPa"};
    info.confused_with = {"curvature_exponent", "load_record"};
    info.splitting_tests = {"tie-downs slack and tight", "wheel load cells under the rollers"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    if (value_of(port.load_N) <= 0.0) return;  // the rollers alone: no vehicle stands on them
    port.load_N += self.parameter(kLoad);
  }
};

}  // namespace

const Effect& effect_tie_down_load() {
  static const Effect effect = make_effect<TieDownLoad>();
  return effect;
}

}  // namespace rollrig::models
