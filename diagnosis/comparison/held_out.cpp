#include "diagnosis/comparison/held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/comparison/bounded_step.h"
#include "diagnosis/comparison/log_determinant.h"

namespace rollrig::diagnosis {
namespace {

struct Bounds {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
};

/// Of the moves (Model::moves_by_unknowns): own parameters stay in their ranges. A base parameter stays within 0.9 of
/// its value: the step is linear, and a larger one could give a negative number.
Bounds find_bounds(const Model& model) {
  constexpr double kMostRelative = 0.9;  // Assumed
  const Eigen::Index n = to_index(model.unknown_count());
  const double infinity = std::numeric_limits<double>::infinity();
  Bounds bounds{Eigen::VectorXd::Constant(n, -infinity), Eigen::VectorXd::Constant(n, infinity)};
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const PriorBounds own = model.own_parameters()[i].bounds();
    bounds.lower[to_index(i)] = own.lower;
    bounds.upper[to_index(i)] = own.upper;
  }
  const std::vector<estimation::FreeParameter>& base = model.base();
  for (std::size_t i = 0; i < base.size(); ++i) {
    const double most = std::abs(kMostRelative * base[i].start_SI / base[i].prior_sd_SI);
    if (most > 0.0) {
      bounds.lower[to_index(model.own_count() + i)] = -most;
      bounds.upper[to_index(model.own_count() + i)] = most;
    }
  }
  return bounds;
}

/// The unknowns at the minimum of x^T M x / 2 - b^T x within the bounds of the moves m = T x.
Eigen::VectorXd solve_within_bounds(const Model& model, const Eigen::MatrixXd& curvature,
                                    const Eigen::VectorXd& gradient) {
  const Bounds bounds = find_bounds(model);
  const Eigen::MatrixXd moves = model.moves_by_unknowns();
  const auto by_unknowns = moves.triangularView<Eigen::Lower>();
  const Eigen::MatrixXd half = by_unknowns.transpose().solve(curvature);
  const Eigen::MatrixXd by_moves = by_unknowns.transpose().solve(half.transpose()).transpose();  // T^-T M T^-1
  return by_unknowns.solve(solve_within(by_moves, by_unknowns.transpose().solve(gradient), bounds.lower, bounds.upper));
}

/// Neighboring blocks of a series: what they have by themselves, given all other blocks of the series.
///
/// Equation  own rows = L^-1 E^T Sigma^-1/2 c, L L^T = E^T Sigma^-1 E; Sigma^-1/2 = (1 - D t D^T) N, with A = N E:
///           E^T Sigma^-1 E = A^T A - (D^T A)^T (2 t - t^2) (D^T A)
/// Symbols   E unit vectors of the blocks, c whitened columns, N whitening by the sensor, D directions of the
///           discrepancy, t what is taken from each of them. A has few rows: what a block leaves in those after it
///           fades
class OwnBlocks {
 public:
  OwnBlocks(const Discrepancy& discrepancy, const Amplitudes& amplitudes, std::size_t series,
            measurements::Block blocks)
      : basis_(discrepancy.bases()[series]), taken_(discrepancy.calc_taken(amplitudes, series)) {
    const Whitener& whitener = discrepancy.set().series()[series].whitener;
    const std::size_t count = blocks.last - blocks.first;
    const std::size_t rows = whitener.find_reach(blocks.last) - blocks.first;
    first_row_ = to_index(blocks.first);
    units_ = RowMatrix::Identity(to_index(rows), to_index(count));
    whitener.apply_from(blocks.first, units_.data(), {rows, count});
    along_ = basis_.directions.middleRows(first_row_, units_.rows()).transpose() * units_;
    const Eigen::VectorXd lost = (1.0 - (1.0 - taken_.array()).square()).sqrt().matrix();
    Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(units_.cols(), units_.cols());
    precision.selfadjointView<Eigen::Lower>().rankUpdate(units_.transpose());
    precision.selfadjointView<Eigen::Lower>().rankUpdate((lost.asDiagonal() * along_).transpose(), -1.0);
    factor_.compute(precision);
  }

