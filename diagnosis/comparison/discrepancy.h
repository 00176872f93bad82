#pragma once
/// What no named effect explains: flexible functions in every channel, of time in each run or of the conditions.

#include <vector>

#include "diagnosis/comparison/model.h"

namespace rollrig::diagnosis {

/// Size of the discrepancy by channel, in noise floors (standard deviation of a block's mean).
using Amplitudes = std::vector<double>;

/// A normal process in every channel, of one of two kinds.
///
/// Of time: in every run by itself hats of 120 s and of 480 s, a constant in each phase, a constant in the run, each
/// with a quarter of the variance. It stands for model error, small under every hypothesis, and free for an effect that
/// follows nothing recorded.
/// Of conditions: the same in all runs, a sum of functions of speed, of load, of speed times load, of the time in the
/// run, of the time since the load changed, of acceleration, pressure and start temperature: an unknown effect that
/// repeats. It stands on top of a small discrepancy of time. Of joined sets each machine has its own functions, or all
/// machines share them: what the one tire does that its law does not say.
///
/// Equation  covariance of the whitened residual  Sigma = 1 + a^2 B B^T, B the whitened basis in noise floors; with
///           B = U s V^T: Sigma^-1 = 1 - U diag(a^2 s^2/(1 + a^2 s^2)) U^T, |Sigma| = prod (1 + a^2 s^2)
/// Checked   tests/diagnosis/discrepancy_test.cpp
class Discrepancy {
 public:
  /// Of time.
  explicit Discrepancy(const PreparedSet& set);
  /// Whose functions of conditions.
  enum class Owner { kMachine, kTire };
  /// Of conditions, on top of a discrepancy of time of given size.
  Discrepancy(const Discrepancy& of_time, const Amplitudes& amplitudes, Owner owner = Owner::kMachine);

  /// A part of the data in which the process is one: U and s^2, over the blocks of these series, one after the other.
  struct Basis {
    std::size_t channel = 0;
    std::vector<std::size_t> series;
    Eigen::MatrixXd directions;
    Eigen::VectorXd strengths;
  };
  const std::vector<Basis>& bases() const { return bases_; }
  const PreparedSet& set() const { return set_; }

  /// Rows of a basis's series, out of columns over the whole set.
  template <class Columns>
  Eigen::MatrixXd gather(const Basis& basis, const Columns& columns) const;

  /// Multiplies whitened columns by Sigma^-1/2, in place; what it stands on is not in it.
  template <class Columns>
  void whiten(const Amplitudes& amplitudes, Columns& columns) const;

  /// Of a discrepancy of time: whitens columns over the blocks of one series, in SI units, by its sensor and by
  /// Sigma^-1/2, in place.
  void whiten_series(const Amplitudes& amplitudes, std::size_t series, RowMatrix& columns) const;

  /// Of a discrepancy of time: what Sigma^-1/2 takes from each direction of one series, as a share.
  Eigen::VectorXd calc_taken(const Amplitudes& amplitudes, std::size_t series) const;

  /// Of a discrepancy of time: ln |Sigma| over the blocks of one series, sensor noise taken out.
  double calc_log_determinant(const Amplitudes& amplitudes, std::size_t series) const;

  /// Sigma^-1/2 of the discrepancy that this one stands on, and log |Sigma| of it; without one, nothing and 0.
  template <class Columns>
  void whiten_below(Columns& columns) const;
  double log_determinant_below() const;

 private:
  void add_basis(std::size_t channel, std::vector<std::size_t> series, const Eigen::MatrixXd& whitened);

  const PreparedSet& set_;
  const Discrepancy* below_ = nullptr;
  Amplitudes below_amplitudes_;
  std::vector<Basis> bases_;
};

}  // namespace rollrig::diagnosis
