#pragma once
/// One corner with effects on it, whose motion a test sets by hand.

#include <string>
#include <utility>
#include <vector>

#include <boost/numeric/odeint/integrate/integrate_n_steps.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"

namespace rollrig::tests {

/// The context of tire a50 on a 1.707 m drum, on a 1.2 m roller, on a belt, or on the road.
inline models::Context<double> make_context_on(tests::Machine kind) {
  models::Context<double> context = DrumFixture().context();
  context.machine = kind->traits;
  if (kind == tests::kDyno) context.surface_curvature_per_m = 1.0 / 0.6;
  if (kind == tests::kRoad || kind == tests::kFlatBelt) context.surface_curvature_per_m = 0.0;
  return context;
}

/// An effect of the registry switched on, its parameters as usual but for the first ones.
inline models::ActiveEffect switch_on(const std::string& id, const std::vector<double>& first_values = {}) {
  return make_active(models::find_effect(id), first_values);
}

/// What a test sets: motion of the contact, and the surroundings.
struct HandFedInputs {
  double speed_m_s = 80.0 / 3.6;
  double acceleration_m_s2 = 0.0;
  double load_N = 5400.0;
  double ambient_K = 298.15;
  bool surface_recorded = false;
  double surface_K = 298.15;
  double drive_force_N = 0.0;  // on the road, positive when it drives
  double brake_force_N = 0.0;
  double slip_power_W = 0.0;
};

template <class S>
class HandFedCorner {
 public:
  HandFedCorner(const models::Context<double>& context, const std::vector<models::ActiveEffect>& effects,
                const models::InitialPort<S>& initial = {}, double temperature_K = 298.15)
      : corner(models::convert_context<S>(context), effects), x(corner.state_count()) {
    corner.initialize(quantity<S>(temperature_K, dimension::kTemperature), initial, x.data());
    now.inflation = {quantity<S>(280e3, dimension::kPressure), quantity<S>(298.15, dimension::kTemperature),
                     quantity<S>(101325.0, dimension::kPressure)};
  }

  /// Fills `now` and `rates` from `inputs` and the states.
  const models::Instant<S>& evaluate() {
    evaluate(x, rates);
    return now;
  }

  /// Integrates all states at these inputs.
  void advance(double duration_s, int steps = 400) {
    namespace odeint = boost::numeric::odeint;
    odeint::runge_kutta4<std::vector<S>, double> stepper;
    const double step_s = duration_s / steps;
    odeint::integrate_n_steps(
        stepper, [this](const std::vector<S>& at, std::vector<S>& rates_at, double) { evaluate(at, rates_at); }, x, 0.0,
        step_s, static_cast<std::size_t>(steps));
    evaluate();
  }

  S& temperature_K(models::Node node) { return x[corner.state_of(node)]; }
  /// A state of an effect, by its key with the effect's id before it.
  S& state(const std::string& key) {
    for (std::size_t i = 0; i < corner.state_count(); ++i) {
      if (corner.states()[i].quantity.header() == key) return x[i];
    }
    throw std::invalid_argument("no state " + key);
  }
  /// Rate of the heat stored in nodes and on its way.
  S stored_heat_rate_W(double step_s = 1e-3) {
    evaluate();
    std::vector<S> later = x;
    for (std::size_t i = 0; i < x.size(); ++i) later[i] = x[i] + S(step_s) * rates[i];
    return (corner.calc_stored_heat_J(later.data()) - corner.calc_stored_heat_J(x.data())) / S(step_s);
  }

  models::Corner<S> corner;
  std::vector<S> x;
  std::vector<S> rates;
  models::Instant<S> now;
  HandFedInputs inputs;

 private:
  void evaluate(const std::vector<S>& at, std::vector<S>& rates_at) {
    const auto q = [](double value, Dimension d) { return quantity<S>(value, d); };
    now.recorded = {q(inputs.speed_m_s, dimension::kSpeed),
                    q(inputs.acceleration_m_s2, dimension::kAcceleration),
                    q(inputs.load_N, dimension::kForce),
                    q(inputs.ambient_K, dimension::kTemperature),
                    q(inputs.surface_K, dimension::kTemperature),
                    inputs.surface_recorded,
                    q(inputs.drive_force_N, dimension::kForce),
                    q(inputs.brake_force_N, dimension::kForce),
                    S(0.0),
                    q(0.0, dimension::kSpeed),
                    S(1.0)};
    corner.apply_inputs(at.data(), now);
    now.motion = {now.acting.speed_m_s,
                  now.acting.acceleration_m_s2,
                  now.acting.load_N,
                  -now.acting.longitudinal_force_N,
                  q(inputs.slip_power_W, dimension::kPower),
                  now.acting.speed_m_s};
    corner.calc_losses(at.data(), now);
    rates_at.resize(corner.state_count());
    corner.calc_rates(at.data(), now, rates_at.data());
  }
};

}  // namespace rollrig::tests