  /// Of whitened columns over the blocks of the series.
  RowMatrix find_rows(const RowMatrix& columns) const {
    const Eigen::MatrixXd in_directions = taken_.asDiagonal() * (basis_.directions.transpose() * columns);
    const Eigen::MatrixXd of_blocks =
        units_.transpose() * columns.middleRows(first_row_, units_.rows()) - along_.transpose() * in_directions;
    return factor_.matrixL().solve(of_blocks);
  }

  double calc_log_determinant() const { return diagnosis::calc_log_determinant(factor_); }

 private:
  const Discrepancy::Basis& basis_;
  Eigen::VectorXd taken_;
  Eigen::Index first_row_ = 0;
  RowMatrix units_;        // A
  Eigen::MatrixXd along_;  // D^T A
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// The blocks of a phase, which are neighbors.
measurements::Block find_blocks(const Series& series, std::size_t phase) {
  const auto [first, last] = std::equal_range(series.phase.begin(), series.phase.end(), phase);
  return {static_cast<std::size_t>(first - series.phase.begin()),
          static_cast<std::size_t>(last - series.phase.begin())};
}

}  // namespace

LeaveOut::LeaveOut(const Study& study, const Candidate& candidate)
    : study_(study), candidate_(candidate), model_(study.make_model(candidate.fit.hypothesis)) {
  const Eigen::Index n = candidate.fit.jacobian.cols();
  with_residuals_.resize(candidate.fit.jacobian.rows(), n + 1);
  with_residuals_ << candidate.fit.jacobian, candidate.fit.residuals;
  study.discrepancy.whiten(candidate.amplitudes, with_residuals_);
  const auto jacobian = with_residuals_.leftCols(n);
  curvature_ = jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n);
  gradient_ = jacobian.transpose() * (jacobian * candidate.fit.unknowns - with_residuals_.col(n));
}

LeaveOut::OwnRows LeaveOut::find_own_rows(const LeftOutPart& part, const RowMatrix& columns) const {
  RowMatrix own(columns.rows(), columns.cols());
  double log_scale = 0.0;
  Eigen::Index next = 0;
  for (std::size_t s = 0; s < study_.set.series().size(); ++s) {
    const Series& series = study_.set.series()[s];
    if (series.run != part.run) continue;
    if (!part.phase.has_value()) {
      own.middleRows(next, to_index(series.size())) = series.rows_of(columns);
      next += to_index(series.size());
      log_scale -= 0.5 * study_.discrepancy.calc_log_determinant(candidate_.amplitudes, s);
      continue;
    }
    const measurements::Block blocks = find_blocks(series, *part.phase);
    if (blocks.first == blocks.last) continue;
    const OwnBlocks of_phase(study_.discrepancy, candidate_.amplitudes, s, blocks);
    const Eigen::Index count = to_index(blocks.last - blocks.first);
    own.middleRows(next, count) = of_phase.find_rows(series.rows_of(columns));
    next += count;
    log_scale += 0.5 * of_phase.calc_log_determinant();
  }
  own.conservativeResize(next, Eigen::NoChange);
  return {own, log_scale};
}

void LeaveOut::take_off_offsets(std::size_t run, RowMatrix& own) const {
  Eigen::Index next = 0;
  for (std::size_t s = 0; s < study_.set.series().size(); ++s) {
    const Series& series = study_.set.series()[s];
    if (series.run != run) continue;
    RowMatrix offset = RowMatrix::Constant(to_index(series.size()), 1, series.offset_sd);
    study_.discrepancy.whiten_series(candidate_.amplitudes, s, offset);
    auto rows = own.middleRows(next, to_index(series.size()));
    const Eigen::RowVectorXd best = offset.transpose() * rows / (1.0 + offset.squaredNorm());
    rows -= offset * best;
    next += to_index(series.size());
  }
}

double LeaveOut::measure(const LeftOutPart& part, Eigen::VectorXd difference) const {
  whiten(study_.set, difference);
  study_.discrepancy.whiten(candidate_.amplitudes, difference);
  RowMatrix own = find_own(part, difference);
  if (!part.phase.has_value()) take_off_offsets(part.run, own);
  return own.squaredNorm();
}

