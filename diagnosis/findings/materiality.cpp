#include "diagnosis/findings/materiality.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/findings/energy_scale.h"
#include "diagnosis/findings/verdict.h"

namespace rollrig::diagnosis {

CauseChange measure_change(const Study& study, const Candidate& cause) {
  const PreparedSet& set = study.set;
  const Fit& fit = cause.fit;
  const Fit& null = study.null.fit;
  const Model model = study.make_model(fit.hypothesis);
  const Model without = study.make_model({});
  const Eigen::VectorXd retuned = without.subtract_from_measured(null.unknowns, null.simulated) -
                                  model.subtract_from_measured(fit.unknowns, fit.simulated);
  CauseChange change;
  change.floors = std::sqrt(sum_squared_floors(set, retuned) / static_cast<double>(set.residual_count()));
  Eigen::VectorXd simulated;
  const Eigen::VectorXd base = fit.unknowns.tail(fit.unknowns.size() - to_index(model.own_count()));
  if (without.simulate(base, study.settings.threads, simulated, nullptr)) {
    change.energy_percent = EnergyScale(set).calc_percent(fit.simulated - simulated);
  }
  return change;
}

bool is_immaterial(const CauseChange& change, double smallest_effect_percent) {
  return change.energy_percent.value_or(0.0) < smallest_effect_percent &&
         change.floors < thresholds::kSmallestEffect_floors_per_percent * smallest_effect_percent;
}

Cause set_aside_trace(std::vector<Cause>& causes, std::map<std::string, double>& probability) {
  Cause trace = std::move(causes.front());
  causes.erase(causes.begin());
  move_probability(trace, trace.probability, "none", probability);
  return trace;
}

}  // namespace rollrig::diagnosis
