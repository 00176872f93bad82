#include "estimation/road_load/coastdown_problem.h"

#include <algorithm>
#include <array>
#include <map>

#include <Eigen/QR>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool has_both_headings(const std::vector<FitRun>& runs) {
  const auto any = [&runs](int heading) {
    return std::any_of(runs.begin(), runs.end(), [heading](const FitRun& run) { return run.heading == heading; });
  };
  return any(+1) && any(-1);
}

/// Covariance of mean forces under white force of unit density. Through bins as given, 1/T. Between means over
/// cells the weight of the force rises over one cell and falls over the next, so that neighbors share a cell.
MatrixXd make_gust_pattern(const FitRun& run, const std::vector<double>& durations_s) {
  const auto n = static_cast<Index>(run.bins.size());
  MatrixXd pattern = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const int upper = run.bins[at].upper_cell;
    if (upper < 0) {
      pattern(k, k) = 1.0 / durations_s[at];
      continue;
    }
    const auto cell = static_cast<std::size_t>(upper);
    const double square = durations_s[at] * durations_s[at];
    pattern(k, k) = (run.cells[cell].length_s + run.cells[cell + 1].length_s) / (3.0 * square);
    if (k == 0) continue;
    pattern(k, k - 1) = run.cells[cell].length_s / (6.0 * durations_s[at] * durations_s[at - 1]);
    pattern(k - 1, k) = pattern(k, k - 1);
  }
  return pattern;
}

/// How the scatter of a run's session goes over its bins: ones, or the forces of the model in N.
VectorXd make_session_shape(const CoastdownProblem& problem, const FitRun& run, const VectorXd& coefficients) {
  VectorXd shape = VectorXd::Ones(static_cast<Index>(run.bins.size()));
  if (problem.session_shape == SessionShape::kConstant) return shape;
  for (Index k = 0; k < shape.size(); ++k) {
    const FitBin& bin = run.bins[static_cast<std::size_t>(k)];
    const double impulse = problem.model.mass_kg() * (bin.high_m_s - bin.low_m_s);
    shape(k) = impulse / problem.model.pass(run, bin, coefficients).duration_s;
  }
  return shape;
}

/// Several sessions: a group each. One session, whose common force A takes: a group a run.
void group_runs(const CoastdownData& data, CoastdownProblem& problem) {
  std::map<std::string, std::vector<std::size_t>> sessions;
  for (std::size_t i = 0; i < problem.runs.size(); ++i) sessions[data.runs[problem.runs[i].index].session].push_back(i);
  problem.has_several_sessions = sessions.size() > 1;
  for (const auto& [session, runs] : sessions) {
    problem.has_repeats = problem.has_repeats || (problem.has_several_sessions && runs.size() > 1);
    if (problem.has_several_sessions) {
      problem.groups.push_back(runs);
    } else {
      for (const std::size_t i : runs) problem.groups.push_back({i});
    }
  }
}

}  // namespace

std::optional<double> given_drag(const RoadLoadFitOptions& options) {
  if (!options.drag_area_m2.has_value()) return std::nullopt;
  return 0.5 * calc_reference_density_kg_m3(options) * *options.drag_area_m2;
}

CoastdownProblem make_problem(const CoastdownData& data, const RoadLoadFitOptions& options, double mass_kg) {
  std::vector<FitRun> runs = make_fit_runs(data, options, mass_kg);
  const bool uses_headings = has_both_headings(runs);
  std::vector<std::string> sessions;
  if (uses_headings) {
    std::map<std::string, std::vector<FitRun>> by_session;
    for (const FitRun& run : runs) by_session[data.runs[run.index].session].push_back(run);
    for (const auto& [session, of_session] : by_session) {
      if (has_both_headings(of_session)) sessions.push_back(session);
    }
  }
  for (FitRun& run : runs) {
    const auto it = std::find(sessions.begin(), sessions.end(), data.runs[run.index].session);
    if (it != sessions.end()) run.wind_column = 4 + static_cast<int>(it - sessions.begin());
  }
  const Index count = 3 + (uses_headings ? 1 + static_cast<Index>(sessions.size()) : 0);
  CoastdownProblem problem{std::move(runs), CoastdownModel(mass_kg, uses_headings, count, given_drag(options)),
                           sessions, {}};
  group_runs(data, problem);
  return problem;
}

std::vector<double> find_durations_s(const CoastdownModel& model, const FitRun& run, const VectorXd& coefficients) {
  std::vector<double> durations;
  for (const FitBin& bin : run.bins) {
    if (bin.upper_cell < 0) {
      durations.push_back(bin.duration_s);
      continue;
    }
    const auto upper = static_cast<std::size_t>(bin.upper_cell);
    const auto passing_s = [&](const SpeedCell& cell) {
      return calc_passing_time_s(cell, model.deceleration(run, bin, coefficients, cell.nominal_speed_m_s));
    };
    durations.push_back(passing_s(run.cells[upper + 1]) - passing_s(run.cells[upper]));
  }
  return durations;
}