Prediction LeaveOut::predict_without(const LeftOutPart& part, Simulated which) const {
  const RowMatrix said = find_own(part, with_residuals_);
  const Eigen::Index n = said.cols() - 1;
  RowMatrix jacobian = said.leftCols(n);
  const Eigen::MatrixXd curvature = curvature_ - jacobian.transpose() * jacobian;
  const bool is_compared = said.rows() > 0;  // else the matrix is empty, and no column of it may be referred to
  Eigen::VectorXd aim = jacobian * candidate_.fit.unknowns;
  if (is_compared) aim -= said.col(n);
  Prediction prediction;
  prediction.unknowns = solve_within_bounds(model_, curvature, gradient_ - jacobian.transpose() * aim);
  if (is_compared && !part.phase.has_value()) {
    jacobian.rightCols(n - to_index(model_.parameter_count())).setZero();
    take_off_offsets(part.run, jacobian);
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(curvature);
  prediction.uncertainty = factor.matrixL().solve(Eigen::MatrixXd(jacobian.transpose())).squaredNorm();
  const bool was_simulated = which == Simulated::kAll
                                 ? model_.simulate(prediction.unknowns, 1, prediction.simulated, nullptr)
                                 : model_.simulate_one(part.run, prediction.unknowns, prediction.simulated);
  if (!was_simulated) prediction.simulated.resize(0);
  return prediction;
}

double LeaveOut::calc_log_likelihood(const LeftOutPart& part) const {
  const OwnRows own = find_own_rows(part, with_residuals_);
  const Eigen::Index n = own.rows.cols() - 1;
  return own.log_scale + calc_log_density(own.rows.leftCols(n), own.rows.col(n));
}

double LeaveOut::calc_log_likelihood_of_files(const std::vector<std::size_t>& base) const {
  RowMatrix stated = RowMatrix::Zero(to_index(base.size()), curvature_.cols());
  for (std::size_t i = 0; i < base.size(); ++i) stated(to_index(i), to_index(model_.own_count() + base[i])) = 1.0;
  return calc_log_density(stated, stated * candidate_.fit.unknowns);
}

std::vector<std::size_t> LeaveOut::list_determined() const {
  constexpr double kLeft = 1e-6;  // of the files, so that there is an inverse
  const Eigen::Index first = to_index(model_.own_count());
  const Eigen::Index count = to_index(model_.parameter_count()) - first;
  Eigen::MatrixXd curvature = curvature_;
  curvature.diagonal().segment(first, count).array() -= 1.0 - kLeft;
  const Eigen::MatrixXd covariance =
      curvature.llt().solve(Eigen::MatrixXd::Identity(curvature.rows(), curvature.cols()));
  std::vector<std::size_t> determined;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (covariance(first + i, first + i) < 1.0) determined.push_back(static_cast<std::size_t>(i));
  }
  return determined;
}

double LeaveOut::calc_log_density(const RowMatrix& jacobian, const Eigen::VectorXd& residuals) const {
  const Eigen::MatrixXd curvature = curvature_ - jacobian.transpose() * jacobian;
  const Eigen::VectorXd aim = jacobian * candidate_.fit.unknowns - residuals;
  const Eigen::VectorXd unknowns = solve_within_bounds(model_, curvature, gradient_ - jacobian.transpose() * aim);
  const Eigen::VectorXd error = residuals + jacobian * (unknowns - candidate_.fit.unknowns);
  // S^-1 and |S| by the curvatures with the rows and without them.
  const Eigen::LLT<Eigen::MatrixXd> with(curvature_);
  const Eigen::LLT<Eigen::MatrixXd> without(curvature);
  const Eigen::VectorXd along = jacobian.transpose() * error;
  const double square = error.squaredNorm() - along.dot(with.solve(along));
  return -0.5 * (square + calc_log_determinant(with) - calc_log_determinant(without));
}

}  // namespace rollrig::diagnosis
