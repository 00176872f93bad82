#include "diagnosis/findings/energy_scale.h"

#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"

namespace rollrig::diagnosis {

EnergyScale::EnergyScale(const PreparedSet& set)
    : set_(set),
      energy_(Eigen::VectorXd::Zero(to_index(set.residual_count()))),
      per_SI_(Eigen::VectorXd::Zero(to_index(set.residual_count()))) {
  const Quantity& force = set.source().kind->traits.force;
  for (const Series& series : set.series()) {
    if (!(set.channels()[series.channel] == force)) continue;
    const measurements::MeasurementSet& source = set.source(set.runs()[series.run].machine);
    const double newtons_per_SI = set.kind().force_channel(source).newtons_per_SI;
    const double skim_limit_N = set.kind().skim_limit_N(source);
    const measurements::MeasuredRun& run = set.runs()[series.run].measured;
    const std::vector<double>& speed_m_s = run.column(models::quantities::kSpeed);
    const std::vector<double>* load_N = skim_limit_N > 0.0 ? &run.column(models::quantities::kLoad) : nullptr;
    const std::vector<double>& readings = run.column(force);
    for (std::size_t k = 0; k < series.size(); ++k) {
      const measurements::Block& block = series.blocks[k];
      const auto mean = [&](const auto& get) { return series.mean_over(block, get); };
      if (load_N != nullptr && mean([&](std::size_t row) { return (*load_N)[row]; }) <= skim_limit_N) continue;
      const double force_N = mean([&](std::size_t row) {
        return set.kind()
            .find_tire_force_N(source, run, row, readings[row])
            .value_or(std::max(0.0, newtons_per_SI * readings[row]));
      });
      if (force_N <= 0.0) continue;
      const double speed_samples_m_s =
          static_cast<double>(block.last - block.first) * mean([&](std::size_t row) { return speed_m_s[row]; });
      const auto at = to_index(series.first_residual + k);
      energy_[at] = force_N * speed_samples_m_s;
      per_SI_[at] = newtons_per_SI * speed_samples_m_s;
    }
  }
}

std::optional<double> EnergyScale::calc_percent(const Eigen::VectorXd& difference) const {
  std::vector<EnergyShare> runs(set_.runs().size());
  for (const Series& series : set_.series()) {
    runs[series.run].error += series.rows_of(per_SI_).dot(series.rows_of(difference));
    runs[series.run].energy += series.rows_of(energy_).sum();
  }
  return calc_rms_percent(runs);
}

std::optional<double> calc_rms_percent(const std::vector<EnergyShare>& runs) {
  double sum = 0.0;
  int count = 0;
  for (const EnergyShare& run : runs) {
    if (!(run.energy > 0.0)) continue;
    const double share = run.error / run.energy;
    sum += share * share;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return 100.0 * std::sqrt(sum / count);
}

}  // namespace rollrig::diagnosis
