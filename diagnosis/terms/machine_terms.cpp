#include "diagnosis/terms/machine_terms.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "models/reference_conditions.h"
#include "models/tire/drum_curvature.h"

namespace rollrig::models {
namespace {

struct SurfaceRoughness {
  enum Parameter { kChange, kLoadPower };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "surface_roughness";
    info.summary =
        "The surface of one machine is rougher or smoother than that of the other: the tire loses more or less on it";
    info.equation = "F_rr <- F_rr (1 + s (Fz/Fz_ref)^n)";
    info.source = "Assumed: s, 1 to 6 %, either sign; n about 0";
    info.parameters = {{"change_percent",
                        between(-50.0, 50.0),
                        {1.0, 6.0, Prior::Scale::kLog, true},
                        "s, of the loss at the reference load",
                        0.0},
                       {"load_power", between(-1.0, 1.0), {-0.2, 0.2}, "n"}};
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"load_record", "drum_diameter", "torque_gain"};
    info.splitting_tests = {"the same tire at two loads on both machines", "a second load cell under the tire",
                            "abrasive paper of one grade on both drums"};
    return info;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    using std::pow;
    if (value_of(now.motion.load_N) <= 0.0) return;
    const S load = now.motion.load_N / now.context->tire.rolling_resistance.reference_load_N;
    port.factor *= S(1.0) + self.parameter(kChange) * pow(load, self.parameter(kLoadPower));
  }
};

struct DrumDiameter {
  enum Parameter { kError, kTurnsShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "drum_diameter";
    info.summary =
        "The drum of one machine is larger or smaller than its file says, as with a worn or newly covered surface: "
        "the torque has another lever, the tire bends otherwise, and a speed that is counted in turns is off";
    info.equation =
        "D <- D (1 + s): torque times 1 + s, v <- v (1 + g s), F_rr <- F_rr K(D (1 + s))/K(D), inertia at the surface "
        "over (1 + s)^2";
    info.source =
        "K as in the baseline, after ISO 28580. Assumed: s, 0.2 to 2 %, either sign; g, 1 where the speed is counted "
        "in turns of the drum, 0 where it is measured at the surface";
    info.parameters = {{"error_percent",
                        between(-20.0, 20.0),
                        {0.2, 2.0, Prior::Scale::kLog, true},
                        "s, true over stated diameter, less one",
                        0.0},
                       {"turns_share", between(0.0, 1.0), {0.2, 0.8}, "g"}};
    info.acts_on = &is_drum;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"torque_gain", "speed_record", "surface_roughness"};
    info.splitting_tests = {"a tape around the drum", "dead weights on a lever of known length",
                            "hand tachometer on the drum's surface"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    const S factor = S(1.0) + self.parameter(kTurnsShare) * self.parameter(kError);
    port.speed_m_s *= factor;
    port.acceleration_m_s2 *= factor;
  }

  template <class S>
  static void contact(const EffectView<S>& self, const Instant<S>&, ContactPort<S>& port) {
    const S size = S(1.0) + self.parameter(kError);
    port.machine_inertia_factor /= size * size;
  }

  template <class S>
  static void loss(const EffectView<S>& self, const Instant<S>& now, LossPort<S>& port) {
    const S& stated_per_m = now.context->surface_curvature_per_m;
    const S true_per_m = stated_per_m / (S(1.0) + self.parameter(kError));
    const S tire_radius_m = now.context->tire.geometry.outer_diameter_m / S(2.0);
    port.factor *= calc_drum_correction(stated_per_m, true_per_m, tire_radius_m);
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    std::vector<S>* force = port.find_force();
    if (force == nullptr) return;
    for (S& value : *force) value *= S(1.0) + self.parameter(kError);
  }
};

struct AmbientRecord {
  enum Parameter { kError, kSpeedShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "ambient_record";
    info.summary =
        "The air at the tire of one machine is warmer or colder than its thermometer says: the tire runs warmer and "
        "loses less, or the other way round";
    info.equation = "T_amb <- T_amb + e (1 - q + q v/80 km/h)";
    info.source = "Assumed: e, 0.5 to 4 K, either sign; q about 0, other where the drum's wind reaches the thermometer";
    info.parameters = {{"error_dK",
                        between(-30.0, 30.0),
                        {0.5, 4.0, Prior::Scale::kLog, true},
                        "e, true over recorded air temperature at 80 km/h",
                        0.0},
                       {"speed_share", between(-1.0, 1.0), {-0.3, 0.3}, "q, of the error, in proportion to speed"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kMachineForce, quantities::kLinerTemperature, quantities::kCavityPressure};
    info.confused_with = {"cell_air_warming", "convection_law", "surface_warming"};
    info.splitting_tests = {"a second thermometer beside the tire", "both thermometers in one bath"};
    return info;
  }

