#include "estimation/tire_fit/fit_tire.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "estimation/tire_fit/drum_residuals.h"
#include "estimation/tire_fit/fit_unknowns.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

using Lines = models::SpeedLines<double>;

/// The residuals as Ceres takes them: one block of unknowns.
class ResidualFunction : public ceres::CostFunction {
 public:
  explicit ResidualFunction(const DrumResiduals& residuals) : residuals_(residuals) {
    set_num_residuals(static_cast<int>(residuals.residual_count()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(residuals.unknown_count()));
  }
  bool Evaluate(double const* const* unknowns, double* out, double** jacobians) const override {
    try {
      residuals_.evaluate(unknowns[0], out, jacobians != nullptr ? jacobians[0] : nullptr);
    } catch (const RunFailure&) {  // no tire: the step that tried it is taken back
      return false;
    }
    return std::all_of(out, out + residuals_.residual_count(), [](double r) { return std::isfinite(r); });
  }

 private:
  const DrumResiduals& residuals_;
};

/// Tells the caller and the log of each iteration.
class FollowIterations : public ceres::IterationCallback {
 public:
  explicit FollowIterations(Progress progress) : progress_(std::move(progress)) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& at) override {
    spdlog::debug("fit: iteration {}, half chi2 {:.6g}, largest gradient {:.2g}", at.iteration, at.cost,
                  at.gradient_max_norm);
    if (progress_) progress_(std::nan(""), fmt::format("iteration {}", at.iteration));
    return ceres::SOLVER_CONTINUE;
  }

 private:
  Progress progress_;
};

/// Puts the fitted numbers and their uncertainties into the set's tire.
void put_tire(const measurements::MeasurementSet& set, const models::TireParameters<double>& best,
              const models::TireParameters<double>& uncertainty, TireFit& fit) {
  fit.tire = set.tire;
  models::TireParameters<double>& values = fit.tire.values;
  values.rolling_resistance = best.rolling_resistance;
  values.load_map = best.load_map;
  values.own = best.own;
  values.thermal = best.thermal;
  fit.tire.standard_uncertainties = uncertainty;
  // z and f belong to the rig on which they were found (§4.2.3); a conductance that was held has no uncertainty.
  const auto if_fitted = [](double sd) { return sd > 0.0 ? std::optional(sd) : std::nullopt; };
  fit.tire.rig_thermal[set.rig->thermal_name()] = {
      best.thermal.rest_conductance_W_per_K, if_fitted(uncertainty.thermal.rest_conductance_W_per_K),
      best.thermal.speed_conductance_W_s_per_m_K, if_fitted(uncertainty.thermal.speed_conductance_W_s_per_m_K)};
  const auto keep_elsewhere = [](const auto& of_set, auto& fitted) {
    fitted.rest_conductance_W_per_K = of_set.rest_conductance_W_per_K;
    fitted.speed_conductance_W_s_per_m_K = of_set.speed_conductance_W_s_per_m_K;
  };
  keep_elsewhere(set.tire.values.thermal, values.thermal);
  keep_elsewhere(set.tire.standard_uncertainties.thermal, fit.tire.standard_uncertainties.thermal);
}

/// The key of a fitted number in the tire's file: "load_map.0.A0_N", "thermal.rig.drum_2m.<conductance>".
std::string find_written_key(const measurements::MeasurementSet& set, const std::string& key) {
  std::string written = find_file_key(key);
  const std::string table = "thermal.";
  if (written.rfind(table + "conductance_", 0) == 0) {
    written.insert(table.size(), "rig." + set.rig->thermal_name() + ".");
  }
  return written;
}

/// Of all fitted numbers of the tire, nuisances among them: the file has what the fit made of both.
void put_correlation(const measurements::MeasurementSet& set, TireFit& fit) {
  std::vector<std::size_t> of_tire;
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    if (fit.estimates[i].key.rfind("tire.", 0) == 0) of_tire.push_back(i);
  }
  models::TireCorrelation fitted;
  for (const std::size_t i : of_tire) {
    fitted.numbers.push_back(find_written_key(set, fit.estimates[i].key));
    fitted.matrix.emplace_back();
    for (const std::size_t j : of_tire) fitted.matrix.back().push_back(i == j ? 1.0 : fit.correlation[i][j]);
  }
  fit.tire.correlation = models::replace_correlation(fit.tire, std::move(fitted));
}

