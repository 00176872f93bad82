// Fits without a part of the data, against generalized least squares over all other blocks, written out.
#include "diagnosis/comparison/held_out.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <functional>

#include "tests/diagnosis/gap_sets.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::LeaveOut;
using diagnosis::LeftOutPart;
using diagnosis::Series;
using diagnosis::to_index;
using tests::FittedBaseline;

namespace {

using Kept = std::function<bool(const Series& series, std::size_t block)>;

/// The best unknowns by the blocks that are kept, from their covariance, to first order about the fit.
Eigen::VectorXd solve_densely(const FittedBaseline& fitted, const Kept& keep) {
  const diagnosis::Fit& fit = fitted.null.fit;
  const Eigen::Index n = fit.jacobian.cols();
  Eigen::MatrixXd curvature = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n);
  for (std::size_t s = 0; s < fitted.set.series().size(); ++s) {
    const Series& series = fitted.set.series()[s];
    const Eigen::Index size = to_index(series.size());
    diagnosis::RowMatrix units = diagnosis::RowMatrix::Identity(size, size);
    fitted.discrepancy.whiten_series(fitted.null.amplitudes, s, units);
    const Eigen::MatrixXd covariance = (units.transpose() * units).inverse();
    Eigen::MatrixXd values(size, n + 1);  // block means: derivatives, and what is aimed at
    diagnosis::RowMatrix whitened = series.rows_of(fit.jacobian);
    Eigen::VectorXd residuals = series.rows_of(fit.residuals);
    series.whitener.undo(whitened.data(), static_cast<std::size_t>(n));
    series.whitener.undo(residuals.data(), 1);
    values << whitened, whitened * fit.unknowns - residuals;
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (keep(series, k)) rows.push_back(to_index(k));
    }
    if (rows.empty()) continue;
    const Eigen::MatrixXd kept = values(rows, Eigen::all);
    const Eigen::MatrixXd weighted = Eigen::MatrixXd(covariance(rows, rows)).llt().solve(kept);
    curvature += kept.leftCols(n).transpose() * weighted.leftCols(n);
    gradient += kept.leftCols(n).transpose() * weighted.col(n);
  }
  return curvature.llt().solve(gradient);
}

const FittedBaseline& two_runs() {
  static const FittedBaseline fitted(tests::add_noise(tests::make_gap_set({}, 2), 3));
  return fitted;
}

void check_same(const Eigen::VectorXd& unknowns, const Eigen::VectorXd& expected) {
  REQUIRE(unknowns.size() == expected.size());
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
    INFO("unknown " << i);
    CHECK(unknowns[i] == Approx(expected[i]).margin(1e-6));
  }
}

}  // namespace

TEST_CASE("a fit without a phase is that by all other blocks, though the noise of neighbors hangs together", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  for (const std::size_t phase : {std::size_t{0}, std::size_t{2}}) {
    INFO("phase " << phase);
    const Eigen::VectorXd expected = solve_densely(fitted, [&](const Series& series, std::size_t block) {
      return series.run != 1 || series.phase[block] != phase;
    });
    check_same(leave_out.predict_without({1, phase}).unknowns, expected);
  }
}

TEST_CASE("a fit without a run is that by the other runs", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const Eigen::VectorXd expected =
      solve_densely(fitted, [](const Series& series, std::size_t) { return series.run != 1; });
  check_same(LeaveOut(fitted, fitted.null).predict_without({1}).unknowns, expected);
}

TEST_CASE("a part is predicted the same whether all runs are simulated or its own", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  const LeftOutPart part{1, 1};
  const diagnosis::Prediction all = leave_out.predict_without(part);
  const diagnosis::Prediction own = leave_out.predict_without(part, LeaveOut::Simulated::kOfPart);
  CHECK(all.uncertainty == own.uncertainty);
  CHECK(all.uncertainty > 0.0);
  for (const Series& series : fitted.set.series()) {
    const auto difference = (series.rows_of(all.simulated) - series.rows_of(own.simulated)).eval();
    if (series.run == 1) CHECK(difference.norm() == 0.0);
  }
}

TEST_CASE("a phase is less uncertain than its run, of which the offset is not known", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  double phases = 0.0;
  for (std::size_t phase = 0; phase < fitted.set.runs()[0].phases.size(); ++phase) {
    phases = std::max(phases, leave_out.predict_without({0, phase}).uncertainty);
  }
  CHECK(phases < leave_out.predict_without({0}).uncertainty);
}

