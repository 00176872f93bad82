#include "diagnosis/output/fleet.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

namespace fs = std::filesystem;

std::string name_of(const FleetMember& member) { return fs::path(member.folder).filename().string(); }

/// A failure below the name of its set.
std::string format_failure(const FleetMember& member) {
  const std::string start = name_of(member) + ": ";
  return member.problem ? "  " + format_error(start, *member.problem) : wrap(start + member.failure, 2);
}

/// What failed, with its reason; which files are in doubt; how many warnings there are of other sets.
std::string format_troubles(const Fleet& fleet) {
  std::string failed, doubtful, warned;
  for (const FleetMember& member : fleet.members) {
    if (!member.findings) {
      failed += format_failure(member);
      continue;
    }
    const std::size_t others = member.findings->warnings.size() - (member.findings->doubt.empty() ? 0 : 1);
    if (!member.findings->doubt.empty()) {
      doubtful += wrap(fmt::format("{}: {}", name_of(member), member.findings->doubt), 2);
    }
    if (others > 0) warned += fmt::format("{}{} {}", warned.empty() ? "" : ", ", name_of(member), others);
  }
  std::string text;
  if (!failed.empty()) text += "\nNot diagnosed\n" + failed;
  if (!doubtful.empty()) text += "\nFiles in doubt, so no cause is named\n" + doubtful;
  if (!warned.empty()) text += "\nWarnings, which rollrig diagnose of that set alone tells\n" + wrap(warned, 2);
  return text;
}

const char* word_of(Shared shared) {
  if (shared == Shared::kMachineAndTire) return "machine or tire";
  return shared == Shared::kMachine ? "machine" : "tire";
}

std::string describe_recurrence(const Recurrence& one) {
  std::string text =
      fmt::format("{}: the {}'s ({}), probability {:.0f} % over {}, named in {}", one.effect, word_of(one.shared),
                  one.name, 100.0 * one.probability, format_count(one.sets, "set"), one.named_in);
  if (one.mean_size) {
    text += fmt::format("; mean size {:.3g} +- {:.1g}{}{}", *one.mean_size, one.mean_size_sd,
                        one.unit.empty() ? "" : " ", one.unit);
  }
  constexpr double kDiffer = 0.01;
  if (one.same_size_p && *one.same_size_p < kDiffer) text += ", but the sizes differ from set to set";
  return text;
}

}  // namespace

std::string machine_of(const measurements::MeasurementSet& set) { return set.rig ? set.rig->name : set.vehicle->name; }

Json diagnose_member(const std::string& folder, const DiagnosisOptions& options, BadRows bad_rows) {
  const measurements::MeasurementSet set = measurements::read_measurement_set(folder, bad_rows);
  const Diagnosis found = diagnose(set, options);
  return {{"machine", machine_of(set)},
          {"tire", set.tire.name},
          {"doubt", found.doubt},
          {"diagnosis", make_diagnosis_json(found)}};
}

void add_member(const std::string& folder, const Json& result, Fleet& fleet) {
  FleetMember member;
  member.folder = folder;
  try {
    member.machine = result.at("machine").get<std::string>();
    member.tire = result.at("tire").get<std::string>();
    member.findings = read_diagnosis_json(result.at("diagnosis"));
    member.findings->doubt = result.at("doubt").get<std::string>();
  } catch (const Json::exception& error) {
    throw InputError({fmt::format("the stored diagnosis of a set is damaged: {}", error.what()), folder, 0, "", "",
                      "what rollrig campaign run has stored", ""});
  }
  fleet.members.push_back(std::move(member));
  fleet.documents.push_back(result.at("diagnosis"));
}

void add_failed_member(const std::string& folder, const std::string& failure, Fleet& fleet) {
  fleet.members.push_back({folder, "", "", std::nullopt, failure, std::nullopt});
  fleet.documents.emplace_back(nullptr);
}

Table make_fleet_table(const Fleet& fleet) {
  Table table{
      "", {"set", "verdict", "cause", "probability", "gap, floors", "after", "machine", "tire", "folder"}, {}, 3};
  for (const FleetMember& member : fleet.members) {
    std::vector<std::string> row{name_of(member), "failed", "see below", "", "", ""};
    if (member.findings) {
      const Findings& one = *member.findings;
      const GapView& gap = one.gap.recalibrated;
      const bool explained = one.verdict == Verdict::kExplained;
      row = {name_of(member),
             one.doubt.empty() ? name_of(one.verdict) : "in doubt",
             explained ? fmt::format("{}", fmt::join(one.causes.front().effects, " + ")) : "",
             one.doubt.empty() ? show_probability(probability_of_verdict(one)) : "",
             fmt::format("{:.2f}", gap.before),
             explained ? fmt::format("{:.2f}", gap.after) : ""};
    }
    row.insert(row.end(), {member.machine, member.tire, member.folder});
    table.rows.push_back(row);
  }
  return table;
}

std::string format_fleet(const Fleet& fleet) {
  std::string text = format_table(make_fleet_table(fleet), 0) + format_troubles(fleet);
  text += "\nComes back from set to set\n";
  if (fleet.recurrences.empty()) text += "  nothing\n";
  for (const Recurrence& one : fleet.recurrences) text += wrap(describe_recurrence(one), 2);
  return text;
}

Json make_fleet_json(const Fleet& fleet) {
  Json json{{"format", "rollrig-fleet/1"}, {"sets", Json::array()}, {"recurring", Json::array()}};
  for (std::size_t i = 0; i < fleet.members.size(); ++i) {
    const FleetMember& member = fleet.members[i];
    const Json own = member.findings && fleet.documents.empty() ? make_diagnosis_json(*member.findings) : Json(nullptr);
    json["sets"].push_back({{"folder", member.folder},
                            {"machine", member.machine},
                            {"tire", member.tire},
                            {"failure", member.failure.empty() ? Json(nullptr) : Json(member.failure)},
                            {"diagnosis", fleet.documents.empty() ? own : fleet.documents[i]}});
  }
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  for (const Recurrence& one : fleet.recurrences) {
    json["recurring"].push_back({{"effect", one.effect},
                                 {"shared", word_of(one.shared)},
                                 {"name", one.name},
                                 {"sets", one.sets},
                                 {"named_in", one.named_in},
                                 {"probability", one.probability},
                                 {"mean_size", or_null(one.mean_size)},
                                 {"mean_size_sd", one.mean_size ? Json(one.mean_size_sd) : Json(nullptr)},
                                 {"unit", one.unit},
                                 {"same_size_p", or_null(one.same_size_p)}});
  }
  return json;
}

}  // namespace rollrig::diagnosis
