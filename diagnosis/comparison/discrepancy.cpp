#include "diagnosis/comparison/discrepancy.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "diagnosis/thresholds.h"
#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

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
      if (apart < 1.0) basis(to_index(k), first + hat) = 1.0 - apart;
    }
  }
}

void add_phases(const Series& series, Eigen::MatrixXd& basis) {
  const std::size_t phases = 1 + *std::max_element(series.phase.begin(), series.phase.end());
  const Eigen::Index first = basis.cols();
  basis.conservativeResize(Eigen::NoChange, first + to_index(phases));
  basis.rightCols(to_index(phases)).setZero();
  for (std::size_t k = 0; k < series.size(); ++k) basis(to_index(k), first + to_index(series.phase[k])) = 1.0;
}

/// The basis of time of a series, in noise floors.
Eigen::MatrixXd make_time_basis(const Series& series) {
  Eigen::MatrixXd columns(to_index(series.size()), 1);
  columns.setOnes();
  for (const double scale_s : thresholds::kDiscrepancyScales_s) add_hats(series, scale_s, columns);
  add_phases(series, columns);
  return columns / std::sqrt(kLevels);
}

/// Triangles between knots, one a knot; beyond the outer knots the outer one goes on.
void put_hats(double x, const std::vector<double>& knots, Eigen::Ref<Eigen::RowVectorXd> row) {
  row.setZero();
  const auto count = static_cast<Eigen::Index>(knots.size());
  const auto upper = std::lower_bound(knots.begin(), knots.end(), x);
  const auto right = static_cast<Eigen::Index>(upper - knots.begin());
  if (right == 0 || right == count) {
    row[right == 0 ? 0 : count - 1] = 1.0;
    return;
  }
  const double left_x = *(upper - 1);
  const double share = (x - left_x) / (*upper - left_x);
  row[right - 1] = 1.0 - share;
  row[right] = share;
}

/// When the load of a run last changed, by row.
std::vector<double> find_time_since_load_change(const PreparedRun& run) {
  const std::vector<double>& time_s = run.measured.time_s;
  std::vector<double> since_s(time_s.size(), 0.0);
  double changed_s = time_s.front();
  for (std::size_t row = 1; row < time_s.size(); ++row) {
    if (measurements::is_load_change(run.measured, row)) changed_s = time_s[row];
    since_s[row] = time_s[row] - changed_s;
  }
  return since_s;
}

/// The basis of conditions of a series, in noise floors: a function of each condition with the same variance.
Eigen::MatrixXd make_condition_basis(const PreparedSet& set, const Series& series) {
  static const std::vector<double> kSpeeds_km_h{0.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0};
  static const std::vector<double> kLoadShares{0.0, 0.05, 0.4, 0.7, 1.0, 1.3, 1.6};
  static const std::vector<double> kTimes_s{0.0, 120.0, 300.0, 600.0, 1200.0, 2400.0, 4800.0};
  static const std::vector<double> kSinceLoad_s{0.0, 60.0, 180.0, 600.0, 1800.0};
  constexpr Eigen::Index kSingles = 5;  // constant, speed times load, acceleration, pressure, start temperature
  constexpr double kConditions = 9.0;
  const auto sizes = {kSpeeds_km_h.size(), kLoadShares.size(), kTimes_s.size(), kSinceLoad_s.size()};
  Eigen::Index columns = kSingles;
  for (const std::size_t size : sizes) columns += to_index(size);
  const PreparedRun& run = set.runs()[series.run];
  const std::vector<double> since_load_s = find_time_since_load_change(run);
  const auto& tire = set.context().tire.rolling_resistance;
  Eigen::MatrixXd basis(to_index(series.size()), columns);
  for (std::size_t k = 0; k < series.size(); ++k) {
    const auto mean = [&](const std::vector<double>& values) {
      return series.mean_over(series.blocks[k], [&](std::size_t row) { return values[row]; });
    };
    const double speed_km_h = 3.6 * mean(run.measured.column(models::quantities::kSpeed));
    const double load_share = mean(run.measured.column(models::quantities::kLoad)) / tire.reference_load_N;
    const double acceleration_m_s2 = series.mean_over(
        series.blocks[k], [&](std::size_t r) { return measurements::find_acceleration(run.measured, r); });
    Eigen::RowVectorXd row(columns);
    Eigen::Index at_column = 0;
    const auto put = [&](double x, const std::vector<double>& knots) {
      put_hats(x, knots, row.segment(at_column, to_index(knots.size())));
      at_column += to_index(knots.size());
    };
    put(speed_km_h, kSpeeds_km_h);
    put(load_share, kLoadShares);
    put(series.time_s[k] - run.measured.time_s.front(), kTimes_s);
    put(mean(since_load_s), kSinceLoad_s);
    row.tail(kSingles) << 1.0, load_share * speed_km_h / 80.0, acceleration_m_s2 / 0.5,
        (run.measured.cold_pressure_Pa - tire.reference_pressure_Pa) / 5e4,
        (run.measured.initial_tire_temperature_K - run.measured.column(models::quantities::kAmbient).front()) / 10.0;
    basis.row(to_index(k)) = row;
  }
  return basis / std::sqrt(kConditions);
}

