#include "diagnosis/comparison/prepared_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kShortBlock_s = 10.0;  // Assumed: short against the warm-up of a tire, and ten samples at 1 Hz
constexpr double kShortBlocksUpTo_s = 24.0 * 3600.0;  // Assumed: three working days of tests
constexpr double kSlack_s = 1e-6;

/// Whether the surface stands still over a row and its neighbors.
bool stands(const measurements::MeasuredRun& run, std::size_t row) {
  const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
  const std::size_t last = std::min(row + 1, speed_m_s.size() - 1);
  for (std::size_t i = row > 0 ? row - 1 : 0; i <= last; ++i) {
    if (speed_m_s[i] != 0.0) return false;
  }
  return true;
}

/// The phase of each of so many rows.
std::vector<std::size_t> phase_by_row(const std::vector<RunPhase>& phases, std::size_t rows) {
  std::vector<std::size_t> of(rows, 0);
  for (std::size_t p = 0; p < phases.size(); ++p) {
    for (std::size_t row = phases[p].first; row < phases[p].last; ++row) of[row] = p;
  }
  return of;
}

/// Rows at which the surface stands and the force was read, into their places.
void add_standstill_rows(const measurements::MeasuredRun& run, const std::vector<double>& force,
                         std::vector<std::size_t>& rows) {
  for (std::size_t row = 0; row < force.size(); ++row) {
    if (stands(run, row) && !std::isnan(force[row])) rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

double sum_recorded_s(const measurements::MeasurementSet& set) {
  double recorded_s = 0.0;
  for (const measurements::MeasuredRun& run : set.runs) recorded_s += run.time_s.back() - run.time_s.front();
  return recorded_s;
}

/// Blocks of samples of one phase. The last sample of a block is less than `length_s` after the first.
std::vector<Block> make_blocks(const std::vector<std::size_t>& rows, const std::vector<double>& time_s,
                               const std::vector<std::size_t>& phase, double length_s) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = rows[i];
    const bool fits = !blocks.empty() && phase[row] == phase[rows[blocks.back().first]] &&
                      time_s[row] < time_s[rows[blocks.back().first]] + length_s - kSlack_s;
    if (fits) {
      blocks.back().last = i + 1;
    } else {
      blocks.push_back({i, i + 1});
    }
  }
  return blocks;
}

/// Rows at which what a series says begins or ends: those of its blocks, and those of gaps between its samples.
void add_cuts(const Series& series, std::vector<std::size_t>& cuts) {
  const std::vector<std::size_t>& rows = series.rows;
  std::vector<std::size_t> strides;
  for (std::size_t i = 1; i < rows.size(); ++i) strides.push_back(rows[i] - rows[i - 1]);
  std::size_t usual = 1;
  if (!strides.empty()) {
    const auto middle = strides.begin() + static_cast<std::ptrdiff_t>(strides.size() / 2);
    std::nth_element(strides.begin(), middle, strides.end());
    usual = *middle;
  }
  for (const Block& block : series.blocks) {
    cuts.push_back(rows[block.first]);
    cuts.push_back(rows[block.last - 1] + 1);
    for (std::size_t i = block.first + 1; i < block.last; ++i) {
      if (rows[i] - rows[i - 1] <= 2 * usual) continue;
      cuts.push_back(rows[i - 1] + 1);
      cuts.push_back(rows[i]);
    }
  }
}

/// Finds in which rows of the simulation the samples of each block lie.
void find_parts(const std::vector<std::size_t>& row_of, Series& series) {
  for (const Block& block : series.blocks) {
    series.first_parts.push_back(series.parts.size());
    for (std::size_t i = block.first; i < block.last; ++i) {
      const std::size_t row = row_of[series.rows[i]];
      const bool is_new = i == block.first || series.parts.back().row != row;
      if (is_new) series.parts.push_back({row, 0.0});
      series.parts.back().samples += 1.0;
    }
  }
  series.first_parts.push_back(series.parts.size());
}

}  // namespace

double find_least_noise(const Quantity& channel) {
  // Assumed: a millionth of the noise of the usual sensors (assets/sensors); of a speed likewise.
  static const std::map<std::string_view, double> kLeast{
      {"N", 2.5e-7}, {"Nm", 2.5e-7}, {"degC", 1e-7}, {"kPa", 5e-8}, {"km_h", 1e-8}};
  const auto least = kLeast.find(channel.unit_suffix());
  return least != kLeast.end() ? least->second : 0.0;
}

void require_noise(const measurements::MeasurementSet& set, const Quantity& channel) {
  const models::SensorParameters& sensor = set.sensors.at(channel);
  const double rounding_sd = sensor.resolution / std::sqrt(12.0);
  const double noise = std::hypot(sensor.noise_sd, sensor.drift_sd, rounding_sd) / channel.file_unit().factor;
  const double least = find_least_noise(channel);
  const std::string key = "[sensors." + channel.header() + "]";
  if (noise <= 0.0) {
    throw InputError({"a sensor has no noise at all, so that nothing would be within it", set.path, 0, key, "0",
                      "noise_sd, drift_sd or resolution above 0", ""});
  }
  if (noise >= least) return;
  throw InputError({"a sensor has less noise than any that is built, so that nothing would be within it", set.path, 0,
                    key, fmt::format("{:.3g}", noise),
                    fmt::format("noise_sd, drift_sd and resolution such that a sample has a standard deviation of {:g} "
                                "{} or more",
                                least, channel.file_unit().symbol),
                    ""});
}

PreparedSet::PreparedSet(const measurements::MeasurementSet& set, ExtraReadings extra)
    : PreparedSet(std::vector<measurements::MeasurementSet>{set}, std::move(extra)) {}

