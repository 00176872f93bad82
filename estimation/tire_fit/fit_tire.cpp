#include "estimation/tire_fit/fit_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimation/tire_fit/drum_residuals.h"
#include "estimation/tire_fit/fit_solution.h"
#include "estimation/tire_fit/fit_unknowns.h"
#include "estimation/tire_fit/two_step_check.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

/// Puts the fitted numbers and their uncertainties into the set's tire.
void put_tire(const measurements::MeasurementSet& set, const models::TireParameters<double>& best,
              const models::TireParameters<double>& uncertainty, TireFit& fit) {
  fit.tire = set.tire;
  fit.tire.basis = models::TireBasis::kMeasured;
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

Estimate make_estimate(const FitUnknowns& unknowns, std::size_t i, double found_SI, double sd_SI) {
  const FreeParameter& parameter = unknowns.parameters[i];
  const Unit unit = unit_of_key(last_part(parameter.key));
  Estimate estimate{parameter.key,
                    unit.from_si(found_SI),
                    sd_SI / unit.factor,
                    i >= unknowns.asked_for,
                    unit.from_si(parameter.lower_SI),
                    unit.from_si(parameter.upper_SI),
                    {}};
  if (parameter.prior_sd_SI > 0.0) {
    estimate.prior = {unit.from_si(parameter.start_SI), parameter.prior_sd_SI / unit.factor,
                      unknowns.of_class.count(parameter.key) == 1};
  }
  return estimate;
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
    const double sd = std::sqrt(covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
    find_parameter(best, key) = found[i];
    find_parameter(uncertainty, key) = sd;
    fit.estimates.push_back(make_estimate(unknowns, i, found[i], sd));
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
    const bool of_class = estimate.prior.has_value() && estimate.prior->of_class;
    const char* within = of_class ? " within the uncertainty of its class" : " within its uncertainty";
    fit.notes[key] = from + (estimate.nuisance ? within : "");
  }
}

/// Warns of numbers that stand on a limit of their range.
void warn_of_limits(TireFit& fit) {
  constexpr double kNear = 1e-4;  // Assumed: of a standard uncertainty
  for (const Estimate& estimate : fit.estimates) {
    const bool is_on = std::min(estimate.value - estimate.least, estimate.most - estimate.value) <= kNear * estimate.sd;
    if (!is_on) continue;
    fit.warnings.push_back(
        fmt::format("{} stands on the limit of its range, {:.4g}: the data ask for a value beyond it, "
                    "and its interval ends there",
                    find_file_key(estimate.key), estimate.value));
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

bool has_free_numbers(const models::TireModelInfo& model) {
  return std::any_of(model.parameters.begin(), model.parameters.end(),
                     [](const models::TireModelParameter& own) { return own.role != models::FitRole::kHeld; });
}

/// A map over load has A1 and B1 of its own at each load.
void require_speeds_of_map(const measurements::MeasurementSet& set, const TwoStepEstimate& start) {
  if (!start.slopes_held) return;
  throw InputError({"a map over load (--load-map) needs two speeds at least, and the set has one", set.path, 0,
                    "speed_km_h", "",
                    "loaded runs at two or more constant speeds that differ by 10 %; or a fit without "
                    "the map",
                    ""});
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

/// The optimum within what the law of the tire allows.
struct Solution {
  FitUnknowns unknowns;
  std::optional<DrumResiduals> residuals;
  std::vector<double> found;
};

Solution solve_within_law(const measurements::MeasurementSet& set, const TireFitOptions& options, FitUnknowns unknowns,
                          std::vector<std::string>& warnings) {
  Solution solution{std::move(unknowns), {}, {}};
  const auto solve = [&] {
    solution.residuals.emplace(set, solution.unknowns.start, solution.unknowns.parameters, options.threads);
    solution.found = minimize(*solution.residuals, list_first_values(solution.unknowns), options.progress);
  };
  solve();
  while (const auto mistake = find_law_mistake(solution.unknowns, solution.found)) {
    warnings.push_back(go_back_within_law(solution.unknowns, *mistake));
    solve();
  }
  return solution;
}

bool is_gas_measured(const measurements::MeasurementSet& set) {
  return std::any_of(set.runs.begin(), set.runs.end(),
                     [](const measurements::MeasuredRun& run) { return run.has(models::quantities::kGasTemperature); });
}

/// Warnings of numbers on a limit, of a two-step regression that says another thing, and of what no number explains.
void add_warnings(const measurements::MeasurementSet& set, TireFit& fit) {
  warn_of_limits(fit);
  if (fit.two_step.has_value()) {
    for (std::string& warning : compare_two_steps(set, fit.tire, fit.at_speeds)) {
      fit.warnings.push_back(std::move(warning));
    }
  }
  constexpr double kMostChi2 = 2.0;  // Assumed: per sample
  if (fit.chi2_per_sample <= kMostChi2) return;
  fit.warnings.push_back(
      fmt::format("what is left is {:.1f} times the noise that the sensors' table says: the model "
                  "lacks something, or the table is wrong; intervals are too narrow",
                  std::sqrt(fit.chi2_per_sample)));
}

}  // namespace

TireFit fit_tire(const measurements::MeasurementSet& set, const TireFitOptions& options) {
  require_fittable_set(set, options.load_map);
  TireFit fit;
  if (set.tire.values.model().info.follows_speed_lines()) fit.two_step = estimate_in_two_steps(set);
  if (options.load_map) require_speeds_of_map(set, *fit.two_step);
  const bool free_H = options.free_H || is_gas_measured(set);
  const auto [unknowns, residuals, found] =
      solve_within_law(set, options, choose_unknowns(set, fit.two_step, options.load_map, free_H), fit.warnings);
  std::vector<double> at_best(residuals->residual_count());
  residuals->evaluate(found.data(), at_best.data(), nullptr);
  measure_channels(set, *residuals, at_best, fit);
  const Eigen::MatrixXd covariance = find_covariance(*residuals, found);
  put_estimates(set, unknowns, found, covariance, fit);
  fit.at_speeds = find_at_speeds(set, unknowns, found, covariance);
  fit.steady = find_steady_tire(set, unknowns, found, covariance);
  for (const ComparedSeries& series : residuals->series()) {
    fit.offsets_SI[{series.run, series.channel}] = residuals->calc_offset_SI(series, found.data());
  }
  write_notes(set, fit);
  add_warnings(set, fit);
  return fit;
}

}  // namespace rollrig::estimation
