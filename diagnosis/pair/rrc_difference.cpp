#include "diagnosis/pair/rrc_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <boost/math/distributions/students_t.hpp>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t kMachines = 2;

/// The force readings of one run that are taken.
struct TakenReadings {
  const Series* series;
  std::size_t machine;
  double newtons_per_SI;
  std::vector<std::size_t> blocks;
  std::vector<double> load_N;  // of each of these blocks; 0 in skim
  Whitener whitener;           // of them alone
};

/// Blocks of a series in which the surface turns at a constant speed.
std::vector<std::size_t> list_steady_blocks(const measurements::MeasuredRun& run, const Series& series) {
  std::vector<std::size_t> steady;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const Block& block = series.blocks[k];
    bool is_steady = true;
    for (std::size_t i = block.first; i < block.last; ++i) {
      const double acceleration_m_s2 = measurements::find_acceleration(run, series.rows[i]);
      is_steady = is_steady && std::abs(acceleration_m_s2) <= measurements::kSteadyAcceleration_m_s2;
    }
    if (is_steady) steady.push_back(k);
  }
  return steady;
}

/// Of steady blocks those of the last minute of their phase, at least one of each.
std::vector<std::size_t> keep_ends_of_phases(const Series& series, const std::vector<std::size_t>& steady) {
  constexpr double kRead_s = 60.0;  // as a laboratory averages the last minute
  std::map<std::size_t, double> end_s;
  for (const std::size_t k : steady) end_s[series.phase[k]] = series.time_s[k];
  std::vector<std::size_t> kept;
  for (const std::size_t k : steady) {
    if (series.time_s[k] > end_s.at(series.phase[k]) - kRead_s) kept.push_back(k);
  }
  return kept;
}

/// A whitener of some blocks, as if only their samples had been taken.
Whitener make_whitener(const models::SensorParameters& sensor, const measurements::MeasuredRun& run,
                       const Series& series, const std::vector<std::size_t>& taken) {
  std::vector<double> time_s;
  std::vector<Block> blocks;
  for (const std::size_t k : taken) {
    const std::size_t first = time_s.size();
    for (std::size_t i = series.blocks[k].first; i < series.blocks[k].last; ++i) {
      time_s.push_back(run.time_s[series.rows[i]]);
    }
    blocks.push_back({first, time_s.size()});
  }
  return Whitener(sensor, time_s, blocks);
}

std::vector<TakenReadings> take_readings(const PreparedSet& set) {
  std::vector<TakenReadings> taken;
  for (const Series& series : set.series()) {
    const PreparedRun& run = set.runs()[series.run];
    const measurements::MeasurementSet& source = set.source(run.machine);
    const Quantity& force = source.kind->traits.force;
    if (!(set.channels()[series.channel] == force)) continue;
    const std::vector<std::size_t> blocks = keep_ends_of_phases(series, list_steady_blocks(run.measured, series));
    if (blocks.empty()) continue;
    TakenReadings readings{&series, run.machine, set.kind().force_channel(source).newtons_per_SI,
                           blocks,  {},          make_whitener(source.sensors.at(force), run.measured, series, blocks)};
    for (const std::size_t k : blocks) {
      const double load_N = find_mean_input(set, series, k, models::quantities::kLoad);
      readings.load_N.push_back(load_N > set.kind().skim_limit_N(source) ? load_N : 0.0);
    }
    taken.push_back(std::move(readings));
  }
  return taken;
}

/// Least squares for d of each machine and the offsets of sessions.
class RrcLine {
 public:
  explicit RrcLine(const PreparedSet& set) : all_(take_readings(set)) {
    const Eigen::Index unknowns = to_index(kMachines + set.offset_count());
    constexpr double kFree = 1e-12;  // so little that an unknown of which no reading says anything is 0
    normal_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
    normal_.diagonal().setConstant(kFree);
    std::set<std::size_t> with_skim;  // offsets
    for (const TakenReadings& one : all_) {
      for (const double load_N : one.load_N) {
        if (load_N > 0.0) {
          loaded_.insert(one.machine);
        } else {
          with_skim.insert(one.series->offset);
        }
      }
    }
    for (const TakenReadings& one : all_) {
      const double sd = one.series->offset_sd;
      if (with_skim.count(one.series->offset) == 0 && sd > 0.0)
        normal_(at_offset(one), at_offset(one)) = 1.0 / (sd * sd);
    }
  }

  bool is_known() const { return loaded_.size() == kMachines; }

  /// The slope of each machine alone, of forces that are no differences.
  std::array<double, kMachines> find_slopes(const Eigen::VectorXd& forces) const {
    Eigen::MatrixXd normal = normal_;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(normal.rows());
    for (const TakenReadings& one : all_) {
      const Columns design = whiten_design(one);
      normal += design.transpose() * design;
      right += design.transpose() * whiten_readings(one, forces);
    }
    const Eigen::VectorXd unknowns = normal.ldlt().solve(right);
    return {unknowns[0], unknowns[1]};
  }

  rollrig::RrcEstimate estimate(const Eigen::VectorXd& difference) {
    std::vector<Columns> design;
    std::vector<Eigen::VectorXd> readings;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(normal_.rows());
    for (const TakenReadings& one : all_) {
      design.push_back(whiten_design(one));
      readings.push_back(whiten_readings(one, difference));
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
  static Eigen::Index at_offset(const TakenReadings& one) { return to_index(kMachines + one.series->offset); }

  Columns whiten_design(const TakenReadings& one) const {
    Columns columns = Columns::Zero(to_index(one.blocks.size()), normal_.rows());
    for (std::size_t i = 0; i < one.blocks.size(); ++i) {
      columns(to_index(i), to_index(one.machine)) = one.load_N[i] / one.newtons_per_SI;
      columns(to_index(i), at_offset(one)) = 1.0;
    }
    one.whitener.apply(columns.data(), static_cast<std::size_t>(columns.cols()));
    return columns;
  }

  static Eigen::VectorXd whiten_readings(const TakenReadings& one, const Eigen::VectorXd& difference) {
    Eigen::VectorXd readings(to_index(one.blocks.size()));
    for (std::size_t i = 0; i < one.blocks.size(); ++i) {
      readings[to_index(i)] = difference[to_index(one.series->first_residual + one.blocks[i])];
    }
    one.whitener.apply(readings.data(), 1);
    return readings;
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

  std::vector<TakenReadings> all_;
  std::set<std::size_t> loaded_;  // machines
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

double read_rrc_ratio(const PreparedSet& set, const Eigen::VectorXd& simulated) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const RrcLine line(set);
  if (!line.is_known()) return nothing;
  const auto measured = line.find_slopes(set.measured()), expected = line.find_slopes(simulated);
  for (const auto& slopes : {measured, expected}) {
    if (!(slopes[0] > 0.0 && slopes[1] > 0.0)) return nothing;
  }
  return (measured[1] / expected[1]) / (measured[0] / expected[0]);
}

}  // namespace rollrig::diagnosis
