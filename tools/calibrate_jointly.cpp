/// Calibrates the source's three tires together, on the bounded law (models/tire/bounded.cpp), with one heat transfer
/// for each rig.
///
/// usage: calibrate_jointly <tests/published> [<page>]
/// Free: at most six numbers of each tire and one of each rig (joint_calibration.h). Residuals and their weights:
/// joint_calibration.cpp. a40, a50, a60 of assets/tires and the files of assets/rigs are rewritten, number by number.
/// Those of the tires get [correlation] as their last table.
/// Written out: free numbers with standard errors and correlations, and every observation. With a page, no file is
/// calibrated: the page is written, a study that leaves out one table or a group of tables at a time (left_out.h).
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <iostream>

#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "tools/joint_calibration.h"
#include "tools/left_out.h"
#include "tools/number_in_file.h"

namespace {

using namespace rollrig;
using tools::joint::FreeNumber;
using tools::joint::JointCalibration;
using tools::joint::Observation;
using tools::joint::Unknowns;

// Ceres steps in proportion to a number: with this added to each, all take steps of 1e-3.
constexpr double kShift = 10.0;
constexpr double kRelativeStep = 1e-4;

struct Cost {
  const JointCalibration& tests;
  std::size_t unknown_count;

  bool operator()(double const* const* shifted, double* residuals) const {
    Unknowns at(shifted[0], shifted[0] + unknown_count);
    for (double& one : at) one -= kShift;
    try {
      for (const Observation& one : tests.observe(at)) *residuals++ = one.residual;
    } catch (const RunFailure&) {
      return false;  // Ceres shortens its step
    }
    return true;
  }
};

struct Fit {
  Unknowns at;
  Eigen::MatrixXd covariance;
};

/// Birge's ratio squared: mean square of the residuals that bear on the fit, over the degrees of freedom. The law
/// misses more than the weights say, so that the uncertainties grow by its root; they never shrink.
double find_scatter(const std::vector<double>& residuals, std::size_t unknowns) {
  double squares = 0.0;
  std::size_t bearing = 0;
  for (const double one : residuals) {
    squares += one * one;
    bearing += one != 0.0 ? 1U : 0U;
  }
  return std::max(1.0, squares / static_cast<double>(bearing - unknowns));
}

/// Whether a residual holds the fit within the law, or within what the project asks for, and is no published number.
bool is_limit(const Observation& one) {
  const auto ends_with = [&](const std::string& end) {
    return one.name.size() >= end.size() && one.name.compare(one.name.size() - end.size(), end.size(), end) == 0;
  };
  return one.table == "cold" || (one.table == "prior" && (ends_with(" fall at rest") || ends_with(" s")));
}

/// Covariance of the unknowns where the fit ends.
/// Equation  C = (J^T J/q + P)^-1
/// Symbols   J derivatives of the residuals without the limits, which say nothing of what is known; q their mean
/// square,
///           see find_scatter; P diagonal, of a prior: a number that is hardly determined stays positive within two
///           standard deviations (Assumed: 0.5 of its logarithm)
Eigen::MatrixXd find_covariance(const JointCalibration& tests, Eigen::MatrixXd derivatives,
                                const std::vector<double>& residuals, const Unknowns& at) {
  constexpr double kMostRelativeSd = 0.5;
  const std::vector<Observation> all = tests.observe(at);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_limit(all[i])) derivatives.row(static_cast<Eigen::Index>(i)).setZero();
  }
  Eigen::MatrixXd information = derivatives.transpose() * derivatives / find_scatter(residuals, at.size());
  const std::vector<FreeNumber>& free = tools::joint::list_free_numbers();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (free[i].is_positive) information(row, row) += 1.0 / (kMostRelativeSd * kMostRelativeSd);
  }
  return information.inverse();
}

Fit fit(const JointCalibration& tests) {
  Unknowns shifted = tests.read_unknowns();
  for (double& one : shifted) one += kShift;
  const std::size_t residual_count = tests.observe(tests.read_unknowns()).size();
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = kRelativeStep;
  auto* cost = new ceres::DynamicNumericDiffCostFunction<Cost, ceres::CENTRAL>(
      new Cost{tests, shifted.size()}, ceres::TAKE_OWNERSHIP, steps);  // the problem takes it
  cost->AddParameterBlock(static_cast<int>(shifted.size()));
  cost->SetNumResiduals(static_cast<int>(residual_count));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, shifted.data());
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-4;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) {
    throw RunFailure("the calibration does not converge: " + summary.BriefReport());
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(residual_count, shifted.size());
  std::vector<double> residuals(residual_count);
  double* jacobian = rows.data();
  const double* at = shifted.data();
  if (!cost->Evaluate(&at, residuals.data(), &jacobian)) throw RunFailure("no derivatives where the fit ends");
  Fit result;
  for (const double one : shifted) result.at.push_back(one - kShift);
  result.covariance = find_covariance(tests, rows, residuals, result.at);
  return result;
}