/// The unit of what all machines share in a channel, in SI units of one series: as a force at the surface or a
/// temperature, it is the noise floor of the channel's first series.
double find_shared_floor(const PreparedSet& set, const Series& series) {
  const auto force_per_SI = [&](const Series& of) {
    const measurements::MeasurementSet& source = set.source(set.runs()[of.run].machine);
    const bool is_force = set.channels()[of.channel] == source.kind->traits.force;
    return is_force ? set.kind().force_channel(source).newtons_per_SI : 1.0;
  };
  const auto first = std::find_if(set.series().begin(), set.series().end(),
                                  [&](const Series& one) { return one.channel == series.channel; });
  return first->floor * force_per_SI(*first) / force_per_SI(series);
}

/// Sensor noise taken out: columns in units of `floor` become whitened ones.
RowMatrix whiten_basis(const Series& series, const Eigen::MatrixXd& columns, double floor) {
  RowMatrix whitened = columns * floor;
  series.whitener.apply(whitened.data(), static_cast<std::size_t>(whitened.cols()));
  return whitened;
}

/// What Sigma^-1/2 takes from each direction of a basis, as a share.
Eigen::VectorXd calc_taken_of(const Discrepancy::Basis& basis, const Amplitudes& amplitudes) {
  const double square = amplitudes[basis.channel] * amplitudes[basis.channel];
  return (1.0 - (1.0 + square * basis.strengths.array()).rsqrt()).matrix();
}

}  // namespace

Discrepancy::Discrepancy(const PreparedSet& set) : set_(set) {
  for (std::size_t s = 0; s < set.series().size(); ++s) {
    const Series& series = set.series()[s];
    add_basis(series.channel, {s}, whiten_basis(series, make_time_basis(series), series.floor));
  }
}

Discrepancy::Discrepancy(const Discrepancy& of_time, const Amplitudes& amplitudes, Owner owner)
    : set_(of_time.set_), below_(&of_time), below_amplitudes_(amplitudes) {
  std::vector<RowMatrix> of_series;
  for (const Series& series : set_.series()) {
    const double floor = owner == Owner::kTire ? find_shared_floor(set_, series) : series.floor;
    of_series.push_back(whiten_basis(series, make_condition_basis(set_, series), floor));
  }
  RowMatrix all(to_index(set_.residual_count()), of_series.front().cols());
  for (std::size_t s = 0; s < of_series.size(); ++s) {
    all.middleRows(to_index(set_.series()[s].first_residual), of_series[s].rows()) = of_series[s];
  }
  below_->whiten(below_amplitudes_, all);
  const std::size_t owners = owner == Owner::kTire ? 1 : set_.machine_count();
  for (std::size_t i = 0; i < owners * set_.channels().size(); ++i) {
    const std::size_t channel = i / owners;
    Basis rows;
    for (std::size_t s = 0; s < set_.series().size(); ++s) {
      const bool is_owned = owners == 1 || set_.runs()[set_.series()[s].run].machine == i % owners;
      if (set_.series()[s].channel == channel && is_owned) rows.series.push_back(s);
    }
    if (!rows.series.empty()) add_basis(channel, rows.series, gather(rows, all));
  }
}

