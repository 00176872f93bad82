#include "report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scenarios/run/run_spec.h"
#include "sim/core/text.h"

namespace rollrig::report {

std::string format_lines(const std::vector<scenarios::ResultLine>& lines) {
  std::size_t width = 0;
  for (const scenarios::ResultLine& line : lines) width = std::max(width, line.label.size());
  std::string text;
  for (const scenarios::ResultLine& line : lines) text += fmt::format("  {:<{}}  {}\n", line.label, width, line.value);
  return text;
}

std::string format_table(const scenarios::ResultTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(count_characters(column));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], count_characters(row[i]));
  }
  const bool names_first = std::any_of(table.rows.begin(), table.rows.end(), [](const std::vector<std::string>& row) {
    return !row.empty() && !row[0].empty() && std::isalpha(static_cast<unsigned char>(row[0][0])) != 0;
  });
  const auto format_row = [&widths, names_first](const std::vector<std::string>& cells) {
    std::string line = " ";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t width = widths[i] + (cells[i].size() - count_characters(cells[i]));
      line += i == 0 && names_first ? fmt::format(" {:<{}}", cells[i], width) : fmt::format(" {:>{}}", cells[i], width);
    }
    return line + "\n";
  };
  std::string text = (table.title.empty() ? "" : "  " + table.title + "\n") + format_row(table.columns);
  for (const auto& row : table.rows) text += format_row(row);
  return text;
}

std::string format_outcome(const scenarios::RunSpec& spec, const scenarios::Outcome& outcome) {
  using Ledger = sim::EnergyTerm::Ledger;
  std::string text = fmt::format("{}   tire {} ({})   rig {}   {}\n", spec.scenario->text.name, spec.tire.name,
                                 spec.tire.designation, spec.rig.name, scenarios::name_of(spec.fidelity));
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
  text += format_lines(outcome.sheet.lines);
  for (const scenarios::ResultTable& table : outcome.sheet.tables) text += format_table(table);
  const sim::EnergyAudit& audit = outcome.recording.audit;
  text += fmt::format("  energy closes to {:.1e} (mechanical) and {:.1e} (thermal) of the work\n",
                      audit.calc_closure(Ledger::kMechanical), audit.calc_closure(Ledger::kThermal));
  for (const std::string& warning : outcome.warnings) text += wrap("warning: " + warning, 2);
  return text;
}

}  // namespace rollrig::report
