#include "estimation/road_load/trace_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>
#include <boost/math/tools/minima.hpp>

#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Coefficients and components of variance by turns.
LinearEstimate iterate_blocks(const std::vector<LinearBlock>& blocks) {
  constexpr int kMostTurns = 60;
  constexpr double kLeastNoise_m_s = 1e-4;  // Assumed: far below any sensor's, so that data without noise have weights
  constexpr double kStep = 1e-3;
  const Eigen::Vector4d start(0.05 * 0.05, 10.0, 1.0, 1.0);  // Assumed: where the turns begin
  VectorXd components = start.head(static_cast<Index>(blocks.front().patterns.size()));
  VectorXd floors = VectorXd::Zero(components.size());
  floors(kSpeedNoise) = kLeastNoise_m_s * kLeastNoise_m_s;
  LinearEstimate estimate;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    estimate = step_variance_components(blocks, components, floors);
    VectorXd wanted = estimate.components;
    wanted(kSpeedNoise) = std::max(wanted(kSpeedNoise), 0.1 * components(kSpeedNoise));
    const bool settled =
        ((wanted - components).array().abs() <= kStep * wanted.array().max(components.array()) + 1e-12).all();
    components = turn < 10 ? wanted : VectorXd(0.5 * (wanted + components));
    if (settled) break;
  }
  return estimate;
}

/// With a column for each session but the first, in which its runs have these shapes, block by block.
std::vector<LinearBlock> add_session_columns(const std::vector<LinearBlock>& blocks,
                                             const std::vector<std::size_t>& sessions,
                                             const std::vector<VectorXd>& shapes) {
  const Index p = blocks.front().X.cols();
  const auto count = static_cast<Index>(*std::max_element(sessions.begin(), sessions.end()));
  std::vector<LinearBlock> with_columns = blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    MatrixXd& X = with_columns[i].X;
    X.conservativeResize(Eigen::NoChange, p + count);
    X.rightCols(count).setZero();
    if (sessions[i] > 0) X.col(p + static_cast<Index>(sessions[i]) - 1) = shapes[i];
  }
  return with_columns;
}

/// What a session says, its runs by their own covariance D: products [X f y]' D^-1 [X f y], f the session's shape.
struct SessionProducts {
  MatrixXd of_X;
  VectorXd X_f, X_y;
  double f_f = 0.0, f_y = 0.0, y_y = 0.0;
};

/// Generalized least squares where each session adds a scatter of this variance, in its shape.
class SessionModel {
 public:
  SessionModel(const std::vector<LinearBlock>& blocks, const std::vector<std::size_t>& sessions,
               const std::vector<VectorXd>& shapes, const VectorXd& components) {
    const Index p = blocks.front().X.cols();
    sessions_.resize(*std::max_element(sessions.begin(), sessions.end()) + 1,
                     {MatrixXd::Zero(p, p), VectorXd::Zero(p), VectorXd::Zero(p)});
    for (std::size_t i = 0; i < blocks.size(); ++i) add(blocks[i], shapes[i], components, sessions_[sessions[i]]);
  }

  /// Restricted log likelihood without its constant, and the estimate there.
  double evaluate(double variance, VectorXd& coefficients, MatrixXd& covariance) const {
    const Index p = sessions_.front().X_f.size();
    MatrixXd information = MatrixXd::Zero(p, p);
    VectorXd right = VectorXd::Zero(p);
    double squares = 0.0, log_determinant = log_determinant_of_runs_;
    for (const SessionProducts& session : sessions_) {
      // (D + s f f')^-1 = D^-1 - D^-1 f f' D^-1 s/(1 + s f'D^-1 f)
      const double share = variance / (1.0 + variance * session.f_f);
      information += session.of_X - share * session.X_f * session.X_f.transpose();
      right += session.X_y - share * session.f_y * session.X_f;
      squares += session.y_y - share * session.f_y * session.f_y;
      log_determinant += std::log1p(variance * session.f_f);
    }
    const Eigen::LDLT<MatrixXd> factors(information);
    coefficients = factors.solve(right);
    covariance = factors.solve(MatrixXd::Identity(p, p));
    log_determinant += factors.vectorD().array().log().sum();
    return -0.5 * (log_determinant + squares - right.dot(coefficients));
  }

