#pragma once
/// What a hypothesis says of a run, or of a stretch of a run, that its fit did not see.

#include <optional>

#include "diagnosis/study.h"

namespace rollrig::diagnosis {

/// What is left out of a fit: a run, or one phase of it.
struct LeftOutPart {
  std::size_t run = 0;  // past the last: nothing
  std::optional<std::size_t> phase = std::nullopt;
};

/// What a hypothesis, fitted without a part, says.
struct Prediction {
  Eigen::VectorXd simulated;  // of every run, or of the one that holds the part; empty where it cannot be simulated
  Eigen::VectorXd unknowns;   // of the fit without the part
  double uncertainty = 0.0;   // of the part left out: sum of the squares of its standard deviations, whitened
};

/// Predicts parts of the data by the other parts. Sensor offsets of a run left out are taken off anew, those of a
/// stretch are predicted: one step of Gauss and Newton within bounds from the fit to all runs,
/// whose derivatives are known; the prediction is simulated.
/// Equation  minimum of |r + J (u - u_0)|^2 + |u|^2 over all rows but those left out
/// Bounds    own parameters within their ranges, base parameters within 0.9 of their value (Assumed)
/// Symbols   r whitened residuals of the fit to all runs at its unknowns u_0, J their derivatives, u in prior units
/// Validity  the noise of a phase depends on that of its neighbors. What a phase says by itself is therefore the
///           projection of r and J on the columns Sigma^-1/2 E, E the unit vectors of its blocks: generalized least
///           squares without these blocks, exactly
/// Checked   tests/diagnosis/gap_test.cpp, tests/diagnosis/held_out_test.cpp
class LeaveOut {
 public:
  LeaveOut(const Study& study, const Candidate& candidate);

  /// Simulates all runs, or only that of the part.
  enum class Simulated { kAll, kOfPart };
  Prediction predict_without(const LeftOutPart& part, Simulated simulated = Simulated::kAll) const;

  /// How likely the hypothesis, fitted without a part, makes what was measured in the part: the logarithm of a density,
  /// up to a number that is the same for all hypotheses.
  /// Equation  -(e^T S^-1 e + ln |S|)/2 + ln |W|;  e = r + J (u - u_0), S = 1 + J C^-1 J^T
  /// Symbols   r, J of the part, whitened by W; u the unknowns of the fit without the part, C^-1 their covariance
  double calc_log_likelihood(const LeftOutPart& part) const;
  /// Likewise of some base parameters as the files state them, predicted by the runs and the other numbers of the
  /// files.
  double calc_log_likelihood_of_files(const std::vector<std::size_t>& base) const;
  /// Base parameters that the runs determine better than the files do: only of these the files can be left out.
  std::vector<std::size_t> list_determined() const;

  /// How clearly a part shows a difference of block means in SI units: sum of squares, whitened as the uncertainty of a
  /// prediction is; of a run, without what its offsets take.
  double measure(const LeftOutPart& part, Eigen::VectorXd difference) const;

 private:
  /// Of whitened columns what a part has that does not follow from the other parts, in independent rows.
  RowMatrix find_own(const LeftOutPart& part, const RowMatrix& columns) const {
    return find_own_rows(part, columns).rows;
  }
  struct OwnRows {
    RowMatrix rows;
    double log_scale = 0.0;  // ln of the determinant by which block means in SI units become these rows; sensor noise
                             // alone is left out where the part is a run
  };
  OwnRows find_own_rows(const LeftOutPart& part, const RowMatrix& columns) const;
  /// Of independent rows with unit noise, predicted by all that is not in them.
  double calc_log_density(const RowMatrix& jacobian, const Eigen::VectorXd& residuals) const;
  /// Of the rows of a run what its offsets leave at their best.
  void take_off_offsets(std::size_t run, RowMatrix& own) const;

  const Study& study_;
  const Candidate& candidate_;
  Model model_;
  RowMatrix with_residuals_;  // derivatives and residuals, whitened by sensors and discrepancy
  Eigen::MatrixXd curvature_;
  Eigen::VectorXd gradient_;
};

}  // namespace rollrig::diagnosis
