#include "estimation/road_load/road_load_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/coastdown_problem.h"
#include "estimation/road_load/road_load_checks.h"
#include "estimation/road_load/road_load_doubts.h"
#include "estimation/road_load/road_load_iteration.h"
#include "estimation/road_load/road_load_report.h"
#include "estimation/road_load/session_differences.h"
#include "sim/core/error.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::size_t count_bins(const CoastdownProblem& problem) {
  std::size_t bins = 0;
  for (const FitRun& run : problem.runs) bins += run.bins.size();
  return bins;
}

RoadLoadEstimate to_estimate(const LinearEstimate& linear) {
  RoadLoadEstimate estimate;
  estimate.load = {linear.coefficients(0), linear.coefficients(1), linear.coefficients(2)};
  estimate.covariance = linear.covariance.topLeftCorner<3, 3>();
  return estimate;
}

void put_points(const CoastdownProblem& problem, const VectorXd& coefficients, const VectorXd& components,
                RoadLoadFit& fit) {
  for (const FitRun& run : problem.runs) {
    const LinearBlock block = linearize(problem, run, coefficients, components);
    const std::vector<double> durations = find_durations_s(problem.model, run, coefficients);
    for (std::size_t k = 0; k < run.bins.size(); ++k) {
      const FitBin& bin = run.bins[k];
      const CoastdownModel::Passage passage = problem.model.pass(run, bin, coefficients);
      const double impulse = problem.model.mass_kg() * (bin.high_m_s - bin.low_m_s);
      RoadLoadPoint point{run.index, bin.high_m_s, bin.low_m_s, durations[k], passage.mean_speed_m_s};
      point.force_N = impulse / durations[k];
      point.fit_N = impulse / passage.duration_s;
      point.residual_N = point.force_N - point.fit_N;
      double variance = 0.0;
      const auto row = static_cast<Index>(k);
      for (Index i = 0; i < components.size(); ++i) {
        variance += components(i) * block.patterns[static_cast<std::size_t>(i)](row, row);
      }
      point.sd_N = std::sqrt(variance);
      fit.points.push_back(point);
    }
  }
}

void put_scatter(const CoastdownProblem& problem, const LinearEstimate& linear, RoadLoadFit& fit) {
  const auto sd = [&linear](CoastdownScatter i) -> std::optional<double> {
    if (!linear.decided[static_cast<std::size_t>(i)]) return std::nullopt;
    return std::sqrt(linear.components(i));
  };
  fit.scatter.speed_sd_m_s = sd(kPassing);
  fit.scatter.gust_N_sqrt_s = sd(kGust);
  fit.scatter.run_force_N = sd(kRunForce);
  fit.scatter.run_speed_N_s_per_m = sd(kRunSpeed);
  if (problem.session_shape == SessionShape::kConstant) {
    fit.scatter.session_force_N = sd(kSession);
  } else {
    fit.scatter.session_share = sd(kSession);
  }
  if (fit.scatter.run_speed_N_s_per_m.has_value()) *fit.scatter.run_speed_N_s_per_m /= kRunSpeedScale_m_s;
  double squares = 0.0;
  double freedom = 0.0;
  for (const FitRun& run : problem.runs) {
    for (const SpeedCell& cell : run.cells) {
      if (cell.samples < 3) continue;
      squares += cell.scatter_m2_s2;
      freedom += cell.samples - 2;
    }
  }
  if (freedom > 0.0) fit.scatter.sample_sd_m_s = std::sqrt(squares / freedom);
}

/// The fit, with the shape of the sessions' differences that is more likely: a constant, unless the data speak clearly.
IteratedFit fit_with_likely_shape(const RoadLoadFitOptions& options, CoastdownProblem& problem) {
  IterationStart start{start_coefficients(problem), VectorXd::Zero(kComponents)};
  start.components(kPassing) = 1e-4;
  const IteratedFit constant = iterate_road_load(problem, options.bounds, start, Components::kEstimated);
  if (!problem.has_several_sessions) return constant;
  CoastdownProblem with_shares = problem;
  with_shares.session_shape = SessionShape::kProportional;
  try {
    const IteratedFit proportional = iterate_road_load(with_shares, options.bounds, start, Components::kEstimated);
    const double gain = proportional.linear.log_likelihood - constant.linear.log_likelihood;
    if (gain < kClearlyMoreLikely) return constant;
    problem.session_shape = with_shares.session_shape;
    return proportional;
  } catch (const RunFailure&) {
    return constant;
  }
}