 private:
  void add(const LinearBlock& block, const VectorXd& shape, const VectorXd& components, SessionProducts& session) {
    MatrixXd D = MatrixXd::Zero(shape.size(), shape.size());
    for (std::size_t i = 0; i < block.patterns.size(); ++i) D += components(static_cast<Index>(i)) * block.patterns[i];
    const Eigen::LLT<MatrixXd> factors(D);
    const MatrixXd X = factors.matrixL().solve(block.X);
    const VectorXd f = factors.matrixL().solve(shape);
    const VectorXd y = factors.matrixL().solve(block.y);
    session.of_X += X.transpose() * X;
    session.X_f += X.transpose() * f;
    session.X_y += X.transpose() * y;
    session.f_f += f.squaredNorm();
    session.f_y += f.dot(y);
    session.y_y += y.squaredNorm();
    log_determinant_of_runs_ += 2.0 * MatrixXd(factors.matrixL()).diagonal().array().log().sum();
  }

  std::vector<SessionProducts> sessions_;
  double log_determinant_of_runs_ = 0.0;
};

struct SessionFit {
  LinearEstimate estimate;
  double sd = 0.0;  // from session to session, in units of the shape
};

/// The components of the runs come from within the sessions; the variance between sessions, `most_sd` squared at most,
/// from the restricted likelihood with these components. Degrees of freedom by Satterthwaite, with one less than the
/// sessions for the part of the variance that is theirs.
SessionFit fit_with_sessions(const std::vector<LinearBlock>& blocks, const std::vector<std::size_t>& sessions,
                             const std::vector<VectorXd>& shapes, double most_sd) {
  constexpr int kBits = 20;
  constexpr double kLeastGain = 1e-4;  // Assumed: of the log likelihood; less is rounding of the search
  SessionFit fit;
  fit.estimate = iterate_blocks(add_session_columns(blocks, sessions, shapes));
  const SessionModel model(blocks, sessions, shapes, fit.estimate.components);
  VectorXd coefficients;
  MatrixXd within, whole;
  const auto loss = [&](double sd) { return -model.evaluate(sd * sd, coefficients, whole); };
  fit.sd = boost::math::tools::brent_find_minima(loss, 0.0, most_sd, kBits).first;
  const double without = model.evaluate(0.0, coefficients, within);
  if (-loss(fit.sd) < without + kLeastGain) fit.sd = 0.0;
  fit.estimate.log_likelihood = model.evaluate(fit.sd * fit.sd, coefficients, whole);
  const double of_sessions = static_cast<double>(*std::max_element(sessions.begin(), sessions.end()));
  VectorXd freedom(coefficients.size());
  for (Index i = 0; i < coefficients.size(); ++i) {
    const double own = within(i, i), added = std::max(0.0, whole(i, i) - own);
    const double whole_2 = whole(i, i) * whole(i, i);
    freedom(i) = whole_2 / (own * own / fit.estimate.degrees_freedom(i) + added * added / of_sessions);
  }
  fit.estimate.coefficients = coefficients;
  fit.estimate.covariance = whole;
  fit.estimate.degrees_freedom = freedom;
  return fit;
}

/// Numbers of the sessions in the order of the blocks, from 0.
std::vector<std::size_t> number_sessions(const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> of_blocks;
  for (const std::string& name : names) of_blocks.push_back(numbers.try_emplace(name, numbers.size()).first->second);
  return of_blocks;
}

}  // namespace

TraceFit fit_trace_blocks(const std::vector<LinearBlock>& blocks, const std::vector<std::string>& names) {
  const TraceFit alike{iterate_blocks(blocks)};
  const std::vector<std::size_t> sessions = number_sessions(names);
  const std::size_t count = *std::max_element(sessions.begin(), sessions.end()) + 1;
  if (count < 2 || count == blocks.size()) return alike;
  std::vector<VectorXd> ones, forces;
  double most_N = 0.0;
  for (const LinearBlock& block : blocks) {
    ones.push_back(VectorXd::Ones(block.y.size()));
    forces.push_back(block.X * alike.estimate.coefficients);
    most_N = std::max(most_N, forces.back().cwiseAbs().maxCoeff());
  }
  try {
    const SessionFit by_force = fit_with_sessions(blocks, sessions, ones, most_N);
    const SessionFit by_share = fit_with_sessions(blocks, sessions, forces, 1.0);
    const bool is_share = by_share.estimate.log_likelihood - by_force.estimate.log_likelihood >= kClearlyMoreLikely;
    return is_share ? TraceFit{by_share.estimate, 0.0, by_share.sd} : TraceFit{by_force.estimate, by_force.sd, 0.0};
  } catch (const RunFailure&) {  // the term of a session is that of the headings, or of the coefficients
    return {alike.estimate, 0.0, 0.0, false};
  }
}

}  // namespace rollrig::estimation
