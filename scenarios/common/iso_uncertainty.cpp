#include "scenarios/common/iso_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/tire/conversion_laws.h"
#include "models/tire/drum_curvature.h"
#include "scenarios/common/iso_method_budgets.h"

namespace rollrig::scenarios {
namespace {

using estimation::Distribution;
using estimation::Evaluation;
using estimation::MeasurementModel;
using estimation::UncertainInput;

// Half-widths of rectangular distributions for instruments of which no file says anything.
constexpr double kIsoLoadLimit = 0.005;                 // Assumed: of the load, a force cell of class 0.5
constexpr double kIsoAmbientLimit_K = 0.2;              // Assumed: a calibrated resistance thermometer
constexpr double kIsoDiameterLimit_m = 0.001;           // Assumed: measured with a tape around the drum
constexpr double kIsoPressureLimit_Pa = 1e3;            // Assumed: a gauge with a resolution of 1 kPa
constexpr double kIsoSpeedLimit_m_s = 0.1 / kKmhPerMs;  // Assumed: a counter on the drum's shaft
constexpr std::size_t kFewestCycles = 3;                // Assumed: whose scatter says more than the sensor's file

/// Places of the inputs.
namespace iso_input {
enum : std::size_t { kReading, kOffset, kGain, kLoad, kDiameter, kAmbient, kSpeed, kPressure, kOfMethod };
}

/// An input with the half-width of a setting, else an assumed one.
UncertainInput make_instrument_input(const std::string& name, const std::string& key, double value,
                                     const std::optional<double>& given, double assumed) {
  const double half_width = given.value_or(assumed);
  UncertainInput input{name, key, value, half_width / std::sqrt(3.0), Distribution::kRectangular};
  const Unit unit = unit_of_key(key);
  const std::string limits = fmt::format("+-{:.4g} {}, rectangular", half_width / unit.factor, unit.symbol);
  input.source =
      given.has_value() ? limits + ", by the setting of the accuracy" : "Assumed: " + limits + "; no file gives it";
  input.is_from_limits = !given.has_value();
  return input;
}

/// F_r over F_r at the test's speed and pressure, of second order in both.
class IsoResponse {
 public:
  IsoResponse(const IsoSimulation& simulate, double speed_m_s, double pressure_Pa)
      : speed_m_s_(speed_m_s), pressure_Pa_(pressure_Pa) {
    const double center = simulate(speed_m_s, pressure_Pa);
    const auto ratio = [&](double speeds, double pressures) {
      return simulate(speed_m_s + speeds * kSpeedStep_m_s, pressure_Pa + pressures * kPressureStep_Pa) / center;
    };
    const double faster = ratio(1.0, 0.0), slower = ratio(-1.0, 0.0), harder = ratio(0.0, 1.0),
                 softer = ratio(0.0, -1.0);
    by_speed_ = 0.5 * (faster - slower);
    by_pressure_ = 0.5 * (harder - softer);
    by_speed_2_ = 0.5 * (faster + slower) - 1.0;
    by_pressure_2_ = 0.5 * (harder + softer) - 1.0;
    by_both_ = ratio(1.0, 1.0) - 1.0 - by_speed_ - by_speed_2_ - by_pressure_ - by_pressure_2_;
  }

  double calc_ratio(double speed_m_s, double pressure_Pa) const {
    const double s = (speed_m_s - speed_m_s_) / kSpeedStep_m_s;
    const double p = (pressure_Pa - pressure_Pa_) / kPressureStep_Pa;
    return 1.0 + (by_speed_ + by_speed_2_ * s) * s + (by_pressure_ + by_pressure_2_ * p) * p + by_both_ * s * p;
  }

 private:
  static constexpr double kSpeedStep_m_s = 2.0 / kKmhPerMs;  // many uncertainties: differences far above rounding
  static constexpr double kPressureStep_Pa = 5e3;

