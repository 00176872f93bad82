#pragma once
/// One corner: a tire on its surface with the parasitic loss of the machine under it, and every effect
/// that is switched on, evaluated port by port. Both fidelities call it, so they share all physics.

#include <string>
#include <vector>

#include "models/effect.h"
#include "models/tire/drum_curvature.h"

namespace rollrig::models {

/// A state of a corner.
struct CornerState {
  Quantity quantity;
  double scale_SI = 1.0;  // size that matters, for the integrator's tolerance
};

template <class S>
class Corner {
 public:
  /// An effect with its parameters in scalar S and the place of its states. Where it does not act on this
  /// kind of rig, its states stay and its hooks are empty.
  struct Installed {
    const Effect* effect;
    const EffectHooks<S>* hooks;
    std::vector<S> parameters;
    std::size_t first_state;
  };

  Corner(Context<S> context, const std::vector<ActiveEffect>& effects);

  const Context<S>& context() const { return context_; }
  /// Effects that are on, in the order of the registry; their parameters may be set anew.
  std::vector<Installed>& effects() { return effects_; }
  const std::vector<Installed>& effects() const { return effects_; }
  const std::vector<CornerState>& states() const { return states_; }
  std::size_t state_count() const { return states_.size(); }
  const NodeSet& nodes() const { return nodes_; }
  std::size_t state_of(Node node) const { return node_state_[index_of(node)]; }

  /// States of a tire whose nodes all have one temperature.
  void initialize(const S& temperature_K, const InitialPort<S>& initial, S* x) const;

  /// Sets the pressure to `pressure_Pa` (gauge) at the gas's present temperature: the cavity is filled anew,
  /// which effects that remember its gas are told (`inflated`).
  void inflate(const S& pressure_Pa, S* x, Inflation<S>& inflation) const;

  /// Fills `now` from `recorded` up to what the actuators need: ports input and contact.
  void apply_inputs(const S* x, Instant<S>& now) const;
  /// From now.motion (speed and load): ports boundary, gas, loss, parasitic.
  void calc_losses(const S* x, Instant<S>& now) const;
  /// From all of now.motion: port thermal, and the rates of all states.
  void calc_rates(const S* x, Instant<S>& now, S* rates) const;

  /// Throws RunFailure where a node is colder or hotter than anything of a tire can be.
  void require_possible(const S* x) const;

  /// What the law of the tire's model alone loses on this surface where all of the tire has one temperature [N].
  S calc_law_N(const S& speed_m_s, const S& load_N, const S& pressure_Pa, const S& temperature_K) const;

  /// Heat stored in all nodes, from 0 K, and on its way into them [J].
  S calc_stored_heat_J(const S* x) const;

 private:
  template <class Port, class Hook>
  void run_port(Hook EffectHooks<S>::*hook, const S* x, const Instant<S>& now, Port& port) const {
    for (const Installed& on : effects_) {
      if (on.hooks->*hook != nullptr) {
        (on.hooks->*hook)(EffectView<S>(on.parameters.data(), x + on.first_state), now, port);
      }
    }
  }
  void fill_temperatures(const S* x, ThermalNetwork<S>& network) const;
  void fill_network(const Instant<S>& now, ThermalNetwork<S>& network) const;

  Context<S> context_;
  const TireModelHooks<S>* model_;
  S curvature_factor_;
  std::vector<Installed> effects_;
  std::vector<CornerState> states_;
  NodeSet nodes_{};
  std::array<const char*, kNodeCount> names_{"", "gas", "tread", "rim", "", ""};
  std::array<std::size_t, kNodeCount> node_state_{};
};

extern template class Corner<double>;
extern template class Corner<Jet>;
extern template class Corner<DimensionedScalar>;

/// Pointers to corners.
template <class S>
std::vector<Corner<S>*> list_corners(std::vector<Corner<S>>& corners) {
  std::vector<Corner<S>*> list;
  for (Corner<S>& corner : corners) list.push_back(&corner);
  return list;
}

/// The context in another scalar.
template <class S>
Context<S> convert_context(const Context<double>& from) {
  Context<S> to;
  to.tire = convert_tire<S>(from.tire);
  to.parasitic = convert<S>(from.parasitic);
  to.vehicle = convert<S>(from.vehicle);
  to.machine = from.machine;
  to.surface_curvature_per_m = quantity<S>(from.surface_curvature_per_m, Dimension{} / dimension::kLength);
  to.machine_radius_m = quantity<S>(from.machine_radius_m, dimension::kLength);
  to.machine_mass_kg = quantity<S>(from.machine_mass_kg, dimension::kMass);
  to.skim_load_N = quantity<S>(from.skim_load_N, dimension::kForce);
  return to;
}

}  // namespace rollrig::models
