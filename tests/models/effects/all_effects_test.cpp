// What holds for every effect at one corner, on every kind of rig, whether a campaign runs there or not.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Effect;
using models::Node;
using tests::HandFedCorner;

namespace {

/// The tire model on which an effect acts.
std::string model_for(const Effect& effect) {
  return effect.info.only_against != nullptr ? effect.info.only_against : "combined";
}

/// Everything that an effect may change, after ten minutes of fast driving and some braking.
std::vector<double> drive(tests::Machine kind, const std::vector<models::ActiveEffect>& effects,
                          const std::string& model) {
  models::Context<double> context = tests::make_context_on(kind);
  context.tire.own = tests::make_own(model);
  context.tire.constant.rrc = 0.0075;
  HandFedCorner<double> at(context, effects);
  at.inputs.speed_m_s = 36.0;
  at.inputs.load_N = 5000.0;
  at.inputs.drive_force_N = is_of_vehicle(kind->traits) ? -400.0 : 0.0;
  at.inputs.brake_force_N = is_of_vehicle(kind->traits) ? 400.0 : 0.0;
  at.inputs.slip_power_W = 20.0;
  at.advance(600.0, 200);
  return {at.now.rolling_resistance_N,
          at.now.parasitic_N,
          at.now.pressure_Pa,
          at.now.heat.heat_in_W,
          at.now.contact.slip_compliance_per_N,
          at.now.contact.machine_inertia_factor,
          at.temperature_K(Node::kLiner),
          at.temperature_K(Node::kGas)};
}

std::vector<double> drive_at_size(tests::Machine kind, const Effect& effect, double size) {
  return drive(kind, {tests::switch_on(effect.info.id, {size})}, model_for(effect));
}

/// Whether some quantity moves further and further off as the size grows.
bool something_grows(tests::Machine kind, const Effect& effect) {
  const models::EffectParameter& size = effect.info.parameters[0];
  const double reach = size.prior.high - *size.off;
  const auto baseline = drive(kind, {}, model_for(effect));
  const auto small = drive_at_size(kind, effect, *size.off + 0.25 * reach);
  const auto middle = drive_at_size(kind, effect, *size.off + 0.5 * reach);
  const auto large = drive_at_size(kind, effect, *size.off + reach);
  for (std::size_t i = 0; i < baseline.size(); ++i) {
    const double by_small = std::abs(small[i] - baseline[i]);
    const double by_middle = std::abs(middle[i] - baseline[i]);
    if (by_small > 0.0 && by_middle > 1.1 * by_small && std::abs(large[i] - baseline[i]) > 1.1 * by_middle) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("every effect is the baseline to the bit at its off value, and where it does not act", "[fast]") {
  for (const Effect* effect : models::all_effects()) {
    for (const tests::Machine kind : rigs::machine_kinds()) {
      INFO(effect->info.id << " on " << kind->word);
      const models::EffectParameter& size = effect->info.parameters[0];
      const bool acts = effect->info.acts_on(kind->traits);
      CHECK(drive_at_size(kind, *effect, acts ? *size.off : size.prior.high) == drive(kind, {}, model_for(*effect)));
    }
  }
}

TEST_CASE("every effect grows with its size", "[fast]") {
  for (const Effect* effect : models::all_effects()) {
    if (effect->hooks<double>().trace != nullptr) continue;  // not at the corner
    if (effect->info.id == "wind_and_grade") continue;       // on the vehicle: measurements/road_resimulation_test.cpp
    for (const tests::Machine kind : rigs::machine_kinds()) {
      if (!effect->info.acts_on(kind->traits)) continue;
      if (effect->info.id == "curvature_exponent" && kind == tests::kDrum) continue;  // the reference drum
      INFO(effect->info.id << " on " << kind->word);
      CHECK(something_grows(kind, *effect));
    }
  }
}

TEST_CASE("an effect that a tire model has already does nothing on such a tire", "[fast]") {
  for (const Effect* effect : models::all_effects()) {
    if (effect->info.only_against == nullptr) continue;
    INFO(effect->info.id);
    const models::ActiveEffect large = tests::switch_on(effect->info.id, {effect->info.parameters[0].prior.high});
    CHECK(drive(tests::kDyno, {large}, "combined") == drive(tests::kDyno, {}, "combined"));
  }
}
