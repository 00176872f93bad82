#include "estimation/drum_deceleration/coast_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/drum_deceleration/coast_evaluation.h"
#include "estimation/uncertainty/common_inputs.h"
#include "models/deceleration_method.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

// Half-widths of rectangular distributions. Assumed: as machines for ISO 28580 have to keep them (UN R117 Annex 6,
// appendix 1), the inertias as `inertia_accuracy_percent` of iso_28580, the rolling radius as a tape measures it.
constexpr double kCoastInertiaLimit = 0.005;
constexpr double kCoastDrumDiameterLimit_m = 0.001;
constexpr double kCoastRollingRadiusLimit_m = 0.002;
constexpr double kCoastMassRatioLimit = 0.05;
constexpr double kCoastSpeedLimit_m_s = 0.1 / kKmhPerMs;
constexpr double kCoastPressureLimit_Pa = 1e3;

constexpr double kLeastShare = 0.01;  // of a net deceleration, that its logarithm is taken of at least

/// What is known at the reference speed.
struct CoastLevels {
  double speed_m_s = 0.0;
  std::vector<double> pressures_Pa;
  std::vector<double> loaded_m_s2;  // means
  std::vector<double> net_m_s2;     // above 0 where there is an exponent
  std::vector<double> sd_of_means;  // of these, in units of the pooled scatter's standard deviation
  std::vector<std::string> names;   // "250 kPa", "250 kPa, 4000 N"
};

/// Places of the inputs in MeasurementModel::inputs; those of several come first. Not there where not needed.
struct CoastInputs {
  std::vector<UncertainInput> list;
  std::size_t runs = 0;  // scatter of the loaded runs, as many as levels
  std::size_t law = 0;   // scatter of the levels about the power law, likewise
  std::optional<std::size_t> drum_alone, wheel_alone, drum_inertia, wheel_inertia, mass_ratio, drum_diameter,
      rolling_radius;
  std::size_t speed = 0, pressure = 0;

  std::size_t add(UncertainInput input) {
    list.push_back(std::move(input));
    return list.size() - 1;
  }
  double value(const std::vector<double>& x, const std::optional<std::size_t>& place, double otherwise) const {
    return place.has_value() ? x[*place] : otherwise;
  }
};

UncertainInput make_mean_input(const std::string& name, const MeanOfRuns& mean) {
  UncertainInput input{name, "deceleration_m_s2", mean.mean, std::sqrt(mean.of_mean.variance)};
  input.evaluation = Evaluation::kTypeA;
  input.source = "standard deviation of the lifted runs over the root of their number";
  if (mean.runs > 1) {
    input.distribution = Distribution::kStudentT;
    input.degrees_freedom = mean.of_mean.freedom;
  } else {
    input.source = "scatter within the one lifted run: that from run to run is not known";
  }
  return input;
}

void add_inertia_inputs(const CoastSet& set, CoastInputs& inputs) {
  if (set.drum_inertia_kg_m2.has_value()) {
    inputs.drum_inertia = inputs.add(make_assumed_input("inertia of the drum", "inertia_kg_m2", *set.drum_inertia_kg_m2,
                                                        kCoastInertiaLimit * *set.drum_inertia_kg_m2, "0.5 %"));
    inputs.drum_diameter = inputs.add(make_assumed_input("diameter of the drum", "drum_diameter_m", set.drum_diameter_m,
                                                         kCoastDrumDiameterLimit_m, "1 mm"));
  }
  if (set.wheel_mass_ratio.has_value()) {
    inputs.mass_ratio =
        inputs.add(make_assumed_input("share of the wheel in the inertia", "ratio", *set.wheel_mass_ratio,
                                      kCoastMassRatioLimit * *set.wheel_mass_ratio, "5 %"));
  } else if (set.drum_inertia_kg_m2.has_value() && set.wheel_inertia_kg_m2.has_value() &&
             set.wheel_rolling_radius_m.has_value()) {
    inputs.wheel_inertia =
        inputs.add(make_assumed_input("inertia of tire and wheel", "inertia_kg_m2", *set.wheel_inertia_kg_m2,
                                      kCoastInertiaLimit * *set.wheel_inertia_kg_m2, "0.5 %"));
    inputs.rolling_radius = inputs.add(make_assumed_input(
        "rolling radius", "rolling_radius_m", *set.wheel_rolling_radius_m, kCoastRollingRadiusLimit_m, "2 mm"));
  }
}

