#include "api/regression_items.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "scenarios/run/golden.h"
#include "scenarios/run/run_spec.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

std::string find_run_file(const std::string& folder, const std::string& run) {
  return (fs::path(folder) / (run + ".toml")).string();
}

scenarios::RunSpec read_run_file(const std::string& folder, const std::string& run) {
  return scenarios::read_run_spec(read_config(find_run_file(folder, run)), folder);
}

/// Files that a run reads, with its golden, as far as they can be read.
Json hash_files_of(const std::string& folder, const std::string& run) {
  const ReadRecorder recorder;
  try {
    scenarios::prepare_run(read_run_file(folder, run));
  } catch (const InputError&) {  // the result of this item says it
  } catch (const RunFailure&) {
  }
  note_as_read(find_golden_file(folder, run));
  Json files = Json::array();
  for (const std::string& file : recorder.list_files()) {
    try {
      files.push_back({{"path", file}, {"sha256", calc_sha256(read_binary_file(file))}});
    } catch (const FileProblem&) {
    }
  }
  return files;
}

/// A number as JSON has it, which knows none that is not finite.
Json write_number(double number) { return std::isfinite(number) ? Json(number) : Json(fmt::format("{}", number)); }
double read_number(const Json& json) {
  return json.is_string() ? std::stod(json.get<std::string>()) : json.get<double>();
}

/// One bad file must not hide how the others fare: it is a status of its run.
void regress_run(const std::string& folder, RegressedRun& run) {
  const std::string golden_file = find_golden_file(folder, run.name);
  try {
    run.status = "bad run file";  // if reading it throws
    const scenarios::RunSpec spec = read_run_file(folder, run.name);
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

}  // namespace

std::string find_golden_file(const std::string& folder, const std::string& run) {
  return (fs::path(folder) / (run + ".golden.csv")).string();
}

RegressionItems::RegressionItems(std::string folder, std::vector<std::string> runs) : folder_(std::move(folder)) {
  for (std::string& run : runs) {
    Json files = hash_files_of(folder_, run);
    runs_.push_back({std::move(run), std::move(files)});
  }
}

Json RegressionItems::describe(std::size_t item) const {
  return {{"run", runs_[item].name}, {"files", runs_[item].files}};
}

Json RegressionItems::carry_out(std::size_t item, std::uint64_t) const {
  RegressedRun run{{}, runs_[item].name};
  regress_run(folder_, run);
  return {{"status", run.status},
          {"golden", run.golden},
          {"compared", run.compared},
          {"problems", run.problems},
          {"worst_quantity", run.worst_quantity},
          {"worst_share", write_number(run.worst_share)}};
}

RegressedRun read_comparison(const std::string& name, const std::string& result) {
  RegressedRun run{{}, name};
  const Json stored = parse_json(result, fmt::format("result of {}", name));
  stored.at("status").get_to(run.status);
  stored.at("golden").get_to(run.golden);
  stored.at("compared").get_to(run.compared);
  stored.at("problems").get_to(run.problems);
  stored.at("worst_quantity").get_to(run.worst_quantity);
  run.worst_share = read_number(stored.at("worst_share"));
  return run;
}

}  // namespace rollrig
