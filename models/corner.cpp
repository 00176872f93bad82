#include "models/corner.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/error.h"

namespace rollrig::models {
namespace {

constexpr double kTemperatureScale_K = 10.0;  // Assumed: size of a tire's warm-up, for tolerances

template <class S>
std::vector<S> convert_parameters(const ActiveEffect& active) {
  std::vector<S> parameters;
  const auto& declared = active.effect->info.parameters;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    parameters.push_back(quantity_of_key<S>(active.parameters[i], declared[i].key));
  }
  return parameters;
}

/// The functions of an effect on this kind of rig, for this tire: none where it does not act.
template <class S>
const EffectHooks<S>* find_hooks(const Effect& effect, const Context<S>& context) {
  static const EffectHooks<S> none;
  return acts_in(effect.info, context.machine, context.tire.model()) ? &effect.hooks<S>() : &none;
}

}  // namespace

template <class S>
Corner<S>::Corner(Context<S> context, const std::vector<ActiveEffect>& effects)
    : context_(std::move(context)),
      model_(&context_.tire.model().template hooks<S>()),
      curvature_factor_(context_.tire.model().info.loss_follows_curvature ? calc_curvature_factor(context_) : S(1.0)) {
  nodes_[index_of(Node::kGas)] = true;
  for (const auto& [node, name] : context_.tire.model().info.nodes) {
    nodes_[index_of(node)] = true;
    names_[index_of(node)] = name;
  }
  for (const ActiveEffect& active : effects) {
    if (!acts_in(active.effect->info, context_.machine, context_.tire.model())) continue;
    for (std::size_t i = 0; i < kNodeCount; ++i) nodes_[i] = nodes_[i] || active.effect->info.nodes[i];
  }
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (!nodes_[i]) continue;
    node_state_[i] = states_.size();
    states_.push_back({intern_quantity(names_[i] + std::string("_temperature_degC")), kTemperatureScale_K});
  }
  for (const ActiveEffect& active : effects) {
    effects_.push_back(
        {active.effect, find_hooks<S>(*active.effect, context_), convert_parameters<S>(active), states_.size()});
    for (const EffectState& state : active.effect->info.states) {
      states_.push_back({intern_quantity(active.effect->info.id + "." + state.key), state.scale_SI});
    }
  }
}

template <class S>
void Corner<S>::initialize(const S& temperature_K, const InitialPort<S>& initial, S* x) const {
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (nodes_[i]) x[node_state_[i]] = temperature_K;
  }
  InitialPort<S> at_start = initial;
  at_start.context = &context_;
  at_start.tire_temperature_K = temperature_K;
  for (const Installed& on : effects_) {
    const auto& declared = on.effect->info.states;
    for (std::size_t i = 0; i < declared.size(); ++i) {
      x[on.first_state + i] = quantity_of_key<S>(0.0, declared[i].key);
    }
    if (on.hooks->initial != nullptr) {
      on.hooks->initial(EffectView<S>(on.parameters.data(), x + on.first_state), at_start, x + on.first_state);
    }
  }
}

template <class S>
void Corner<S>::inflate(const S& pressure_Pa, S* x, Inflation<S>& inflation) const {
  inflation.cold_pressure_Pa = pressure_Pa;
  inflation.temperature_K = x[state_of(Node::kGas)];
  for (const Installed& on : effects_) {
    S* states = x + on.first_state;
    if (on.hooks->inflated != nullptr) on.hooks->inflated(EffectView<S>(on.parameters.data(), states), states);
  }
}

template <class S>
void Corner<S>::apply_inputs(const S* x, Instant<S>& now) const {
  now.context = &context_;
  fill_temperatures(x, now.thermal);
  now.acting = now.recorded;
  run_port(&EffectHooks<S>::input, x, now, now.acting);
  now.contact = {quantity<S>(0.0, Dimension{} / dimension::kForce), S(1.0), S(1.0)};
  run_port(&EffectHooks<S>::contact, x, now, now.contact);
}

template <class S>
void Corner<S>::calc_losses(const S* x, Instant<S>& now) const {
  using std::abs;
  const S speed_m_s = abs(now.motion.speed_m_s);
  now.boundary = {now.acting.surface_recorded ? now.acting.surface_K : now.acting.ambient_K, speed_m_s};
  run_port(&EffectHooks<S>::boundary, x, now, now.boundary);
  now.gas = {S(1.0), S(1.0)};
  run_port(&EffectHooks<S>::gas, x, now, now.gas);
  now.pressure_Pa = calc_gauge_pressure_Pa(now.inflation, now.thermal.temperature_K[index_of(Node::kGas)],
                                           now.gas.mass_ratio, now.gas.volume_ratio);
  now.curvature_factor = curvature_factor_;
  now.loss = LossPort<S>{S(1.0), model_->find_loss_temperature_K(context_.tire, now.thermal), zero<S>(), zero<S>()};
  run_port(&EffectHooks<S>::loss, x, now, now.loss);
  now.parasitic = {S(1.0), zero<S>()};
  run_port(&EffectHooks<S>::parasitic, x, now, now.parasitic);

  const S fade = calc_standstill_fade(now.motion.speed_m_s);
  const S law_N = now.loss.factor * (now.curvature_factor * model_->calc_loss_N(now));
  now.rolling_resistance_N = fade * (law_N + now.loss.extra_force_N);
  now.heating_force_N = fade * (law_N + now.loss.extra_heating_force_N);
  now.parasitic_N =
      fade * (now.parasitic.factor * calc_parasitic_N(context_.parasitic, speed_m_s) + now.parasitic.extra_force_N);
}