  template <class S>
  static void input(const EffectView<S>& self, const Instant<S>&, InputPort<S>& port) {
    using std::abs;
    const S& share = self.parameter(kSpeedShare);
    const S x = abs(port.speed_m_s) / get_reference_speed_m_s<S>();
    port.ambient_K += self.parameter(kError) * (S(1.0) - share + share * x);
  }
};

struct LinerRecord {
  enum Parameter { kError, kRiseShare };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "liner_record";
    info.summary = "The thermometer in the tire reads higher or lower on one machine, by more than its offset";
    info.equation = "T <- T + e (1 - q + q (T - 25 degC)/30 K)";
    info.source = "Assumed: e, 0.5 to 4 K, either sign; q, an error of scale or an offset";
    info.parameters = {
        {"error_dK", between(-30.0, 30.0), {0.5, 4.0, Prior::Scale::kLog, true}, "e, shown over true at 55 degC", 0.0},
        {"rise_share", between(0.0, 1.0), {0.2, 0.8}, "q, of the error, in proportion to the rise over 25 degC"}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kLinerTemperature};
    info.clean_in = {quantities::kMachineForce, quantities::kCavityPressure};
    info.confused_with = {"tread_liner_lag"};
    info.splitting_tests = {"both thermometers in one bath"};
    return info;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    std::vector<S>* liner_K = port.find(quantities::kLinerTemperature);
    if (liner_K == nullptr) return;
    const S reference_K = get_reference_temperature_K<S>();
    const S span_K = quantity<S>(30.0, dimension::kTemperature);
    const S& share = self.parameter(kRiseShare);
    for (S& value_K : *liner_K) {
      value_K += self.parameter(kError) * (S(1.0) - share + share * ((value_K - reference_K) / span_K));
    }
  }
};

}  // namespace
}  // namespace rollrig::models

namespace rollrig::diagnosis {
namespace {

/// On every machine the tire brings these along.
constexpr std::array kTireEffects{"tire_temperature", "load_exponent",     "pressure_exponent", "curvature_exponent",
                                  "standing_wave",    "rubber_memory",     "flat_spot",         "tire_loss_in_skim",
                                  "slip_loss",        "gas_heat_transfer", "tread_liner_lag",   "cavity_volume"};

}  // namespace

const char* letter_of_machine(std::size_t machine) { return machine == 0 ? "A" : "B"; }

MachineTerm::MachineTerm(const models::Effect& effect, std::size_t machine)
    : effect_(effect), machine_(machine), info_(effect.info) {
  info_.id += std::string(" on ") + letter_of_machine(machine);
}

bool belongs_to_tire(const std::string& effect) {
  return std::find(kTireEffects.begin(), kTireEffects.end(), effect) != kTireEffects.end();
}

const std::vector<const models::Effect*>& effects_between_machines() {
  static const std::vector<const models::Effect*> effects{
      &models::make_effect<models::SurfaceRoughness>(), &models::make_effect<models::DrumDiameter>(),
      &models::make_effect<models::AmbientRecord>(), &models::make_effect<models::LinerRecord>()};
  return effects;
}

std::vector<std::string> machine_effect_names() {
  std::vector<std::string> names;
  for (const MachineTerm* term : all_machine_terms()) {
    if (term->machine() == 0) names.push_back(term->effect_name());
  }
  std::sort(names.begin(), names.end());
  return names;
}

const std::vector<const MachineTerm*>& all_machine_terms() {
  static const std::vector<MachineTerm> terms = [] {
    std::vector<MachineTerm> made;
    for (const std::size_t machine : {0U, 1U}) {
      for (const models::Effect* effect : models::all_effects()) {
        if (!belongs_to_tire(effect->info.id)) made.emplace_back(*effect, machine);
      }
      for (const models::Effect* effect : effects_between_machines()) made.emplace_back(*effect, machine);
    }
    return made;
  }();
  static const std::vector<const MachineTerm*> all = [] {
    std::vector<const MachineTerm*> pointers;
    for (const MachineTerm& term : terms) pointers.push_back(&term);
    return pointers;
  }();
  return all;
}

std::vector<const Term*> choose_machine_terms(const models::MachineTraits& machine, const models::TireModel& tire,
                                              const std::vector<std::string>& only,
                                              const std::vector<std::string>& without) {
  std::vector<const Term*> chosen;
  for (const MachineTerm* term : all_machine_terms()) {
    const std::string& name = term->effect_name();
    const bool is_seen = models::acts_in(term->info(), machine, tire) && models::is_seen_on(term->info(), machine);
    const bool is_wanted = (only.empty() || std::count(only.begin(), only.end(), name) > 0) &&
                           std::count(without.begin(), without.end(), name) == 0;
    if (is_seen && is_wanted) chosen.push_back(term);
  }
  return chosen;
}

}  // namespace rollrig::diagnosis
