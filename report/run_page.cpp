#include "report/run_page.h"

#include <fmt/format.h>

#include "report/blocks.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using Ledger = sim::EnergyTerm::Ledger;

/// Name of a term of the energy audit: heat goes into the surface on which the tire rolls.
std::string name_term(const std::string& term, const scenarios::RunSpec& spec) {
  if (term != "heat_to_road") return term;
  switch (spec.rig.kind->traits.surface) {
    case models::Surface::kDrum:
      return "heat_to_drum";
    case models::Surface::kBelt:
      return "heat_to_belt";
    case models::Surface::kRoller:
      return "heat_to_rollers";
    case models::Surface::kRoad:
      break;
  }
  return term;
}

Json make_ledger(const scenarios::RunSpec& spec, const sim::EnergyAudit& audit, Ledger ledger, const char* name) {
  Json terms = Json::array();
  for (const sim::EnergyTerm& term : audit.terms) {
    if (term.ledger == ledger) terms.push_back({{"name", name_term(term.name, spec)}, {"in_J", rounded(term.in_J)}});
  }
  return {{"name", name}, {"terms", terms}};
}

/// Both ledgers of the audit as flows; what the tire loses flows on from the mechanical into the thermal one.
Block make_energy(const scenarios::RunSpec& spec, const sim::EnergyAudit& audit) {
  return {
      {"type", "energy"},
      {"ledgers",
       {make_ledger(spec, audit, Ledger::kMechanical, "mechanical work"),
        make_ledger(spec, audit, Ledger::kThermal, "heat in the tire")}},
      {"links", Json::array({Json::array({"tire_loss", "heat_generated"})})},
      {"caption", fmt::format("From left to right: what brings energy in, and where it goes or stays. The mechanical "
                              "balance closes to {:.1e} of the work, the thermal one to {:.1e}. Terms below 0.1 % "
                              "of the inflow stand in the table alone.",
                              audit.calc_closure(Ledger::kMechanical), audit.calc_closure(Ledger::kThermal))}};
}

std::string list_effects(const scenarios::RunSpec& spec) {
  std::string names;
  for (const models::ActiveEffect& active : spec.effects) {
    names += (names.empty() ? ", effects: " : ", ") + plain_name(active.effect->info.id);
  }
  return names;
}

std::string make_subtitle(const scenarios::RunSpec& spec) {
  std::string text =
      fmt::format("Simulated: tire {} ({}), rig {}", spec.tire.name, spec.tire.designation, spec.rig.name);
  if (spec.vehicle.has_value()) {
    text += fmt::format(", vehicle {} of {:.0f} kg", spec.vehicle->name, spec.vehicle->body.mass_kg);
  }
  return text + fmt::format(", {}{}",
                            spec.fidelity == scenarios::Fidelity::kQuasiStatic ? "quasi-static"
                                                                               : scenarios::name_of(spec.fidelity),
                            list_effects(spec));
}

Section make_over_time(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  const sim::Recording<double>& recording = outcome.recording;
  Section section{"The test over time"};
  section.blocks.push_back({{"type", "time_bar"}, {"phases", make_phases(recording.phases)}});
  section.blocks.push_back(make_animation(spec, recording));
  if (std::optional<Block> heat = make_cross_section(spec, recording)) section.blocks.push_back(std::move(*heat));
  section.blocks.push_back(make_times(recording));
  return section;
}

Section make_result(const scenarios::Outcome& outcome) {
  Section section = report::make_section("Result", outcome.sheet.list_tables(), {});
  std::vector<Block> first;
  if (!outcome.sheet.summary.empty()) first.push_back(make_lead("", outcome.sheet.summary));
  std::vector<Tile> tiles;
  for (const scenarios::ShownHeadline& headline : outcome.sheet.headlines) {
    tiles.push_back({headline.label, headline.value, headline.unit, headline.note, "", {}});
    for (const std::string& key : headline.keys) tiles.back().from.push_back("/result/" + key);
  }
  if (!tiles.empty()) first.push_back(make_tiles(tiles));
  if (!outcome.warnings.empty()) first.push_back(make_warnings(outcome.warnings));
  if (std::optional<Block> figure = make_first_figure(outcome.result, outcome.recording)) {
    first.push_back(std::move(*figure));
  }
  put_first(std::move(first), section);
  return section;
}

}  // namespace

Page make_run_page(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  Page page{"run", spec.scenario->text.summary, make_subtitle(spec), {}, find_view(outcome.recording)};
  page.add(make_result(outcome));
  page.add(make_coast_figures(outcome.result, outcome.recording));
  page.add(make_run_figures(outcome.result));
  page.add(make_over_time(spec, outcome));
  page.add({"Energy balance", "", {make_energy(spec, outcome.recording.audit)}});
  page.add({"Procedure",
            "",
            {make_equations(spec.scenario->text.name), make_paragraph(spec.scenario->text.procedure),
             make_paragraph(spec.scenario->text.source)}});
  Json inputs = scenarios::make_manifest(spec, outcome);
  inputs.erase("format");
  page.add({"Inputs", "", {{{"type", "inputs"}, {"groups", inputs}}}, "All inputs, defaults included"});
  return page;
}

}  // namespace rollrig::report
