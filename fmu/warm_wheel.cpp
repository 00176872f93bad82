#include "fmu/warm_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fmu/fastest_rate.h"
#include "rigs/standstill_grid.h"
#include "sim/core/error.h"
#include "sim/fixed_grid_integrator.h"

namespace rollrig::fmu {
namespace {

/// What is asked of an input: name and meaning, what is allowed.
struct InputInfo {
  const char* name;
  const char* doc;
  Range range;
};

constexpr Range kSurroundings_K = between(150.0, 500.0);  // Assumed: wider than any weather or test cell
constexpr Range kForces_N = between(-1e6, 1e6);

/// In the order of a roller's inputs; then the acceleration.
constexpr std::array<InputInfo, rigs::kRollerInputCount + 1> kInputs{
    {{"speed_m_s", "Speed of the surface past the wheel", between(-kHighestSpeed_m_s, kHighestSpeed_m_s)},
     {"load_N", "Load at the contact", between(0.0, 1e6)},
     {"ambient_temperature_K", "Air at the tire", kSurroundings_K},
     {"surface_temperature_K", "Road, drum, belt or roller under the tire; it does not follow ambient_temperature_K",
      kSurroundings_K},
     {"drive_force_N", "Torque at the hub divided by the loaded radius; positive when it drives", kForces_N},
     {"acceleration_m_s2",
      "Rate of change of speed_m_s; in co-simulation, the speed also changes at this rate during a step",
      between(-1e3, 1e3)}}};
constexpr std::size_t kSpeed = rigs::index_of(rigs::DrumInput::kSpeed);
constexpr std::size_t kAcceleration = rigs::kRollerInputCount;

struct OutputInfo {
  const char* name;
  const char* doc;
};

constexpr std::array<OutputInfo, 9> kOutputs{
    {{"rolling_resistance_N", "Rolling resistance of the tire, against the motion"},
     {"parasitic_loss_N", "Loss of the bearings, of the rig or on the road of the wheel, as force at the surface"},
     {"loss_force_N", "Rolling resistance, parasitic loss and slip, as a dynamometer measures them"},
     {"contact_force_N", "Force of the wheel on the surface, positive when it drives"},
     {"cavity_pressure_Pa", "Gauge pressure in the tire"},
     {"slip_power_W", "Heat by longitudinal slip; 0 without the effect slip_loss"},
     {"heat_generated_W", "Heat that arises in the tire"},
     {"heat_to_air_W", "Heat that the tire gives to the air"},
     {"heat_to_surface_W", "Heat that the tire gives to the surface"}}};

template <class S>
std::array<S, kOutputs.size()> read_outputs(const rigs::DrivenWheel<S>& wheel) {
  const models::Instant<S>& now = wheel.now();
  return {now.rolling_resistance_N, now.parasitic_N,         wheel.loss_force_N(), -now.motion.longitudinal_force_N,
          now.pressure_Pa,          now.motion.slip_power_W, now.heat.heat_in_W,   now.heat.to_air_W,
          now.heat.to_road_W};
}

constexpr const char* kLostEnergy = "tire_loss_J";
constexpr double kEnergyScale_J = 1e5;  // Assumed: of a tire in minutes
constexpr std::size_t kLostIntegral = rigs::index_of(rigs::RecordedIntegral::kTireLoss);

constexpr double kMostSteps = 1e5;  // of the integrator in one advance(), so that a mistaken number ends soon
/// Longest step of the integrator times the fastest rate. The Runge-Kutta method is stable to 2.7.
/// Assumed: the rest is for a rate that grows within a step.
constexpr double kStable = 2.0;

constexpr const char* kLiner = "liner_temperature_K";  // whatever the tire's model calls it

/// Temperatures in K, else as the corner names its states.
std::string name_state(const Quantity& quantity) {
  return quantity.unit_suffix() == "degC" ? std::string(quantity.name()) + "_K" : quantity.header();
}

InputError bad_value(const Variable& variable, double value, const std::string& what) {
  std::string allowed = variable.range.to_string();
  if (allowed.empty()) allowed = "a number";
  if (!variable.unit.symbol.empty()) allowed += " " + variable.unit.symbol;
  return InputError({what, "", 0, variable.name, fmt::format("{:g}", value), allowed, ""});
}

void require_finite(double value, const std::string& name) {
  if (std::isfinite(value)) return;
  throw InputError(
      {"the value is not a finite number", "", 0, name, fmt::format("{:g}", value), "a finite number", ""});
}

/// What ranges of single numbers cannot say. Throws InputError.
void require_consistent(const WheelModel& model) {
  const models::TireParameters<double>& tire = model.context.tire;
  const auto refuse = [](const std::string& what, const std::string& key, double value, const std::string& allowed) {
    throw InputError({what, "", 0, key, fmt::format("{:g}", value), allowed, ""});
  };
  if (tire.geometry.rim_diameter_m >= tire.geometry.outer_diameter_m) {
    refuse("the tire is smaller than its rim", "geometry.outer_diameter_m", tire.geometry.outer_diameter_m,
           fmt::format("more than {:g} m, the diameter of the rim", tire.geometry.rim_diameter_m));
  }
  for (std::size_t i = 1; i < tire.load_map.size(); ++i) {
    if (tire.load_map[i].load_N > tire.load_map[i - 1].load_N) continue;
    refuse("loads of the map must increase", fmt::format("load_map.{}.load_N", i), tire.load_map[i].load_N,
           fmt::format("more than {:g} N", tire.load_map[i - 1].load_N));
  }
  const models::TireModelInfo& info = tire.model().info;
  if (info.find_mistake == nullptr) return;
  if (const auto mistake = info.find_mistake(tire.own)) {
    throw InputError({mistake->what, "", 0, info.id + "." + mistake->key, "", mistake->allowed, ""});
  }
}

[[noreturn]] void refuse_length(double duration_s, const std::string& what, const std::string& allowed) {
  throw InputError({what, "", 0, "step", fmt::format("{:g}", duration_s), allowed, ""});
}

/// Throws InputError for a duration that takes more steps of the integrator than one advance() may.
void require_few_steps(double duration_s, double step_s) {
  const double longest_s = kMostSteps * step_s;
  if (duration_s > longest_s) refuse_length(duration_s, "the step is too long", fmt::format("up to {:g} s", longest_s));
}

/// Throws InputError for a length that advance() cannot go on by.
void require_step(double duration_s, double longest_step_s, double time_s) {
  if (!(duration_s > 0.0) || !std::isfinite(duration_s)) {
    refuse_length(duration_s, "a step must have a length", "> 0 s");
  }
  require_few_steps(duration_s, longest_step_s);
  require_time(time_s + duration_s);
  if (time_s + duration_s > time_s) return;
  const double spacing_s = std::nextafter(time_s, kLatest_s) - time_s;
  refuse_length(duration_s, "the step is too short for the time",
                fmt::format("at least {:g} s at {:g} s", spacing_s, time_s));
}

/// The parameter that makes a wheel with this fastest rate too fast for any step.
InputError make_too_fast(const Culprit& culprit, double rate_per_s) {
  const Unit unit = unit_of_key(culprit.field.key);
  const double limit_SI = culprit.value_SI * std::pow(kStable / kShortestStep_s / rate_per_s, 1.0 / culprit.exponent);
  const std::string allowed = fmt::format("{} {:.2g} {}", culprit.exponent > 0.0 ? "at most about" : "at least about",
                                          unit.from_si(limit_SI), unit.symbol);
  return InputError({fmt::format("with this value, the tire changes within {:.2g} s, and steps of the integrator would "
                                 "have to be shorter than {:g} s",
                                 1.0 / rate_per_s, kShortestStep_s),
                     "", 0, culprit.name, fmt::format("{:g}", unit.from_si(culprit.value_SI)), allowed, ""});
}

}  // namespace

void require_time(double time_s) {
  if (std::abs(time_s) <= kLatest_s) return;
  throw InputError({"the time is too far from 0, or not a number", "", 0, "time", fmt::format("{:g}", time_s),
                    fmt::format("{:g} to {:g} s", -kLatest_s, kLatest_s), ""});
}

/// The equations, with what an integrator needs.
struct WarmWheel::Simulation : WheelEquations<double> {
  explicit Simulation(const WheelModel& model) : WheelEquations<double>(model), integrator(wheel) {}