  double speed_m_s_, pressure_Pa_;
  double by_speed_ = 0.0, by_speed_2_ = 0.0, by_pressure_ = 0.0, by_pressure_2_ = 0.0, by_both_ = 0.0;
};

/// Whether the scatter of the cycles stands for noise and drift of the sensor.
bool has_scatter(const RunSpec& spec, const MethodBudget& budget, const std::vector<Cycle>& cycles) {
  return has_sensor(spec, budget) && cycles.size() > kFewestCycles;
}

struct ScatterOfCycles {
  double sd_N = 0.0;
  double degrees_of_freedom = 0.0;
};

/// Scatter of the rolling resistance about its trend. The first cycle, the end of the warm-up, is left out: the tire is
/// not as warm in it as in those that follow.
/// Equation  s^2 = sum (F_{i+1} - F_i)^2 / (2 (n - 1)), with 2 (n - 1)^2/(3 n - 4) degrees of freedom
/// Validity  a trend that is small from cycle to cycle; normal errors
/// Source    mean square successive difference, von Neumann et al., Annals of Mathematical Statistics 12 (1941) 153; not
///           read. The degrees of freedom: twice its squared mean over its variance
ScatterOfCycles calc_scatter(const std::vector<Cycle>& cycles) {
  const auto n = static_cast<double>(cycles.size() - 1);
  double squares = 0.0;
  for (std::size_t i = 2; i < cycles.size(); ++i) {
    squares += std::pow(cycles[i].rolling_resistance_N - cycles[i - 1].rolling_resistance_N, 2);
  }
  return {std::sqrt(squares / (2.0 * (n - 1.0))), 2.0 * (n - 1.0) * (n - 1.0) / (3.0 * n - 4.0)};
}

/// Standard deviation of the two decelerations, referred to the loaded one.
/// Equation  s^2 = s_t^2 + (c_s/c_t)^2 s_s^2
/// Symbols   s_t, s_s standard deviation of the loaded deceleration and of that in skim; c mass at the surface
UncertainInput make_deceleration_input(const RunSpec& spec, const Cycle& cycle, const MethodReadings& readings) {
  const double mass_ratio =
      calc_coasting_mass_kg(spec, cycle.skim.load_N) / calc_coasting_mass_kg(spec, cycle.loaded.load_N);
  UncertainInput input{"scatter of the coasts", "deceleration_m_s2", readings.loaded - readings.skim,
                       std::hypot(readings.loaded_sd, mass_ratio * readings.skim_sd)};
  input.source = "scatter of the speeds about the curves that fit the coasts";
  input.evaluation = Evaluation::kTypeA;
  return input;
}

/// How much force the reading of a method stands for, per unit.
double calc_force_per_reading(const RunSpec& spec, const MethodBudget& budget, const Reading& at) {
  const double own = budget.own.has_value() ? budget.own->value.value_or(0.0) : 0.0;
  return budget.calc_force_N({spec, at, 1.0, spec.rig.lever_m(), 1.0, own});
}

/// The difference of the two readings: its error from noise, drift and resolution, by the sensor or by the cycles.
UncertainInput make_reading_input(const RunSpec& spec, const std::vector<Cycle>& cycles,
                                  const MethodReadings& readings) {
  const Cycle& cycle = cycles.back();
  const MethodBudget& budget = find_method_budget(readings.method);
  UncertainInput input{"noise and drift, load minus skim", find_reading_key(spec, budget),
                       readings.loaded - readings.skim};
  if (!has_scatter(spec, budget, cycles)) {
    if (budget.is_slope()) return make_deceleration_input(spec, cycle, readings);
    const MethodSensor at = find_method_sensor(spec, budget, cycle.loaded.speed_m_s);
    input.standard_uncertainty =
        std::sqrt(models::calc_difference_variance(at.sensor, cycle.loaded.samples, spec.sample_interval_s,
                                                   cycle.skim.window.start_s - cycle.loaded.window.start_s));
    input.source = at.source;
    input.is_from_limits = at.is_assumed;
    return input;
  }
  const ScatterOfCycles scatter = calc_scatter(cycles);
  input.name = "repeatability, cycle to cycle";
  input.standard_uncertainty = scatter.sd_N / calc_force_per_reading(spec, budget, cycle.loaded);
  input.degrees_freedom = scatter.degrees_of_freedom;
  input.evaluation = Evaluation::kTypeA;
  input.distribution = Distribution::kStudentT;
  input.source =
      fmt::format("successive differences of {} cycles, noise and drift of the sensor included", cycles.size() - 1);
  return input;
}

UncertainInput make_pressure_input(const RunSpec& spec, double pressure_Pa, const IsoAccuracies& accuracies) {
  const models::SensorSet& usual = spec.rig.kind->default_sensors;
  for (const models::SensorSet* sensors : {spec.sensors.has_value() ? &*spec.sensors : nullptr, &usual}) {
    if (accuracies.pressure_Pa.has_value() || sensors == nullptr) continue;
    if (sensors->count(quantities::kCavityPressure) == 0) continue;
    UncertainInput input{"pressure as set", "pressure_kPa", pressure_Pa,
                         sensors->at(quantities::kCavityPressure).offset_sd};
    input.source = "offset of the sensor of the cavity pressure";
    return input;
  }
  return make_instrument_input("pressure as set", "pressure_kPa", pressure_Pa, accuracies.pressure_Pa,
                               kIsoPressureLimit_Pa);
}

UncertainInput make_diameter_input(const RunSpec& spec, const IsoAccuracies& accuracies) {
  if (reads_torque(spec.rig.kind->traits)) {
    return make_instrument_input("drum diameter", "diameter_m", spec.rig.drum.diameter_m, accuracies.drum_diameter_m,
                                 kIsoDiameterLimit_m);
  }
  UncertainInput input{"drum diameter", "diameter_m"};
  input.source = "none: a flat surface";
  return input;
}

/// The common offset of both readings.
UncertainInput make_offset_input(const RunSpec& spec, const MethodBudget& budget, double speed_m_s) {
  const std::string key = find_reading_key(spec, budget);
  if (budget.is_slope()) {
    UncertainInput none{"zero of the speed", key};
    none.source = "none: a slope over time has no zero";
    return none;
  }
  UncertainInput offset{budget.zero_name, key};
  const MethodSensor at = find_method_sensor(spec, budget, speed_m_s);
  offset.standard_uncertainty = at.sensor.offset_sd;
  offset.is_from_limits = at.is_assumed;
  offset.source = at.is_assumed ? at.source : "offset of the sensor; the skim test cancels it";
  return offset;
}

std::vector<UncertainInput> make_iso_inputs(const RunSpec& spec, const std::vector<Cycle>& cycles,
                                            const MethodReadings& readings, double pressure_Pa,
                                            const IsoAccuracies& accuracies) {
  const Reading& loaded = cycles.back().loaded;
  const MethodBudget& budget = find_method_budget(readings.method);
  const std::optional<double> load_N =
      accuracies.load.has_value() ? std::optional(*accuracies.load * loaded.load_N) : std::nullopt;
  std::vector<UncertainInput> inputs{
      make_reading_input(spec, cycles, readings),
      make_offset_input(spec, budget, loaded.speed_m_s),
      make_instrument_input(budget.gain_name, "gain_percent", 1.0, accuracies.gain, budget.gain_limit),
      make_instrument_input("load", "load_N", loaded.load_N, load_N, kIsoLoadLimit * loaded.load_N),
      make_diameter_input(spec, accuracies),
      make_instrument_input("ambient temperature", "ambient_degC", loaded.ambient_K, accuracies.ambient_K,
                            kIsoAmbientLimit_K),
      make_instrument_input("speed", "speed_km_h", loaded.speed_m_s, accuracies.speed_m_s, kIsoSpeedLimit_m_s),
      make_pressure_input(spec, pressure_Pa, accuracies)};
  if (budget.own.has_value()) {
    const OwnInput& own = *budget.own;
    inputs.push_back(make_instrument_input(own.name, own.key, own.value.value_or(readings.misalignment_rad),
                                           accuracies.*own.accuracy, own.assumed));
  }
  return inputs;
}

/// K_r for another diameter of a drum, over that for the rig's own; 1 on a belt.
double calc_diameter_correction(const RunSpec& spec, double diameter_m) {
  if (!reads_torque(spec.rig.kind->traits)) return 1.0;
  constexpr double kReferenceCurvature_per_m = 1.0;  // of the 2 m drum
  const double tire_radius_m = spec.tire.values.geometry.outer_diameter_m / 2.0;
  const auto correction = [&](double curvature_per_m) {
    return models::calc_drum_correction(curvature_per_m, kReferenceCurvature_per_m, tire_radius_m);
  };
  return correction(2.0 / diameter_m) / correction(spec.rig.curvature_per_m());
}

}  // namespace

MeasurementModel make_iso_model(const RunSpec& spec, const std::vector<Cycle>& cycles, const MethodReadings& readings,
                                double pressure_Pa, const IsoAccuracies& accuracies, const IsoSimulation& simulate) {
  MeasurementModel model;
  const std::string by = readings.method == kTorqueMethod ? "" : fmt::format(" by the {} method", readings.method);
  model.measurands = {{"RRc at 25 degC, 2 m drum", "rrc_25degC_2m_N_per_kN"}, {"RRc as measured" + by, "rrc_N_per_kN"}};
  model.inputs = make_iso_inputs(spec, cycles, readings, pressure_Pa, accuracies);
  model.left_out = {"mounting of the tire, and how the test repeats from day to day: this is one test"};
  const MethodBudget& budget = find_method_budget(readings.method);
  if (!has_scatter(spec, budget, cycles)) {
    model.left_out.push_back(
        budget.channel == nullptr
            ? fmt::format(
                  "repeatability from cycle to cycle: it takes measurement_cycles = {} or more, with a sensor of "
                  "the {}",
                  kFewestCycles, readings.method)
            : fmt::format("repeatability from cycle to cycle: no sensor of the {} method is simulated",
                          readings.method));
  }
  if (budget.is_slope() && !has_sensor(spec, budget)) {
    model.left_out.push_back("noise of the speed: the run has no sensor of the speed");
  }
  model.left_out.insert(model.left_out.end(), budget.left_out.begin(), budget.left_out.end());
  const double speed_m_s = model.inputs[iso_input::kSpeed].value;
  const IsoResponse response(simulate, speed_m_s, pressure_Pa);
  model.evaluate = [&spec, &budget, response, speed_m_s, skim = readings.skim,
                    cycle = cycles.back()](const std::vector<double>& x) {
    const bool is_drum = reads_torque(spec.rig.kind->traits);
    const auto calc_force_N = [&](const Reading& at, double value) {
      return budget.calc_force_N({spec, at, value, is_drum ? 0.5 * x[iso_input::kDiameter] : spec.rig.lever_m(),
                                  x[iso_input::kSpeed] / speed_m_s,
                                  budget.own.has_value() ? x[iso_input::kOfMethod] : 0.0});
    };
    const double loaded_N = calc_force_N(cycle.loaded, skim + x[iso_input::kReading] + x[iso_input::kOffset]);
    const double skim_N = calc_force_N(cycle.skim, skim + x[iso_input::kOffset]);
    const double resistance_N =
        x[iso_input::kGain] * (loaded_N - skim_N) * response.calc_ratio(x[iso_input::kSpeed], x[iso_input::kPressure]);
    const double rrc = resistance_N / x[iso_input::kLoad];
    return std::vector<double>{
        correct_rrc(rrc, x[iso_input::kAmbient], spec) * calc_diameter_correction(spec, x[iso_input::kDiameter]), rrc};
  };
  return model;
}

}  // namespace rollrig::scenarios