void put_estimates(const measurements::MeasurementSet& set, const FitUnknowns& unknowns,
                   const std::vector<double>& found, const Eigen::MatrixXd& covariance, TireFit& fit) {
  models::Context<double> best = unknowns.start;
  models::Context<double> uncertainty;
  uncertainty.tire = set.tire.standard_uncertainties;
  uncertainty.tire.load_map.assign(best.tire.load_map.size(), {});
  uncertainty.tire.own = {best.tire.own.model, std::vector<double>(best.tire.own.values.size())};
  uncertainty.tire.thermal.rest_conductance_W_per_K = uncertainty.tire.thermal.speed_conductance_W_s_per_m_K = 0.0;
  for (std::size_t i = 0; i < unknowns.parameters.size(); ++i) {
    const std::string& key = unknowns.parameters[i].key;
    const Unit unit = unit_of_key(last_part(key));
    const double sd = std::sqrt(covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
    find_parameter(best, key) = found[i];
    find_parameter(uncertainty, key) = sd;
    fit.estimates.push_back({key, unit.from_si(found[i]), sd / unit.factor, i >= unknowns.asked_for});
  }
  const auto n = static_cast<Eigen::Index>(unknowns.parameters.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    fit.correlation.emplace_back();
    for (Eigen::Index j = 0; j < n; ++j) {
      fit.correlation.back().push_back(covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)));
    }
  }
  put_tire(set, best.tire, uncertainty.tire, fit);
  put_correlation(set, fit);
}

void write_notes(const measurements::MeasurementSet& set, TireFit& fit) {
  const std::string from = fmt::format("fitted to set '{}'", set.name);
  for (const Estimate& estimate : fit.estimates) {
    std::string key = find_written_key(set, estimate.key);
    if (key.rfind("load_map.", 0) == 0) key = "rolling_resistance.load_map." + last_part(key);
    fit.notes[key] = from + (estimate.nuisance ? " within its uncertainty" : "");
  }
}

/// Rms of each channel's whitened residuals.
void measure_channels(const measurements::MeasurementSet& set, const DrumResiduals& residuals,
                      const std::vector<double>& at_best, TireFit& fit) {
  std::size_t samples = 0;
  double chi2 = 0.0;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    ChannelFit of_channel{channel, 0, 0.0};
    for (const ComparedSeries& series : residuals.series()) {
      if (series.channel != channel) continue;
      for (std::size_t k = 0; k < series.rows.size(); ++k) {
        const double r = at_best[series.first_residual + k];
        of_channel.whitened_rms += r * r;
      }
      of_channel.samples += series.rows.size();
    }
    if (of_channel.samples == 0) continue;
    samples += of_channel.samples;
    chi2 += of_channel.whitened_rms;
    of_channel.whitened_rms = std::sqrt(of_channel.whitened_rms / static_cast<double>(of_channel.samples));
    fit.channels.push_back(of_channel);
  }
  fit.chi2_per_sample = chi2 / static_cast<double>(samples);
}

/// Inverse of J^T J. The columns of J are scaled to unit length first: in SI units a heat capacity's is so much shorter
/// than the others' that it would pass for a direction that the data do not decide.
Eigen::MatrixXd find_covariance(const DrumResiduals& residuals, const std::vector<double>& unknowns) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto count = static_cast<Eigen::Index>(residuals.unknown_count());
  std::vector<double> at_best(residuals.residual_count());
  RowMatrix jacobian(static_cast<Eigen::Index>(residuals.residual_count()), count);
  residuals.evaluate(unknowns.data(), at_best.data(), jacobian.data());
  const Eigen::VectorXd lengths = jacobian.colwise().norm();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  constexpr double kUndecided = 1e-7;  // Assumed: of unit columns, what rounding leaves of a direction without effect
  qr.setThreshold(kUndecided);
  if (lengths.minCoeff() > 0.0) qr.compute(jacobian * lengths.cwiseInverse().asDiagonal());
  if (!(lengths.minCoeff() > 0.0) || !lengths.allFinite() || qr.rank() < count) {
    throw RunFailure("the fit has no covariance: the data do not decide the parameters");
  }
  const Eigen::MatrixXd r = qr.matrixR().topRows(count).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse =
      qr.colsPermutation() * r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::MatrixXd scaled = lengths.cwiseInverse().asDiagonal() * inverse;
  return scaled * scaled.transpose();
}

bool has_free_numbers(const models::TireModelInfo& model) {
  return std::any_of(model.parameters.begin(), model.parameters.end(),
                     [](const models::TireModelParameter& own) { return own.role != models::FitRole::kHeld; });
}

void require_fittable_set(const measurements::MeasurementSet& set, bool load_map) {
  if (is_of_vehicle(set.kind->traits)) {
    throw InputError({"a tire is fitted to a set of a drum or belt", set.path, 0, "rig", "",
                      "a rig whose carriage presses the tire", ""});
  }
  const models::TireModelInfo& model = set.tire.values.model().info;
  if (!model.follows_speed_lines() && !has_free_numbers(model)) {
    throw InputError({"the loss of this tire's model has no numbers that are fitted", set.tire.path, 0, "model",
                      model.id, "a model with A0 to B1 in [rolling_resistance], or bounded", ""});
  }
  if (load_map && !model.follows_speed_lines()) {
    throw InputError({"a map over load (--load-map) is of A0 to B1, which the loss of this tire's model does not have",
                      set.tire.path, 0, "model", model.id,
                      "a model with A0 to B1 in [rolling_resistance]; or fit without the map", ""});
  }
}