  sim::FixedGridIntegrator<double> integrator;
};

WarmWheel::WarmWheel(const WheelModel& model) : original_model_(model), model_(model) {
  const std::string text = write_wheel_model(model);
  checksum_ = calc_checksum(text.data(), text.size());
  list_variables();
  reset();
}

WarmWheel::~WarmWheel() = default;

void WarmWheel::undo_initialize() {
  simulation_.reset();
  forget_derivatives();
  states_.clear();
  is_evaluated_ = false;
}

void WarmWheel::reset() {
  undo_initialize();
  model_ = original_model_;
  list_parameters();
  inputs_.clear();
  for (std::size_t i = 0; i < kInputs.size(); ++i) inputs_.push_back(variables_[i].start);
  input_slopes_.assign(kInputs.size(), 0.0);
  time_s_ = 0.0;
}

void WarmWheel::list_parameters() {
  parameters_.clear();
  WheelModel::visit_used(model_,
                         [this](const std::string&, const Field&, double& member) { parameters_.push_back(&member); });
}

void WarmWheel::add_variable(Variable variable) {
  if (variable.unit.symbol.empty()) variable.unit = unit_of_key(variable.name);
  const Role role = variable.role;
  variable.index = static_cast<std::size_t>(std::count_if(
      variables_.begin(), variables_.end(), [role](const Variable& other) { return other.role == role; }));
  variables_.push_back(std::move(variable));
}

void WarmWheel::list_variables() {
  const std::array<double, kInputs.size()> starts{0.0, model_.load_N, model_.ambient_K, model_.ambient_K, 0.0, 0.0};
  for (std::size_t i = 0; i < kInputs.size(); ++i) {
    add_variable({kInputs[i].name, Role::kInput, kInputs[i].doc, kInputs[i].range, {}, starts[i]});
  }
  for (const OutputInfo& output : kOutputs) add_variable({output.name, Role::kOutput, output.doc, {}, {}});
  first_state_ = variables_.size();
  const models::Corner<double> corner(model_.context, model_.effects);
  for (std::size_t i = 0; i < corner.state_count(); ++i) {
    const models::CornerState& state = corner.states()[i];
    const std::string name = i == corner.state_of(models::Node::kLiner) ? kLiner : name_state(state.quantity);
    const Unit unit = unit_of_key(name);
    add_variable({name, Role::kState, "State: " + plain_name(name), {}, unit, 0.0, state.scale_SI / unit.factor});
  }
  add_variable({kLostEnergy, Role::kState, "Energy that rolling resistance has taken", {}, {}, 0.0, kEnergyScale_J});
  state_count_ = variables_.size() - first_state_;
  for (std::size_t i = 0; i < state_count_; ++i) {
    const Variable of = state(i);
    add_variable({"der(" + of.name + ")", Role::kRate, "Rate of " + of.name, {}, of.unit});
  }
  WheelModel::visit_used(model_, [this](const std::string& name, const Field& field, double value_SI) {
    const Unit unit = unit_of_key(field.key);
    add_variable({name, Role::kParameter, field.doc, field.range, unit, unit.from_si(value_SI)});
  });
  add_variable({"time_s", Role::kTime, "Time", {}, {}});
}

const Variable& WarmWheel::variable(std::size_t index) const {
  if (index < variables_.size()) return variables_[index];
  throw InputError({"there is no such variable", "", 0, "", fmt::format("{}", index),
                    fmt::format("0 to {}", variables_.size() - 1), ""});
}

void WarmWheel::require_initialized() const {
  if (simulation_ == nullptr) {
    throw InputError({"the wheel has not been initialized", "", 0, "", "", "initialize it before this call", ""});
  }
}

void WarmWheel::set(std::size_t index, double value) {
  const Variable& given = variable(index);
  if (given.role != Role::kInput && given.role != Role::kParameter) {
    throw bad_value(given, value, "only inputs and parameters can be set");
  }
  if (!given.range.contains(value)) throw bad_value(given, value, "the value is not allowed");
  if (given.role == Role::kInput) {
    inputs_[given.index] = value;
    is_evaluated_ = false;
    return;
  }
  if (is_initialized()) throw bad_value(given, value, "a parameter cannot be set after the start");
  *parameters_[given.index] = given.unit.to_si(value);
}

bool WarmWheel::is_state(std::size_t index) const { return variable(index).role == Role::kState; }

void WarmWheel::set_state(std::size_t index, double value) {
  require_initialized();
  std::vector<double> states(state_count_);
  get_states(states.data());
  states[variable(index).index] = value;
  set_states(states.data());
}

void WarmWheel::set_input_slope(std::size_t index, double slope_per_s) {
  const Variable& given = variable(index);
  require_finite(slope_per_s, given.name);
  if (given.role != Role::kInput || given.index == kAcceleration) {
    throw bad_value(given, slope_per_s, "only an input but the acceleration has a slope");
  }
  if (given.index == kSpeed) return set(kAcceleration, slope_per_s);
  input_slopes_[given.index] = slope_per_s;
}

double WarmWheel::get_slope_if_input(std::size_t index) const {
  const Variable& of = variable(index);
  return of.role == Role::kInput ? find_slope(of.index) : 0.0;
}

double WarmWheel::find_slope(std::size_t input) const {
  return input == kSpeed ? inputs_[kAcceleration] : input_slopes_[input];
}

double WarmWheel::get(std::size_t index) {
  const Variable& wanted = variable(index);
  switch (wanted.role) {
    case Role::kInput:
      return inputs_[wanted.index];
    case Role::kParameter:
      return wanted.unit.from_si(*parameters_[wanted.index]);
    case Role::kState:
      require_initialized();
      return wanted.unit.from_si(states_[wanted.index]);
    case Role::kOutput:
      evaluate();
      return outputs_[wanted.index];
    case Role::kTime:
      return time_s_;
    case Role::kRate:
      break;
  }
  evaluate();
  return rates_[wanted.index] / wanted.unit.factor;
}

double WarmWheel::get_if_settable(std::size_t index) {
  const Role role = variable(index).role;
  return role == Role::kInput || role == Role::kParameter ? get(index) : 0.0;
}

/// The present inputs, and their slopes where time passes.
sim::Segment WarmWheel::make_segment(double duration_s) const {
  sim::Segment segment;
  segment.duration_s = duration_s;
  for (std::size_t i = 0; i < rigs::kRollerInputCount; ++i) {
    segment.inputs.push_back({inputs_[i], find_slope(i)});
  }
  return segment;
}

std::unique_ptr<WarmWheel::Simulation> WarmWheel::make_simulation(double time_s) const {
  require_consistent(model_);
  auto simulation = std::make_unique<Simulation>(model_);
  simulation->wheel.initialize(make_segment(0.0), time_s, simulation->states.data());
  return simulation;
}

void WarmWheel::initialize(double time_s) {
  require_time(time_s);
  std::unique_ptr<Simulation> simulation = make_simulation(time_s);
  states_ = simulation->states;
  states_.push_back(0.0);
  simulation_ = std::move(simulation);
  forget_derivatives();
  time_s_ = time_s;
  is_evaluated_ = false;
}

void WarmWheel::set_time(double time_s) {
  require_time(time_s);
  time_s_ = time_s;
}

void WarmWheel::evaluate() {
  require_initialized();
  if (is_evaluated_) return;
  Simulation& simulation = *simulation_;
  std::copy_n(states_.begin(), simulation.states.size(), simulation.states.begin());
  simulation.wheel.set_given({inputs_[kAcceleration], {}});
  simulation.evaluate(make_segment(0.0), time_s_);
  const auto outputs = read_outputs(simulation.wheel);
  outputs_.assign(outputs.begin(), outputs.end());
  rates_ = simulation.rates;
  rates_.push_back(simulation.integrals[kLostIntegral]);
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(outputs_.begin(), outputs_.end(), is_finite) ||
      !std::all_of(rates_.begin(), rates_.end(), is_finite)) {
    throw RunFailure("the equations give no finite number for these inputs and states");
  }
  is_evaluated_ = true;
}