/// The set with the inertias and radii of a trial.
CoastSet apply_inputs(const CoastSet& set, const CoastInputs& inputs, const std::vector<double>& x) {
  CoastSet trial = set;
  trial.runs.clear();
  if (inputs.drum_inertia.has_value()) trial.drum_inertia_kg_m2 = x[*inputs.drum_inertia];
  if (inputs.wheel_inertia.has_value()) trial.wheel_inertia_kg_m2 = x[*inputs.wheel_inertia];
  if (inputs.mass_ratio.has_value()) trial.wheel_mass_ratio = x[*inputs.mass_ratio];
  if (inputs.drum_diameter.has_value()) trial.drum_diameter_m = x[*inputs.drum_diameter];
  if (inputs.rolling_radius.has_value()) trial.wheel_rolling_radius_m = x[*inputs.rolling_radius];
  return trial;
}

std::size_t find_reference_index(const CoastSet& set, const DrumCoastdownFit& fit) {
  const std::size_t index = find_reference_speed(set);
  if (!fit.points[index].levels.empty()) return index;
  throw InputError({fmt::format("there is no result near the reference speed, {:.1f} km/h, to give an uncertainty for",
                                kKmhPerMs * set.reference_speed_m_s),
                    set.path, 0, "reference_speed_km_h", "",
                    "one of speeds_km_h at which loaded and lifted runs have a result", ""});
}

CoastLevels list_levels(const SpeedPoint& point) {
  CoastLevels levels;
  levels.speed_m_s = point.speed_m_s;
  const auto differs = [&point](const PressureLevel& level) {
    return !is_same_load(level.load_N, point.levels.front().load_N);
  };
  const bool has_loads = std::any_of(point.levels.begin(), point.levels.end(), differs);
  for (const PressureLevel& level : point.levels) {
    levels.pressures_Pa.push_back(level.pressure_Pa);
    levels.loaded_m_s2.push_back(level.loaded_m_s2);
    levels.net_m_s2.push_back(level.net_m_s2.value);
    levels.sd_of_means.push_back(1.0 / std::sqrt(static_cast<double>(level.runs)));
    levels.names.push_back(fmt::format("{:.0f} kPa", 1e-3 * level.pressure_Pa) +
                           (has_loads ? fmt::format(", {:.0f} N", level.load_N) : ""));
  }
  return levels;
}

}  // namespace

