#include "estimation/rolling_law/rolling_uncertainty.h"

#include <optional>
#include <utility>

#include "estimation/uncertainty/common_inputs.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

// Half-widths of rectangular distributions, common to all points. Assumed: of gain, load, pressure and speed what
// machines for ISO 28580 have to keep (UN R117 Annex 6, appendix 1); nothing on them was found in SAE J2452 and SAE
// J1269.
constexpr double kRollingForceGainLimit = 0.005;
constexpr double kRollingParasiticLimit_N = 0.1;  // Assumed: drift of the zero between load and skim
constexpr double kRollingLoadLimit = 0.005;
constexpr double kRollingPressureLimit_Pa = 1e3;
constexpr double kRollingSpeedLimit_m_s = 0.1 / kKmhPerMs;

/// Places of the inputs. The scatter of the points follows, at kSpeed where the law has no speed.
namespace rolling_input {
enum : std::size_t { kGain, kParasitic, kLoad, kPressure, kSpeed };
}

/// How the forces of the points scatter, each by itself and, where there are any, whole sets.
struct PointScatter {
  double sd_N = 0.0;
  double freedom = 0.0;
  std::optional<SetScatter> set_scatter;
};

struct RollingInputs {
  std::vector<UncertainInput> inputs;
  PointScatter scatter;
  std::size_t first_scatter = 0;      // place of the first one of the points
  std::size_t first_set_scatter = 0;  // likewise of the sets
  bool has_speed = false;
};

RollingInputs make_rolling_inputs(const std::vector<FittedPoint>& points, const PointScatter& scatter, bool has_speed) {
  double speed_m_s = 0.0, pressure_Pa = 0.0;
  for (const FittedPoint& at : points) {
    speed_m_s += at.point.speed_m_s / static_cast<double>(points.size());
    pressure_Pa += at.point.pressure_Pa / static_cast<double>(points.size());
  }
  RollingInputs made;
  made.has_speed = has_speed;
  made.inputs = {make_assumed_input("gain of torque or force", "gain_percent", 1.0, kRollingForceGainLimit, "0.5 %"),
                 make_assumed_input("parasitic loss that was subtracted", "force_N", 0.0, kRollingParasiticLimit_N,
                                    "0.1 N, the drift of the zero between load and skim"),
                 make_assumed_input("gain of the load", "gain_percent", 1.0, kRollingLoadLimit, "0.5 %"),
                 make_assumed_input("pressure", "pressure_kPa", pressure_Pa, kRollingPressureLimit_Pa, "1 kPa")};
  if (has_speed) {
    made.inputs.push_back(make_assumed_input("speed", "speed_km_h", speed_m_s, kRollingSpeedLimit_m_s, "0.1 km/h"));
  }
  made.scatter = scatter;
  const auto add = [&made](std::vector<UncertainInput> inputs) {
    const std::size_t first = made.inputs.size();
    made.inputs.insert(made.inputs.end(), inputs.begin(), inputs.end());
    return first;
  };
  made.first_scatter = add(make_scatter_inputs(points.size(), scatter.freedom, "scatter of the points",
                                               "standard deviation of the residuals"));
  if (scatter.set_scatter.has_value()) {
    made.first_set_scatter =
        add(make_scatter_inputs(scatter.set_scatter->set_count(), scatter.set_scatter->find_whole_freedom(),
                                "scatter from set to set", "how far sets lie off the law"));
  }
  return made;
}

/// Points as they would be measured with the errors of the inputs.
std::vector<RollingPoint> apply_errors(const std::vector<FittedPoint>& points, const RollingInputs& made,
                                       const std::vector<double>& x) {
  const std::vector<double> scatter = take_scatter(x, made.first_scatter, points.size());
  const std::optional<SetScatter>& set_scatter = made.scatter.set_scatter;
  const std::vector<double> set_errors = set_scatter.has_value()
                                             ? take_scatter(x, made.first_set_scatter, set_scatter->set_count())
                                             : std::vector<double>{};
  const auto error_of = [&](std::size_t i) { return x[i] - made.inputs[i].value; };
  std::vector<RollingPoint> measured;
  for (std::size_t i = 0; i < points.size(); ++i) {
    RollingPoint point = points[i].point;
    const double of_set =
        set_scatter.has_value() ? set_scatter->relative_sd * set_errors[set_scatter->set_of_point[i]] : 0.0;
    const double force_N = points[i].fitted_N * (1.0 + of_set) + made.scatter.sd_N * scatter[i];
    point.force_N = x[rolling_input::kGain] * force_N + x[rolling_input::kParasitic];
    point.load_N *= x[rolling_input::kLoad];
    point.pressure_Pa += error_of(rolling_input::kPressure);
    if (made.has_speed) point.speed_m_s += error_of(rolling_input::kSpeed);
    measured.push_back(point);
  }
  return measured;
}

