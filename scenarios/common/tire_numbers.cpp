#include "scenarios/common/tire_numbers.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace rollrig::scenarios {

TireNumbers TireNumbers::of(const models::TireFile& tire) {
  TireNumbers numbers;
  std::vector<double> sds;
  models::TireParameters<double>::visit_all(tire.standard_uncertainties,
                                            [&](const std::string& table, const Field& field, const double& sd) {
                                              if (sd <= 0.0) return;
                                              numbers.keys.push_back(table + "." + field.key);
                                              sds.push_back(sd);
                                            });
  const auto n = static_cast<Eigen::Index>(sds.size());
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  const std::vector<std::string>& correlated = tire.correlation.numbers;
  const auto find = [&correlated](const std::string& key) {
    return static_cast<std::size_t>(std::find(correlated.begin(), correlated.end(), key) - correlated.begin());
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::size_t a = find(numbers.keys[static_cast<std::size_t>(i)]);
      const std::size_t b = find(numbers.keys[static_cast<std::size_t>(j)]);
      if (i != j && a < correlated.size() && b < correlated.size()) correlation(i, j) = tire.correlation.matrix[a][b];
    }
  }
  numbers.root = correlation.llt().matrixL();
  for (Eigen::Index i = 0; i < n; ++i) numbers.root.row(i) *= sds[static_cast<std::size_t>(i)];
  return numbers;
}

void TireNumbers::move(const Eigen::VectorXd& z, models::TireFile& tire) const {
  const Eigen::VectorXd moves = root * z;
  models::TireParameters<double>::visit_all(
      tire.values, [&](const std::string& table, const Field& field, double& value) {
        const auto found = std::find(keys.begin(), keys.end(), table + "." + field.key);
        if (found != keys.end()) value += moves(found - keys.begin());
      });
}

}  // namespace rollrig::scenarios