template <class S>
void Corner<S>::calc_rates(const S* x, Instant<S>& now, S* rates) const {
  fill_network(now, now.thermal);
  run_port(&EffectHooks<S>::thermal, x, now, now.thermal);
  now.heat = calc_heat_flows(now.thermal, now.acting.ambient_K, now.boundary.surface_K);
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (nodes_[i]) rates[node_state_[i]] = now.heat.temperature_rate_K_s[i];
  }
  for (const Installed& on : effects_) {
    const S* states = x + on.first_state;
    if (on.hooks->rates != nullptr) {
      on.hooks->rates(EffectView<S>(on.parameters.data(), states), now, rates + on.first_state);
    } else {  // on a rig on which it does not act
      const S second = quantity<S>(1.0, dimension::kTime);
      for (std::size_t i = 0; i < on.effect->info.states.size(); ++i) {
        rates[on.first_state + i] = S(0.0) * states[i] / second;
      }
    }
  }
}

template <class S>
void Corner<S>::require_possible(const S* x) const {
  constexpr double kColdest_K = 100.0;   // Assumed: rubber shatters long before
  constexpr double kHottest_K = 1000.0;  // Assumed: rubber burns long before
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (!nodes_[i]) continue;
    const double temperature_K = value_of(x[node_state_[i]]);
    if (temperature_K > kColdest_K && temperature_K < kHottest_K) continue;  // neither where it is not a number
    const std::string is = std::isfinite(temperature_K) ? fmt::format("{:.4g} degC", temperature_K - kZeroCelsius_K)
                                                        : std::string("not finite");
    throw RunFailure(fmt::format(
        "the temperature of the tire's {} is {}: values of the tire, the rig or an effect are beyond what can be "
        "simulated; nearer to the usual ones, they may be within",
        names_[i], is));
  }
}

template <class S>
S Corner<S>::calc_stored_heat_J(const S* x) const {
  Instant<S> at_rest;  // capacities do not depend on the motion
  at_rest.context = &context_;
  fill_temperatures(x, at_rest.thermal);
  fill_network(at_rest, at_rest.thermal);
  run_port(&EffectHooks<S>::thermal, x, at_rest, at_rest.thermal);
  S stored_J = at_rest.thermal.under_way_J;
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (nodes_[i]) stored_J += at_rest.thermal.heat_capacity_J_per_K[i] * at_rest.thermal.temperature_K[i];
  }
  return stored_J;
}

template <class S>
void Corner<S>::fill_temperatures(const S* x, ThermalNetwork<S>& network) const {
  network.active = nodes_;
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (nodes_[i]) network.temperature_K[i] = x[node_state_[i]];
  }
}

/// The network of the tire's model, with nothing yet of nodes that effects ask for.
template <class S>
void Corner<S>::fill_network(const Instant<S>& now, ThermalNetwork<S>& network) const {
  for (std::size_t i = 0; i < kNodeCount; ++i) {
    if (!nodes_[i]) continue;
    network.heat_capacity_J_per_K[i] = network.heat_W[i] = zero<S>();
    network.air_W_per_K[i] = network.road_W_per_K[i] = zero<S>();
    for (std::size_t j = i + 1; j < kNodeCount; ++j) {
      if (nodes_[j]) network.link_W_per_K[i][j] = zero<S>();
    }
  }
  network.under_way_J = zero<S>();
  network.under_way_W = zero<S>();
  model_->fill_network(now, network);
  add_tire_heat(now, HeatSource::kHysteresis, S(now.heating_force_N * now.motion.rolling_speed_m_s), network);
}

template <class S>
S Corner<S>::calc_law_N(const S& speed_m_s, const S& load_N, const S& pressure_Pa, const S& temperature_K) const {
  Instant<S> now;
  now.context = &context_;
  now.motion.speed_m_s = speed_m_s;
  now.motion.load_N = load_N;
  now.pressure_Pa = pressure_Pa;
  now.loss.temperature_K = temperature_K;
  return curvature_factor_ * model_->calc_loss_N(now);
}

template class Corner<double>;
template class Corner<Jet>;
template class Corner<DimensionedScalar>;

}  // namespace rollrig::models
