#include "report/run_page.h"

#include <fmt/format.h>

#include "report/animation.h"
#include "report/blocks.h"
#include "report/energy.h"
#include "report/run_figures.h"
#include "report/time_panels.h"
#include "scenarios/run/run_spec.h"

namespace rollrig::report {
namespace {

std::string list_effects(const scenarios::RunSpec& spec) {
  std::string names;
  for (const models::ActiveEffect& active : spec.effects) {
    names += (names.empty() ? ", effects: " : ", ") + active.effect->info.id;
  }
  return names;
}

std::string make_subtitle(const scenarios::RunSpec& spec) {
  std::string text = fmt::format("Tire {} ({}), rig {}", spec.tire.name, spec.tire.designation, spec.rig.name);
  if (spec.vehicle.has_value()) {
    text += fmt::format(", vehicle {} of {:.0f} kg", spec.vehicle->name, spec.vehicle->body.mass_kg);
  }
  return text + fmt::format(", {}{}", scenarios::name_of(spec.fidelity), list_effects(spec));
}

Section make_result(const scenarios::Outcome& outcome) {
  Section section = begin_section("Result", outcome.warnings);
  if (!outcome.sheet.lines.empty()) section.blocks.push_back(make_lines(outcome.sheet.lines));
  for (const scenarios::ResultTable& table : outcome.sheet.tables) section.blocks.push_back(make_table(table));
  return section;
}

Section make_over_time(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  const sim::Recording<double>& recording = outcome.recording;
  Section section{"The test over time"};
  section.blocks.push_back({{"type", "time_bar"}, {"phases", make_phases(recording.phases)}});
  section.blocks.push_back(make_animation(spec, recording));
  section.blocks.push_back(make_times(recording));
  return section;
}

}  // namespace

Page make_run_page(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  Page page{"run", spec.scenario->text.summary, make_subtitle(spec), {}, find_view(outcome.recording)};
  page.add(make_result(outcome));
  page.add(make_run_figures(outcome.result));
  page.add(make_over_time(spec, outcome));
  page.add({"Energy balance", "", {make_energy(outcome.recording.audit)}});
  page.add(
      {"Procedure", "", {make_paragraph(spec.scenario->text.procedure), make_paragraph(spec.scenario->text.source)}});
  Json inputs = scenarios::make_manifest(spec, outcome);
  inputs.erase("format");
  page.add(make_inputs(inputs));
  return page;
}

}  // namespace rollrig::report