void require_freedom(const RollingTest& test, const RegressionStatistics& statistics) {
  if (statistics.freedom > 0) return;
  throw InputError(
      {"there are as many coefficients as points, so that their scatter is unknown and no uncertainty can "
       "be given",
       test.path, 0, "", "", "more points, or no --uncertainty and no --monte-carlo", ""});
}

std::vector<std::string> list_rolling_left_out(const RollingTest& test) {
  std::vector<std::string> left_out{"the tire itself: break-in, storage, how one tire of a kind differs from another",
                                    "temperature of the air: the points say nothing of it",
                                    "diameter and surface of the drum: the forces are those of this machine"};
  if (test.is_simulated) {
    left_out.push_back("that the test was simulated: the instruments are those of a machine that would measure it");
  }
  return left_out;
}

PointScatter find_point_scatter(const J2452Fit& fit) {
  if (!fit.includes_set_scatter())
    return {fit.statistics.residual_sd_N, static_cast<double>(fit.statistics.freedom), {}};
  return {fit.set_scatter->point_sd_N, fit.set_scatter->freedom_within, fit.set_scatter};
}

}  // namespace

MeasurementModel make_j2452_model(const RollingTest& test, const J2452Fit& fit,
                                  const std::optional<J2452Reference>& reference) {
  require_freedom(test, fit.statistics);
  MeasurementModel model;
  model.measurands = {{"alpha, of pressure", "alpha"}, {"beta, of load", "beta"}};
  if (reference.has_value()) {
    model.measurands.insert(model.measurands.end(), {{"F at 80 km/h", "rolling_resistance_N"},
                                                     {"RRc", "rrc_N_per_kN"},
                                                     {"MERF, " + reference->cycles.urban_cycle, "merf_urban_N"},
                                                     {"MERF, " + reference->cycles.highway_cycle, "merf_highway_N"},
                                                     {"SMERF", "smerf_N"}});
  }
  const RollingInputs made = make_rolling_inputs(fit.points, find_point_scatter(fit), true);
  model.inputs = made.inputs;
  model.left_out = list_rolling_left_out(test);
  model.evaluate = [points = fit.points, made, reference](const std::vector<double>& x) {
    const J2452Fit again = fit_j2452(apply_errors(points, made, x));
    std::vector<double> results{again.law.alpha, again.law.beta};
    if (reference.has_value()) {
      const J2452Reference at = evaluate_reference(again, reference->condition, reference->cycles);
      results.insert(results.end(), {at.force.value_N, at.force.value_N / at.condition.load_N, at.urban.value_N,
                                     at.highway.value_N, at.combined.value_N});
    }
    return results;
  };
  return model;
}

MeasurementModel make_multipoint_model(const RollingTest& test, const MultipointFit& fit,
                                       const std::optional<MultipointReference>& reference) {
  require_freedom(test, fit.statistics);
  MeasurementModel model;
  const std::string at = reference.has_value() ? "reference" : "mean load, pressure";
  model.measurands = {{"F at " + at, "rolling_resistance_N"}, {"RRc", "rrc_N_per_kN"}};
  const RollingInputs made = make_rolling_inputs(
      fit.points, {fit.statistics.residual_sd_N, static_cast<double>(fit.statistics.freedom), {}}, false);
  model.inputs = made.inputs;
  model.left_out = list_rolling_left_out(test);
  const double load_N = reference.has_value() ? reference->condition.load_N : fit.load_0_N;
  const double pressure_Pa = reference.has_value() ? reference->condition.pressure_Pa : fit.pressure_0_Pa;
  model.evaluate = [points = fit.points, form = fit.form, made, load_N, pressure_Pa](const std::vector<double>& x) {
    const MultipointFit again = fit_multipoint(apply_errors(points, made, x), form);
    const double force_N = again.estimate_force(load_N, pressure_Pa).value_N;
    return std::vector<double>{force_N, force_N / load_N};
  };
  return model;
}

}  // namespace rollrig::estimation