TEST_CASE("what an offset takes does not count as a difference of a run, and counts in a phase", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(to_index(fitted.set.residual_count()));
  for (const Series& series : fitted.set.series()) {
    if (series.run == 0 && series.channel == 0) series.rows_of(shift).setConstant(0.3 * series.offset_sd);
  }
  const double of_phase = leave_out.measure({0, 1}, shift);
  CHECK(leave_out.measure({0}, shift) < 1.0);  // a standard deviation of the offset's prior and no more
  CHECK(of_phase > 1.0);
  CHECK(leave_out.measure({1}, shift) == Approx(0.0).margin(1e-9));
}

namespace {

/// ln of the density of the block means that are kept, to first order about the fit: normal, with what the unknowns and
/// the noise make of their covariance.
double calc_log_density(const FittedBaseline& fitted, const Kept& keep) {
  const diagnosis::Fit& fit = fitted.null.fit;
  const Eigen::Index n = fit.jacobian.cols();
  const Eigen::Index all = to_index(fitted.set.residual_count());
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(all, all);
  Eigen::MatrixXd values(all, n + 1);
  std::vector<Eigen::Index> rows;
  for (std::size_t s = 0; s < fitted.set.series().size(); ++s) {
    const Series& series = fitted.set.series()[s];
    const Eigen::Index size = to_index(series.size());
    const Eigen::Index first = to_index(series.first_residual);
    diagnosis::RowMatrix units = diagnosis::RowMatrix::Identity(size, size);
    fitted.discrepancy.whiten_series(fitted.null.amplitudes, s, units);
    noise.block(first, first, size, size) = (units.transpose() * units).inverse();
    diagnosis::RowMatrix whitened = series.rows_of(fit.jacobian);
    Eigen::VectorXd residuals = series.rows_of(fit.residuals);
    series.whitener.undo(whitened.data(), static_cast<std::size_t>(n));
    series.whitener.undo(residuals.data(), 1);
    values.middleRows(first, size) << whitened, whitened * fit.unknowns - residuals;
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (keep(series, k)) rows.push_back(first + to_index(k));
    }
  }
  const Eigen::MatrixXd kept = values(rows, Eigen::all);
  const Eigen::MatrixXd covariance =
      Eigen::MatrixXd(noise(rows, rows)) + kept.leftCols(n) * kept.leftCols(n).transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  const double log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
  return -0.5 * (kept.col(n).dot(factor.solve(kept.col(n))) + log_determinant);
}

}  // namespace

TEST_CASE("the likelihood of a part that was left out is that of all over that of the rest", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  const double all = calc_log_density(fitted, [](const Series&, std::size_t) { return true; });
  const double rest = calc_log_density(
      fitted, [](const Series& series, std::size_t block) { return series.run != 1 || series.phase[block] != 1; });
  CHECK(leave_out.calc_log_likelihood({1, 1}) == Approx(all - rest).epsilon(1e-6));
  // Of a run, the sensors' own part is left out: it is the same for all hypotheses.
  const double without_run =
      calc_log_density(fitted, [](const Series& series, std::size_t) { return series.run != 1; });
  double of_sensors = 0.0;
  for (const Series& series : fitted.set.series()) {
    if (series.run != 1) continue;
    diagnosis::RowMatrix units = diagnosis::RowMatrix::Identity(to_index(series.size()), to_index(series.size()));
    series.whitener.apply(units.data(), series.size());
    const Eigen::LLT<Eigen::MatrixXd> factor(units.transpose() * units);
    of_sensors += factor.matrixLLT().diagonal().array().log().sum();
  }
  CHECK(leave_out.calc_log_likelihood({1}) == Approx(all - without_run - of_sensors).epsilon(1e-6));
}

TEST_CASE("numbers of the files that the runs speak against are unlikely once they are left out", "[fast]") {
  const FittedBaseline& fitted = two_runs();
  const LeaveOut leave_out(fitted, fitted.null);
  const std::vector<std::size_t> determined = leave_out.list_determined();
  REQUIRE_FALSE(determined.empty());
  // Data that ask for one number five of its standard uncertainties away.
  diagnosis::Candidate moved = fitted.null;
  moved.fit.residuals -= 5.0 * moved.fit.jacobian.col(to_index(determined.front()));
  const double against = LeaveOut(fitted, moved).calc_log_likelihood_of_files(determined);
  CHECK(leave_out.calc_log_likelihood_of_files(determined) > against + 3.0);
}
