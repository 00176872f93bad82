#include "rollrig/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "api/data.h"
#include "api/option_range.h"
#include "comparison/compare_results.h"
#include "comparison/compare_sets.h"
#include "comparison/compare_tires.h"
#include "comparison/comparison_json.h"
#include "comparison/result_folder.h"
#include "report/comparison_page.h"
#include "rollrig/assets.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kWhatIsCompared =
    "folders of results (result.json), measurement sets (set.toml), or tires (a name or a .toml file)";

InputError compare_error(const std::string& what, const std::string& value, const std::string& allowed,
                         const std::string& nearest = "") {
  return InputError({what, "command line", 0, "compared", value, allowed, nearest});
}

bool is_set_file(const std::string& given) { return fs::path(given).filename() == "set.toml"; }

/// What a folder, file or name stands for. Throws InputError.
ComparedKind recognize(const std::string& given) {
  if (given.empty()) throw compare_error("the name of what is compared is empty", given, kWhatIsCompared);
  if (is_there(given) && fs::is_directory(given)) {
    if (comparison::holds_result(given)) return ComparedKind::kResults;
    if (is_there((fs::path(given) / "set.toml").string())) return ComparedKind::kSets;
    throw compare_error(fmt::format("'{}' is a folder without result.json and set.toml", given), given,
                        kWhatIsCompared);
  }
  if (is_set_file(given) && is_there(given)) return ComparedKind::kSets;
  if (is_file_name(given)) {
    if (fs::path(given).extension() == ".toml") return ComparedKind::kTires;
    throw compare_error(fmt::format("'{}' is no folder and no .toml file", given), given, kWhatIsCompared,
                        nearest_file(given));
  }
  const std::vector<std::string> tires = list_assets("tires");
  if (std::find(tires.begin(), tires.end(), given) != tires.end()) return ComparedKind::kTires;
  throw compare_error(fmt::format("'{}' is no folder and no tire", given), given,
                      fmt::format("{}. Tires: {}", kWhatIsCompared, fmt::join(tires, ", ")),
                      nearest_name(given, tires));
}

/// Where the content is: the file of a tire, the folder of results or of a set.
fs::path find_place(const std::string& given, ComparedKind kind) {
  if (kind == ComparedKind::kTires) return fs::path(find_asset("tires", given));
  return is_set_file(given) ? fs::absolute(given).parent_path() : fs::path(given);
}

ComparedKind require_one_kind(const CompareInput& input) {
  if (input.compared.size() < 2) {
    throw compare_error("there is nothing to compare with", input.compared.empty() ? "" : input.compared.front(),
                        "two or more of one kind: " + std::string(kWhatIsCompared));
  }
  const ComparedKind kind = recognize(input.compared.front());
  for (const std::string& given : input.compared) {
    const ComparedKind own = recognize(given);
    if (own == kind) continue;
    throw compare_error(fmt::format("'{}' cannot be compared with '{}': they are {} and {}", given,
                                    input.compared.front(), comparison::name_of(own), comparison::name_of(kind)),
                        given, "all of one kind: " + std::string(kWhatIsCompared));
  }
  if (kind != ComparedKind::kTires && !input.scenario.empty()) {
    throw InputError({fmt::format("a virtual test is of tires, and these are {}", comparison::name_of(kind)),
                      "command line", 0, "--scenario", input.scenario, "--scenario with tires alone", ""});
  }
  return kind;
}

void require_each_once(const CompareInput& input, ComparedKind kind) {
  for (auto given = input.compared.begin(); given != input.compared.end(); ++given) {
    for (auto other = input.compared.begin(); other != given; ++other) {
      std::error_code none;
      if (!fs::equivalent(find_place(*given, kind), find_place(*other, kind), none)) continue;
      throw compare_error(fmt::format("'{}' and '{}' are the same", *other, *given), *given, "each once");
    }
  }
}

