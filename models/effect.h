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

#include "models/ports.h"

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
  std::vector<RigKind> acts_on{RigKind::kDrum, RigKind::kDyno, RigKind::kFlat};  // elsewhere a corner leaves it out
  std::optional<Baseline> only_against = std::nullopt;  // the baseline that lacks it; the other has it
  std::vector<RigKind> faint_on{};                      // of these, where it changes too little to be seen
  NodeSet nodes{};                                      // thermal nodes that it needs beside the baseline's
  std::vector<std::string> visible_in;       // measured channels, of any rig kind, that a finite size changes
  std::vector<std::string> clean_in;         // measured channels, of any rig kind, that it leaves bit-identical
  std::vector<std::string> confused_with;    // ids
  std::vector<std::string> splitting_tests;  // tests that tell it from those
  LawError law_error{};                      // where it exceeds the diagnosis' usual shares
};

/// The word for a rig kind in files and on pages.
const char* name_of(RigKind kind);

/// Whether the effect changes anything on such a rig.
bool acts_on(const EffectInfo& info, RigKind kind);
/// The same against a baseline.
bool acts_in(const EffectInfo& info, RigKind kind, Baseline baseline);

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
  EffectHooks<double> on_double;
  EffectHooks<Jet> on_jet;
  EffectHooks<DimensionedScalar> on_dimensioned;

  template <class S>
  const EffectHooks<S>& hooks() const;
};

template <>
inline const EffectHooks<double>& Effect::hooks<double>() const {
  return on_double;
}
template <>
inline const EffectHooks<Jet>& Effect::hooks<Jet>() const {
  return on_jet;
}
template <>
inline const EffectHooks<DimensionedScalar>& Effect::hooks<DimensionedScalar>() const {
  return on_dimensioned;
}

namespace detail {

// Finds E::port<S> where E has it; leaves the hook nullptr where it has not.
#define ROLLRIG_FIND_HOOK(port)                           \
  template <class E, class S>                             \
  auto find_##port(int)->decltype(&E::template port<S>) { \
    return &E::template port<S>;                          \
  }                                                       \
  template <class E, class S>                             \
  std::nullptr_t find_##port(long) {                      \
    return nullptr;                                       \
  }
ROLLRIG_FIND_HOOK(input)
ROLLRIG_FIND_HOOK(boundary)
ROLLRIG_FIND_HOOK(gas)
ROLLRIG_FIND_HOOK(contact)
ROLLRIG_FIND_HOOK(loss)
ROLLRIG_FIND_HOOK(parasitic)
ROLLRIG_FIND_HOOK(thermal)
ROLLRIG_FIND_HOOK(rates)
ROLLRIG_FIND_HOOK(initial)
ROLLRIG_FIND_HOOK(inflated)
ROLLRIG_FIND_HOOK(trace)
#undef ROLLRIG_FIND_HOOK

template <class E, class S>
EffectHooks<S> find_hooks() {
  EffectHooks<S> hooks;
  hooks.input = find_input<E, S>(0);
  hooks.boundary = find_boundary<E, S>(0);
  hooks.gas = find_gas<E, S>(0);
  hooks.contact = find_contact<E, S>(0);
  hooks.loss = find_loss<E, S>(0);
  hooks.parasitic = find_parasitic<E, S>(0);
  hooks.thermal = find_thermal<E, S>(0);
  hooks.rates = find_rates<E, S>(0);
  hooks.initial = find_initial<E, S>(0);
  hooks.inflated = find_inflated<E, S>(0);
  hooks.trace = find_trace<E, S>(0);
  return hooks;
}

}  // namespace detail

/// The effect that struct E describes.
template <class E>
Effect make_effect() {
  return {E::info(), detail::find_hooks<E, double>(), detail::find_hooks<E, Jet>(),
          detail::find_hooks<E, DimensionedScalar>()};
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
