#include "diagnosis/remainder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace rollrig::diagnosis {
namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

constexpr double kScales_s[] = {120.0, 480.0};  // Assumed: shorter is noise, longer is a phase
constexpr double kLevels = 4.0;

/// Triangles of that width, spread evenly over the series' time.
void add_hats(const Series& series, double spacing_s, Eigen::MatrixXd& basis) {
  const double start_s = series.time_s.front();
  const double length_s = series.time_s.back() - start_s;
  const auto intervals = static_cast<Eigen::Index>(std::max(1.0, std::round(length_s / spacing_s)));
  const double step_s = std::max(length_s, 1.0) / static_cast<double>(intervals);
  const Eigen::Index first = basis.cols();
  basis.conservativeResize(Eigen::NoChange, first + intervals + 1);
  basis.rightCols(intervals + 1).setZero();
  for (std::size_t k = 0; k < series.size(); ++k) {
    for (Eigen::Index hat = 0; hat <= intervals; ++hat) {
      const double apart = std::abs(series.time_s[k] - start_s - static_cast<double>(hat) * step_s) / step_s;
      if (apart < 1.0) basis(at(k), first + hat) = 1.0 - apart;
    }
  }
}

void add_phases(const Series& series, Eigen::MatrixXd& basis) {
  const std::size_t phases = 1 + *std::max_element(series.phase.begin(), series.phase.end());
  const Eigen::Index first = basis.cols();
  basis.conservativeResize(Eigen::NoChange, first + at(phases));
  basis.rightCols(at(phases)).setZero();
  for (std::size_t k = 0; k < series.size(); ++k) basis(at(k), first + at(series.phase[k])) = 1.0;
}

Remainder::Basis make_basis(const Series& series) {
  Eigen::MatrixXd columns(at(series.size()), 1);
  columns.setOnes();
  for (const double scale_s : kScales_s) add_hats(series, scale_s, columns);
  add_phases(series, columns);
  RowMatrix whitened = columns * (series.floor / std::sqrt(kLevels));
  series.whitener.apply(whitened.data(), static_cast<std::size_t>(whitened.cols()));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(whitened.transpose() * whitened);
  const Eigen::VectorXd& values = solver.eigenvalues();  // increasing
  constexpr double kNegligible = 1e-9;
  const double largest = values[values.size() - 1];
  const Eigen::Index kept = (values.array() > kNegligible * largest).count();
  Remainder::Basis basis;
  basis.strengths = values.tail(kept);
  basis.directions =
      whitened * solver.eigenvectors().rightCols(kept) * basis.strengths.cwiseSqrt().cwiseInverse().asDiagonal();
  return basis;
}

}  // namespace

Remainder::Remainder(const PreparedSet& set) : set_(set) {
  for (const Series& series : set.series()) bases_.push_back(make_basis(series));
}

template <class Columns>
void Remainder::whiten(const Amplitudes& amplitudes, Columns& columns) const {
  for (std::size_t s = 0; s < bases_.size(); ++s) {
    const Series& series = set_.series()[s];
    const Basis& basis = bases_[s];
    const double square = amplitudes[series.channel] * amplitudes[series.channel];
    const Eigen::VectorXd taken = (1.0 - (1.0 + square * basis.strengths.array()).rsqrt()).matrix();
    auto rows = columns.middleRows(at(series.first_residual), at(series.size()));
    const Eigen::MatrixXd along = basis.directions.transpose() * rows;
    rows -= basis.directions * (taken.asDiagonal() * along);
  }
}

template void Remainder::whiten(const Amplitudes&, RowMatrix&) const;
template void Remainder::whiten(const Amplitudes&, Eigen::VectorXd&) const;

}  // namespace rollrig::diagnosis
