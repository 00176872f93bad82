#include <ceres/ceres.h>

#include <cmath>

#include "tools/figure_3_13.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

scenarios::RunSpec make_figure_spec(double heat_capacity_J_per_K) {
  scenarios::RunSpec spec = make_source_drive("a50");
  spec.tire.values.own = {&models::default_tire_model(), {}};  // (3.5)
  auto& rr = spec.tire.values.rolling_resistance;
  rr.lowest_speed_m_s = 20.0 / 3.6;  // §4.2.1
  rr.A1_N_s_per_m = (64.7752 - 55.1434) / (kHighSpeed_m_s - kLowSpeed_m_s);
  rr.A0_N = 55.1434 - rr.A1_N_s_per_m * kLowSpeed_m_s;
  rr.B1_s_per_m_K = (0.0191 - 0.0177) / (kHighSpeed_m_s - kLowSpeed_m_s);
  rr.B0_per_K = 0.0177 - rr.B1_s_per_m_K * kLowSpeed_m_s;
  spec.tire.values.thermal.heat_capacity_J_per_K = heat_capacity_J_per_K;
  return spec;
}

/// Differences of the eight sections at ln z, ln f; residuals in points.
struct Sections {
  scenarios::RunSpec spec;
  std::vector<double> published;

  std::vector<double> differences(const double* x) const {
    scenarios::RunSpec at = spec;
    at.tire.values.thermal.rest_conductance_W_per_K = std::exp(x[0]);
    at.tire.values.thermal.speed_conductance_W_s_per_m_K = std::exp(x[1]);
    std::vector<double> found;
    const Json result = scenarios::run_scenario(at, {}).result;
    for (const Json& section : result["sections"]) found.push_back(section["difference_percent"].get<double>() / 100.0);
    return found;
  }
  bool operator()(const double* x, double* residuals) const {
    const std::vector<double> found = differences(x);
    for (std::size_t i = 0; i < published.size(); ++i) residuals[i] = 100.0 * (found[i] - published[i]);
    return true;
  }
};

}  // namespace

CoolingFit fit_cooling_to_figure_3_13(const std::vector<double>& published, double heat_capacity_J_per_K) {
  constexpr int kSections = 8;
  Sections sections{make_figure_spec(heat_capacity_J_per_K), published};
  double x[2] = {std::log(15.0), std::log(1.5)};
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = 1e-4;
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::NumericDiffCostFunction<Sections, ceres::CENTRAL, kSections, 2>(
                               &sections, ceres::DO_NOT_TAKE_OWNERSHIP, kSections, steps),
                           nullptr, x);
  ceres::Solver::Options options;
  options.function_tolerance = 1e-8;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) throw RunFailure("z and f do not converge");
  return {std::exp(x[0]), std::exp(x[1]), std::sqrt(2.0 * summary.final_cost / kSections) / 100.0,
          sections.differences(x)};
}

}  // namespace rollrig::tools
