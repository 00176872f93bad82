#include "validation/generator/recorder.h"

// Without this uBLAS checks each access, at several times the cost of the arithmetic.
#define BOOST_UBLAS_NDEBUG
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_dense_output.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/error.h"
#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

namespace odeint = boost::numeric::odeint;
using Vector = boost::numeric::ublas::vector<double>;
using Matrix = boost::numeric::ublas::matrix<double>;

constexpr double kStep_s = 0.5;  // of signals: half a sampling interval

/// Right-hand side and its derivatives, by differences, for odeint.
auto make_system(const Plant& plant) {
  const auto rates = [&plant](const Vector& x, Vector& dxdt, double t) { plant.calc_rates(t, &x[0], &dxdt[0]); };
  const auto derivatives = [&plant](const Vector& x, Matrix& jacobian, double t, Vector& dfdt) {
    constexpr double kTimeStep_s = 1e-4;
    const std::size_t n = plant.size();
    std::vector<double> at(x.begin(), x.end());
    std::vector<double> base(n);
    std::vector<double> moved(n);
    plant.calc_rates(t, at.data(), base.data());
    for (std::size_t j = 0; j < n; ++j) {
      const double kept = at[j];
      const double step = 1e-7 * (1.0 + std::abs(kept));
      at[j] += step;
      plant.calc_rates(t, at.data(), moved.data());
      at[j] = kept;
      for (std::size_t i = 0; i < n; ++i) jacobian(i, j) = (moved[i] - base[i]) / step;
    }
    plant.calc_rates(t + kTimeStep_s, at.data(), moved.data());
    for (std::size_t i = 0; i < n; ++i) dfdt[i] = (moved[i] - base[i]) / kTimeStep_s;
  };
  return std::make_pair(rates, derivatives);
}

/// What a leg is asked for: at each cell's start the temperature and pressure, at two points within it, by Gauss'
/// rule, the force.
class Collector {
 public:
  explicit Collector(const Specimen& specimen) : specimen_(specimen), lever_(specimen.machine->find_lever(specimen)) {}

  /// The next time that is wanted.
  double next_s() const { return static_cast<double>(cell_) * kStep_s + kPoints[point_]; }
  /// Takes what there is at that time.
  void take(const Plant& plant, const double* state, double load_change_N, double load_step_s) {
    const double time_s = next_s();
    const Reading reading = plant.read(time_s, state);
    if (point_ == 0) {
      liner.push_back(reading.liner_degC);
      pressure.push_back(reading.pressure_kPa);
      force.push_back(find_inertia(plant, time_s));
      if (plant.friction_brakes_at(time_s)) force.back() = std::nan("");
    } else {
      const double since_s = time_s - load_step_s;
      const double swing_Nm = specimen_.controller_swing_Nm * load_change_N / specimen_.reference_load_N *
                              std::exp(-since_s / specimen_.controller_time_s) *
                              std::cos(specimen_.controller_frequency_rad_s * since_s);
      force.back() += 0.5 * (lever_ * reading.force_N + swing_Nm);
    }
    point_ = (point_ + 1) % kPoints.size();
    if (point_ == 0) ++cell_;
  }

  std::vector<double> force;  // of the first channel: means over cells
  std::vector<double> liner;  // at the start of each cell
  std::vector<double> pressure;

 private:
  static constexpr double kGauss = 0.57735026918962576;  // 1/sqrt(3)
  static constexpr std::array<double, 3> kPoints{0.0, 0.5 * kStep_s*(1.0 - kGauss), 0.5 * kStep_s*(1.0 + kGauss)};

  /// Torque or force that the momentum gained over a cell takes.
  double find_inertia(const Plant& plant, double time_s) const {
    const double gained_m_s = plant.speed_at(time_s + kStep_s) - plant.speed_at(time_s);
    const double mass_kg = plant.moving_mass_kg(plant.load_at(time_s + 0.5 * kStep_s));
    return lever_ * mass_kg * gained_m_s / kStep_s;
  }

  const Specimen& specimen_;
  double lever_ = 1.0;
  std::size_t cell_ = 0;
  std::size_t point_ = 0;
};

/// A change of load that still settles.
struct LoadStep {
  double before_N = 0.0;
  double time_s = 0.0;
};

/// Integrates over a leg and hands what it asks for to the collector. Steps may reach beyond the end of the
/// leg, where its straight lines go on.
Vector integrate_leg(const Plant& plant, const Leg& leg, const LoadStep& step, Vector state, Collector& collector) {
  using Controller = odeint::rosenbrock4_controller<odeint::rosenbrock4<double>>;
  constexpr double kFirstStep_s = 0.02;
  constexpr double kLongestStep_s = 30.0;
  odeint::rosenbrock4_dense_output<Controller> stepper(Controller(1e-7, 1e-8, kLongestStep_s));
  stepper.initialize(state, leg.start_s, kFirstStep_s);
  const auto system = make_system(plant);
  for (double reached_s = leg.start_s; reached_s < leg.end_s();) {
    const auto [from_s, to_s] = stepper.do_step(system);
    if (!(to_s > from_s)) throw RunFailure("the integration does not go on");
    reached_s = to_s;
    while (collector.next_s() < std::min(reached_s, leg.end_s())) {
      stepper.calc_state(collector.next_s(), state);
      collector.take(plant, &state[0], leg.load_N - step.before_N, step.time_s);
    }
  }
  stepper.calc_state(leg.end_s(), state);
  return state;
}

