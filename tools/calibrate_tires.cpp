/// Calibrates the source's tires to the numbers that the source publishes, on the drum and on the dynamometer.
///
/// usage: calibrate_tires <tests/published> <tire.toml> [<tire.toml> ...]
/// Fitted for each tire, nine parameters: A and B at 80 and 120 km/h (A0, A1, B0, B1), z and f on rig dyno_1m2,
/// z and f on rig drum_2m, and the heat capacity. To what, and with which weights and priors: virtual_tests.cpp
/// and the published numbers' files. The tire files are rewritten in place, number by number; comments stay.
/// Written out: fitted numbers with standard errors, every observation, the condition of the problem.
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <iostream>

#include "sim/core/file_io.h"
#include "tools/number_in_file.h"
#include "tools/virtual_tests.h"

namespace {

using namespace rollrig;
using tools::Calibration;
using tools::replace_number;
using tools::VirtualTests;

using Cost = ceres::DynamicNumericDiffCostFunction<VirtualTests, ceres::CENTRAL>;

struct Fit {
  Calibration at;
  Eigen::MatrixXd jacobian;  // of the weighted residuals
};

Fit calibrate(VirtualTests& tests) {
  Fit fit;
  fit.at = Calibration::of(tests.tire());
  double* x = fit.at.x.data();
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = 1e-4;
  auto* cost = new Cost(&tests, ceres::DO_NOT_TAKE_OWNERSHIP, steps);  // the problem takes it
  cost->AddParameterBlock(static_cast<int>(Calibration::kCount));
  cost->SetNumResiduals(static_cast<int>(tests.observation_count()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, x);
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-9;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE)
    throw RunFailure("calibration does not converge: " + summary.BriefReport());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(tests.observation_count(),
                                                                              Calibration::kCount);
  std::vector<double> residuals(tests.observation_count());
  double* jacobian = rows.data();
  const double* at = x;
  cost->Evaluate(&at, residuals.data(), &jacobian);
  fit.jacobian = rows;
  return fit;
}

/// Standard errors from the weights, and the condition of the problem with columns of unit length.
void report(const VirtualTests& tests, const Fit& fit) {
  const Eigen::VectorXd length = fit.jacobian.colwise().norm();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(fit.jacobian * length.cwiseInverse().asDiagonal(), Eigen::ComputeThinV);
  const Eigen::VectorXd values = svd.singularValues();
  const Eigen::MatrixXd half = svd.matrixV() * values.cwiseInverse().asDiagonal();
  const Eigen::VectorXd error = half.rowwise().norm().cwiseQuotient(length);
  for (std::size_t i = 0; i < Calibration::kCount; ++i) {
    fmt::print("  {:<12} {:>10.5f} +- {:.5f}\n", Calibration::kNames[i], fit.at.x[i],
               error[static_cast<Eigen::Index>(i)]);
  }
  fmt::print("  condition {:.0f}\n", values[0] / values[values.size() - 1]);
  const std::vector<tools::Observation> all = tests.observe(fit.at);
  for (const tools::Observation& o : all) {
    fmt::print("  {:<24} published {:>10.5f} fitted {:>10.5f} sd {:.5f} residual {:+.2f}\n", o.name, o.published,
               o.fitted, o.sd, o.residual);
  }
  fmt::print("  rms over the eight sections {:.3f} points\n", 100.0 * VirtualTests::section_rms(all));
}

void calibrate_file(const std::string& folder, const std::string& path) {
  std::string text = read_text_file(path);
  const std::string name = models::read_tire(parse_config(text, path)).name;
  VirtualTests tests(path, tools::read_published_tire(folder, name));
  const Fit fit = calibrate(tests);
  models::TireFile tire = tests.tire();
  fit.at.put(tire);
  const auto& rr = tire.values.rolling_resistance;
  text = replace_number(text, "rolling_resistance", "A0_N", rr.A0_N);
  text = replace_number(text, "rolling_resistance", "A1_N_s_per_m", rr.A1_N_s_per_m);
  text = replace_number(text, "rolling_resistance", "B0_per_degC", rr.B0_per_K);
  text = replace_number(text, "rolling_resistance", "B1_s_per_m_degC", rr.B1_s_per_m_K);
  text = replace_number(text, "thermal", "heat_capacity_J_per_K", tire.values.thermal.heat_capacity_J_per_K);
  for (const char* rig : {"drum_2m", "dyno_1m2"}) {
    const std::string table = std::string("thermal.rig.") + rig;
    text =
        replace_number(text, table, "conductance_at_rest_W_per_K", *tire.rig_thermal.at(rig).rest_conductance_W_per_K);
    text = replace_number(text, table, "conductance_per_speed_W_s_per_m_K",
                          *tire.rig_thermal.at(rig).speed_conductance_W_s_per_m_K);
  }
  fmt::print("{}\n", name);
  report(tests, fit);
  write_file_atomically(path, text);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: calibrate_tires <tests/published> <tire.toml> ...\n";
    return 2;
  }
  try {
    for (int i = 2; i < argc; ++i) calibrate_file(argv[1], argv[i]);
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "calibration failed: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
