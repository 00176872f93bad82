#include "rollrig/run_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "api/campaign_definition.h"
#include "api/item_table.h"
#include "api/run_items.h"
#include "api/sensitivity.h"
#include "campaigns/items.h"
#include "campaigns/store.h"
#include "exports/tree.h"
#include "report/sensitivity_page.h"
#include "sim/core/columns.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/shell_word.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kFileName = "campaign.json";

campaigns::Part to_part(const CampaignPart& part) { return {part.number, part.count}; }
CampaignPart from_part(const campaigns::Part& part) { return {part.number, part.count}; }

RunCampaignState make_state(const campaigns::Tally& tally, const std::string& of,
                            const std::vector<std::string>& running = {}) {
  RunCampaignState state;
  state.items = tally.items;
  state.done = tally.done;
  state.failed = tally.failed;
  state.json = to_text(Json{{"format", "rollrig-campaign-state/1"},
                            {"items", tally.items},
                            {"done", tally.done},
                            {"failed", tally.failed},
                            {"processes", running.size()}}) +
               "\n";
  state.text = wrap(
      fmt::format("{}: {} of {} done{}{}", of, tally.done, format_count(tally.items, "item"),
                  tally.failed > 0 ? fmt::format(", {} of them failed", tally.failed) : "",
                  running.empty()
                      ? ""
                      : fmt::format(", {} at work",
                                    running.size() == 1 ? "1 process" : fmt::format("{} processes", running.size()))),
      0);
  return state;
}

}  // namespace

struct RunCampaign::Data {
  CampaignDefinition definition;
  RunItems items;
  campaigns::CampaignFolder folder;

  std::string path_of_definition() const { return (fs::path(folder.path) / kFileName).string(); }
  std::vector<std::string> list_filled_files() const {
    const std::vector<std::string> files = folder.list_files();
    if (!files.empty()) return files;
    throw InputError({"the campaign has no results yet", folder.path, 0, "", "", "rollrig campaign run first", ""});
  }

  ItemTable read_table() const { return read_item_table(list_filled_files(), folder.definition, items); }
};

CampaignPart read_campaign_part(const std::string& text) { return from_part(campaigns::read_part(text)); }

std::optional<CampaignPart> find_campaign_part() {
  const auto part = campaigns::find_part([](const char* name) -> const char* { return std::getenv(name); });
  if (!part.has_value()) return std::nullopt;
  return from_part(*part);
}

void define_run_campaign(const RunCampaignInput& input, const std::string& folder) {
  std::error_code none;
  if (fs::exists(folder, none) && !fs::is_empty(folder, none)) {
    throw InputError({fmt::format("'{}' is there already and holds files", folder), "command line", 0, "folder", folder,
                      "a new or an empty folder", ""});
  }
  CampaignDefinition definition = make_definition(input);
  definition.files = RunItems(definition).check();
  write_folder(folder, {{kFileName, definition.to_text()}});
}

RunCampaign::RunCampaign(const std::string& folder) {
  const std::string path = (fs::path(folder) / kFileName).string();
  if (!is_there(path)) {
    throw InputError({fmt::format("'{}' is no folder of a campaign", folder), "command line", 0, "folder", folder,
                      fmt::format("a folder with a {}, which rollrig campaign new makes", kFileName), ""});
  }
  const std::string content = read_text_file(path);
  const CampaignDefinition definition = CampaignDefinition::read(content, path);
  try {
    data_ = std::make_shared<Data>(Data{definition, RunItems(definition), {folder, content, definition.design.seed}});
  } catch (const InputError& error) {  // of a design that somebody has changed by hand
    InputProblem problem = error.problem();
    problem.file = path;
    throw InputError(problem);
  }
}

RunCampaignState RunCampaign::carry_out(const CampaignPart& part, int threads, const Progress& progress) const {
  require_same_version(data_->definition, data_->path_of_definition());
  RunItems items(data_->definition);
  items.watch_files(data_->definition.files);
  items.check();
  const auto advance = [&progress](double done) {
    if (progress) progress(done, "");
  };
  const campaigns::Tally tally = campaigns::carry_out_items(items, data_->folder, to_part(part), threads, advance);
  const std::string of = part.count == 1
                             ? data_->folder.path
                             : fmt::format("{}, part {} of {}", data_->folder.path, part.number, part.count);
  return make_state(tally, of);
}

RunCampaignState RunCampaign::read_state() const {
  const campaigns::FolderState state = campaigns::read_state(data_->folder, data_->items.count());
  return make_state(state.tally, data_->folder.path, state.running);
}

RunCampaignState RunCampaign::merge() const {
  const std::vector<std::string> files = data_->list_filled_files();
  const std::string merged = (fs::path(data_->folder.path) / "results.sqlite").string();
  if (files == std::vector<std::string>{merged}) return read_state();
  // What an earlier merge that was cut short has left there are records of this campaign, too.
  const std::string partial = merged + ".partial";
  std::vector<bool> is_merged(data_->items.count());
  campaigns::Store store(partial, data_->folder.definition);  // which only one merge at a time can open
  campaigns::read_records(files, data_->folder.definition, [&](const campaigns::Record& record) {
    store.write(record);
    if (record.item < is_merged.size()) is_merged[record.item] = true;
  });
  store.close();
  fs::rename(partial, merged);
  const auto has = [&is_merged](std::size_t item) { return item < is_merged.size() && is_merged[item]; };
  for (const std::string& file : files) {
    if (file != merged) campaigns::remove_if_contained(file, data_->folder.definition, has);
  }
  return read_state();
}