/// Marches over a leg in steps of one cell; within them the state is taken as linear.
Vector march_leg(const Plant& plant, const Leg& leg, Vector state, Collector& collector) {
  odeint::rosenbrock4<double> stepper;
  const auto system = make_system(plant);
  const auto steps = static_cast<int>(std::lround(leg.duration_s / kStep_s));
  Vector next = state;
  Vector between = state;
  for (int i = 0; i < steps; ++i) {
    const double from_s = leg.start_s + i * kStep_s;
    stepper.do_step(system, state, from_s, next, kStep_s);
    while (collector.next_s() < from_s + kStep_s - 1e-9) {
      const double part = (collector.next_s() - from_s) / kStep_s;
      between = (1.0 - part) * state + part * next;
      collector.take(plant, &between[0], 0.0, 0.0);
    }
    state = next;
  }
  return state;
}

Collector simulate(const Specimen& specimen, const Effects& effects, const RunPlan& run) {
  Plant plant(specimen, effects, run);
  const std::vector<double> start = plant.start();
  Vector state(start.size());
  std::copy(start.begin(), start.end(), state.begin());
  Collector collector(specimen);
  std::vector<Leg> legs = run.legs;
  const Leg& last = legs.back();
  Leg margin{last.end_s(), kMargin_s, last.end_m_s, last.end_m_s, last.load_N};
  margin.start_longitudinal_N = margin.end_longitudinal_N = last.end_longitudinal_N;
  margin.start_elevation_m = margin.end_elevation_m = last.end_elevation_m;
  legs.push_back(margin);
  LoadStep step{legs.front().load_N, 0.0};
  for (std::size_t i = 0; i < legs.size(); ++i) {
    if (i > 0 && legs[i].load_N != legs[i - 1].load_N) step = {legs[i - 1].load_N, legs[i].start_s};
    plant.enter(legs[i], step.before_N, step.time_s);
    state = specimen.machine->has_knots ? march_leg(plant, legs[i], std::move(state), collector)
                                        : integrate_leg(plant, legs[i], step, std::move(state), collector);
  }
  return collector;
}

void turn_over(std::vector<double>& force) {
  for (double& value : force) value = -value;
}

/// Given columns: instantaneous, as the rig reports them.
void fill_given(const RunPlan& run, RunRecord& record) {
  const auto rows = static_cast<std::size_t>(std::lround(run.end_s())) + 1;
  std::size_t leg = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double time_s = static_cast<double>(row);
    while (leg + 1 < run.legs.size() && time_s >= run.legs[leg].end_s()) ++leg;
    const Leg& now = run.legs[leg];
    record.time_s.push_back(time_s);
    record.speed_km_h.push_back(3.6 * (now.start_m_s + now.acceleration_m_s2() * (time_s - now.start_s)));
    record.load_N.push_back(now.load_N);
    const double part = (time_s - now.start_s) / now.duration_s;
    const auto between = [part](double start, double end) { return start + part * (end - start); };
    record.longitudinal_N.push_back(between(now.start_longitudinal_N, now.end_longitudinal_N));
    record.elevation_m.push_back(between(now.start_elevation_m, now.end_elevation_m));
    record.ambient_degC.push_back(run.air.at(time_s));
  }
}

}  // namespace

Signal::Signal(double step_s, std::vector<double> values) : step_s_(step_s), values_(std::move(values)) {
  integral_.push_back(0.0);
  for (std::size_t i = 1; i < values_.size(); ++i) {
    integral_.push_back(integral_.back() + 0.5 * step_s_ * (values_[i - 1] + values_[i]));
  }
}

double Signal::integral(double time_s) const {
  if (time_s <= 0.0) return time_s * values_.front();
  const auto last = values_.size() - 1;
  const double place = time_s / step_s_;
  const auto cell = static_cast<std::size_t>(place);
  if (cell >= last) return integral_.back() + (time_s - static_cast<double>(last) * step_s_) * values_.back();
  const double part = place - static_cast<double>(cell);
  return integral_[cell] + step_s_ * part * (values_[cell] + 0.5 * part * (values_[cell + 1] - values_[cell]));
}

double Signal::mean(double from_s, double to_s) const { return (integral(to_s) - integral(from_s)) / (to_s - from_s); }

double RunRecord::sample(const Signal& signal, std::size_t row, double shift_s) const {
  const double from_s = row == 0 ? time_s[row] : time_s[row] - kStep_s;
  const double to_s = row + 1 == time_s.size() ? time_s[row] : time_s[row] + kStep_s;
  return signal.mean(from_s + shift_s, to_s + shift_s);
}

RunRecord record_run(const Specimen& specimen, const Effects& effects, const RunPlan& run) {
  Specimen built = specimen;
  for (const Effect& effect : effects) effect.rebuild(built);
  Collector collected = simulate(built, effects, run);
  RunRecord record;
  record.specimen = &specimen;
  record.lever = specimen.machine->find_lever(built);
  fill_given(run, record);
  record.liner = Signal(kStep_s, std::move(collected.liner));
  record.pressure = Signal(kStep_s, std::move(collected.pressure));
  const std::vector<double>& cells = collected.force;
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    const std::size_t after = 2 * row;  // cells of half a second
    const bool is_first = row == 0;
    const bool is_last = row + 1 == record.time_s.size();
    const double mean =
        is_first ? cells[after] : (is_last ? cells[after - 1] : 0.5 * (cells[after - 1] + cells[after]));
    record.force.push_back(mean + run.find_hung(record.time_s[row]));
    record.liner_degC.push_back(record.sample(record.liner, row));
    record.pressure_kPa.push_back(record.sample(record.pressure, row));
  }
  // Torque counts positive when it drives, so in reversed rotation the sensor has the other sign; its zero does not.
  if (run.reversed) turn_over(record.force);
  for (const Effect& effect : effects) effect.trace(record);
  if (run.reversed) turn_over(record.force);
  return record;
}

}  // namespace rollrig::generator