PreparedSet::PreparedSet(std::vector<measurements::MeasurementSet> sets, ExtraReadings extra)
    : extra_(std::move(extra)), kind_(&kind_of(sets.front())) {
  for (measurements::MeasurementSet& set : sets) {
    std::sort(set.runs.begin(), set.runs.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    for (measurements::MeasuredRun& run : set.runs) kind_->complete(set, run);
    models::Context<double> context = measurements::make_context(set);
    machines_.push_back({std::move(set), std::move(context)});
  }
  double recorded_s = 0.0;
  for (const Machine& machine : machines_) recorded_s += sum_recorded_s(machine.set);
  block_length_s_ = kShortBlock_s * std::max(1.0, recorded_s / kShortBlocksUpTo_s);
  find_channels();
  for (std::size_t machine = 0; machine < machines_.size(); ++machine) {
    for (const measurements::MeasuredRun& run : machines_[machine].set.runs) add_run(machine, run);
  }
  if (series_.empty()) {
    throw InputError(
        {"nothing was measured in any run", source().path, 0, "", "", "samples in one measured channel", ""});
  }
  measured_.resize(to_index(residual_count_));
  for (const Series& series : series_) {
    series.rows_of(measured_) = Eigen::Map<const Eigen::VectorXd>(series.measured.data(), to_index(series.size()));
  }
}

/// Channels with a sample in any run.
void PreparedSet::find_channels() {
  std::vector<Quantity> readable = measurements::measured_channels(*source().kind);
  for (const Quantity& channel : extra_.sensors) {
    if (std::find(readable.begin(), readable.end(), channel) == readable.end()) readable.push_back(channel);
  }
  for (const Quantity& channel : readable) {
    const bool measured = std::any_of(machines_.begin(), machines_.end(), [&](const Machine& machine) {
      return std::any_of(machine.set.runs.begin(), machine.set.runs.end(),
                         [&](const measurements::MeasuredRun& run) { return run.has_samples(channel); });
    });
    if (measured) channels_.push_back(channel);
  }
}

void PreparedSet::add_run(std::size_t machine, const measurements::MeasuredRun& run) {
  const measurements::MeasurementSet& set = source(machine);
  const std::vector<RunPhase> phases = kind_->find_phases(set, run);
  const std::size_t first_series = series_.size();
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    if (!run.has(channels_[channel])) continue;
    const auto [it, fresh] = offsets_.emplace(std::tuple(machine, run.session, channel), offsets_.size());
    add_series(machine, run, phases, {channel, it->second});
  }
  std::vector<std::size_t> cuts;
  for (std::size_t s = first_series; s < series_.size(); ++s) add_cuts(series_[s], cuts);
  measurements::MergedRun simulated = measurements::merge_steady_rows(run, *set.kind, std::move(cuts), block_length_s_);
  for (std::size_t s = first_series; s < series_.size(); ++s) find_parts(simulated.row_of, series_[s]);
  measurements::Resimulation resimulation(simulated.run, *set.kind);
  runs_.push_back({run, std::move(simulated), std::move(resimulation), phases, machine});
}

void PreparedSet::add_series(std::size_t machine, const measurements::MeasuredRun& run,
                             const std::vector<RunPhase>& run_phases, ChannelOfSession of) {
  const Quantity& quantity = channels_[of.channel];
  const measurements::MeasurementSet& set = source(machine);
  const models::SensorParameters& sensor = set.sensors.at(quantity);
  require_noise(set, quantity);
  const std::vector<double>& values = run.column(quantity);
  std::vector<std::size_t> rows = kind_->find_compared_rows(run, quantity);
  const bool reads_zero = extra_.force_at_standstill || run.force_at_standstill;
  if (reads_zero && quantity == set.kind->traits.force) add_standstill_rows(run, values, rows);
  if (rows.empty()) return;
  const std::vector<std::size_t> phases = phase_by_row(run_phases, run.time_s.size());
  std::vector<Block> blocks = make_blocks(rows, run.time_s, phases, block_length_s_);
  const Whitener whitener(sensor, measurements::find_times(run, rows), blocks);
  Series series{
      runs_.size(), of.channel, of.offset, sensor.offset_sd, std::move(rows), std::move(blocks), {}, {}, {}, whitener,
      {},           {},         0.0,       residual_count_};
  std::vector<double> floors;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const Block& block = series.blocks[k];
    series.time_s.push_back(series.mean_over(block, [&](std::size_t row) { return run.time_s[row]; }));
    series.measured.push_back(series.mean_over(block, [&](std::size_t row) { return values[row]; }));
    series.phase.push_back(phases[series.rows[block.first]]);
    floors.push_back(whitener.standard_deviation(k));
  }
  std::nth_element(floors.begin(), floors.begin() + static_cast<std::ptrdiff_t>(floors.size() / 2), floors.end());
  series.floor = floors[floors.size() / 2];
  residual_count_ += series.size();
  series_.push_back(std::move(series));
}

double find_mean_input(const PreparedSet& set, const Series& series, std::size_t block, const Quantity& input) {
  const std::vector<double>& values = set.runs()[series.run].measured.column(input);
  return series.mean_over(series.blocks[block], [&](std::size_t row) { return values[row]; });
}

double sum_squared_floors(const PreparedSet& set, const Eigen::VectorXd& change) {
  double sum = 0.0;
  for (const Series& series : set.series()) {
    sum += series.rows_of(change).squaredNorm() / (series.floor * series.floor);
  }
  return sum;
}

}  // namespace rollrig::diagnosis
