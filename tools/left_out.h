#pragma once
/// How well the joint calibration predicts what it is not fitted to.

#include <functional>
#include <string>
#include <vector>

#include "tools/joint_calibration.h"

namespace rollrig::tools::joint {

/// Observations of one kind, and what is left out for their prediction.
struct LeftOut {
  std::string title;
  std::set<std::string> left_out;  // tables
  std::string table;
  std::string word;  // in the names of the observations; empty: all
  std::string unit;
};
const std::vector<LeftOut>& list_left_out();

/// Its errors: virtual less published, or how far outside of what is published.
struct Errors {
  double rms = 0.0;
  double largest = 0.0;
  std::string worst;  // observation that has the largest
};
Errors find_errors(const std::vector<Observation>& observations, const LeftOut& kind);

/// docs/calibration_left_out.md, with one fit for each set of tables that is left out. `fit` fits `tests` as they are.
std::string make_left_out_page(JointCalibration& tests, const std::function<Unknowns()>& fit);

/// Start of the row of a kind: its title and the errors when fitted.
std::string begin_row(const LeftOut& kind, const Errors& fitted);

}  // namespace rollrig::tools::joint