/// The unknowns at the optimum.
std::vector<double> minimize(const DrumResiduals& residuals, const Progress& progress) {
  std::vector<double> found = residuals.start();
  ceres::Problem problem;
  problem.AddResidualBlock(new ResidualFunction(residuals), nullptr, found.data());
  for (std::size_t i = 0; i < residuals.parameters().size(); ++i) {
    const FreeParameter& parameter = residuals.parameters()[i];
    const int at = static_cast<int>(i);
    if (std::isfinite(parameter.lower_SI)) problem.SetParameterLowerBound(found.data(), at, parameter.lower_SI);
    if (std::isfinite(parameter.upper_SI)) problem.SetParameterUpperBound(found.data(), at, parameter.upper_SI);
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 100;
  solver.function_tolerance = 1e-10;
  solver.logging_type = ceres::SILENT;
  FollowIterations follow(progress);
  solver.callbacks.push_back(&follow);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) throw RunFailure("the fit does not converge: " + summary.message);
  return found;
}

}  // namespace

TireFit fit_tire(const measurements::MeasurementSet& set, const TireFitOptions& options) {
  require_fittable_set(set, options.load_map);
  TireFit fit;
  if (set.tire.values.model().info.follows_speed_lines()) fit.two_step = estimate_in_two_steps(set);
  const bool gas_measured = std::any_of(set.runs.begin(), set.runs.end(), [](const measurements::MeasuredRun& run) {
    return run.has(models::quantities::kGasTemperature);
  });
  const bool free_H = options.free_H || gas_measured;
  FitUnknowns unknowns = choose_unknowns(set, fit.two_step, options.load_map, free_H);
  std::optional<DrumResiduals> residuals;
  std::vector<double> found;
  const auto solve = [&] {
    residuals.emplace(set, unknowns.start, unknowns.parameters, options.threads);
    found = minimize(*residuals, options.progress);
  };
  solve();
  while (const auto mistake = find_law_mistake(unknowns, found)) {
    fit.warnings.push_back(go_back_within_law(unknowns, *mistake));
    solve();
  }

  std::vector<double> at_best(residuals->residual_count());
  residuals->evaluate(found.data(), at_best.data(), nullptr);
  measure_channels(set, *residuals, at_best, fit);
  put_estimates(set, unknowns, found, find_covariance(*residuals, found), fit);
  write_notes(set, fit);
  constexpr double kMostChi2 = 2.0;  // Assumed: per sample
  if (fit.chi2_per_sample > kMostChi2) {
    fit.warnings.push_back(
        fmt::format("what is left is {:.1f} times the noise that the sensors' table says: the model "
                    "lacks something, or the table is wrong; intervals are too narrow",
                    std::sqrt(fit.chi2_per_sample)));
  }
  return fit;
}

std::vector<ParameterEstimate> list_parameters(const TireFit& fit) {
  std::vector<ParameterEstimate> parameters;
  for (const Estimate& at : fit.estimates) {
    const std::string key = find_file_key(at.key);
    parameters.push_back({key, at.value, at.sd, at.lower_95(), at.upper_95(), unit_of_key(last_part(key)).symbol});
  }
  return parameters;
}

Json make_two_step_json(const TwoStepEstimate& two_step) {
  Json json;
  Lines::visit(two_step, [&](const Field& line, double value) { json[line.key] = value; });
  json["z_W_per_K"] = two_step.rest_conductance_W_per_K;
  json["f_W_s_per_m_K"] = two_step.speed_conductance_W_s_per_m_K;
  if (two_step.H_gas_W_per_K.has_value()) json["H_gas_W_per_K"] = *two_step.H_gas_W_per_K;
  return json;
}

Json make_fit_json(const measurements::MeasurementSet& set, const TireFit& fit) {
  Json json = {{"format", "rollrig-fit/1"}, {"set", set.name}, {"tire", set.tire.name}, {"rig", set.rig->name}};
  json["parameters"] = Json::array();
  for (const Estimate& estimate : fit.estimates) {
    json["parameters"].push_back({{"name", estimate.key},
                                  {"value", estimate.value},
                                  {"sd", estimate.sd},
                                  {"ci95", {estimate.lower_95(), estimate.upper_95()}},
                                  {"unit", unit_of_key(last_part(estimate.key)).symbol},
                                  {"nuisance", estimate.nuisance}});
  }
  json["correlation"] = fit.correlation;
  json["chi2_per_sample"] = fit.chi2_per_sample;
  json["channels"] = Json::array();
  for (const ChannelFit& channel : fit.channels) {
    json["channels"].push_back(
        {{"channel", channel.channel.header()}, {"samples", channel.samples}, {"whitened_rms", channel.whitened_rms}});
  }
  json["two_step"] = fit.two_step.has_value() ? make_two_step_json(*fit.two_step) : Json(nullptr);
  if (!fit.warnings.empty()) json["warnings"] = fit.warnings;
  return json;
}

}  // namespace rollrig::estimation