/// Wind and slope from what differs between the headings.
void put_wind_and_slope(const CoastdownProblem& problem, const RoadLoadFitOptions& options,
                        const LinearEstimate& linear, RoadLoadFit& fit) {
  if (problem.model.count() < 4) return;
  const double weight_N = find_test_mass_kg(options, fit.effective_mass_kg) * kStandardGravity_m_s2;
  fit.slope = linear.coefficients(3) / weight_N;
  fit.slope_sd = std::sqrt(linear.covariance(3, 3)) / weight_N;
  const double drag = given_drag(options).value_or(fit.load.C_N_s2_per_m2);
  if (drag <= 0.0) return;
  for (std::size_t i = 0; i < problem.wind_sessions.size(); ++i) {
    const auto column = static_cast<Index>(4 + i);
    fit.winds.push_back({problem.wind_sessions[i], linear.coefficients(column) / (2.0 * drag),
                         std::sqrt(linear.covariance(column, column)) / (2.0 * drag)});
  }
}

/// A, B, C of each heading alone, with the scatter of the whole, that of sessions too.
void put_headings(const CoastdownProblem& problem, const RoadLoadFitOptions& options, const VectorXd& coefficients,
                  const VectorXd& components, RoadLoadFit& fit) {
  for (const int heading : {+1, -1}) {
    CoastdownProblem part{{}, CoastdownModel(problem.model.mass_kg(), false, 3, given_drag(options)), {}, {}};
    part.session_shape = problem.session_shape;
    part.has_repeats = problem.has_repeats;
    for (const std::vector<std::size_t>& group : problem.groups) {
      std::vector<std::size_t> of_heading;
      for (const std::size_t i : group) {
        if (problem.runs[i].heading != heading) continue;
        of_heading.push_back(part.runs.size());
        part.runs.push_back(problem.runs[i]);
        part.runs.back().wind_column = -1;
      }
      if (!of_heading.empty()) part.groups.push_back(of_heading);
    }
    if (part.runs.empty()) continue;
    try {
      IterationStart start{coefficients.head(3), components};
      if (!all_possible(part, start.coefficients)) start.coefficients = start_coefficients(part);
      const IteratedFit found = iterate_road_load(part, options.bounds, start, Components::kHeld);
      fit.headings.push_back({heading, static_cast<int>(part.runs.size()), to_estimate(found.linear)});
    } catch (const RunFailure& failure) {
      fit.warnings.push_back(fmt::format("heading {} alone: {}", heading > 0 ? "+" : "-", failure.what()));
    }
  }
}

/// The coefficients at the mean weather of the runs.
models::RoadLoad<double> at_test_weather(const CoastdownProblem& problem, const models::RoadLoad<double>& load) {
  double rolling = 0.0;
  double density = 0.0;
  const auto bins = static_cast<double>(count_bins(problem));
  for (const FitRun& run : problem.runs) {
    for (const FitBin& bin : run.bins) {
      rolling += bin.at.rolling;
      density += bin.at.density;
    }
  }
  return {load.A_N * rolling / bins, load.B_N_s_per_m * rolling / bins, load.C_N_s2_per_m2 * density / bins};
}

/// Half of a 95 % interval.
double calc_reach(double degrees_freedom, double sd) {
  const double freedom = std::clamp(degrees_freedom, 1.0, 1e6);
  return boost::math::quantile(boost::math::students_t(freedom), 0.975) * sd;
}

void put_bounds(const RoadLoadFitOptions& options, const IteratedFit& iterated, RoadLoadFit& fit) {
  fit.bounds = options.bounds;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    fit.on_bound[at] = iterated.linear.covariance(i, i) == 0.0;
    fit.degrees_freedom[at] = iterated.linear.degrees_freedom(i);
    const double value = iterated.unbounded.coefficients(i);
    const double reach = calc_reach(fit.degrees_freedom[at], std::sqrt(iterated.unbounded.covariance(i, i)));
    fit.free_interval_95[at] = {value - reach, value + reach};
  }
}

void require_enough(const CoastdownProblem& problem, const RoadLoadFitOptions& options) {
  constexpr std::size_t kLeastBins = 4;  // one more than coefficients
  const std::size_t bins = count_bins(problem);
  if (bins >= kLeastBins) return;
  const double from = 3.6 * options.speed_from_m_s;
  const bool limited = std::isfinite(options.speed_to_m_s);
  throw InputError({fmt::format("too few speed bins to fit A, B and C: {} {}", bins,
                                limited ? fmt::format("from {:.4g} to {:.4g} km/h", from, 3.6 * options.speed_to_m_s)
                                        : fmt::format("above {:.4g} km/h", from)),
                    "", 0, "", "", fmt::format("at least {} bins in which the speed falls", kLeastBins), ""});
}

