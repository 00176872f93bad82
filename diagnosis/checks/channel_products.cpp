#include "diagnosis/checks/channel_products.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/checks/mistake_unknowns.h"
#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"
#include "measurements/whitener.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

using Values = std::vector<double>;

/// Blocks of the samples at these times: each of its own on the road, where every change of speed tells; else of 20 s,
/// or shorter in a run of less than ten minutes, whose times may be in minutes.
std::vector<measurements::Block> make_averages(const MeasurementSet& set, const Values& times_s) {
  constexpr double kAverage_s = 20.0;
  constexpr double kFewest = 30.0;
  std::vector<measurements::Block> blocks;
  const double usual_s = std::min(kAverage_s, (times_s.back() - times_s.front()) / kFewest);
  const double length_s = models::is_on_road(set.kind->traits) ? 0.0 : usual_s;
  for (std::size_t first = 0, last = 0; first < times_s.size(); first = last) {
    for (last = first + 1; last < times_s.size() && times_s[last] - times_s[first] < length_s;) ++last;
    blocks.push_back({first, last});
  }
  return blocks;
}

/// The rows without those that stand far out: a spike tells nothing of units and columns.
std::vector<std::size_t> drop_spikes(const Values& measured, const Values& simulated, double noise_sd,
                                     std::vector<std::size_t> rows) {
  constexpr double kFar = 10.0;  // Assumed: times the noise, and the deviation that kUsual of the rows do not exceed
  constexpr double kUsual = 0.95;
  Values deviations;
  for (const std::size_t row : rows) deviations.push_back(std::abs(measured[row] - simulated[row]));
  const auto usual = deviations.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(rows.size() - 1));
  std::nth_element(deviations.begin(), usual, deviations.end());
  const double limit = kFar * std::max(*usual, noise_sd);
  const auto is_far = [&](std::size_t row) { return std::abs(measured[row] - simulated[row]) > limit; };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_far), rows.end());
  return rows;
}

ChannelProducts calc_channel_products(const MeasurementSet& set, const MeasuredRun& run, const Quantity& channel,
                                      const Values& simulated, const std::vector<std::size_t>& rows,
                                      const Values& times_of_file_s) {
  const Unknowns unknowns = list_unknowns(set, run, channel, simulated);
  std::vector<const Values*> parts;
  for (const Values& part : unknowns.scaled) parts.push_back(&part);
  for (const Values& part : unknowns.fixed) parts.push_back(&part);
  const Values& measured = run.column(channel);
  const Values times_s = measurements::find_times(run, rows);
  const std::vector<measurements::Block> blocks = make_averages(set, times_of_file_s);
  const models::SensorParameters& sensor = set.sensors.at(channel);
  const std::size_t columns = parts.size() + 2;
  Values values(blocks.size() * columns, 0.0);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto samples = static_cast<double>(blocks[k].last - blocks[k].first);
    double* of_block = values.data() + k * columns;
    for (std::size_t i = blocks[k].first; i < blocks[k].last; ++i) {
      of_block[0] += (measured[rows[i]] - simulated[rows[i]]) / samples;
      for (std::size_t c = 0; c < parts.size(); ++c) of_block[c + 1] += (*parts[c])[rows[i]] / samples;
    }
    of_block[columns - 1] = sensor.offset_sd;
  }
  measurements::Whitener(sensor, times_s, blocks).apply(values.data(), columns);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(values.data(), static_cast<Eigen::Index>(blocks.size()),
                                       static_cast<Eigen::Index>(columns));
  const auto whitened = all.rightCols(static_cast<Eigen::Index>(columns) - 1);
  return {static_cast<double>(blocks.size()), all.col(0).squaredNorm(), whitened.transpose() * all.col(0),
          whitened.transpose() * whitened, static_cast<Eigen::Index>(unknowns.scaled.size())};
}

}  // namespace

ComparedRows choose_rows(const MeasurementSet& set, const MeasuredRun& run) {
  constexpr double kSlow = 0.2;  // Assumed: of the highest speed; about 20 km/h in town, in whatever unit
  const bool is_driven = models::is_of_vehicle(set.kind->traits);
  const Values& speed_m_s = run.column(quantities::kSpeed);
  const double slow_m_s = kSlow * *std::max_element(speed_m_s.begin(), speed_m_s.end());
  ComparedRows chosen;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    if (!run.has(channel)) continue;
    const bool is_force = channel == set.kind->traits.force;
    const Values& measured = run.column(channel);
    std::vector<std::size_t> samples;
    for (std::size_t row = 0; row < measured.size(); ++row) {
      const bool is_slow = is_driven && is_force && speed_m_s[row] < slow_m_s;
      if (!std::isnan(measured[row]) && !is_slow) samples.push_back(row);
    }
    std::vector<std::size_t> compared = find_compared_rows(set, run, channel);
    const bool all = is_driven || 2 * compared.size() < samples.size();
    chosen[channel] = all ? std::move(samples) : std::move(compared);
  }
  return chosen;
}

RunProducts calc_products(const MeasurementSet& set, const MeasuredRun& run, const sim::Recording<double>& simulated,
                          const ComparedRows& rows, const Values& times_s) {
  RunProducts products;
  for (const Quantity& channel : measurements::measured_channels(*set.kind)) {
    products.emplace_back();
    if (!run.has(channel) || rows.count(channel) == 0) continue;
    const Values& measured = run.column(channel);
    std::vector<std::size_t> there;  // an exchanged column may have no samples in some of the rows
    for (const std::size_t row : rows.at(channel)) {
      if (!std::isnan(measured[row])) there.push_back(row);
    }
    if (there.empty()) continue;
    const Values& expected = simulated.channel(channel);
    there = drop_spikes(measured, expected, set.sensors.at(channel).noise_sd, std::move(there));
    Values times_of_file_s;
    for (const std::size_t row : there) times_of_file_s.push_back(times_s[row]);
    products.back() = calc_channel_products(set, run, channel, expected, there, times_of_file_s);
  }
  return products;
}

}  // namespace rollrig::diagnosis
