#include "diagnosis/comparison/held_out.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "diagnosis/comparison/bounded_step.h"

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

RowMatrix LeaveOut::find_own(const LeftOutPart& part, const RowMatrix& columns) const {
  RowMatrix own(columns.rows(), columns.cols());
  Eigen::Index next = 0;
  for (std::size_t s = 0; s < study_.set.series().size(); ++s) {
    const Series& series = study_.set.series()[s];
    if (series.run != part.run) continue;
    if (!part.phase.has_value()) {
      own.middleRows(next, to_index(series.size())) = series.rows_of(columns);
      next += to_index(series.size());
      continue;
    }
    std::vector<Eigen::Index> blocks;
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (series.phase[k] == *part.phase) blocks.push_back(to_index(k));
    }
    if (blocks.empty()) continue;
    const Eigen::Index count = to_index(blocks.size());
    RowMatrix units = RowMatrix::Zero(to_index(series.size()), count);
    for (std::size_t k = 0; k < blocks.size(); ++k) units(blocks[k], to_index(k)) = 1.0;
    study_.discrepancy.whiten_series(candidate_.amplitudes, s, units);
    const Eigen::LLT<Eigen::MatrixXd> factor(units.transpose() * units);
    own.middleRows(next, count) = factor.matrixL().solve(Eigen::MatrixXd(units.transpose() * series.rows_of(columns)));
    next += count;
  }
  own.conservativeResize(next, Eigen::NoChange);
  return own;
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
  const Eigen::VectorXd aim = jacobian * candidate_.fit.unknowns - said.col(n);
  Prediction prediction;
  prediction.unknowns = solve_within_bounds(model_, curvature, gradient_ - jacobian.transpose() * aim);
  if (!part.phase.has_value()) {
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

}  // namespace rollrig::diagnosis