/// What is made of the parameters when it is asked for.
void WarmWheel::forget_derivatives() {
  jet_simulation_.reset();
  fastest_rate_.reset();
}

/// Step of the integrator through a piece that is straight in all inputs: the longest, unless the states change so fast
/// by themselves that it would be unstable.
double WarmWheel::choose_step_s(const sim::Segment& piece, const double* states) {
  const double longest_s = model_.longest_step_s;
  if (fastest_rate_ == nullptr) fastest_rate_ = std::make_unique<FastestRate>(model_);
  const double usual_per_s = fastest_rate_->usual_per_s();
  constexpr double kFar = 0.25;  // Assumed: of the bound, where no load or drive can lead to it
  if (usual_per_s * longest_s < kFar * kStable) return longest_s;
  if (!(usual_per_s * kShortestStep_s <= kStable)) {
    throw make_too_fast(find_culprit(model_, original_model_), usual_per_s);
  }
  double rate_per_s = 0.0;
  for (const double elapsed_s : {0.0, piece.duration_s}) {
    sim::Segment moment;
    for (const sim::Ramp& input : piece.inputs) moment.inputs.push_back({input.at(elapsed_s), 0.0});
    rate_per_s = std::max(rate_per_s, fastest_rate_->calc_per_s(moment, inputs_[kAcceleration], states));
  }
  if (!(rate_per_s * kShortestStep_s <= kStable)) {
    throw RunFailure(
        fmt::format("with these inputs, the tire changes within {:.2g} s, and steps of the integrator would "
                    "have to be shorter than {:g} s",
                    1.0 / rate_per_s, kShortestStep_s));
  }
  const double step_s = std::min(longest_s, kStable / rate_per_s);
  require_few_steps(piece.duration_s, step_s);
  return step_s;
}

