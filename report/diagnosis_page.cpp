#include "report/diagnosis_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "diagnosis/terms/term.h"
#include "report/blocks.h"
#include "report/set_comparison.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using diagnosis::Diagnosis;

/// The cause's effects at their fitted size; those without an estimate at the center of their prior.
std::vector<models::ActiveEffect> make_effects(const Cause& cause) {
  std::vector<models::ActiveEffect> active;
  for (const std::string& id : cause.effects) {
    const models::Effect& effect = diagnosis::find_term(id).effect();
    models::ActiveEffect one{&effect, {}};
    for (const models::EffectParameter& parameter : effect.info.parameters) {
      const std::string name = id + "." + parameter.key;
      const auto at = std::find_if(cause.parameters.begin(), cause.parameters.end(),
                                   [&name](const ParameterEstimate& each) { return each.name == name; });
      const double value = at != cause.parameters.end() ? at->value : parameter.prior.center();
      one.parameters.push_back(unit_of_key(parameter.key).to_si(value));
    }
    active.push_back(std::move(one));
  }
  return active;
}

std::vector<SimulatedSet> simulate_before_and_after(const diagnosis::PreparedSet& set, const Diagnosis& diagnosis) {
  const models::Context<double> context = measurements::make_context(set.source());
  std::vector<SimulatedSet> simulated{simulate_set(set, "simulated, files' numbers", context, {})};
  const diagnosis::FittedSet& fitted = diagnosis.fitted;
  if (!fitted.recalibrated.empty()) simulated.push_back({"recalibrated", fitted.recalibrated});
  if (diagnosis.verdict == Verdict::kNoGap || diagnosis.causes.empty()) return simulated;
  const Cause& cause = diagnosis.causes.front();
  std::string names;
  for (const std::string& id : cause.effects) names += (names.empty() ? "" : " and ") + name_effect(id);
  if (!fitted.with_cause.empty()) {
    simulated.push_back({"recalibrated, with " + names, fitted.with_cause});
  } else {
    simulated.push_back(simulate_set(set, "files' numbers, with " + names, context, make_effects(cause)));
  }
  return simulated;
}

Section make_runs(const diagnosis::PreparedSet& set, const std::vector<SimulatedSet>& simulated) {
  Section section{
      "Run by run",
      "Measurement and simulation. With the files' numbers a gap is seen that a recalibration would take as "
      "well, sensor offsets among it; recalibrated, the numbers are moved within their uncertainties and the "
      "offsets added, each fit to all runs."};
  for (std::size_t run = 0; run < set.runs().size(); ++run) {
    const auto of_run = [run](const diagnosis::Series& series) { return series.run == run; };
    if (std::none_of(set.series().begin(), set.series().end(), of_run))
      continue;  // it measured nothing: a warning says so
    section.blocks.push_back(make_comparison(set, run, simulated));
  }
  return section;
}

std::string describe_set(const measurements::MeasurementSet& set) {
  const std::string machine = set.rig.has_value()       ? "rig " + set.rig->name
                              : set.vehicle.has_value() ? "vehicle " + set.vehicle->name
                                                        : "";
  return fmt::format("Tire {}, {}, {}", set.tire.name, machine, format_count(set.runs.size(), "run"));
}

}  // namespace

Page make_diagnosis_page(const measurements::MeasurementSet& set, const Diagnosis& diagnosis) {
  const diagnosis::PreparedSet prepared(set);
  const std::vector<SimulatedSet> simulated = simulate_before_and_after(prepared, diagnosis);
  const std::string restriction = diagnosis::describe_restriction(diagnosis, &name_effect);
  Page page{"diagnose", fmt::format("Diagnosis of {}", name_set(diagnosis.set)), describe_set(set)};
  if (!restriction.empty()) page.subtitle += "; compared: " + restriction;
  page.add(make_verdict(diagnosis));
  page.add(make_causes(diagnosis));
  page.add(make_gap(diagnosis));
  if (!diagnosis.base_numbers.empty()) page.add(make_base_numbers(diagnosis));
  Section where{"Where it lies"};
  if (!simulated.front().values.empty()) {
    where.blocks.push_back(make_gap_map(prepared, simulated.front(), diagnosis.where));
  }
  if (!diagnosis.balance.empty()) where.blocks.push_back(make_balance(diagnosis));
  page.add(std::move(where));
  page.add(make_next(diagnosis));
  page.add(make_explanations(diagnosis));
  page.add(make_runs(prepared, simulated));
  page.add(make_document(diagnosis::make_diagnosis_json(diagnosis), "The diagnosis as JSON"));
  return page;
}

}  // namespace rollrig::report
