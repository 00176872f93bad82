#pragma once

#include <Eigen/Cholesky>

namespace rollrig::diagnosis {

/// ln |M| of a factored matrix M = L L^T.
inline double calc_log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace rollrig::diagnosis
