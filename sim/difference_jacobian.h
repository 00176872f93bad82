#pragma once
/// How the rates of a system change with its states, by differences.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rollrig::sim {

/// A Jacobian by forward differences, column by column. States on which no rate depended, as the angle of a wheel, are
/// changed all at once from then on: one evaluation shows whether that is still so.
///
/// Equation  J_ij = (f_i(y + d_j e_j) - f_i(y))/d_j, d_j = max(sqrt(eps) |y_j|, 0.1 atol_j)
/// Symbols   f rates of the states, atol_j the absolute tolerance of a state, eps the rounding of a double
/// Shapes    n states; the matrix is stored column by column
/// Checked   tests/sim/difference_jacobian_test.cpp
class DifferenceJacobian {
 public:
  explicit DifferenceJacobian(std::vector<double> tolerances)
      : tolerances_(std::move(tolerances)),
        is_inert_(tolerances_.size(), false),
        changed_(tolerances_.size()),
        rates_(tolerances_.size()) {}

  /// `evaluate(y, rates)` fills the rates at y; `rates` are those at `y`; `jacobian` has n x n entries.
  template <class Evaluate>
  void fill(const double* y, const double* rates, double* jacobian, Evaluate&& evaluate) {
    if (!are_inert(y, rates, evaluate)) is_inert_.assign(is_inert_.size(), false);
    for (std::size_t j = 0; j < is_inert_.size(); ++j) {
      double* column = jacobian + j * is_inert_.size();
      if (is_inert_[j]) {
        std::fill(column, column + is_inert_.size(), 0.0);
      } else {
        fill_column(j, y, rates, column, evaluate);
      }
    }
  }

 private:
  template <class Evaluate>
  bool are_inert(const double* y, const double* rates, Evaluate&& evaluate) {
    if (std::none_of(is_inert_.begin(), is_inert_.end(), [](bool inert) { return inert; })) return true;
    std::copy(y, y + changed_.size(), changed_.begin());
    for (std::size_t j = 0; j < is_inert_.size(); ++j) {
      if (is_inert_[j]) changed_[j] += find_increment(j, y[j]);
    }
    evaluate(changed_.data(), rates_.data());
    return std::equal(rates_.begin(), rates_.end(), rates);
  }

  template <class Evaluate>
  void fill_column(std::size_t j, const double* y, const double* rates, double* column, Evaluate&& evaluate) {
    std::copy(y, y + changed_.size(), changed_.begin());
    changed_[j] += find_increment(j, y[j]);
    evaluate(changed_.data(), rates_.data());
    bool is_zero = true;
    for (std::size_t i = 0; i < rates_.size(); ++i) {
      column[i] = (rates_[i] - rates[i]) / (changed_[j] - y[j]);
      is_zero = is_zero && column[i] == 0.0;
    }
    is_inert_[j] = is_zero;
  }

  double find_increment(std::size_t j, double y) const {
    return std::max(std::sqrt(std::numeric_limits<double>::epsilon()) * std::abs(y), 0.1 * tolerances_[j]);
  }

  std::vector<double> tolerances_;
  std::vector<bool> is_inert_;
  std::vector<double> changed_, rates_;
};

}  // namespace rollrig::sim