MeasurementModel make_coast_model(const CoastSet& set, const DrumCoastdownFit& fit) {
  const std::size_t index = find_reference_index(set, fit);
  const auto speed = static_cast<Eigen::Index>(index);
  const SpeedPoint& point = fit.points[index];
  const Tables tables = make_tables(set, fit);
  const LoadedScatter scatter = calc_loaded_scatter(tables.loaded, tables.levels, speed);
  const CoastLevels levels = list_levels(point);
  const std::size_t count = levels.names.size();
  // One law of pressure only where all levels have one load: a force at another load is another force. Where the levels
  // about the law say less than the runs at one pressure, or nothing (two pressures), the scatter of the runs counts.
  const bool has_rest = point.is_exponent_by_law;
  const bool has_exponent = point.pressure_exponent.has_value() &&
                            keep_main_load(tables.levels).pressures_Pa.size() == tables.levels.pressures_Pa.size();

  CoastInputs inputs;
  const bool is_repeated = scatter.single_run.freedom > 0.0;
  inputs.list = make_scatter_inputs(
      count, is_repeated ? scatter.single_run.freedom : std::numeric_limits<double>::infinity(),
      "scatter of the loaded runs",
      is_repeated ? "standard deviation of runs at one pressure, pooled"
                  : "scatter within the runs: no pressure was run twice, that from run to run is not known");
  inputs.drum_alone =
      inputs.add(make_mean_input("deceleration of the drum alone", calc_mean(tables.drum_alone, speed)));
  if (tables.mass_ratio > 0.0) {
    inputs.wheel_alone =
        inputs.add(make_mean_input("deceleration of the wheel alone", calc_mean(tables.wheel_alone, speed)));
  }
  add_inertia_inputs(set, inputs);
  inputs.speed =
      inputs.add(make_assumed_input("speed", "speed_km_h", levels.speed_m_s, kCoastSpeedLimit_m_s, "0.1 km/h"));
  if (has_exponent) {
    inputs.pressure = inputs.add(
        make_assumed_input("zero of the pressure gauge", "pressure_kPa", 0.0, kCoastPressureLimit_Pa, "1 kPa"));
    inputs.law = inputs.list.size();
  }
  if (has_exponent && has_rest) {
    for (UncertainInput& rest :
         make_scatter_inputs(count, static_cast<double>(count) - 2.0, "scatter of the pressures about the power law",
                             "standard deviation of the levels about the line")) {
      inputs.list.push_back(std::move(rest));
    }
  }

  MeasurementModel model;
  const bool has_force = set.calc_drum_mass_kg().has_value();
  for (const std::string& name : levels.names) {
    model.measurands.push_back(has_force ? Measurand{"rolling resistance at " + name, "rolling_resistance_N"}
                                         : Measurand{"net deceleration at " + name, "net_deceleration_m_s2"});
  }
  if (has_exponent) model.measurands.push_back({"exponent of pressure", "pressure_exponent"});
  model.inputs = inputs.list;
  model.left_out = {"the tire itself: break-in, storage, how one tire of a kind differs from another",
                    "temperature of the air: the set says nothing of it",
                    "load: the force is that at the load of the runs"};
  if (!set.is_mass_ratio_known()) {
    model.left_out.emplace_back("bearing and air losses of the wheel: they stay in the force");
  }
  model.evaluate = [set = apply_inputs(set, {}, {}), inputs, levels, has_exponent, has_rest, has_force,
                    sd_m_s2 = std::sqrt(scatter.single_run.variance),
                    law_sd = point.level_scatter.value_or(0.0)](const std::vector<double>& x) {
    const CoastSet trial = apply_inputs(set, inputs, x);
    const std::size_t size = levels.names.size();
    const double mass_ratio = trial.calc_mass_ratio();
    const double gain = x[inputs.speed] / levels.speed_m_s;
    const auto calc_net = [&](double loaded_m_s2) {
      const models::CoastDecelerations<double> a{loaded_m_s2, x[*inputs.drum_alone],
                                                 inputs.value(x, inputs.wheel_alone, 0.0)};
      return gain * models::calc_net_deceleration(a, mass_ratio);
    };
    const std::vector<double> errors = take_scatter(x, inputs.runs, size);
    std::vector<double> results;
    for (std::size_t i = 0; i < size; ++i) {
      const double net_m_s2 = calc_net(levels.loaded_m_s2[i] + sd_m_s2 * levels.sd_of_means[i] * errors[i]);
      results.push_back(has_force ? *trial.calc_drum_mass_kg() * net_m_s2 : net_m_s2);
    }
    if (!has_exponent) return results;
    std::vector<double> pressures_Pa, net_m_s2;
    for (std::size_t i = 0; i < size; ++i) {
      pressures_Pa.push_back(levels.pressures_Pa[i] + x[inputs.pressure]);
      const double run_error_m_s2 = has_rest ? 0.0 : sd_m_s2 * levels.sd_of_means[i] * errors[i];
      // A rare trial without a loss: its exponent is far off, and the forces of it count.
      net_m_s2.push_back(std::max(calc_net(levels.loaded_m_s2[i] + run_error_m_s2), kLeastShare * levels.net_m_s2[i]));
    }
    if (has_rest) {
      const std::vector<double> rests = take_scatter(x, inputs.law, size);
      for (std::size_t i = 0; i < size; ++i) net_m_s2[i] *= std::exp(law_sd * rests[i]);
    }
    results.push_back(fit_power_law(pressures_Pa, net_m_s2).slope);
    return results;
  };
  return model;
}

}  // namespace rollrig::estimation
