#pragma once
/// What an effect declares, and how its functions reach the ports.
///
/// An effect is one file, models/effects/<id>.cpp: a struct with a static `info()` and a static function
/// template for each port that it uses, handed to make_effect(). See docs/add_an_effect.md.

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "models/tire/tire_model.h"

namespace rollrig::models {

/// What is known of a parameter before any measurement, in the unit of its key: about two thirds of the
/// belief lie between low and high. With both positive on a log scale, else on a linear one.
struct Prior {
  enum class Scale { kLinear, kLog };
  double low = 0.0;
  double high = 0.0;
  Scale scale = Scale::kLinear;
  bool either_sign = false;  // low and high are of the magnitude; the sign is as likely minus as plus

  double center() const;
};

struct EffectParameter {
  const char* key;  // name with unit; the key in [effects.<id>]
  Range range;      // in the unit of the key
  Prior prior;      // in the unit of the key
  const char* doc;
  std::optional<double> off = std::nullopt;  // value at which the effect does nothing; shape parameters have none
};

struct EffectState {
  const char* key;  // name with unit
  double scale_SI;  // size that matters, for the integrator's tolerance
  const char* doc;
};

/// How far an effect's law may be from the truth, where that is more than usual: shares of what it changes.
struct LawError {
  double law_share = 0.0;    // of what nothing else can change
  double whole_share = 0.0;  // of all that it changes, base parameters held
};

/// Everything about an effect that is not an equation in code.
struct EffectInfo {
  std::string id;
  std::string summary;
  std::string equation;
  std::string source;
  std::vector<EffectParameter> parameters;  // the size first
  std::vector<EffectState> states;
  bool (*acts_on)(const MachineTraits&) = &is_any;    // elsewhere a corner leaves it out
  const char* only_against = nullptr;                 // id of the tire model that lacks it; others have it
  bool (*faint_on)(const MachineTraits&) = &is_none;  // of these, where it changes too little to be seen
  NodeSet nodes{};                         // thermal nodes that it adds; it does not act on a tire model that has them
  std::vector<Quantity> visible_in;        // measured ones that a finite size changes, on machines that have them
  std::vector<Quantity> clean_in;          // likewise: those that it leaves bit-identical
  std::vector<std::string> confused_with;  // ids
  std::vector<std::string> splitting_tests;  // tests that tell it from those
  LawError law_error{};                      // where it exceeds the diagnosis' usual shares
};

/// Whether the effect changes anything on such a machine with a tire of that model.
bool acts_in(const EffectInfo& info, const MachineTraits& machine, const TireModel& model);
/// Whether it changes enough on such a machine to be seen.
bool is_seen_on(const EffectInfo& info, const MachineTraits& machine);

/// An effect's own numbers at one instant.
template <class S>
class EffectView {
 public:
  EffectView(const S* parameters, const S* states) : parameters_(parameters), states_(states) {}
  const S& parameter(std::size_t i) const { return parameters_[i]; }
  const S& state(std::size_t i) const { return states_[i]; }

 private:
  const S* parameters_;
  const S* states_;
};

/// An effect's functions for one scalar; nullptr for a port that it does not use.
template <class S>
struct EffectHooks {
  void (*input)(const EffectView<S>&, const Instant<S>&, InputPort<S>&) = nullptr;
  void (*boundary)(const EffectView<S>&, const Instant<S>&, BoundaryPort<S>&) = nullptr;
  void (*gas)(const EffectView<S>&, const Instant<S>&, GasPort<S>&) = nullptr;
  void (*contact)(const EffectView<S>&, const Instant<S>&, ContactPort<S>&) = nullptr;
  void (*loss)(const EffectView<S>&, const Instant<S>&, LossPort<S>&) = nullptr;
  void (*parasitic)(const EffectView<S>&, const Instant<S>&, ParasiticPort<S>&) = nullptr;
  void (*thermal)(const EffectView<S>&, const Instant<S>&, ThermalPort<S>&) = nullptr;
  void (*rates)(const EffectView<S>&, const Instant<S>&, S* state_rates) = nullptr;
  void (*initial)(const EffectView<S>&, const InitialPort<S>&, S* states) = nullptr;
  void (*inflated)(const EffectView<S>&, S* states) = nullptr;
  void (*trace)(const EffectView<S>&, TracePort<S>&) = nullptr;
};

/// An effect as the registry holds it: what it declares, and its functions for the three scalars.
struct Effect {
  EffectInfo info;
  ForEachScalar<EffectHooks> by_scalar;

  template <class S>
  const EffectHooks<S>& hooks() const {
    return std::get<EffectHooks<S>>(by_scalar);
  }
};

namespace detail {

/// Sets a hook to what `find` gives for E; leaves it nullptr where E has no such function.
template <class E, class Hook, class Find>
void set_where_found(Hook& hook, Find find) {
  if constexpr (std::is_invocable_v<Find, E>) hook = find(E{});
}

template <class E, class S>
EffectHooks<S> find_hooks() {
  EffectHooks<S> hooks;
#define ROLLRIG_SET_HOOK(port)                                                                      \
  set_where_found<E>(hooks.port, [](auto effect) -> decltype(&decltype(effect)::template port<S>) { \
    return &decltype(effect)::template port<S>;                                                     \
  });
  ROLLRIG_SET_HOOK(input)
  ROLLRIG_SET_HOOK(boundary)
  ROLLRIG_SET_HOOK(gas)
  ROLLRIG_SET_HOOK(contact)
  ROLLRIG_SET_HOOK(loss)
  ROLLRIG_SET_HOOK(parasitic)
  ROLLRIG_SET_HOOK(thermal)
  ROLLRIG_SET_HOOK(rates)
  ROLLRIG_SET_HOOK(initial)
  ROLLRIG_SET_HOOK(inflated)
  ROLLRIG_SET_HOOK(trace)
#undef ROLLRIG_SET_HOOK
  return hooks;
}

}  // namespace detail

/// The effect that struct E describes.
template <class E>
const Effect& make_effect() {
  static const Effect effect{
      E::info(),
      {detail::find_hooks<E, double>(), detail::find_hooks<E, Jet>(), detail::find_hooks<E, DimensionedScalar>()}};
  return effect;
}

/// An effect switched on, with its parameters in SI units, in the order of its declaration.
struct ActiveEffect {
  const Effect* effect = nullptr;
  std::vector<double> parameters;
};

/// All effects, in the order of models/effects/effects.def.
const std::vector<const Effect*>& all_effects();
std::vector<std::string> effect_ids();
/// Throws InputError with the nearest known id.
const Effect& find_effect(const std::string& id);

/// Reads [effects.<id>] tables: parameters left out take the center of their prior. Throws InputError.
std::vector<ActiveEffect> read_effects(const ConfigTable& effects);

/// For a person: "<id> (<key> = <value in the unit of the key>, ...)", one after the other.
std::string describe_effects(const std::vector<ActiveEffect>& effects);

}  // namespace rollrig::models
