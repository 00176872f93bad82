#pragma once
/// Numbers of a tire file that are uncertain.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "models/tire/tire_file.h"

namespace rollrig::scenarios {

/// Numbers of the tire file that have a standard uncertainty, and how their errors go together.
struct TireNumbers {
  std::vector<std::string> keys;  // "bounded.loss_N"
  Eigen::MatrixXd root;           // S L

  static TireNumbers of(const models::TireFile& tire);
  /// Adds S L z to the tire.
  void move(const Eigen::VectorXd& z, models::TireFile& tire) const;
};

}  // namespace rollrig::scenarios