void WarmWheel::advance(double duration_s) {
  require_initialized();
  require_step(duration_s, model_.longest_step_s, time_s_);
  for (std::size_t i = 0; i < rigs::kRollerInputCount; ++i) {
    const double end = inputs_[i] + find_slope(i) * duration_s;
    if (!kInputs[i].range.contains(end)) throw bad_value(variables_[i], end, "the slope leads to a value not allowed");
  }
  Simulation& simulation = *simulation_;
  is_evaluated_ = false;
  simulation.integrator.begin_run(time_s_);
  std::copy_n(states_.begin(), simulation.states.size(), simulation.integrator.state());
  simulation.integrator.integrals()[kLostIntegral] = states_.back();
  simulation.wheel.set_given({inputs_[kAcceleration], {}});
  sim::Program program;
  program.phases.push_back({"", {make_segment(duration_s)}, {}, {}});
  double end_s = time_s_;
  program = rigs::refine_near_standstill(std::move(program), kSpeed);
  for (const sim::Segment& piece : program.phases.front().segments) {
    end_s += piece.duration_s;
    simulation.wheel.begin_segment(piece, simulation.integrator.time_s(), simulation.integrator.state(),
                                   simulation.integrator.integrals());
    const double longest_s = choose_step_s(piece, simulation.integrator.state());
    simulation.integrator.begin_segment(piece.max_step_s > 0.0 ? std::min(piece.max_step_s, longest_s) : longest_s,
                                        nullptr);
    while (simulation.integrator.time_s() < end_s) {
      simulation.integrator.step(end_s);
      simulation.wheel.require_possible(simulation.integrator.state());
    }
  }
  std::copy_n(simulation.integrator.state(), simulation.states.size(), states_.begin());
  states_.back() = simulation.integrator.integrals()[kLostIntegral];
  time_s_ += duration_s;
  for (std::size_t i = 0; i < rigs::kRollerInputCount; ++i) {
    inputs_[i] += find_slope(i) * duration_s;
    input_slopes_[i] = 0.0;
  }
}

