#include "comparison/compare_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "comparison/budget_difference.h"
#include "comparison/energy_waterfall.h"
#include "comparison/flat_values.h"
#include "comparison/input_differences.h"
#include "comparison/overlay.h"
#include "comparison/result_folder.h"
#include "scenarios/run/flat_results.h"
#include "scenarios/run/scenario.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::comparison {
namespace {

void require_one_scenario(const std::vector<ResultFolder>& folders) {
  const auto name_scenario = [](const ResultFolder& folder) { return folder.result.value("scenario", std::string()); };
  const std::string first = name_scenario(folders.front());
  for (const ResultFolder& folder : folders) {
    if (name_scenario(folder) == first) continue;
    throw InputError({"results of different scenarios have nothing to compare", folder.file_of("result.json"), 0,
                      "scenario", name_scenario(folder), fmt::format("{}, as the first of the results", first), ""});
  }
}

/// Reads what a comparison needs of a result, each in its type.
/// Errors  InputError: what is missing or of another type, with the file of this result
void require_whole(const ResultFolder& folder) {
  try {
    const Json& result = folder.result;
    result.at("scenario").get<std::string>();
    result.at("energy").value("terms_J", Json::object()).get<std::map<std::string, double>>();
    for (const Json& phase : result.value("phases", Json::array())) {
      phase.at("name").get<std::string>();
      phase.at("start_s").get<double>();
      phase.at("end_s").get<double>();
    }
    for (const Json& budget : result.value("uncertainty", Json::object()).value("budgets", Json::array())) {
      budget.at("key").get<std::string>();
      budget.at("value").get<double>();
      budget.at("contributions").get<Json::array_t>();
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError({fmt::format("a result was changed or is damaged: {}", error.what()),
                      folder.file_of("result.json"), 0, "", "", "files as rollrig run --out writes them", ""});
  }
}

/// The budgets of a result by the key of what they are of.
const Json* find_budget(const ResultFolder& folder, const std::string& key) {
  const auto uncertainty = folder.result.find("uncertainty");
  if (uncertainty == folder.result.end()) return nullptr;
  for (const Json& budget : uncertainty->at("budgets")) {
    if (budget.at("key") == key) return &budget;
  }
  return nullptr;
}

SharedInputs find_shared(const ResultFolder& reference, const ResultFolder& other) {
  const Json a = strip_manifest(reference.manifest);
  const Json b = strip_manifest(other.manifest);
  const auto is_same = [&](const char* key) { return a.value(key, Json()) == b.value(key, Json()); };
  const auto drop_tires = [](Json vehicle) {
    if (vehicle.is_object() && vehicle.contains("axles")) {
      for (Json& axle : vehicle["axles"]) axle.erase("tire");
    }
    return vehicle;
  };
  const bool is_one_vehicle = drop_tires(a.value("vehicle", Json())) == drop_tires(b.value("vehicle", Json()));
  return {a == b && reference.result.at("result") == other.result.at("result"),
          is_same("rig") && is_same("sensors") && is_one_vehicle, is_same("tire")};
}

/// Results with a budget that are no results of their own, such as an energy over all sections.
void add_budget_values(const std::vector<ResultFolder>& folders, std::vector<Json>& flat) {
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const Json budgets = folders[i].result.value("uncertainty", Json::object()).value("budgets", Json::array());
    for (const Json& budget : budgets) {
      const std::string key = budget.at("key");
      if (!flat[i].contains(key)) flat[i][key] = budget.at("value");
    }
  }
}

/// Why a result has no interval.
std::string explain_no_interval(const ResultFolder& folder, const std::string& name, const std::string& scenario) {
  if (folder.result.contains("uncertainty")) return "no budget is of this result";
  const scenarios::Scenario* found = scenarios::find_scenario_if_any(scenario);
  if (found != nullptr && !found->has_uncertainty) return fmt::format("{} has no uncertainty budget", scenario);
  return fmt::format("{} was run without --uncertainty", name);
}

void add_intervals(const std::vector<ResultFolder>& folders, Comparison& comparison) {
  const std::string scenario = folders.front().result.at("scenario");
  for (ComparedValue& value : comparison.values) {
    const Json* reference = find_budget(folders.front(), value.name);
    if (reference != nullptr) value.label = reference->at("name").get<std::string>();
    for (std::size_t i = 1; i < folders.size(); ++i) {
      Difference& difference = value.differences[i - 1];
      const Json* other = find_budget(folders[i], value.name);
      if (reference == nullptr || other == nullptr) {
        const std::size_t lacking = reference == nullptr ? 0 : i;
        add_reason(explain_no_interval(folders[lacking], comparison.names[lacking], scenario), difference);
        continue;
      }
      const DifferenceUncertainty found =
          calc_difference_uncertainty(*reference, *other, find_shared(folders.front(), folders[i]));
      add_interval(found.sd, found.coverage_factor, difference);
    }
  }
}

std::string join_names(const std::vector<std::string>& names) {
  return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
}

/// What the intervals take to be common, for each of the others.
void describe_shared(const std::vector<ResultFolder>& folders, Comparison& comparison) {
  bool has_interval = false;
  for (std::size_t i = 1; i < folders.size(); ++i) {
    const SharedInputs shared = find_shared(folders.front(), folders[i]);
    InputNames names;
    for (const ComparedValue& value : comparison.values) {
      const Json* reference = find_budget(folders.front(), value.name);
      const Json* other = find_budget(folders[i], value.name);
      if (reference == nullptr || other == nullptr) continue;
      const InputNames own = name_inputs(*reference, *other, shared);
      const auto add = [](const std::vector<std::string>& from, std::vector<std::string>& to) {
        for (const std::string& name : from) {
          if (std::find(to.begin(), to.end(), name) == to.end()) to.push_back(name);
        }
      };
      add(own.common, names.common);
      add(own.independent, names.independent);
      has_interval = true;
    }
    if (names.common.empty() && names.independent.empty()) continue;
    const std::string why = shared.is_same_run       ? "one run, in two copies"
                            : shared.has_one_machine ? "the machine is the same"
                                                     : "the machines differ";
    comparison.method.push_back(fmt::format("{} and {}: {}. Taken to be common: {}. Independent: {}",
                                            comparison.names.front(), comparison.names[i], why,
                                            join_names(names.common), join_names(names.independent)));
  }
  if (!has_interval) {
    comparison.method.push_back(
        "no difference has an interval: both results need an uncertainty budget, from rollrig run --uncertainty");
    return;
  }
  comparison.method.insert(comparison.method.begin(),
                           "intervals of 95 % from the uncertainty budgets of both results (GUM 5.2.2): a common error "
                           "cancels as far as both results depend on it alike, errors of each add up");
}

/// Whether a row is of the next phase, which has the name of this one.
bool is_of_next(const OverlaidRun& run, std::size_t phase, std::size_t row) {
  constexpr double kSlack_s = 1e-6;
  return phase + 1 < run.phases.size() && run.phases[phase + 1].name == run.phases[phase].name &&
         run.time_s[row] > run.phases[phase].end_s + kSlack_s;
}

OverlaidRun read_overlaid(const ResultFolder& folder) {
  OverlaidRun run;
  const CsvTable& table = folder.recording;
  run.time_s = table.plain_numbers("time_s", {});
  const std::vector<std::string> phases = table.text("phase");
  for (const Json& phase : folder.result.value("phases", Json::array())) {
    run.phases.push_back({phase.at("name"), phase.at("start_s"), phase.at("end_s")});
  }
  std::size_t at = 0;
  for (std::size_t row = 0; row < phases.size(); ++row) {
    while (at < run.phases.size() && (run.phases[at].name != phases[row] || is_of_next(run, at, row))) ++at;
    if (at == run.phases.size())
      throw table.cell_error(row, "phase", "no phase of result.json", "its phases, in order");
    run.phase.push_back(at);
  }
  for (const std::string& column : table.columns()) {
    if (column == "time_s" || column == "phase") continue;
    run.channels.emplace_back(column, table.plain_numbers(column, {}));
  }
  return run;
}

void add_waterfalls(const std::vector<ResultFolder>& folders, Comparison& comparison) {
  const auto find_terms = [](const ResultFolder& folder) {
    return folder.result.at("energy").value("terms_J", Json::object());
  };
  for (std::size_t i = 1; i < folders.size(); ++i) {
    const std::optional<EnergyWaterfall> waterfall =
        make_waterfall(find_terms(folders.front()), find_terms(folders[i]), comparison.names[i]);
    if (waterfall.has_value()) comparison.waterfalls.push_back(*waterfall);
  }
}

/// Whether a result is that of a headline, such as "economy.combined.range_km" of "economy.last.range_km".
bool is_headline(const std::string& result, const std::string& headline) {
  const std::size_t place = headline.find(".last.");
  if (place == std::string::npos) return result == headline;
  const std::string list = headline.substr(0, place + 1);
  const std::string member = headline.substr(place + 5);
  return result.size() > list.size() + member.size() && result.compare(0, list.size(), list) == 0 &&
         result.compare(result.size() - member.size(), member.size(), member) == 0;
}

/// The result that matters most: an RRc, else the first headline of the scenario, else one with an interval, else the
/// one that differs most by its size.
void choose_main_result(const scenarios::Scenario* scenario, Compared& compared) {
  const std::vector<ComparedValue>& values = compared.comparison.values;
  const auto differs = [](const ComparedValue& value) { return value.differences.front().value.has_value(); };
  const bool has_main =
      std::any_of(values.begin(), values.end(), [](const ComparedValue& value) { return value.name == kMainResult; });
  if (scenario != nullptr && !has_main) {
    for (const auto& headline : scenario->headlines) {
      for (std::size_t i = values.size(); i-- > 0;) {  // the last record of a list
        if (is_headline(values[i].name, headline.first) && differs(values[i])) return choose_main(i, compared);
      }
    }
  }
  const auto weigh = [](const ComparedValue& value) {
    const Difference& first = value.differences.front();
    return std::make_tuple(value.name == kMainResult, first.sd.has_value(), std::abs(first.percent.value_or(0.0)));
  };
  std::optional<std::size_t> chosen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!differs(values[i]) || values[i].unit == "s") continue;
    if (!chosen.has_value() || weigh(values[i]) > weigh(values[*chosen])) chosen = i;
  }
  if (chosen.has_value()) choose_main(*chosen, compared);
}

