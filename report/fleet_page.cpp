#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "report/blocks.h"
#include "report/diagnosis_page.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using diagnosis::Fleet;
using diagnosis::Recurrence;
using diagnosis::Shared;
using diagnosis::show_probability;

std::string name_shared(const Recurrence& at) {
  switch (at.shared) {
    case Shared::kMachine:
      return "machine " + at.name;
    case Shared::kTire:
      return "tire " + at.name;
    case Shared::kMachineAndTire:
      break;
  }
  return "machine and tire " + at.name;
}

Block make_recurrences(const Fleet& fleet) {
  Table table{
      "", {"effect", "with", "sets", "named in", "probability that it acts in all", "mean size", "sd", "unit"}, {}};
  for (const Recurrence& at : fleet.recurrences) {
    table.rows.push_back({name_effect(at.effect), name_shared(at), fmt::format("{}", at.sets),
                          fmt::format("{}", at.named_in), show_probability(at.probability),
                          at.mean_size.has_value() ? fmt::format("{:.3g}", *at.mean_size) : "-",
                          at.mean_size.has_value() ? fmt::format("{:.2g}", at.mean_size_sd) : "-", at.unit});
  }
  return make_table(table);
}

/// Gap of every set before and after its cause.
Block make_gaps(const Fleet& fleet) {
  Json names = Json::array(), before = Json::array(), after = Json::array();
  for (const FleetMember& member : fleet.members) {
    if (!member.findings.has_value()) continue;
    names.push_back(last_part(member.folder, '/'));
    before.push_back(rounded(member.findings->gap.recalibrated.before));
    const bool has_cause = member.findings->verdict == Verdict::kExplained;
    after.push_back(has_cause ? rounded(member.findings->gap.recalibrated.after) : Json(nullptr));
  }
  return make_bars({"Gap on held-out runs", "noise floors"}, names,
                   {{{"name", "before"}, {"values", before}}, {{"name", "with the cause"}, {"values", after}}});
}

Block make_fleet_tiles(const Fleet& fleet) {
  std::size_t counts[4] = {};  // explained, no gap, unexplained, not diagnosed
  for (const FleetMember& member : fleet.members) {
    if (!member.findings.has_value()) {
      ++counts[3];
      continue;
    }
    ++counts[member.findings->verdict == Verdict::kExplained ? 0 : member.findings->verdict == Verdict::kNoGap ? 1 : 2];
  }
  const std::string of = "of " + format_count(fleet.members.size(), "set");
  std::vector<Tile> tiles{{"Explained", fmt::format("{}", counts[0]), "", of, "good", {}},
                          {"No gap", fmt::format("{}", counts[1]), "", of, "good", {}},
                          {"Unexplained", fmt::format("{}", counts[2]), "", of, counts[2] > 0 ? "bad" : "", {}}};
  if (counts[3] > 0) tiles.push_back({"Not diagnosed", fmt::format("{}", counts[3]), "", of, "bad", {}});
  return make_tiles(tiles);
}

/// The verdict on a set in a sentence, or why there is none, and what is warned of.
Section make_member(const FleetMember& member) {
  Section section{last_part(member.folder, '/')};
  if (!member.findings.has_value()) {
    section.blocks.push_back(
        make_lead("bad", "Not diagnosed: " + (member.problem ? member.problem->what : member.failure)));
    if (!member.problem) return section;
    for (const ProblemPart& part : list_parts(*member.problem)) {
      section.blocks.push_back(make_paragraph(fmt::format("{}: {}", part.label, part.content)));
    }
    return section;
  }
  const bool is_bad = member.findings->verdict == Verdict::kUnexplained;
  section.blocks.push_back(make_lead(is_bad ? "bad" : "good", describe_verdict(*member.findings)));
  if (!member.findings->warnings.empty()) section.blocks.push_back(make_warnings(member.findings->warnings));
  return section;
}

}  // namespace

/// The table of the terminal, with names in place of words that files and options have.
Table make_named_table(const Fleet& fleet) {
  Table table = diagnosis::make_fleet_table(fleet);
  const auto column_of = [&table](const char* heading) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), heading) -
                                    table.columns.begin());
  };
  const std::size_t verdict = column_of("verdict");
  const std::size_t cause = column_of("cause");
  for (std::size_t i = 0; i < fleet.members.size(); ++i) {
    const std::optional<Findings>& findings = fleet.members[i].findings;
    if (!findings.has_value()) continue;
    std::vector<std::string>& row = table.rows[i];
    row[verdict] = plain_name(row[verdict]);
    if (row[cause].empty()) continue;
    row[cause].clear();
    for (const std::string& id : findings->causes.front().effects) {
      row[cause] += (row[cause].empty() ? "" : " + ") + name_effect(id);
    }
  }
  return table;
}

Page make_fleet_page(const Fleet& fleet) {
  Page page{"diagnose", "Diagnosis of " + format_count(fleet.members.size(), "set"), ""};
  page.add({"Sets", "", {make_fleet_tiles(fleet), make_table(make_named_table(fleet)), make_gaps(fleet)}});
  Section back{"What comes back"};
  back.blocks.push_back(fleet.recurrences.empty()
                            ? make_paragraph("No effect acts with more than 80 % in all sets of a machine or a tire.")
                            : make_recurrences(fleet));
  page.add(std::move(back));
  for (const FleetMember& member : fleet.members) {
    page.add(make_member(member));
  }
  return page;
}

}  // namespace rollrig::report