void WarmWheel::get_states(double* states) const {
  require_initialized();
  for (std::size_t i = 0; i < state_count_; ++i) states[i] = state(i).unit.from_si(states_[i]);
}

void WarmWheel::set_states(const double* states) {
  require_initialized();
  std::vector<double> states_SI(state_count_);
  for (std::size_t i = 0; i < state_count_; ++i) {
    require_finite(states[i], state(i).name);
    states_SI[i] = state(i).unit.to_si(states[i]);
  }
  simulation_->wheel.require_possible(states_SI.data());
  states_ = std::move(states_SI);
  is_evaluated_ = false;
}

void WarmWheel::get_rates(double* rates) {
  for (std::size_t i = 0; i < state_count_; ++i) rates[i] = get(first_rate() + i);
}

std::vector<double> WarmWheel::differentiate(const std::vector<std::size_t>& unknown,
                                             const std::vector<std::size_t>& known,
                                             const std::vector<double>& direction, Moment moment) {
  require_initialized();
  const bool is_start = moment == Moment::kStart;
  if (jet_simulation_ == nullptr || is_start) {
    auto made = std::make_unique<WheelEquations<Jet>>(model_);
    made->wheel.initialize(make_segment(0.0), time_s_, made->states.data());
    jet_simulation_ = std::move(made);
  }
  WheelEquations<Jet>& simulation = *jet_simulation_;
  Jet lost{states_.back()};
  std::transform(states_.begin(), states_.end() - 1, simulation.states.begin(),
                 [](double value) { return Jet(value); });
  rigs::DrivenWheel<Jet>::Given given;
  given.acceleration_m_s2 = Jet(inputs_[kAcceleration]);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Variable& by = variable(known[i]);
    require_finite(direction[i], by.name);
    if (by.role == Role::kInput) {
      Jet& seeded = by.index == kAcceleration ? given.acceleration_m_s2 : given.seeds[by.index];
      seeded.v[0] += direction[i];
    } else if (by.role == Role::kState && !is_start) {
      Jet& seeded = by.index + 1 == state_count_ ? lost : simulation.states[by.index];
      seeded.v[0] += direction[i] * by.unit.factor;
    } else {
      throw bad_value(
          by, direction[i],
          is_start ? "derivatives at the start are by inputs alone" : "derivatives are by inputs and states alone");
    }
  }
  simulation.wheel.set_given(given);
  if (is_start) simulation.wheel.initialize(make_segment(0.0), time_s_, simulation.states.data());
  simulation.evaluate(make_segment(0.0), time_s_);
  const auto outputs = read_outputs(simulation.wheel);
  std::vector<double> derivatives;
  for (const std::size_t index : unknown) {
    const Variable& of = variable(index);
    const bool is_lost = of.index + 1 == state_count_;
    if (of.role == Role::kOutput) {
      derivatives.push_back(outputs[of.index].v[0]);
    } else if (of.role == Role::kState) {
      derivatives.push_back((is_lost ? lost : simulation.states[of.index]).v[0] / of.unit.factor);
    } else if (of.role == Role::kRate) {
      derivatives.push_back((is_lost ? simulation.integrals[kLostIntegral] : simulation.rates[of.index]).v[0] /
                            of.unit.factor);
    } else {
      throw bad_value(of, 0.0, "derivatives are those of outputs, states and rates alone");
    }
  }
  return derivatives;
}

