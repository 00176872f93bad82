#include "diagnosis/findings/gap_measure.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/report_unit.h"

namespace rollrig::diagnosis {
namespace {

/// The offset that fits the differences of a series best, with the prior of its sensor.
struct OffsetFit {
  double offset = 0.0;           // SI
  double offset_variance = 0.0;  // of the estimate
};

OffsetFit fit_offset(const Series& series, const Eigen::VectorXd& difference) {
  std::vector<double> whitened(series.size());
  std::vector<double> ones(series.size(), 1.0);
  for (std::size_t k = 0; k < series.size(); ++k) whitened[k] = difference[to_index(series.first_residual + k)];
  series.whitener.apply(whitened.data(), 1);
  series.whitener.apply(ones.data(), 1);
  double along = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    along += ones[k] * whitened[k];
    square += ones[k] * ones[k];
  }
  const double prior = series.offset_sd > 0.0 ? 1.0 / (series.offset_sd * series.offset_sd) : 1e300;
  const double offset = along / (square + prior);
  return {offset, 1.0 / (square + prior)};
}

}  // namespace

void StretchSquares::add(const StretchSquares& other) {
  above += other.above;
  blocks += other.blocks;
}

double StretchSquares::gap() const { return blocks > 0.0 ? std::sqrt(std::max(0.0, above / blocks)) : 0.0; }

void add_run(const Scale& scale, std::size_t run, const Eigen::VectorXd& difference, Measure& measure,
             const std::set<std::size_t>* counted) {
  measure.channels.resize(scale.set.channels().size());
  for (const Series& series : scale.set.series()) {
    if (series.run != run) continue;
    const OffsetFit fit = fit_offset(series, difference);
    for (std::size_t k = 0; k < series.size(); ++k) {
      if (counted != nullptr && counted->count(series.phase[k]) == 0) continue;
      const std::size_t at = series.first_residual + k;
      const double d = difference[to_index(at)] - fit.offset;
      const double sd = series.whitener.standard_deviation(k);
      const double above = d * d - std::max(0.0, sd * sd - fit.offset_variance);
      measure.stretches[{run, series.phase[k]}].add({above / (series.floor * series.floor), 1.0});
      measure.channels[series.channel].add({above, 1.0});
      measure.energies[run].error += scale.energy.energy_per_SI(at) * d;
      measure.energies[run].energy += scale.energy.energy(at);
    }
  }
}

Measure measure_runs(const Scale& scale, const Eigen::VectorXd& simulated) {
  const Eigen::VectorXd difference = scale.set.measured() - simulated;
  Measure measure;
  for (std::size_t run = 0; run < scale.set.runs().size(); ++run) add_run(scale, run, difference, measure);
  return measure;
}

Measure measure_as_calibrated(const Study& study, const Scale& scale, const Candidate& candidate) {
  const PreparedSet& set = study.set;
  const Model model(set, {}, candidate.fit.hypothesis);
  constexpr int kMost = 6;
  RefitStart start{candidate.amplitudes, Eigen::VectorXd(to_index(model.unknown_count())), 1, kMost};
  const Eigen::Index own = to_index(model.own_count());
  const Eigen::Index offsets = to_index(set.offset_count());
  start.unknowns << candidate.fit.unknowns.head(own), candidate.fit.unknowns.tail(offsets);
  const Eigen::VectorXd simulated = refit(model, study.discrepancy, start).simulated;
  return simulated.size() == 0 ? Measure() : measure_runs(scale, simulated);
}

double gap_of(const Measure& measure) {
  StretchSquares sum;
  for (const auto& [where, stretch] : measure.stretches) sum.add(stretch);
  return sum.gap();
}

std::optional<double> find_energy_percent(const Measure& measure) {
  std::vector<EnergyShare> runs;
  for (const auto& [run, share] : measure.energies) runs.push_back(share);
  return calc_rms_percent(runs);
}

std::vector<ChannelRms> list_channel_rms(const PreparedSet& set, const Measure& measure) {
  std::vector<ChannelRms> channels;
  for (std::size_t c = 0; c < set.channels().size(); ++c) {
    const ReportUnit unit = find_report_unit(set, set.channels()[c]);
    const double rms = measure.channels.empty() ? 0.0 : unit.per_SI * measure.channels[c].gap();
    channels.push_back({set.channels()[c].header(), unit.symbol, rms});
  }
  return channels;
}

}  // namespace rollrig::diagnosis
