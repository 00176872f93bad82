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

Prediction predict_without(const Study& study, const Candidate& candidate, std::size_t held_out) {
  RowMatrix jacobian = candidate.fit.jacobian;
  Eigen::VectorXd residuals = candidate.fit.residuals;
  study.discrepancy.whiten(candidate.amplitudes, jacobian);
  study.discrepancy.whiten(candidate.amplitudes, residuals);
  RowMatrix left_out = RowMatrix::Zero(jacobian.rows(), jacobian.cols());
  for (const Series& series : study.set.series()) {
    if (series.run != held_out) continue;
    auto rows = series.rows_of(jacobian);
    series.rows_of(left_out) = rows;
    rows.setZero();
    series.rows_of(residuals).setZero();
  }
  const Eigen::Index n = jacobian.cols();
  const Eigen::LLT<Eigen::MatrixXd> curvature(jacobian.transpose() * jacobian + Eigen::MatrixXd::Identity(n, n));
  const Model model = study.make_model(candidate.fit.hypothesis);
  const Eigen::VectorXd& from = candidate.fit.unknowns;
  const Eigen::VectorXd unknowns =
      solve_within_bounds(model, curvature.reconstructedMatrix(), jacobian.transpose() * (jacobian * from - residuals));
  Prediction prediction;
  const auto parameters = to_index(model.parameter_count());  // offsets are taken off anew
  left_out.rightCols(n - parameters).setZero();
  prediction.uncertainty = curvature.matrixL().solve(Eigen::MatrixXd(left_out.transpose())).squaredNorm();
  if (!model.simulate(unknowns, 1, prediction.simulated, nullptr)) prediction.simulated.resize(0);
  return prediction;
}

}  // namespace rollrig::diagnosis
