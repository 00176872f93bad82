#include "estimation/road_load/procedure_uncertainty.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "estimation/uncertainty/common_inputs.h"
#include "estimation/uncertainty/covariance_root.h"

namespace rollrig::estimation {
namespace {

constexpr std::size_t kCoefficients = 3;

/// Root L of the covariance of the coefficients as tested.
Eigen::Matrix3d calc_tested_root(const RoadLoadProcedure& procedure) {
  Eigen::Matrix3d jacobian;  // the correction is linear in the coefficients
  for (int i = 0; i < 3; ++i) {
    TestedRoadLoad unit = procedure.tested;
    unit.measured = Eigen::Vector3d::Unit(i);
    jacobian.col(i) = apply_sensor_errors(unit, {}, {});
  }
  return jacobian.inverse() * calc_covariance_root(procedure.repeatability);
}

double find_fewest_freedom(const RoadLoadProcedure& procedure) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (procedure.repeatability(i, i) > 0.0) least = std::min(least, procedure.freedom(i));
  }
  return std::max(1.0, least);
}

UncertainInput make_sensor_input(const RoadLoadSensor& sensor) {
  UncertainInput input{sensor.name, sensor.key, sensor.reading, sensor.half_width / std::sqrt(3.0),
                       Distribution::kRectangular};
  input.source = sensor.source;
  input.is_from_limits = true;
  return input;
}

std::vector<std::string> list_procedure_left_out(const RoadLoadProcedure& procedure) {
  std::vector<std::string> left_out{
      "the state of the vehicle: tires, brakes, bearings, alignment",
      "K0, by which the rolling loss falls with the temperature of the air",
      procedure.rotating_mass_assumed ? "the rotating mass, for which 3 % of the mass are taken" : "the rotating mass"};
  if (procedure.kind == RoadLoadProcedureKind::kWltp) {
    left_out.push_back(
        "the bias of the procedure, from times over bins of speed: up to 0.1 % of the force, in f1 some 3 % of it");
  }
  const TestedRoadLoad& tested = procedure.tested;
  if (!tested.correction.ambient_K.has_value()) left_out.push_back("air temperature: it was not measured");
  if (tested.correction.ambient_K.has_value() && !tested.correction.ambient_pressure_Pa.has_value()) {
    left_out.push_back("air pressure: it was not measured");
  }
  if (procedure.kind == RoadLoadProcedureKind::kJ1263) {
    left_out.push_back("wind: the error of its mean is not propagated");
  } else if (!tested.has_air_speed && tested.correction.wind_m_s == 0.0) {
    left_out.push_back("wind: it was not measured, or opposite headings cancel it");
  }
  if (tested.most_torque_Nm > 0.0 && tested.wheel_speed_Hz == 0.0) {
    left_out.push_back("the dynamic radius, which was given");
  }
  return left_out;
}

}  // namespace

MeasurementModel make_procedure_model(const RoadLoadProcedure& procedure) {
  MeasurementModel model;
  model.measurands = {{"f0", "f0_N"}, {"f1", "f1_N_per_km_h"}, {"f2", "f2_N_per_km_h2"}};
  const bool has_f1 = procedure.kind != RoadLoadProcedureKind::kJ1263;
  if (!has_f1) model.measurands.erase(model.measurands.begin() + 1);
  model.inputs = make_scatter_inputs(kCoefficients, find_fewest_freedom(procedure), "scatter of the runs",
                                     "covariance of f0, f1 and f2 by the procedure");
  const std::size_t first_sensor = model.inputs.size();
  std::vector<RoadLoadSensor> sensors = list_road_load_sensors(procedure.tested);
  for (const RoadLoadSensor& sensor : sensors) model.inputs.push_back(make_sensor_input(sensor));
  model.left_out = list_procedure_left_out(procedure);
  model.evaluate = [tested = procedure.tested, root = calc_tested_root(procedure), sensors = std::move(sensors),
                    inputs = model.inputs, first_sensor, has_f1](const std::vector<double>& x) {
    const std::vector<double> scatter = take_scatter(x, 0, kCoefficients);
    TestedRoadLoad drawn = tested;
    drawn.measured += root * Eigen::Vector3d(scatter[0], scatter[1], scatter[2]);
    std::vector<double> errors;
    for (std::size_t i = first_sensor; i < x.size(); ++i) errors.push_back(x[i] - inputs[i].value);
    const Eigen::Vector3d load = apply_sensor_errors(drawn, sensors, errors);
    return has_f1 ? std::vector<double>{load(0), load(1), load(2)} : std::vector<double>{load(0), load(2)};
  };
  return model;
}

}  // namespace rollrig::estimation
