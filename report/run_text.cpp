#include "report/run_page.h"

#include <fmt/format.h>

#include "scenarios/run/run_spec.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace rollrig::report {

std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  using Ledger = sim::EnergyTerm::Ledger;
  std::string text = fmt::format("{}   tire {} ({})   rig {}   {}\n", spec.scenario->text.name,
                                 show_on_one_line(spec.tire.name), show_on_one_line(spec.tire.designation),
                                 show_on_one_line(spec.rig.name), scenarios::name_of(spec.fidelity));
  if (spec.vehicle.has_value()) {
    text += wrap(fmt::format("vehicle {}: {:.0f} kg, driven axle {}", spec.vehicle->name, spec.vehicle->body.mass_kg,
                             rigs::list_driven_axles(*spec.vehicle)),
                 2);
  }
  if (!spec.effects.empty()) {
    std::string names;
    for (const models::ActiveEffect& active : spec.effects) {
      const models::EffectInfo& info = active.effect->info;
      names += " " + info.id;
      if (!info.acts_on(spec.rig.kind->traits)) {
        names += fmt::format(" (does not act on {})", spec.rig.kind->word);
      } else if (!models::acts_in(info, spec.rig.kind->traits, spec.tire.model(spec.baseline))) {
        names += " (this baseline has it)";
      }
    }
    text += wrap("effects on:" + names, 2);
  }
  text += format_tables(outcome.sheet.list_tables());
  const sim::EnergyAudit& audit = outcome.recording.audit;
  text += fmt::format("  energy balance: error {:.1e} (mechanical), {:.1e} (thermal) of the work done\n",
                      audit.calc_closure(Ledger::kMechanical), audit.calc_closure(Ledger::kThermal));
  return text + format_warnings(outcome.warnings);
}

}  // namespace rollrig::report