/// Short names that are all different: the last part of a path where that suffices.
std::vector<std::string> name_compared(const std::vector<std::string>& given) {
  std::vector<std::string> names;
  for (const std::string& one : given) {
    fs::path path = fs::path(one).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (path.filename() == "set.toml") path = fs::absolute(path).parent_path();
    if (path.filename() == "." || path.filename() == "..") path = fs::weakly_canonical(fs::absolute(path));
    names.push_back(path.extension() == ".toml" ? path.stem().string() : path.filename().string());
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    if (std::count(names.begin(), names.end(), name) == 1) continue;
    for (std::size_t j = 0; j < names.size(); ++j) {
      if (names[j] == name) names[j] = given[j];
    }
  }
  return names;
}

comparison::Compared compare_tire_files(const CompareInput& input, const std::vector<std::string>& names,
                                        const Progress& progress) {
  std::vector<std::string> scenarios{"iso_28580"};
  if (!input.scenario.empty() && input.scenario != scenarios.front()) scenarios.push_back(input.scenario);
  std::vector<comparison::VirtualTest> tests;
  std::vector<models::TireFile> tires;
  for (const std::string& scenario : scenarios) {
    tests.push_back({scenario, {}});
    for (const std::string& tire : input.compared) {
      RunInput run;
      run.scenario_or_file = scenario;
      run.tire = tire;
      scenarios::RunSpec spec = read_run(run);
      const auto& fidelities = spec.scenario->fidelities;
      if (std::find(fidelities.begin(), fidelities.end(), scenarios::Fidelity::kQuasiStatic) != fidelities.end()) {
        spec.fidelity = scenarios::Fidelity::kQuasiStatic;
      }
      spec.sensors.reset();
      scenarios::prepare_run(spec);  // says what is wrong before the first runs
      if (tests.size() == 1) tires.push_back(spec.tire);
      tests.back().runs.push_back(std::move(spec));
    }
  }
  return comparison::compare_tires(tires, tests, names, input.threads, [&progress](double done) {
    if (progress) progress(done, "");
  });
}

comparison::Compared compare_all(const CompareInput& input, ComparedKind kind, const Progress& progress) {
  const std::vector<std::string> names = name_compared(input.compared);
  if (kind == ComparedKind::kResults) return comparison::compare_results(input.compared, names);
  if (kind == ComparedKind::kTires) return compare_tire_files(input, names, progress);
  std::vector<measurements::MeasurementSet> sets;
  for (const std::string& folder : input.compared) {
    sets.push_back(measurements::read_measurement_set(folder, input.bad_rows));
  }
  return comparison::compare_sets(sets, names);
}

std::string make_comparison_text(const Comparison& comparison) {
  std::string text =
      fmt::format("compare   {}: {}\n", comparison::name_of(comparison.kind), fmt::join(comparison.names, ", "));
  if (!comparison.message.empty()) text += wrap(comparison.message, 2);
  text += format_tables(report::make_comparison_tables(comparison));
  for (const EnergyWaterfall& waterfall : comparison.waterfalls) {
    if (waterfall.missing.empty()) continue;
    text += wrap(
        fmt::format("terms that one of the two does not have count as 0: {}", fmt::join(waterfall.missing, ", ")), 2);
  }
  for (const std::string& sentence : comparison.method) text += wrap(sentence, 2);
  for (const std::string& reason : report::list_interval_reasons(comparison)) text += wrap(reason, 2);
  return text + format_warnings(comparison.warnings);
}

}  // namespace

Comparison compare(const CompareInput& input, const Progress& progress) {
  require_threads(input.threads);
  const ComparedKind kind = require_one_kind(input);
  require_each_once(input, kind);
  const auto compared = std::make_shared<const comparison::Compared>(compare_all(input, kind, progress));
  Comparison result = compared->comparison;
  result.text = make_comparison_text(result);
  result.json = to_text(comparison::make_comparison_json(result));
  result.make_files = [compared, json = result.json] {
    return FolderFiles{{"comparison.json", json},
                       {"differences.csv", comparison::make_differences_csv(compared->comparison)}};
  };
  result.make_page = [compared] { return report::make_html(report::make_comparison_page(*compared)); };
  return result;
}

}  // namespace rollrig
