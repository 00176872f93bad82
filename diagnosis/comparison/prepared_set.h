#pragma once
/// A measured set made ready for comparison: runs in a fixed order, blocks of samples, whitening, sensor offsets.

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "diagnosis/comparison/eigen_index.h"
#include "diagnosis/comparison/run_phases.h"
#include "measurements/merged_rows.h"
#include "measurements/resimulation.h"
#include "measurements/whitener.h"
#include "models/ports.h"

namespace rollrig::diagnosis {

class MeasurementKind;

using measurements::Block;
using measurements::Whitener;

/// Samples of a block that lie in one row of the simulation.
struct SimulatedPart {
  std::size_t row = 0;  // of the simulation
  double samples = 0.0;
};

/// One channel of one run.
struct Series {
  std::size_t run = 0;
  std::size_t channel = 0;  // index into PreparedSet::channels
  std::size_t offset = 0;   // index of the sensor offset that it shares with its session
  double offset_sd = 0.0;
  std::vector<std::size_t> rows;   // samples that are compared
  std::vector<Block> blocks;       // of those
  std::vector<double> time_s;      // mean time of each block
  std::vector<std::size_t> phase;  // of each block, index into the run's phases
  std::vector<double> measured;    // block means, SI
  Whitener whitener;
  std::vector<SimulatedPart> parts;      // of all blocks, in order
  std::vector<std::size_t> first_parts;  // of each block, and one past the last part
  double floor = 0.0;                    // noise floor: median of the blocks' standard deviations, without the offset
  std::size_t first_residual = 0;        // index of its first residual

  std::size_t size() const { return blocks.size(); }
  /// The rows of this series in a vector or matrix over all residuals.
  template <class Columns>
  auto rows_of(Columns& columns) const {
    return columns.middleRows(to_index(first_residual), to_index(size()));
  }
  /// Mean over the samples of a block.
  template <class Get>
  auto mean_over(const Block& block, Get&& get) const {
    auto sum = get(rows[block.first]);
    for (std::size_t i = block.first + 1; i < block.last; ++i) sum += get(rows[i]);
    return decltype(sum)(sum / static_cast<double>(block.last - block.first));
  }
  /// Mean over the samples of a block of what a simulation has in its rows.
  template <class S>
  S mean_of_simulated(std::size_t block, const std::vector<S>& simulated) const {
    const SimulatedPart& first = parts[first_parts[block]];
    S sum = first.samples * simulated[first.row];
    for (std::size_t i = first_parts[block] + 1; i < first_parts[block + 1]; ++i) {
      sum += parts[i].samples * simulated[parts[i].row];
    }
    return sum / static_cast<double>(blocks[block].last - blocks[block].first);
  }
};

struct PreparedRun {
  measurements::MeasuredRun measured;
  measurements::MergedRun simulated;  // its rows are those of the simulation
  measurements::Resimulation resimulation;
  std::vector<RunPhase> phases;
  std::size_t machine = 0;  // on which it was measured (PreparedSet::source())
};

/// What a test may read beyond a measurement set's columns.
struct ExtraReadings {
  bool force_at_standstill = false;  // where the surface stands: the sensor's zero
  std::vector<Quantity> sensors;     // channels of sensors that the rig does not have (rig_sensors.h)
};

/// The least standard deviation of a sample that is believed, in the unit of files.
double find_least_noise(const Quantity& channel);

/// Throws InputError where the sensor of a channel has less noise, drift and rounding together than that.
void require_noise(const measurements::MeasurementSet& set, const Quantity& channel);

/// Runs are put in the order of their ids, so that the order in the file does not matter. A block ends at the end of a
/// phase, or before the first sample that is 10 s or more after the first sample of the block. In sets of more than 24
/// recorded hours, blocks are longer in proportion, so that their number hardly grows with the recorded time. The kind
/// of the set (kinds/measurement_kind.h) decides which rows are compared, what the phases are, and how a run is
/// simulated.
/// Several sets of one tire and one kind of machine are joined, each on a machine of its own: their runs come one set
/// after the other, and no two of them share an offset.
/// Errors  InputError: no sample in any channel; a sensor without any noise; what the set's kind needs is not there
class PreparedSet {
 public:
  explicit PreparedSet(const measurements::MeasurementSet& set, ExtraReadings extra = {});
  explicit PreparedSet(std::vector<measurements::MeasurementSet> sets, ExtraReadings extra = {});

  std::size_t machine_count() const { return machines_.size(); }
  /// The set that was measured on a machine.
  const measurements::MeasurementSet& source(std::size_t machine = 0) const { return machines_[machine].set; }
  const ExtraReadings& extra() const { return extra_; }
  const MeasurementKind& kind() const { return *kind_; }
  const models::Context<double>& context(std::size_t machine = 0) const { return machines_[machine].context; }
  const std::vector<PreparedRun>& runs() const { return runs_; }
  const std::vector<Quantity>& channels() const { return channels_; }
  const std::vector<Series>& series() const { return series_; }
  std::size_t offset_count() const { return offsets_.size(); }
  std::size_t residual_count() const { return residual_count_; }
  /// 10 s times the recorded hours / 24, and at least 10 s.
  double block_length_s() const { return block_length_s_; }
  /// Block means of every series, SI units, one for each residual.
  const Eigen::VectorXd& measured() const { return measured_; }

 private:
  struct Machine {
    measurements::MeasurementSet set;  // with its runs in order
    models::Context<double> context;
  };

  void find_channels();
  void add_run(std::size_t machine, const measurements::MeasuredRun& run);
  struct ChannelOfSession {
    std::size_t channel;
    std::size_t offset;
  };
  void add_series(std::size_t machine, const measurements::MeasuredRun& run, const std::vector<RunPhase>& phases,
                  ChannelOfSession of);

  ExtraReadings extra_;
  std::vector<Machine> machines_;
  const MeasurementKind* kind_;
  std::map<std::tuple<std::size_t, std::string, std::size_t>, std::size_t> offsets_;  // by machine, session, channel
  std::vector<PreparedRun> runs_;
  std::vector<Quantity> channels_;
  std::vector<Series> series_;
  double block_length_s_ = 0.0;
  std::size_t residual_count_ = 0;
  Eigen::VectorXd measured_;
};

/// Mean over a block of what the run of a series records as an input.
double find_mean_input(const PreparedSet& set, const Series& series, std::size_t block, const Quantity& input);

/// Sum of the squares of a change of block means, SI units, each in noise floors of its series.
double sum_squared_floors(const PreparedSet& set, const Eigen::VectorXd& change);

}  // namespace rollrig::diagnosis
