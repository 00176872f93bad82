#include "rollrig/regress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "api/option_range.h"
#include "api/regression_items.h"
#include "campaigns/items.h"
#include "report/list_pages.h"
#include "rollrig/version.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

/// Names of the files in `folder` that end in `ending`, without it, sorted; none where it is no folder. Throws
/// InputError for a folder that cannot be read.
std::vector<std::string> list_names(const std::string& folder, const std::string& ending) {
  std::vector<std::string> names;
  std::error_code code;
  const fs::directory_iterator entries(folder, code);
  if (code && code != std::errc::no_such_file_or_directory && code != std::errc::not_a_directory) {
    throw InputError({fmt::format("cannot read '{}': {}", folder, code.message()), folder, 0, "", "",
                      "a folder that can be read and searched", ""});
  }
  for (const auto& entry : entries) {
    const std::string file = entry.path().filename().string();
    if (file.size() < ending.size() || file.substr(file.size() - ending.size()) != ending) continue;
    names.push_back(file.substr(0, file.size() - ending.size()));
  }
  std::sort(names.begin(), names.end());
  return names;
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

/// All runs, compared with their goldens, in the order of their names.
std::vector<RegressedRun> carry_out_runs(const std::string& folder, const std::vector<std::string>& names,
                                         const RegressionOptions& options) {
  const RegressionItems items(folder, names);
  const campaigns::CampaignFolder nowhere{"", library_version(), 0};  // the results go into no file
  std::vector<RegressedRun> runs(items.count());
  const auto add = [&](const campaigns::Record& record) {
    runs[record.item] = read_comparison(names[record.item], record.result);
  };
  campaigns::carry_out_all(items, nowhere, options.threads, add, [&](double share) {
    if (options.progress) options.progress(share, "");
  });
  return runs;
}

}  // namespace

Regression regress(const std::string& folder, const RegressionOptions& options) {
  require_threads(options.threads);
  Regression found;
  found.folder = folder.empty() ? (fs::path(find_assets_folder()) / "regression").string() : folder;
  const std::vector<std::string> names = list_names(found.folder, ".toml");
  if (names.empty()) {
    throw InputError({fmt::format("no run files in '{}'", found.folder), found.folder, 0, "", "",
                      "a folder with run files (.toml)", ""});
  }
  found.runs = carry_out_runs(found.folder, names, options);
  // A golden without a run file is listed, lest a renamed run goes unchecked.
  for (const std::string& name : list_names(found.folder, ".golden.csv")) {
    const std::string run_file = (fs::path(found.folder) / (name + ".toml")).string();
    if (fs::exists(run_file)) continue;
    RegressedRun& run = found.runs.emplace_back(RegressedRun{{}, name, "no run file"});
    run.problems = {fmt::format("{} has no run file {}", find_golden_file(found.folder, run.name), run_file)};
  }
  make_report(found);
  return found;
}

Regression update_goldens(Regression found) {
  std::vector<StagedOutput> staged;  // all, before any takes its place: an error or Ctrl-C changes no golden
  for (RegressedRun& run : found.runs) {
    if (run.golden.empty() || run.status == "same") continue;
    throw_if_interrupted();
    staged.emplace_back(find_golden_file(found.folder, run.name), run.golden);
    if (run.status == "no golden") run.problems.clear();  // else they say what was updated
    run.status = "updated";
  }
  for (StagedOutput& golden : staged) golden.commit();
  make_report(found);
  return found;
}

}  // namespace rollrig
