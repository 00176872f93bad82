#include "estimation/road_load/road_load_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/road_load/road_load_report.h"
#include "estimation/uncertainty/common_inputs.h"
#include "estimation/uncertainty/covariance_root.h"

namespace rollrig::estimation {
namespace {

// Half-widths of rectangular distributions; no file says anything of these instruments.
constexpr double kMassLimit = 0.002;         // Assumed: of the mass, a vehicle scale, driver and load included
constexpr double kKnownRotatingLimit = 0.1;  // Assumed: of a rotating mass that is given
constexpr double kRatioLimit = 0.01;  // Assumed: of the mass as tested, where 3 % of it are taken for what rotates
constexpr double kSpeedGainLimit = 0.002;    // Assumed: satellite navigation or a wheel of known circumference
constexpr double kAmbientLimit_K = 1.0;      // Assumed: a thermometer at the track
constexpr double kPressureLimit_Pa = 300.0;  // Assumed: a barometer at the track
constexpr double kFallLimit = 0.3;           // Assumed: of K_0, which differs from tire to tire

constexpr std::size_t kScattered = 3;  // A, B, C

/// Places of the inputs after those of the scatter.
namespace road_input {
enum : std::size_t { kMass = kScattered + 1, kRotating, kSpeedGain, kAmbient, kPressure, kFall };
}

/// Mean over all samples (or bins) of all runs; `missing` where there are none.
double calc_mean_of(const CoastdownData& data, std::vector<double> CoastdownConditions::*member, double missing) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CoastdownRun& run : data.runs) {
    for (const double value : run.conditions.*member) sum += value;
    count += (run.conditions.*member).size();
  }
  return count == 0 ? missing : sum / static_cast<double>(count);
}

/// The fewest degrees of freedom of the coefficients that are not on a bound.
double find_least_freedom(const RoadLoadFit& fit) {
  double freedom = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kScattered; ++i) {
    if (!fit.on_bound[i]) freedom = std::min(freedom, fit.degrees_freedom[i]);
  }
  return std::max(1.0, freedom);
}

std::vector<UncertainInput> make_road_inputs(const CoastdownData& data, const RoadLoadFitOptions& options,
                                             const RoadLoadFit& fit) {
  std::vector<UncertainInput> inputs = make_scatter_inputs(kScattered, find_least_freedom(fit), "scatter of the runs",
                                                           "covariance of A, B and C by the fit");
  const double mass_kg = find_test_mass_kg(options, fit.effective_mass_kg);
  const double rotating_kg = fit.effective_mass_kg - mass_kg;
  inputs.push_back(make_assumed_input("mass as tested", "mass_kg", mass_kg, kMassLimit * mass_kg, "0.2 % of the mass"));
  inputs.push_back(options.rotating_mass_kg.has_value()
                       ? make_assumed_input("rotating mass", "rotating_mass_kg", rotating_kg,
                                            kKnownRotatingLimit * rotating_kg, "10 % of it")
                       : make_assumed_input("rotating mass", "rotating_mass_kg", rotating_kg, kRatioLimit * mass_kg,
                                            "1 % of the mass as tested, since 3 % of it are taken"));
  if (fit.per_mass) {
    for (std::size_t i = road_input::kMass; i <= road_input::kRotating; ++i) {
      inputs[i].standard_uncertainty = 0.0;
      inputs[i].source = "none: forces per unit of mass";
      inputs[i].is_from_limits = false;
    }
  }
  inputs.push_back(make_assumed_input("gain of the speed", "gain_percent", 1.0, kSpeedGainLimit, "0.2 %"));
  inputs.push_back(make_assumed_input(
      "air temperature", "ambient_degC",
      calc_mean_of(data, &CoastdownConditions::ambient_K, options.reference_temperature_K), kAmbientLimit_K, "1 degC"));
  inputs.push_back(
      make_assumed_input("air pressure", "ambient_pressure_kPa",
                         calc_mean_of(data, &CoastdownConditions::ambient_pressure_Pa, options.reference_pressure_Pa),
                         kPressureLimit_Pa, "0.3 kPa"));
  inputs.push_back(make_assumed_input("fall of A and B with temperature", "fall_per_K", options.rolling_fall_per_K,
                                      kFallLimit * options.rolling_fall_per_K, "30 % of it"));
  return inputs;
}

void list_left_out(const CoastdownData& data, const RoadLoadFit& fit, MeasurementModel& model) {
  model.left_out.push_back("the state of the vehicle: tires, brakes, bearings, alignment");
  if (!fit.wind_corrected) model.left_out.push_back("wind: it was not measured; its scatter is in that of the runs");
  if (!fit.ambient_corrected) model.left_out.push_back("air temperature during the test: it was not measured");
  if (data.runs.size() < 4) {
    model.left_out.push_back("how coastdowns differ from run to run: there are too few runs to tell");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (fit.on_bound[i]) {
      model.left_out.push_back(fmt::format("scatter of {}, which is on its limit", model.measurands[i].key));
    }
  }
}

}  // namespace

MeasurementModel make_road_load_model(const CoastdownData& data, const RoadLoadFitOptions& options,
                                      const RoadLoadFit& fit) {
  MeasurementModel model;
  constexpr const char* kNames[] = {"A, at standstill", "B, rise with speed", "C, rise with the square of speed"};
  for (int i = 0; i < 3; ++i) model.measurands.push_back({kNames[i], road_load_key(i, fit.per_mass)});
  model.inputs = make_road_inputs(data, options, fit);
  list_left_out(data, fit, model);
  const std::array<double, 3> fitted = fit.values();
  const Eigen::Vector3d load(fitted[0], fitted[1], fitted[2]);
  const Eigen::Matrix3d root = calc_covariance_root(fit.covariance);
  const double reference_K = options.reference_temperature_K;
  const auto rolling = [reference_K](double fall_per_K, double ambient_K) {
    return 1.0 + fall_per_K * (ambient_K - reference_K);
  };
  const double rolling_0 = rolling(model.inputs[road_input::kFall].value, model.inputs[road_input::kAmbient].value);
  const double density_0 = model.inputs[road_input::kPressure].value / model.inputs[road_input::kAmbient].value;
  const double mass_0 = model.inputs[road_input::kMass].value + model.inputs[road_input::kRotating].value;
  model.evaluate = [=](const std::vector<double>& x) {
    const std::vector<double> scatter = take_scatter(x, 0, kScattered);
    const Eigen::Vector3d scattered = load + root * Eigen::Vector3d(scatter[0], scatter[1], scatter[2]);
    const double by_mass = (x[road_input::kMass] + x[road_input::kRotating]) / mass_0;
    const double by_weather = rolling(x[road_input::kFall], x[road_input::kAmbient]) / rolling_0;
    const double by_density = density_0 * x[road_input::kAmbient] / x[road_input::kPressure];
    return std::vector<double>{by_mass * by_weather * x[road_input::kSpeedGain] * scattered(0),
                               by_mass * by_weather * scattered(1),
                               by_mass * by_density / x[road_input::kSpeedGain] * scattered(2)};
  };
  return model;
}

}  // namespace rollrig::estimation