void put_range(const CoastdownProblem& problem, RoadLoadFit& fit) {
  fit.low_m_s = std::numeric_limits<double>::infinity();
  for (const FitRun& run : problem.runs) {
    const bool trace = !run.cells.empty();
    fit.high_m_s = std::max(fit.high_m_s, trace ? run.cells.front().high_m_s : run.bins.front().high_m_s);
    fit.low_m_s = std::min(fit.low_m_s, trace ? run.cells.back().low_m_s : run.bins.back().low_m_s);
  }
}

/// Bounds that the data alone exclude: what is left of the interval has no width and says nothing.
void warn_of_contradicting_bounds(RoadLoadFit& fit) {
  constexpr const char* kNames[] = {"A", "B", "C"};
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::array<double, 2>& alone = fit.free_interval_95[at];
    const double value = fit.values()[at];
    if (!fit.on_bound[at] || (alone[0] <= value && value <= alone[1])) continue;
    fit.warnings.push_back(fmt::format(
        "{} stands on its bound, {:.4g}, but the data alone put it at {:.4g} to {:.4g} {}: the bound contradicts them. "
        "The interval has no width for that, and no uncertainty of {} is known",
        kNames[i], road_load_in_file_unit(i, value), road_load_in_file_unit(i, alone[0]),
        road_load_in_file_unit(i, alone[1]), unit_of_key(road_load_key(i, fit.per_mass)).symbol, kNames[i]));
  }
}

/// The drag area that is given against the one of C, which holds all that goes with the square of the speed.
void doubt_drag_area(const RoadLoadFitOptions& options, RoadLoadFit& fit) {
  constexpr double kMostFactor = 2.0;  // Assumed: the square of the rolling loss is far less than the drag
  if (!options.drag_area_m2.has_value() || fit.per_mass) return;
  const double per_C = 2.0 / calc_reference_density_kg_m3(options);
  const double low_m2 = per_C * fit.interval_95(2)[0], high_m2 = per_C * fit.interval_95(2)[1];
  const double given_m2 = *options.drag_area_m2;
  if (given_m2 <= kMostFactor * high_m2 && given_m2 >= low_m2 / kMostFactor) return;
  fit.warnings.push_back(fmt::format(
      "--drag-area is {:g} m2, but C is that of {:.3g} m2: is it the drag area Cd A in m2? The wind is corrected by it",
      given_m2, per_C * fit.load.C_N_s2_per_m2));
}

void doubt_fitted_winds(RoadLoadFit& fit) {
  for (const auto& wind : fit.winds) {
    if (std::abs(wind.wind_m_s) < kMostFittedWind_m_s) continue;
    fit.warnings.push_back(fmt::format(
        "the headings of '{}' differ as in a wind of {:.0f} m/s, in which nobody coasts down: its square is not "
        "subtracted. Are both headings from the same vehicle, in the same units?",
        wind.session, std::abs(wind.wind_m_s)));
  }
}

/// Of such a session, nothing tells its own wind from its force, and a slope only what the other sessions show.
void warn_of_one_heading(const CoastdownProblem& problem, const CoastdownData& data, RoadLoadFit& fit) {
  if (problem.model.count() == 3 || !problem.has_several_sessions) return;
  std::vector<std::string> one_way;
  for (const FitRun& run : problem.runs) {
    const std::string name = "'" + data.runs[run.index].session + "'";
    const bool is_said = std::find(one_way.begin(), one_way.end(), name) != one_way.end();
    if (run.wind_column < 0 && !is_said) one_way.push_back(name);
  }
  if (one_way.empty()) return;
  fit.warnings.push_back(
      fmt::format("one heading only in {} {}: a wind there is inside its force, and so in A, B and C",
                  one_way.size() == 1 ? "session" : "sessions", fmt::join(one_way, ", ")));
}