void Discrepancy::add_basis(std::size_t channel, std::vector<std::size_t> series, const Eigen::MatrixXd& whitened) {
  // Of the two matrices with these strengths the smaller one: a few samples over a long time touch few of many hats.
  const bool is_wide = whitened.cols() > whitened.rows();
  Eigen::MatrixXd square;
  if (is_wide) {
    square = whitened * whitened.transpose();
  } else {
    square = whitened.transpose() * whitened;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(square);
  const Eigen::VectorXd& values = solver.eigenvalues();  // increasing
  constexpr double kNegligible = 1e-9;
  const double largest = values[values.size() - 1];
  const Eigen::Index kept = (values.array() > kNegligible * largest).count();
  Basis basis{channel, std::move(series), solver.eigenvectors().rightCols(kept), values.tail(kept)};
  if (!is_wide) {
    basis.directions = whitened * basis.directions * basis.strengths.cwiseSqrt().cwiseInverse().asDiagonal();
  }
  bases_.push_back(std::move(basis));
}

template <class Columns>
Eigen::MatrixXd Discrepancy::gather(const Basis& basis, const Columns& columns) const {
  Eigen::Index rows = 0;
  for (const std::size_t s : basis.series) rows += to_index(set_.series()[s].size());
  Eigen::MatrixXd gathered(rows, columns.cols());
  Eigen::Index next = 0;
  for (const std::size_t s : basis.series) {
    const Series& series = set_.series()[s];
    gathered.middleRows(next, to_index(series.size())) = series.rows_of(columns);
    next += to_index(series.size());
  }
  return gathered;
}

void Discrepancy::whiten_series(const Amplitudes& amplitudes, std::size_t series, RowMatrix& columns) const {
  set_.series()[series].whitener.apply(columns.data(), static_cast<std::size_t>(columns.cols()));
  const Basis& basis = bases_[series];  // of time: one each
  const Eigen::VectorXd taken = calc_taken_of(basis, amplitudes);
  const Eigen::MatrixXd along = basis.directions.transpose() * columns;
  columns -= basis.directions * (taken.asDiagonal() * along);
}

template <class Columns>
void Discrepancy::whiten(const Amplitudes& amplitudes, Columns& columns) const {
  for (const Basis& basis : bases_) {
    const Eigen::VectorXd taken = calc_taken_of(basis, amplitudes);
    const Eigen::MatrixXd along = basis.directions.transpose() * gather(basis, columns);
    const Eigen::MatrixXd change = basis.directions * (taken.asDiagonal() * along);
    Eigen::Index next = 0;
    for (const std::size_t s : basis.series) {
      const Series& series = set_.series()[s];
      series.rows_of(columns) -= change.middleRows(next, to_index(series.size()));
      next += to_index(series.size());
    }
  }
}

template <class Columns>
void Discrepancy::whiten_below(Columns& columns) const {
  if (below_ != nullptr) below_->whiten(below_amplitudes_, columns);
}

Eigen::VectorXd Discrepancy::calc_taken(const Amplitudes& amplitudes, std::size_t series) const {
  return calc_taken_of(bases_[series], amplitudes);  // of time: one each
}

double Discrepancy::calc_log_determinant(const Amplitudes& amplitudes, std::size_t series) const {
  const Basis& basis = bases_[series];  // of time: one each
  const double square = amplitudes[basis.channel] * amplitudes[basis.channel];
  return (1.0 + square * basis.strengths.array()).log().sum();
}

double Discrepancy::log_determinant_below() const {
  double sum = 0.0;
  if (below_ == nullptr) return sum;
  for (std::size_t s = 0; s < below_->bases().size(); ++s) sum += below_->calc_log_determinant(below_amplitudes_, s);
  return sum;
}

template Eigen::MatrixXd Discrepancy::gather(const Basis&, const RowMatrix&) const;
template Eigen::MatrixXd Discrepancy::gather(const Basis&, const Eigen::VectorXd&) const;
template void Discrepancy::whiten(const Amplitudes&, RowMatrix&) const;
template void Discrepancy::whiten(const Amplitudes&, Eigen::VectorXd&) const;
template void Discrepancy::whiten_below(RowMatrix&) const;
template void Discrepancy::whiten_below(Eigen::VectorXd&) const;

}  // namespace rollrig::diagnosis
