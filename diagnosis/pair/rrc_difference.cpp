#include "diagnosis/pair/rrc_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <boost/math/distributions/students_t.hpp>

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The force readings of one run.
struct ForceSeries {
  const Series* series = nullptr;
  std::size_t machine = 0;
  double newtons_per_SI = 1.0;
  std::vector<double> load_N;       // of each block
  std::vector<bool> is_in_skim;     // likewise
  std::vector<std::size_t> uneven;  // blocks in which the speed changes
};

/// Blocks next to which the mean speed changes.
std::vector<std::size_t> find_uneven_blocks(const PreparedSet& set, const Series& series) {
  constexpr double kSteady_m_s2 = 0.02;  // Assumed: above the noise of speeds, below any change of speed
  std::vector<double> speed_m_s;
  for (std::size_t k = 0; k < series.size(); ++k) {
    speed_m_s.push_back(find_mean_input(set, series, k, models::quantities::kSpeed));
  }
  std::vector<std::size_t> uneven;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = std::min(k + 1, series.size() - 1);
    const double time_s = series.time_s[after] - series.time_s[before];
    if (time_s > 0.0 && std::abs(speed_m_s[after] - speed_m_s[before]) > kSteady_m_s2 * time_s) uneven.push_back(k);
  }
  return uneven;
}

std::vector<ForceSeries> find_force_series(const PreparedSet& set) {
  std::vector<ForceSeries> found;
  for (const Series& series : set.series()) {
    const std::size_t machine = set.runs()[series.run].machine;
    const measurements::MeasurementSet& source = set.source(machine);
    if (!(set.channels()[series.channel] == source.kind->traits.force)) continue;
    ForceSeries force{&series, machine, set.kind().force_channel(source).newtons_per_SI, {}, {}, {}};
    for (std::size_t k = 0; k < series.size(); ++k) {
      force.load_N.push_back(find_mean_input(set, series, k, models::quantities::kLoad));
      force.is_in_skim.push_back(force.load_N.back() <= set.kind().skim_limit_N(source));
    }
    force.uneven = find_uneven_blocks(set, series);
    found.push_back(std::move(force));
  }
  return found;
}

/// Unknowns of the least squares: d of each machine, offsets of sessions, and one for each uneven block, which takes
/// the block out without disturbing the drift between its neighbors.
class RrcLine {
 public:
  explicit RrcLine(const PreparedSet& set) : all_(find_force_series(set)) {
    std::size_t unknowns = kMachines + set.offset_count();
    for (const ForceSeries& one : all_) {
      first_uneven_.push_back(unknowns);
      unknowns += one.uneven.size();
      for (std::size_t k = 0; k < one.load_N.size(); ++k) {
        if (one.is_in_skim[k]) {
          with_skim_.insert(one.series->offset);
        } else {
          loaded_.insert(one.machine);
        }
      }
    }
    normal_ = Eigen::MatrixXd::Zero(to_index(unknowns), to_index(unknowns));
    constexpr double kFree = 1e-12;  // so little that unknowns of which no block says anything are 0
    normal_.diagonal().setConstant(kFree);
    for (const ForceSeries& one : all_) {
      const double sd = one.series->offset_sd;
      const bool has_skim = with_skim_.count(one.series->offset) > 0;
      if (!has_skim && sd > 0.0) normal_(at_offset(one), at_offset(one)) = 1.0 / (sd * sd);
    }
  }

  bool is_known() const { return loaded_.size() == kMachines; }

  rollrig::RrcEstimate estimate(const Eigen::VectorXd& difference) {
    std::vector<Columns> design;
    std::vector<Eigen::VectorXd> readings;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(normal_.rows());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      design.push_back(whiten_design(i));
      readings.emplace_back(all_[i].series->rows_of(difference));
      all_[i].series->whitener.apply(readings.back().data(), 1);
      normal_ += design.back().transpose() * design.back();
      right += design.back().transpose() * readings.back();
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal_);
    const Eigen::VectorXd unknowns = solver.solve(right);
    Eigen::VectorXd contrast = Eigen::VectorXd::Zero(normal_.rows());
    contrast[0] = 1.0;
    contrast[1] = -1.0;
    const Eigen::VectorXd along = solver.solve(contrast);
    double scatter = 0.0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const double score = along.dot(design[i].transpose() * (readings[i] - design[i] * unknowns));
      scatter += score * score;
    }
    return make_estimate(contrast.dot(unknowns), std::sqrt(contrast.dot(along)), scatter);
  }

 private:
  static constexpr std::size_t kMachines = 2;

  static Eigen::Index at_offset(const ForceSeries& one) { return to_index(kMachines + one.series->offset); }

  Columns whiten_design(std::size_t i) const {
    const ForceSeries& one = all_[i];
    Columns columns = Columns::Zero(to_index(one.load_N.size()), normal_.rows());
    for (std::size_t k = 0; k < one.load_N.size(); ++k) {
      columns(to_index(k), to_index(one.machine)) = one.load_N[k] / one.newtons_per_SI;
      columns(to_index(k), at_offset(one)) = 1.0;
    }
    for (std::size_t j = 0; j < one.uneven.size(); ++j) {
      columns(to_index(one.uneven[j]), to_index(first_uneven_[i] + j)) = 1.0;
    }
    one.series->whitener.apply(columns.data(), static_cast<std::size_t>(columns.cols()));
    return columns;
  }

  rollrig::RrcEstimate make_estimate(double value, double noise_sd, double scatter) const {
    constexpr double kTwoSided95 = 0.975;
    constexpr double kNormal95 = 1.959964;
    constexpr double kPerKilo = 1e3;  // N/N to N/kN
    double half = kNormal95 * noise_sd;
    if (all_.size() > kMachines) {
      const double freedom = static_cast<double>(all_.size() - kMachines);
      const double sd = std::sqrt(scatter * static_cast<double>(all_.size()) / freedom);
      half = std::max(half, sd * boost::math::quantile(boost::math::students_t(freedom), kTwoSided95));
    }
    return {kPerKilo * value, kPerKilo * (value - half), kPerKilo * (value + half)};
  }

  std::vector<ForceSeries> all_;
  std::vector<std::size_t> first_uneven_;  // place of the unknown of the first uneven block of each series
  std::set<std::size_t> with_skim_;        // offsets
  std::set<std::size_t> loaded_;           // machines
  Eigen::MatrixXd normal_;
};

}  // namespace

rollrig::RrcEstimate read_rrc_difference(const PreparedSet& set, const Eigen::VectorXd& simulated) {
  RrcLine line(set);
  if (!line.is_known()) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    return {nothing, nothing, nothing};
  }
  return line.estimate(set.measured() - simulated);
}

}  // namespace rollrig::diagnosis