void print_observations(const std::vector<Observation>& all) {
  for (const Observation& one : all) {
    fmt::print("  {:<6} {:<32} published {:>9.3f} fitted {:>9.3f} residual {:+.2f}\n", one.table, one.name,
               one.published, one.fitted, one.residual);
  }
  fmt::print("  rms of Tables 4.4 and 4.5 {:.2f} points, of Table 5.1 {:.2f} Wh/km\n",
             tools::joint::find_rms(all, {"4.4", "4.5"}), tools::joint::find_rms(all, {"5.1"}));
}

void print_numbers(const Fit& fit) {
  const Eigen::VectorXd sd = fit.covariance.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < fit.at.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    fmt::print("  {:<28} {:>9.4f} +- {:.4f}; correlations", tools::joint::name_of_unknown(i), fit.at[i], sd[row]);
    for (std::size_t k = 0; k < i; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const double correlation = fit.covariance(row, column) / (sd[row] * sd[column]);
      if (std::abs(correlation) > 0.5) fmt::print(" {:+.2f} ({})", correlation, tools::joint::name_of_unknown(k));
    }
    fmt::print("\n");
  }
}

const char* find_table(const FreeNumber& one) {
  return one.key == std::string(tools::joint::kCapacity) ? "thermal" : "bounded";
}

/// Of a tire's own numbers, to three decimals, whatever the rigs and the other tires are. A number and its logarithm
/// have the same correlations to first order.
models::TireCorrelation find_correlation(std::size_t tire, const Eigen::MatrixXd& covariance) {
  const std::vector<FreeNumber>& free = tools::joint::list_free_numbers();
  std::vector<Eigen::Index> own;
  models::TireCorrelation correlation;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i].tire != tire) continue;
    own.push_back(static_cast<Eigen::Index>(i));
    correlation.numbers.push_back(fmt::format("{}.{}", find_table(free[i]), free[i].key));
  }
  for (const Eigen::Index i : own) {
    std::vector<double>& row = correlation.matrix.emplace_back();
    for (const Eigen::Index k : own) {
      const double exact = covariance(i, k) / std::sqrt(covariance(i, i) * covariance(k, k));
      row.push_back(std::round(1e3 * exact) / 1e3 + 0.0);  // no -0
    }
  }
  return correlation;
}

/// The file of a tire with its free numbers, their standard uncertainties and correlations.
std::string rewrite_tire(const models::TireFile& file, std::size_t tire, const Eigen::MatrixXd& covariance) {
  std::string text = read_text_file(file.path);
  Eigen::Index i = 0;
  for (const FreeNumber& one : tools::joint::list_free_numbers()) {
    const double own_sd = std::sqrt(covariance(i, i));
    ++i;
    if (one.tire != tire) continue;
    const double value = *tools::joint::find_number(file.values, one.key);
    const double sd = one.is_positive ? value * own_sd : own_sd;
    text = tools::replace_number(text, find_table(one), one.key, value);
    text = tools::replace_number(text, find_table(one), std::string(one.key) + "_sd", sd);
  }
  text = text.substr(0, text.find("\n[correlation]")) + models::write_correlation(find_correlation(tire, covariance));
  models::read_tire(parse_config(text, file.path));  // throws where rounding leaves no correlation matrix
  return text;
}

/// The rise with speed, which is in proportion, has the same relative standard uncertainty.
void rewrite_rig(const std::string& path, const models::TireCooling& cooling, double relative_sd) {
  std::string text = read_text_file(path);
  models::TireCooling::visit(cooling, [&](const Field& field, const double& value) {
    text = tools::replace_number(text, "tire_cooling", field.key, value);
    text = tools::replace_number(text, "tire_cooling", std::string(field.key) + "_sd", relative_sd * value);
  });
  write_file_atomically(path, text);
}

/// Rewrites the files in place: the free numbers, and of those of the tires what the covariance says.
void write_files(const tools::joint::CalibratedFiles& files, const Eigen::MatrixXd& covariance) {
  for (std::size_t tire = 0; tire < tools::kTires.size(); ++tire) {
    write_file_atomically(files.tires[tire].path, rewrite_tire(files.tires[tire], tire, covariance));
  }
  for (std::size_t i = 0; i < files.rigs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(tools::joint::list_free_numbers().size() + i);
    for (const std::string& alike : tools::joint::kRigsAlike.at(files.rigs[i].name)) {
      constexpr double kAlikeSd = 0.15;  // Assumed: 15 %; the two calibrated rigs differ by a factor of 1.64
      const bool is_calibrated = alike == files.rigs[i].name;
      rewrite_rig(find_asset("rigs", alike), files.rigs[i].tire_cooling,
                  is_calibrated ? std::sqrt(covariance(row, row)) : kAlikeSd);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: calibrate_jointly <tests/published> [<page>]\n";
    return 2;
  }
  try {
    const std::string published = argv[1];
    JointCalibration tests(tools::joint::read_files(), published);
    if (argc == 3) {
      write_file_atomically(argv[2], tools::joint::make_left_out_page(tests, [&] { return fit(tests).at; }));
      return 0;
    }
    const Fit best = fit(tests);
    print_numbers(best);
    print_observations(tests.observe(best.at));
    write_files(tests.put(best.at), best.covariance);
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "calibration failed: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
