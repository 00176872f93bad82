#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "cli/command.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "report/list_pages.h"
#include "report/text.h"
#include "scenarios/run/golden.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct Options {
  std::string folder;
  OutputOptions output;
  int threads = 0;
  bool update = false;
};

struct Case {
  std::string name;
  std::string run_file;
  std::string golden_file;
  std::string golden_text;  // as it would be written now
  std::string status;       // "same", "differs", "no golden", "bad golden", "bad run file", "failed", "updated"
  scenarios::GoldenComparison comparison;
};

std::vector<Case> find_cases(const std::string& folder) {
  std::vector<Case> cases;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    if (entry.path().extension() != ".toml") continue;
    Case found;
    found.name = entry.path().stem().string();
    found.run_file = entry.path().string();
    found.golden_file = (entry.path().parent_path() / (found.name + ".golden.csv")).string();
    cases.push_back(found);
  }
  if (cases.empty()) {
    throw InputError(
        {fmt::format("no run files in '{}'", folder), folder, 0, "", "", "a folder with run files (.toml)", ""});
  }
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

void set_problem(Case& each, const char* status, const std::exception& error) {
  each.status = status;
  each.comparison.problems = {error.what()};
}

void compare_case(Case& each, std::vector<scenarios::GoldenValue>& now) {
  if (!fs::exists(each.golden_file)) {
    each.status = "no golden";
    return;
  }
  try {
    const std::vector<scenarios::GoldenValue> golden = scenarios::read_golden(each.golden_file);
    scenarios::keep_tolerances(golden, now);
    each.comparison = scenarios::compare_with_golden(golden, now);
    each.status = each.comparison.problems.empty() ? "same" : "differs";
  } catch (const InputError& error) {
    set_problem(each, "bad golden", error);
  }
}

/// One bad file must not hide how the others fare: it is a status of its case.
void run_case(Case& each) {
  try {
    const scenarios::RunSpec spec =
        scenarios::read_run_spec(read_config(each.run_file), fs::path(each.run_file).parent_path().string());
    std::vector<scenarios::GoldenValue> now = scenarios::make_golden(scenarios::run_scenario(spec, {}));
    compare_case(each, now);
    each.golden_text = scenarios::write_golden(now);
  } catch (const RunFailure& failure) {
    set_problem(each, "failed", failure);
  } catch (const InputError& error) {
    set_problem(each, "bad run file", error);
  }
}

/// Goldens whose run file is gone are listed, lest a renamed run goes unchecked.
void add_orphans(const std::string& folder, std::vector<Case>& cases) {
  constexpr const char* kGolden = ".golden.csv";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    const std::size_t at = file.find(kGolden);
    if (at == std::string::npos) continue;
    const std::string name = file.substr(0, at);
    if (std::any_of(cases.begin(), cases.end(), [&](const Case& each) { return each.name == name; })) continue;
    Case orphan;
    orphan.name = name;
    orphan.status = "no run file";
    cases.push_back(orphan);
  }
}

/// Writes new goldens where wanted; the exit status of the whole.
int settle_cases(std::vector<Case>& cases, bool update) {
  int status = kDone;
  for (Case& each : cases) {
    if (update && !each.golden_text.empty() && each.status != "same") {
      write_file_atomically(each.golden_file, each.golden_text);
      each.status = "updated";
    }
    if (each.status == "same" || each.status == "updated") continue;
    status = std::max<int>(status, each.status.rfind("bad", 0) == 0 ? kInputError : kDiffers);
  }
  return status;
}

std::string format_cases(const std::vector<Case>& cases) {
  scenarios::ResultTable table{"", {"run", "status", "values", "worst, share of tolerance"}, {}};
  for (const Case& each : cases) {
    const std::string worst =
        each.comparison.worst_quantity.empty() ? "-" : fmt::format("{:.2g}", each.comparison.worst_share);
    table.rows.push_back({each.name, each.status, fmt::format("{}", each.comparison.compared), worst});
  }
  std::string text = report::format_table(table);
  constexpr std::size_t kShownProblems = 5;
  for (const Case& each : cases) {
    if (each.status == "same" || each.comparison.problems.empty()) continue;
    text += each.name + "\n";
    for (std::size_t i = 0; i < std::min(kShownProblems, each.comparison.problems.size()); ++i) {
      text += wrap(each.comparison.problems[i], 4);
    }
    if (each.comparison.problems.size() > kShownProblems) {
      text += fmt::format("    and {} more\n", each.comparison.problems.size() - kShownProblems);
    }
  }
  return text;
}

Json cases_to_json(const std::vector<Case>& cases) {
  Json json = {{"format", "rollrig-regression/1"}, {"runs", Json::array()}};
  for (const Case& each : cases) {
    json["runs"].push_back({{"name", each.name},
                            {"status", each.status},
                            {"compared", each.comparison.compared},
                            {"worst_share_of_tolerance", each.comparison.worst_share},
                            {"worst", each.comparison.worst_quantity},
                            {"problems", each.comparison.problems}});
  }
  return json;
}

int regress_command(const Options& options) {
  const std::string folder =
      options.folder.empty() ? (fs::path(find_assets_folder()) / "regression").string() : options.folder;
  std::vector<Case> cases = find_cases(folder);
  Output output(options.output);
  {
    ProgressLine progress("regress", options.output.quiet);
    std::atomic<std::size_t> done{0};
    parallel_for(cases.size(), options.threads, [&](std::size_t i) {
      run_case(cases[i]);
      progress.update(static_cast<double>(++done) / static_cast<double>(cases.size()));
    });
  }
  add_orphans(folder, cases);
  output.require_no_input();
  const int status = settle_cases(cases, options.update);
  const Json json = cases_to_json(cases);
  output.write({"", to_text(json), {}, [&json] { return report::make_html(report::make_regress_page(json)); }});
  output.print(format_cases(cases));
  return status;
}

}  // namespace

void add_regress_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<Options>(
      app, action, "regress", "Rerun all regression scenarios against their goldens", &regress_command);
  command->add_option("folder", options->folder, "Folder of run files [assets/regression]");
  command->add_flag("--update", options->update, "Write new goldens where results differ");
  command->add_option("--threads", options->threads, "Threads [as many as the machine has]")
      ->check(CLI::Range(1, 1024));
  options->output.add_to(*command, "File for the comparison, - for standard output");
}

}  // namespace rollrig::cli
