#include "diagnosis/findings/gap_steps.h"

#include <algorithm>

#include "diagnosis/findings/gap_measure.h"

namespace rollrig::diagnosis {
namespace {

GapStep make_step(const std::string& name, const PreparedSet& set, const Measure& measure) {
  GapStep step{name, gap_of(measure), find_energy_percent(measure), {}};
  for (const ChannelRms& at : list_channel_rms(set, measure)) step.channels.push_back({at.channel, at.unit, at.rms});
  return step;
}

/// The first terms of a hypothesis, fitted from where the whole of it lies. What the comparison has fitted is not
/// fitted again. Empty where no fit is found.
Eigen::VectorXd simulate_first_terms(const Study& study, const Comparison& comparison, const Candidate& lead,
                                     std::size_t count) {
  const std::vector<SignedTerm>& all = lead.fit.hypothesis.terms;
  const Hypothesis first{{all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)}};
  const auto known = std::find_if(comparison.candidates.begin(), comparison.candidates.end(),
                                  [&](const Candidate& one) { return one.fit.hypothesis == first; });
  if (known != comparison.candidates.end()) return known->fit.simulated;
  const Model model = study.make_model(first);
  const Eigen::Index own = to_index(model.own_count());
  RefitStart start{lead.amplitudes, Eigen::VectorXd(to_index(model.unknown_count())), study.settings.threads};
  start.unknowns << lead.fit.unknowns.head(own), lead.fit.unknowns.tail(start.unknowns.size() - own);
  return refit(model, study.discrepancy, start).simulated;
}

}  // namespace

std::vector<GapStep> find_gap_steps(const Study& study, const Comparison& comparison, const Candidate* lead) {
  const Scale scale{study.set, EnergyScale(study.set)};
  const Measure calibrated = measure_as_calibrated(study, scale, study.null);
  if (calibrated.stretches.empty()) return {};
  std::vector<GapStep> steps;
  steps.push_back(make_step("as calibrated", study.set, calibrated));
  steps.push_back(make_step("recalibrated", study.set, measure_runs(scale, study.null.fit.simulated)));
  if (lead == nullptr) return steps;
  const std::vector<std::string> names = lead->fit.hypothesis.names();
  for (std::size_t count = 1; count <= names.size(); ++count) {
    const Eigen::VectorXd simulated =
        count == names.size() ? lead->fit.simulated : simulate_first_terms(study, comparison, *lead, count);
    if (simulated.size() == 0) continue;  // the next step has this effect, too
    steps.push_back(make_step(names[count - 1], study.set, measure_runs(scale, simulated)));
  }
  return steps;
}

}  // namespace rollrig::diagnosis
