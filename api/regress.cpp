#include "rollrig/regress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "report/list_pages.h"
#include "scenarios/run/golden.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

/// Names of the files in `folder` that end in `ending`, without it, sorted.
std::vector<std::string> list_names(const std::string& folder, const std::string& ending) {
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string file = entry.path().filename().string();
    if (file.size() < ending.size() || file.substr(file.size() - ending.size()) != ending) continue;
    names.push_back(file.substr(0, file.size() - ending.size()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string find_golden_file(const std::string& folder, const RegressedRun& run) {
  return (fs::path(folder) / (run.name + ".golden.csv")).string();
}

/// One bad file must not hide how the others fare: it is a status of its run.
void regress_run(const std::string& folder, RegressedRun& run) {
  const std::string golden_file = find_golden_file(folder, run);
  try {
    run.status = "bad run file";  // if reading it throws
    const ConfigTable document = read_config((fs::path(folder) / (run.name + ".toml")).string());
    const scenarios::RunSpec spec = scenarios::read_run_spec(document, folder);
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    to_text(outcome.result);  // throws where a result is no number
    std::vector<scenarios::GoldenValue> now = scenarios::make_golden(outcome);
    run.golden = scenarios::write_golden(now);
    run.status = fs::exists(golden_file) ? "bad golden" : "no golden";  // likewise
    if (run.status == "no golden") {
      run.problems = {fmt::format("there is no {}; --update writes it", golden_file)};
      return;
    }
    const std::vector<scenarios::GoldenValue> golden = scenarios::read_golden(golden_file);
    scenarios::keep_tolerances(golden, now);
    run.golden = scenarios::write_golden(now);
    static_cast<GoldenComparison&>(run) = scenarios::compare_with_golden(golden, now);
    run.status = run.problems.empty() ? "same" : "differs";
  } catch (const RunFailure& failure) {
    run.status = "failed";
    run.problems = {failure.what()};
  } catch (const InputError& error) {
    run.problems = {error.what()};
  }
}

/// The first of what differs in each run.
std::string format_problems(const std::vector<RegressedRun>& runs) {
  std::string text;
  for (const RegressedRun& run : runs) {
    if (run.status == "same" || run.problems.empty()) continue;
    text += run.name + "\n";
    const std::size_t shown = std::min<std::size_t>(5, run.problems.size());
    for (std::size_t i = 0; i < shown; ++i) text += wrap(run.problems[i], 4);
    if (run.problems.size() > shown) text += fmt::format("    and {} more\n", run.problems.size() - shown);
  }
  return text;
}

/// Makes text, JSON and page agree with the runs.
void make_report(Regression& found) {
  Json json = {{"format", "rollrig-regression/1"}, {"runs", Json::array()}};
  for (const RegressedRun& run : found.runs) {
    json["runs"].push_back(
        {{"name", run.name},
         {"status", run.status},
         {"compared", run.compared},
         {"worst_share_of_tolerance", std::isfinite(run.worst_share) ? Json(run.worst_share) : Json()},
         {"worst", run.worst_quantity},
         {"problems", run.problems}});
  }
  found.text = format_table(report::make_regress_table(json)) + format_problems(found.runs);
  found.json = to_text(json);
  found.make_page = [json] { return report::make_html(report::make_regress_page(json)); };
}

}  // namespace

Regression regress(const std::string& folder, const RegressionOptions& options) {
  Regression found;
  found.folder = folder.empty() ? (fs::path(find_assets_folder()) / "regression").string() : folder;
  for (const std::string& name : list_names(found.folder, ".toml")) found.runs.push_back({{}, name});
  if (found.runs.empty()) {
    throw InputError({fmt::format("no run files in '{}'", found.folder), found.folder, 0, "", "",
                      "a folder with run files (.toml)", ""});
  }
  parallel_for(
      found.runs.size(), options.threads, [&](std::size_t i) { regress_run(found.folder, found.runs[i]); },
      [&](double share) {
        if (options.progress) options.progress(share, "");
      });
  // A golden without a run file is listed, lest a renamed run goes unchecked.
  for (const std::string& name : list_names(found.folder, ".golden.csv")) {
    const std::string run_file = (fs::path(found.folder) / (name + ".toml")).string();
    if (fs::exists(run_file)) continue;
    RegressedRun& run = found.runs.emplace_back(RegressedRun{{}, name, "no run file"});
    run.problems = {fmt::format("{} has no run file {}", find_golden_file(found.folder, run), run_file)};
  }
  make_report(found);
  return found;
}

Regression update_goldens(Regression found) {
  for (RegressedRun& run : found.runs) {
    if (run.golden.empty() || run.status == "same") continue;
    throw_if_interrupted();
    write_file_atomically(find_golden_file(found.folder, run), run.golden);
    if (run.status == "no golden") run.problems.clear();  // else they say what was updated
    run.status = "updated";
  }
  make_report(found);
  return found;
}

}  // namespace rollrig