Compared compare_folders(const std::vector<ResultFolder>& folders, const std::vector<std::string>& names) {
  Compared compared;
  Comparison& comparison = compared.comparison;
  comparison.kind = ComparedKind::kResults;
  comparison.names = names;
  std::vector<const Json*> manifests;
  std::vector<Json> results;
  for (const ResultFolder& folder : folders) {
    manifests.push_back(&folder.manifest);
    results.push_back(folder.result.at("result"));
  }
  comparison.inputs = find_different_inputs(manifests, {"format", "rollrig", "integrator"});
  std::vector<Json> flat = scenarios::flatten_results(results);
  add_budget_values(folders, flat);
  const scenarios::Scenario* scenario =
      scenarios::find_scenario_if_any(folders.front().result.at("scenario").get<std::string>());
  for (const std::string& key : list_keys(flat)) comparison.values.push_back(make_value(key, flat, scenario));
  add_intervals(folders, comparison);
  describe_shared(folders, comparison);
  add_waterfalls(folders, comparison);
  choose_main_result(scenario, compared);
  std::vector<OverlaidRun> runs;
  for (const ResultFolder& folder : folders) runs.push_back(read_overlaid(folder));
  compared.overlays.push_back(overlay_runs(runs, names, "", comparison.warnings));
  return compared;
}

}  // namespace

Compared compare_results(const std::vector<std::string>& paths, const std::vector<std::string>& names) {
  std::vector<ResultFolder> folders;
  for (const std::string& path : paths) {
    folders.push_back(read_result_folder(path));
    require_whole(folders.back());
  }
  try {
    require_one_scenario(folders);
    return compare_folders(folders, names);
  } catch (const nlohmann::json::exception& error) {
    throw InputError({fmt::format("a result was changed or is damaged: {}", error.what()),
                      fmt::format("{}", fmt::join(paths, ", ")), 0, "", "", "files as rollrig run --out writes them",
                      ""});
  }
}

}  // namespace rollrig::comparison