LinearBlock linearize(const CoastdownProblem& problem, const FitRun& run, const VectorXd& coefficients,
                      const VectorXd& components) {
  const CoastdownModel& model = problem.model;
  const auto n = static_cast<Index>(run.bins.size());
  const std::vector<double> durations = find_durations_s(model, run, coefficients);
  LinearBlock block{VectorXd(n), MatrixXd(n, model.count()), {}};
  MatrixXd passing = MatrixXd::Zero(n, n);
  VectorXd speed(n), force_per_s(n), lower_variance(n);
  for (Index k = 0; k < n; ++k) {
    const FitBin& bin = run.bins[static_cast<std::size_t>(k)];
    const CoastdownModel::Passage passage = model.pass(run, bin, coefficients);
    const double impulse = model.mass_kg() * (bin.high_m_s - bin.low_m_s);
    const double force = impulse / passage.duration_s;
    force_per_s(k) = force / passage.duration_s;
    const double upper_a = model.force_N(run, bin, coefficients, bin.high_m_s) / model.mass_kg();
    const double lower_a = model.force_N(run, bin, coefficients, bin.low_m_s) / model.mass_kg();
    const double upper_variance = 1.0 / (bin.upper_samples * upper_a * upper_a);
    lower_variance(k) = 1.0 / (bin.lower_samples * lower_a * lower_a);
    passing(k, k) = force_per_s(k) * force_per_s(k) * (upper_variance + lower_variance(k));
    if (bin.follows) {
      passing(k, k - 1) = -force_per_s(k) * force_per_s(k - 1) * lower_variance(k - 1);
      passing(k - 1, k) = passing(k, k - 1);
    }
    speed(k) = passage.mean_speed_m_s / kRunSpeedScale_m_s;
    block.X.row(k) = -force_per_s(k) * passage.gradient.transpose();
    // 1/dt of a noisy dt is on average too large by its relative variance
    const double relative_variance = components(kPassing) * passing(k, k) / (force * force);
    const double measured = impulse / durations[static_cast<std::size_t>(k)] * (1.0 - std::min(relative_variance, 0.5));
    block.y(k) = measured - force + block.X.row(k).dot(coefficients);
  }
  // the session's component is shared by runs: linearize_all() puts it there
  block.patterns = {passing, make_gust_pattern(run, durations), MatrixXd::Ones(n, n), speed * speed.transpose(),
                    MatrixXd::Zero(n, n)};
  return block;
}

bool all_possible(const CoastdownProblem& problem, const VectorXd& coefficients) {
  for (const FitRun& run : problem.runs) {
    for (const FitBin& bin : run.bins) {
      if (!problem.model.pass(run, bin, coefficients).possible) return false;
      if (problem.model.force_N(run, bin, coefficients, bin.high_m_s) <= 0.0) return false;
      if (problem.model.force_N(run, bin, coefficients, bin.low_m_s) <= 0.0) return false;
    }
  }
  return true;
}

VectorXd start_coefficients(const CoastdownProblem& problem) {
  std::vector<std::array<double, 2>> points;  // speed, force
  for (const FitRun& run : problem.runs) {
    for (const FitBin& bin : run.bins) {
      double dv = bin.high_m_s - bin.low_m_s;
      double dt = bin.duration_s;
      double speed = 0.5 * (bin.high_m_s + bin.low_m_s);
      if (bin.upper_cell >= 0) {
        const SpeedCell& upper = run.cells[static_cast<std::size_t>(bin.upper_cell)];
        const SpeedCell& lower = run.cells[static_cast<std::size_t>(bin.upper_cell) + 1];
        dv = upper.mean_speed_m_s - lower.mean_speed_m_s;
        dt = lower.mean_time_s - upper.mean_time_s;
        speed = 0.5 * (upper.mean_speed_m_s + lower.mean_speed_m_s);
      }
      points.push_back({speed, problem.model.mass_kg() * dv / dt});
    }
  }
  const auto n = static_cast<Index>(points.size());
  MatrixXd X(n, 3);
  VectorXd y(n);
  for (Index i = 0; i < n; ++i) {
    const auto& [speed, force] = points[static_cast<std::size_t>(i)];
    X.row(i) << 1.0, speed, speed * speed;
    y(i) = force;
  }
  VectorXd coefficients = VectorXd::Zero(problem.model.count());
  coefficients.head(3) = X.colPivHouseholderQr().solve(y);
  if (all_possible(problem, coefficients)) return coefficients;
  coefficients.setZero();
  coefficients(0) = y.mean();
  if (coefficients(0) > 0.0) return coefficients;
  throw RunFailure("the speed does not fall: no force to fit");
}

std::vector<LinearBlock> linearize_all(const CoastdownProblem& problem, const VectorXd& coefficients,
                                       const VectorXd& components) {
  std::vector<LinearBlock> blocks;
  for (const std::vector<std::size_t>& group : problem.groups) {
    std::vector<LinearBlock> parts;
    VectorXd shape;
    for (const std::size_t i : group) {
      const FitRun& run = problem.runs[i];
      parts.push_back(linearize(problem, run, coefficients, components));
      const VectorXd of_run = make_session_shape(problem, run, coefficients);
      shape.conservativeResize(shape.size() + of_run.size());
      shape.tail(of_run.size()) = of_run;
    }
    // with one run in each session, a constant force of sessions is that of runs
    const bool has_scatter = problem.has_repeats || problem.session_shape == SessionShape::kProportional;
    blocks.push_back(join_blocks(parts));
    if (has_scatter) blocks.back().patterns[kSession] = shape * shape.transpose();
  }
  return blocks;
}

}  // namespace rollrig::estimation
