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

/// How many sets have which verdict.
struct FleetCounts {
  std::size_t explained = 0, no_gap = 0, unexplained = 0, failed = 0;
};

FleetCounts count_verdicts(const Fleet& fleet) {
  FleetCounts counts;
  for (const FleetMember& member : fleet.members) {
    if (!member.findings.has_value()) {
      ++counts.failed;
      continue;
    }
    const Verdict verdict = member.findings->verdict;
    ++(verdict == Verdict::kExplained ? counts.explained
       : verdict == Verdict::kNoGap   ? counts.no_gap
                                      : counts.unexplained);
  }
  return counts;
}

/// "bearing warmup in 2 sets, torque gain in 1 set", the most frequent cause first.
std::string list_fleet_causes(const Fleet& fleet) {
  std::vector<std::pair<std::string, std::size_t>> causes;
  for (const FleetMember& member : fleet.members) {
    if (!member.findings.has_value() || member.findings->verdict != Verdict::kExplained) continue;
    std::vector<std::string> names;
    for (const std::string& id : member.findings->causes.front().effects) names.push_back(name_effect(id));
    const std::string name = fmt::format("{}", fmt::join(names, " with "));
    const auto known = std::find_if(causes.begin(), causes.end(), [&](const auto& one) { return one.first == name; });
    known == causes.end() ? causes.emplace_back(name, 1) : (++known->second, *known);
  }
  std::stable_sort(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t kMost = 3;
  const bool is_cut = causes.size() > kMost;
  causes.resize(std::min(causes.size(), kMost));
  std::vector<std::string> texts;
  for (const auto& [name, count] : causes) texts.push_back(fmt::format("{} in {}", name, format_count(count, "set")));
  return fmt::format("{}{}", fmt::join(texts, ", "), is_cut ? " and others" : "");
}

Block make_fleet_lead(const Fleet& fleet) {
  const FleetCounts counts = count_verdicts(fleet);
  const std::size_t all = fleet.members.size();
  std::string text;
  if (counts.explained > 0) {
    text = fmt::format("A cause was found in {} of {}: {}.", counts.explained, format_count(all, "set"),
                       list_fleet_causes(fleet));
  } else if (counts.no_gap == all) {
    text = fmt::format("No cause was found in any of {}, and none is needed: the simulation meets all measurements.",
                       format_count(all, "set"));
  } else {
    text = fmt::format("No cause was found in any of {}.", format_count(all, "set"));
  }
  if (counts.no_gap > 0 && counts.no_gap < all)
    text += fmt::format(" No gap in {}.", format_count(counts.no_gap, "set"));
  if (counts.unexplained > 0)
    text += fmt::format(" A gap without a cause in {}.", format_count(counts.unexplained, "set"));
  if (counts.failed > 0) text += fmt::format(" Not diagnosed: {}.", format_count(counts.failed, "set"));
  return make_lead(counts.unexplained + counts.failed > 0 ? "bad" : "good", text);
}

Block make_fleet_tiles(const Fleet& fleet) {
  const FleetCounts counts = count_verdicts(fleet);
  const std::string of = "of " + format_count(fleet.members.size(), "set");
  const auto make = [&of](const char* label, std::size_t count, const char* tone) {
    return Tile{label, fmt::format("{}", count), "", of, count > 0 ? tone : "", {}};
  };
  std::vector<Tile> tiles{make("Explained by a cause", counts.explained, "good"), make("No gap", counts.no_gap, "good"),
                          make("A gap without a cause", counts.unexplained, "bad")};
  if (counts.failed > 0) tiles.push_back(make("Not diagnosed", counts.failed, "bad"));
  // What was found stands first.
  std::stable_partition(tiles.begin(), tiles.end(), [](const Tile& tile) { return !tile.tone.empty(); });
  return make_tiles(tiles);
}

/// Whether a set has a gap that a bar would show.
bool has_gap(const Fleet& fleet) {
  const FleetCounts counts = count_verdicts(fleet);
  return counts.explained + counts.unexplained > 0;
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
  // A terminal has no room for them.
  table.columns[column_of("gap, floors")] = "gap, noise floors";
  table.columns[column_of("after")] = "gap with the cause, noise floors";
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
  for (const FleetMember& member : fleet.members) {
    if (!member.findings.has_value() || !page.subtitle.empty()) continue;
    const std::string restriction = diagnosis::describe_restriction(*member.findings, &name_effect);
    if (!restriction.empty()) page.subtitle = "Compared: " + restriction;
  }
  Section sets{"Sets", "", {make_fleet_lead(fleet), make_fleet_tiles(fleet)}};
  if (has_gap(fleet)) sets.blocks.push_back(make_gaps(fleet));
  sets.blocks.push_back(make_table(make_named_table(fleet)));
  page.add(std::move(sets));
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