Snapshot WarmWheel::take_snapshot() const {
  Snapshot snapshot{{}, inputs_, input_slopes_, states_, time_s_, checksum_};
  for (const double* parameter : parameters_) snapshot.parameters.push_back(*parameter);
  return snapshot;
}

void WarmWheel::restore(const Snapshot& snapshot) {
  const bool has_states = !snapshot.states.empty();
  if (snapshot.wheel != checksum_ || snapshot.parameters.size() != parameters_.size() ||
      snapshot.inputs.size() != inputs_.size() || snapshot.input_slopes.size() != inputs_.size() ||
      (has_states && snapshot.states.size() != state_count_)) {
    throw InputError({"the state is one of another wheel", "", 0, "", "", "a state of this wheel", ""});
  }
  require_time(snapshot.time_s);
  for (const Variable& given : variables_) {
    if (given.role != Role::kInput && given.role != Role::kParameter) continue;
    const double value = given.role == Role::kInput ? snapshot.inputs[given.index]
                                                    : given.unit.from_si(snapshot.parameters[given.index]);
    const double slack = 1e-9 * std::abs(value);  // of the conversion of units
    if (!given.range.contains(value) && !given.range.contains(value - slack) && !given.range.contains(value + slack)) {
      throw bad_value(given, value, "the state has a value that is not allowed");
    }
  }
  for (const double slope : snapshot.input_slopes) require_finite(slope, "slope");
  for (std::size_t i = 0; i < snapshot.states.size(); ++i) require_finite(snapshot.states[i], state(i).name);

  const Snapshot before = take_snapshot();
  const auto put = [this](const Snapshot& from) {
    for (std::size_t i = 0; i < parameters_.size(); ++i) *parameters_[i] = from.parameters[i];
    inputs_ = from.inputs;
    input_slopes_ = from.input_slopes;
  };
  std::unique_ptr<Simulation> simulation;
  const bool same_wheel = is_initialized() && before.parameters == snapshot.parameters;
  try {
    put(snapshot);
    if (has_states && !same_wheel) simulation = make_simulation(snapshot.time_s);
    if (has_states) (same_wheel ? *simulation_ : *simulation).wheel.require_possible(snapshot.states.data());
  } catch (...) {
    put(before);
    throw;
  }
  if (!same_wheel || !has_states) {
    simulation_ = std::move(simulation);
    forget_derivatives();
  }
  states_ = snapshot.states;
  time_s_ = snapshot.time_s;
  is_evaluated_ = false;
}

}  // namespace rollrig::fmu