void warn(const CoastdownProblem& problem, const CoastdownData& data, const RoadLoadFitOptions& options,
          RoadLoadFit& fit) {
  const std::size_t left_out = data.runs.size() - problem.runs.size();
  if (left_out > 0)
    fit.warnings.push_back(fmt::format("without a whole speed bin, and left out: {}", format_count(left_out, "run")));
  if (problem.model.count() == 3) {
    fit.warnings.push_back("not both headings: wind and slope are inside A, B and C, and no standard deviation tells");
  }
  if (!fit.ambient_corrected) {
    fit.warnings.push_back("no ambient temperature given: not corrected to reference conditions");
  }
  if (const auto doubt = doubt_ambient(data)) fit.warnings.push_back(*doubt);
  const bool has_pressures = std::all_of(data.runs.begin(), data.runs.end(), [](const CoastdownRun& run) {
    return !run.conditions.ambient_pressure_Pa.empty();
  });
  if (fit.ambient_corrected && !has_pressures) {
    fit.warnings.push_back(fmt::format(
        "no column ambient_pressure_kPa: {:.5g} kPa, that of reference, is taken for it, which has an effect on C",
        1e-3 * options.reference_pressure_Pa));
  }
  if (!fit.scatter.run_force_N.has_value() || !fit.scatter.run_speed_N_s_per_m.has_value()) {
    fit.warnings.push_back(
        "too few runs to tell how they differ from run to run: the standard deviations are those of the noise along a "
        "run, and too small");
  }
  const SessionWinds winds =
      problem.wind_sessions.empty() ? SessionWinds::kInDeviations : SessionWinds::kFitted;
  if (const auto doubt = doubt_session_difference(data, find_run_deviations(fit), winds)) {
    fit.warnings.push_back(*doubt);
  }
  warn_of_one_heading(problem, data, fit);
  doubt_fitted_winds(fit);
  doubt_drag_area(options, fit);
  if (!options.mass_kg.has_value()) {
    fit.warnings.push_back("no mass given: A, B and C are per unit of effective mass");
  } else {
    for (std::string& doubt : doubt_road_load(fit.load, *options.mass_kg, fit.high_m_s)) {
      fit.warnings.push_back(std::move(doubt));
    }
  }
  if (options.bounds.has_value()) {
    fit.warnings.push_back(
        "bounds are on: estimates are pushed off where the data alone would put them, and what "
        "stands on a bound has no standard deviation");
    warn_of_contradicting_bounds(fit);
  }
}

}  // namespace

double RoadLoadEstimate::sd(int i) const { return std::sqrt(covariance(i, i)); }

double RoadLoadEstimate::force_sd_N(double speed_m_s) const {
  const Eigen::Vector3d phi(1.0, speed_m_s, speed_m_s * speed_m_s);
  return std::sqrt(std::max(0.0, phi.dot(covariance * phi)));
}

std::array<double, 2> RoadLoadFit::interval_95(int i) const {
  const auto at = static_cast<std::size_t>(i);
  const double value = values()[at];
  const double reach = calc_reach(degrees_freedom[at], sd(i));
  const std::array<double, 2> whole = on_bound[at] ? std::array<double, 2>{std::min(value, free_interval_95[at][0]),
                                                                           std::max(value, free_interval_95[at][1])}
                                                   : std::array<double, 2>{value - reach, value + reach};
  if (!bounds.has_value()) return whole;
  return {std::max(whole[0], bounds->lower[at]), std::min(whole[1], bounds->upper[at])};
}

bool RoadLoadFit::is_cut(int i) const {
  const auto at = static_cast<std::size_t>(i);
  if (!bounds.has_value()) return false;
  const double reach = calc_reach(degrees_freedom[at], sd(i));
  const double value = values()[at];
  return on_bound[at] || value - reach < bounds->lower[at] || value + reach > bounds->upper[at];
}

RoadLoadFit fit_road_load(const CoastdownData& data, const RoadLoadFitOptions& options) {
  RoadLoadFit fit;
  fit.per_mass = !options.mass_kg.has_value();
  if (!fit.per_mass) {
    fit.effective_mass_kg =
        *options.mass_kg + options.rotating_mass_kg.value_or((kDefaultEffectiveRatio - 1.0) * *options.mass_kg);
  }
  CoastdownProblem problem = make_problem(data, options, fit.effective_mass_kg);
  require_enough(problem, options);
  const IteratedFit iterated = fit_with_likely_shape(options, problem);
  const auto& [linear, unbounded, coefficients, components, iterations, settled] = iterated;
  fit.iterations = iterations;
  if (!settled) {
    fit.warnings.push_back(
        "the scatter between runs or sessions did not settle: the standard deviations and intervals are uncertain");
  }
  static_cast<RoadLoadEstimate&>(fit) = to_estimate(linear);
  put_bounds(options, iterated, fit);
  fit.chi2_per_dof = linear.chi2 / static_cast<double>(static_cast<Index>(count_bins(problem)) - problem.model.count());
  const auto measured = [&data](auto member) {
    return std::any_of(data.runs.begin(), data.runs.end(),
                       [member](const CoastdownRun& run) { return !(run.conditions.*member).empty(); });
  };
  fit.ambient_corrected = measured(&CoastdownConditions::ambient_K);
  fit.wind_corrected = measured(&CoastdownConditions::wind_m_s);
  fit.as_tested = at_test_weather(problem, fit.load);
  put_range(problem, fit);
  put_scatter(problem, linear, fit);
  put_wind_and_slope(problem, options, linear, fit);
  put_points(problem, coefficients, components, fit);
  warn(problem, data, options, fit);
  put_headings(problem, options, coefficients, components, fit);
  return fit;
}

}  // namespace rollrig::estimation