std::string RunCampaign::make_csv() const {
  const ItemTable table = data_->read_table();
  std::vector<std::string> columns{"item"};
  for (const campaigns::Factor& factor : data_->definition.design.factors) columns.push_back(factor.key);
  columns.insert(columns.end(), table.results.begin(), table.results.end());
  if (table.has_failures()) columns.emplace_back("failure");
  CsvWriter csv(columns);
  for (std::size_t row = 0; row < table.items.size(); ++row) {
    csv.add(std::to_string(table.items[row] + 1));
    for (const std::string& value : table.values[row]) csv.add(value);
    for (const std::vector<double>& column : table.numbers) csv.add(CsvWriter::Rounded{column[row], 12});
    if (table.has_failures()) csv.add(table.failures[row]);
    csv.end_row();
  }
  return csv.take();
}

Export RunCampaign::make_export() const {
  const auto tree = std::make_shared<exports::Group>();
  const ItemTable table = data_->read_table();
  exports::Group rows;
  rows.is_table = true;
  exports::Column numbers;
  for (const std::size_t item : table.items) numbers.push_back(static_cast<double>(item + 1));
  rows.add("item", {numbers});
  const std::vector<campaigns::Factor>& factors = data_->definition.design.factors;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    exports::Texts texts;
    exports::Column values;
    for (const std::vector<std::string>& of_item : table.values) {
      texts.push_back(of_item[f]);
      if (const auto number = parse_number(texts.back())) values.push_back(*number);
    }
    if (values.size() == texts.size()) {
      rows.add(factors[f].key, {values});
    } else {
      rows.add(factors[f].key, {texts});
    }
  }
  for (std::size_t r = 0; r < table.results.size(); ++r) rows.add(table.results[r], {table.numbers[r]});
  if (table.has_failures()) rows.add("failure", {table.failures});
  tree->add("format", {std::string("rollrig-campaign-export/1")});
  tree->add("items", {rows});
  tree->add("definition", {data_->folder.definition});
  return {[tree] { return exports::make_mat(*tree); }, [tree] { return exports::make_hdf5(*tree); }};
}

Report RunCampaign::calc_sensitivity(const std::string& result) const {
  const campaigns::DesignInput& design = data_->definition.design;
  const bool is_sobol = design.name == campaigns::kSobolIndices;
  if (!is_sobol && design.name != campaigns::kMorris) {
    throw InputError({fmt::format("a campaign of design {} does not tell how sensitive a result is", design.name),
                      data_->path_of_definition(), 0, "design", design.name,
                      fmt::format("{} or {}", campaigns::kSobolIndices, campaigns::kMorris), ""});
  }
  const ItemTable table = data_->read_table();
  if (table.results.empty()) {
    throw InputError({"no item of the campaign has a result: all that were carried out failed", data_->folder.path, 0,
                      "", "", "rollrig campaign export, whose column failure says why", ""});
  }
  const auto known = std::find(table.results.begin(), table.results.end(), result);
  if (known == table.results.end()) {
    InputProblem problem = unknown_name("result", result, table.results);
    problem.file = "command line";
    problem.key = "--result";
    throw InputError(problem);
  }
  const std::vector<double>& column = table.numbers[static_cast<std::size_t>(known - table.results.begin())];
  campaigns::ItemResults values(data_->items.count(), std::nan(""));
  for (std::size_t row = 0; row < table.items.size(); ++row) values[table.items[row]] = column[row];
  const std::size_t factors = design.factors.size();
  const Sensitivity found =
      is_sobol ? describe_indices(result, design, campaigns::calc_sobol_indices(values, factors, design.seed))
               : describe_effects(result, design, campaigns::calc_morris_measures(values, factors, design.seed));
  Report report;
  report.json = to_text(found.json) + "\n";
  report.text = format_table(found.table) + wrap(found.explanation, 0);
  report.make_page = [data = data_, found, table, column] {
    std::vector<report::FactorScatter> scatters;
    for (const std::size_t f : found.order) {
      constexpr std::size_t kMostCharts = 6;  // Assumed: the factors that matter
      if (scatters.size() == kMostCharts) break;
      report::FactorScatter scatter{data->definition.design.factors[f].key, {}, column};
      for (const std::vector<std::string>& of_item : table.values) {
        if (const auto number = parse_number(of_item[f])) scatter.values.push_back(*number);
      }
      if (scatter.values.size() == column.size()) scatters.push_back(scatter);
    }
    return report::make_html(report::make_sensitivity_page(found.json, found.table, found.explanation, scatters));
  };
  return report;
}

std::string RunCampaign::make_slurm_job(std::size_t tasks, const std::string& program) const {
  const std::string folder = fs::absolute(data_->folder.path).lexically_normal().string();
  return fmt::format(
      "#!/bin/sh\n"
      "# {} items of {} in {} tasks. Submit with sbatch; a task that was killed goes on where it stopped when it is\n"
      "# started again. Afterwards: rollrig campaign merge\n"
      "#SBATCH --job-name=rollrig\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --requeue\n"
      "exec {} campaign run {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads \"$SLURM_CPUS_PER_TASK\" --quiet\n",
      data_->items.count(), data_->definition.run.scenario_or_file, tasks, tasks, quote_for_shell(program),
      quote_for_shell(folder), tasks);
}

}  // namespace rollrig
