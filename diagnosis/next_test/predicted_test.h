#pragma once
/// A test on paper: what each open hypothesis says that it would measure.

#include <functional>
#include <vector>

#include "diagnosis/comparison/information.h"
#include "diagnosis/findings/open_questions.h"
#include "diagnosis/next_test/test_menu.h"

namespace rollrig::diagnosis {

/// The test's runs as a set on the same rig, with the same sensors.
measurements::MeasurementSet make_virtual_set(const PreparedSet& set, const PlannedTest& test);
/// Changes of block means by each sensor offset of a set, one standard deviation of it; not whitened.
RowMatrix make_offsets(const PreparedSet& set);

/// The runs of a test simulated at the parameters of each hypothesis, sensors' noise whitened as in a diagnosis, one
/// new session: a row for each block mean, then the difference of the clocks and numbers that the test determines.
class PredictedTest {
 public:
  PredictedTest(const Study& study, const std::vector<OpenHypothesis>& open, const PlannedTest& test);

  /// Whether every hypothesis can be simulated on it.
  bool is_possible() const { return !predictions_.empty(); }

  /// Outcomes as far as the channels of `wanted` show them: one without a name stands for clocks and numbers.
  /// Equation  covariance = 1 + (J L)(J L)^T + offsets, L L^T what the parameters are uncertain by after the
  ///           measurement, all of it reduced to the directions in which means and covariances of the hypotheses differ
  ///           from 1
  /// Validity  linear in the parameters about the fit; model error as in the comparison, common to all hypotheses, in
  ///           proportion to what they differ by on average. Noise and model error of a channel do not depend on
  ///           another, so that whitened rows may be left out
  /// Checked   tests/diagnosis/next_test_test.cpp
  std::vector<PredictedOutcome> find_outcomes(const std::function<bool(const Quantity&)>& wanted = [](const Quantity&) {
    return true;
  }) const;

 private:
  /// Of one hypothesis: block means and how they move with the spread of its parameters.
  struct Prediction {
    Eigen::VectorXd mean;
    RowMatrix spread;
  };
  bool simulate(const PreparedSet& set, const Study& study, const std::vector<OpenHypothesis>& open);
  Amplitudes find_model_error(const PreparedSet& set) const;
  void add_clock_reading(const Study& study, const std::vector<OpenHypothesis>& open);
  void add_number_reading(const Study& study, const std::vector<OpenHypothesis>& open, const NumberReading& number);
  /// A row for each hypothesis with neither mean nor spread yet; returns its index.
  Eigen::Index append_row();
  static std::vector<PredictedOutcome> reduce(const std::vector<Prediction>& predictions, const RowMatrix& common);

  std::vector<Prediction> predictions_;
  RowMatrix offsets_;               // columns of the new session's sensor offsets
  std::vector<Quantity> channels_;  // of each row
};

}  // namespace rollrig::diagnosis
