#include "rollrig/item_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>

#include "api/campaign_definition.h"
#include "api/campaign_items.h"
#include "api/folder_lock.h"
#include "api/item_table.h"
#include "api/open_campaign.h"
#include "api/option_range.h"
#include "api/sensitivity.h"
#include "api/set_items.h"
#include "campaigns/items.h"
#include "campaigns/store.h"
#include "diagnosis/output/fleet.h"
#include "exports/tree.h"
#include "report/diagnosis_page.h"
#include "report/sensitivity_page.h"
#include "rollrig/diagnose.h"
#include "sim/core/columns.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"
#include "sim/core/shell_word.h"
#include "sim/core/text.h"
#include "sim/core/visible.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

campaigns::Part to_part(const CampaignPart& part) { return {part.number, part.count}; }
CampaignPart from_part(const campaigns::Part& part) { return {part.number, part.count}; }

}  // namespace

struct ItemCampaign::Data : OpenCampaign {
  ItemFiles files() const { return {list_filled_files(), folder.definition}; }
  ItemTable read_table() const {
    const std::unique_ptr<CampaignItems> own = make_items(definition);  // it learns the names of the results
    return read_item_table(files(), *own);
  }
};

CampaignPart read_campaign_part(const std::string& text) { return from_part(campaigns::read_part(text)); }

namespace {

const char* get_variable(const char* name) { return std::getenv(name); }

std::optional<CampaignPart> from_environment(std::optional<campaigns::Part> (*find)(const campaigns::Environment&)) {
  const auto part = find(get_variable);
  if (!part.has_value()) return std::nullopt;
  return from_part(*part);
}

}  // namespace

std::optional<CampaignPart> find_campaign_part() { return from_environment(campaigns::find_part); }
std::optional<CampaignPart> find_launched_part() { return from_environment(campaigns::find_process_part); }
bool is_array_task() { return campaigns::is_array_task(get_variable); }

namespace {

/// What `make` says, in a new folder. Returns what is warned of.
std::vector<std::string> write_definition(const std::string& folder, const std::function<CampaignDefinition()>& make) {
  std::error_code none;
  if (fs::exists(folder, none) && !fs::is_empty(folder, none)) {
    throw InputError({fmt::format("'{}' is there already and holds files", folder), "command line", 0, "folder", folder,
                      "a new or an empty folder", ""});
  }
  CampaignDefinition definition = make();
  const CampaignItems::Check found = make_items(definition)->check();
  definition.files = found.files;
  try {
    write_folder(folder, {{kCampaignFileName, definition.to_text()}});
  } catch (const InputError& error) {
    InputProblem problem = error.problem();
    if (problem.allowed.find("--force") == std::string::npos) throw;
    problem.allowed = "a new or an empty folder";  // another process has made it meanwhile
    throw InputError(problem);
  }
  return found.warnings;
}

}  // namespace

void define_run_campaign(const RunCampaignInput& input, const std::string& folder) {
  write_definition(folder, [&input] { return make_definition(input); });
}

std::vector<std::string> define_diagnosis_campaign(const DiagnosisCampaignInput& input, const std::string& folder) {
  if (input.sets.empty()) {
    throw InputError({"there is no set to diagnose", "", 0, "sets", "", "folders of measurement sets", ""});
  }
  require_comparable_effects(input.only, input.without);
  diagnosis::require_valid_options(make_diagnosis_options(input));
  return write_definition(folder, [&input] { return make_definition(input); });
}

ItemCampaign::ItemCampaign(const std::string& folder) : data_(std::make_shared<Data>(Data{open_campaign(folder)})) {}

CampaignState ItemCampaign::carry_out(const CampaignPart& part, int threads, const Progress& progress) const {
  require_threads(threads);
  const std::unique_ptr<CampaignItems> items = data_->make_watched_items();
  double last = 0.0;
  const auto advance = [&](double done) {
    last = done;
    if (progress) progress(done, "");
  };
  const campaigns::Tally tally = campaigns::carry_out_items(*items, data_->folder, to_part(part), threads, advance);
  if (last < 1.0) advance(1.0);  // there was nothing to do
  const std::string of = part.count == 1
                             ? data_->folder.path
                             : fmt::format("{}, part {} of {}", data_->folder.path, part.number, part.count);
  return make_state(tally, of);
}

CampaignState ItemCampaign::read_state() const {
  const campaigns::FolderState state = campaigns::read_state(data_->folder, data_->items->count());
  return make_state(state.tally, data_->folder.path, state.running);
}

CampaignState ItemCampaign::merge() const {
  const FolderLock alone(data_->folder.path);
  if (alone.is_taken()) {
    throw InputError({"another process merges the results of this campaign now", data_->folder.path, 0, "", "",
                      "to wait until it has ended", ""});
  }
  const std::vector<std::string> files = data_->list_filled_files();
  const std::string merged = (fs::path(data_->folder.path) / "results.sqlite").string();
  if (files == std::vector<std::string>{merged}) return read_state();
  // read_state() throws if a file has an item beyond those of the campaign.
  const std::vector<std::string> running = campaigns::read_state(data_->folder, data_->items->count()).running;
  if (!running.empty()) {
    throw InputError({"a process writes results of this campaign now", running.front(), 0, "", "",
                      "to wait until it has ended; see rollrig campaign status", ""});
  }
  // A file that a killed merge has left may be used again: its records are of this campaign.
  const std::string partial = merged + ".partial";
  std::vector<bool> is_merged(data_->items->count());
  const bool was_there = is_there(partial);
  std::unique_ptr<campaigns::Store> store;
  try {
    store = std::make_unique<campaigns::Store>(partial, data_->folder.definition);
    campaigns::read_records(files, data_->folder.definition, [&](const campaigns::Record& record) {
      store->write(record);
      if (record.item < is_merged.size()) is_merged[record.item] = true;
    });
    store->close();
  } catch (...) {
    // A file that could not be opened may be of another campaign, or in use by another merge: it stays.
    if (store == nullptr && was_there) throw;
    // Otherwise it goes: on a full disk, for example, it would only take room.
    store.reset();
    std::error_code ignored;
    for (const char* end : {"", "-wal", "-journal"}) fs::remove(partial + end, ignored);
    throw;
  }
  fs::rename(partial, merged);
  synchronize_folder(data_->folder.path);  // before the files that it replaces go
  const auto has = [&is_merged](std::size_t item) { return item < is_merged.size() && is_merged[item]; };
  for (const std::string& file : files) {
    if (file == merged) continue;
    campaigns::remove_if_contained(file, data_->folder.definition, has);
    if (!is_there(file)) campaigns::remove_progress(file);
  }
  return read_state();
}

void ItemCampaign::write_csv(const std::function<void(const std::string&)>& append) const {
  const ItemFiles files = data_->files();
  const std::unique_ptr<CampaignItems> items = make_items(data_->definition);
  const ItemColumns table = find_item_columns(files, *items);
  std::vector<std::string> columns{"item"};
  for (const auto& names : {items->list_keys(), table.text_results, table.results}) {
    columns.insert(columns.end(), names.begin(), names.end());
  }
  if (table.has_failures) columns.emplace_back("failure");
  CsvWriter csv(columns);
  std::size_t rows = 0;
  visit_item_rows(files, *items, table, [&](const ItemRow& row) {
    csv.add(std::to_string(row.item + 1));
    for (const std::string& value : row.values) csv.add(value);
    for (const std::string& text : row.texts) csv.add(text);
    for (const double number : row.numbers) csv.add(CsvWriter::Rounded{number, 12});
    if (table.has_failures) csv.add(row.failure);
    csv.end_row();
    constexpr std::size_t kAtOnce = 1000;
    if (++rows % kAtOnce == 0) append(csv.take());
  });
  append(csv.take());
}

Export ItemCampaign::make_export() const {
  const auto tree = std::make_shared<exports::Group>();
  const ItemTable table = data_->read_table();
  exports::Group rows;
  rows.is_table = true;
  exports::Column numbers;
  for (const std::size_t item : table.items) numbers.push_back(static_cast<double>(item + 1));
  rows.add("item", {numbers});
  const std::vector<std::string> keys = data_->items->list_keys();
  for (std::size_t f = 0; f < keys.size(); ++f) {
    exports::Texts texts;
    exports::Column values;
    for (const std::vector<std::string>& of_item : table.values) {
      texts.push_back(of_item[f]);
      if (const auto number = parse_number(texts.back())) values.push_back(*number);
    }
    if (values.size() == texts.size()) {
      rows.add(keys[f], {values});
    } else {
      rows.add(keys[f], {texts});
    }
  }
  for (std::size_t r = 0; r < table.texts.size(); ++r) rows.add(table.columns.text_results[r], {table.texts[r]});
  for (std::size_t r = 0; r < table.numbers.size(); ++r) rows.add(table.columns.results[r], {table.numbers[r]});
  if (table.columns.has_failures) rows.add("failure", {table.failures});
  tree->add("format", {std::string("rollrig-campaign-export/1")});
  tree->add("items", {rows});
  tree->add("definition", {data_->content});
  return {[tree] { return exports::make_mat(*tree); }, [tree] { return exports::make_hdf5(*tree); }};
}

Report ItemCampaign::calc_sensitivity(const std::string& result) const {
  const campaigns::DesignInput& design = data_->definition.design;
  const bool is_sobol = design.name == campaigns::kSobolIndices;
  if (data_->definition.diagnosis.has_value()) {
    throw InputError({"a campaign of diagnoses does not tell how sensitive a result is", data_->path_of_definition(), 0,
                      "diagnosis", "", "a campaign of runs", ""});
  }
  if (!is_sobol && design.name != campaigns::kMorris) {
    throw InputError({fmt::format("a campaign of design {} does not tell how sensitive a result is", design.name),
                      data_->path_of_definition(), 0, "design", design.name,
                      fmt::format("{} or {}", campaigns::kSobolIndices, campaigns::kMorris), ""});
  }
  const ItemTable table = data_->read_table();
  const std::vector<std::string>& results = table.columns.results;
  if (results.empty()) {
    throw InputError({"no item of the campaign has a result: all that were carried out failed", data_->folder.path, 0,
                      "", "", "rollrig campaign export, whose column failure says why", ""});
  }
  const auto known = std::find(results.begin(), results.end(), result);
  if (known == results.end()) {
    InputProblem problem = unknown_name("result", result, results);
    problem.file = "command line";
    problem.key = "--result";
    throw InputError(problem);
  }
  const std::vector<double>& column = table.numbers[static_cast<std::size_t>(known - results.begin())];
  campaigns::ItemResults values(data_->items->count(), std::nan(""));
  for (std::size_t row = 0; row < table.items.size(); ++row) values[table.items[row]] = column[row];
  const std::size_t factors = design.factors.size();
  Sensitivity found =
      is_sobol ? describe_indices(result, design, campaigns::calc_sobol_indices(values, factors, design.seed))
               : describe_effects(result, design, campaigns::calc_morris_measures(values, factors, design.seed));
  std::vector<report::FactorScatter> scatters;
  for (const std::size_t f : found.order) {
    constexpr std::size_t kMostCharts = 6;  // Assumed: the factors that matter
    if (scatters.size() == kMostCharts) break;
    std::vector<std::string> of_items;
    for (const std::vector<std::string>& of_item : table.values) of_items.push_back(of_item[f]);
    scatters.push_back(report::make_factor_scatter(design.factors[f].key, of_items, column));
  }
  found.json["over_two_factors"] = report::make_factor_means(scatters);
  for (std::size_t i = 0; !is_sobol && i < scatters.size(); ++i) {
    const std::vector<double> steps = report::list_factor_steps(scatters[i]);
    if (!steps.empty()) found.json["factors"][i]["steps"] = steps;
  }
  Report report;
  report.json = to_text(found.json);
  report.text = format_table(found.table) + wrap(found.explanation, 0);
  report.make_page = [found, scatters] {
    return report::make_html(report::make_sensitivity_page(found.json, found.table, found.explanation, scatters));
  };
  return report;
}

Report ItemCampaign::summarize_diagnoses() const {
  if (!data_->definition.diagnosis.has_value()) {
    throw InputError({"a campaign of runs has no diagnoses", data_->path_of_definition(), 0, "run", "",
                      "rollrig campaign export; or a campaign of sets", ""});
  }
  const auto fleet = std::make_shared<diagnosis::Fleet>();
  campaigns::read_records(data_->list_filled_files(), data_->folder.definition, [&](const campaigns::Record& record) {
    require_item(record, data_->items->count(), data_->folder.path);
    const std::string& set = data_->definition.diagnosis->sets[record.item];
    if (record.failure.empty()) {
      diagnosis::add_member(set, parse_json(record.result, fmt::format("result of item {}", record.item + 1)), *fleet);
    } else {
      diagnosis::add_failed_member(set, record.failure, *fleet);
    }
  });
  fleet->recurrences = diagnosis::find_recurrences(fleet->members);
  Report report;
  report.json = to_text(diagnosis::make_fleet_json(*fleet));
  report.text = diagnosis::format_fleet(*fleet);
  const std::size_t open = data_->items->count() - fleet->members.size();
  if (open > 0) report.text += wrap(fmt::format("{} not diagnosed yet", format_count(open, "set")), 0);
  report.make_page = [fleet] { return report::make_html(report::make_fleet_page(*fleet)); };
  return report;
}

std::string ItemCampaign::make_slurm_job(std::size_t tasks, const std::string& program) const {
  const std::string folder = fs::absolute(data_->folder.path).lexically_normal().string();
  return fmt::format(
      "#!/bin/sh\n"
      "# {} items of {} in {} tasks. Submit with sbatch; a task that was killed continues where it stopped when it is\n"
      "# started again. Afterwards: rollrig campaign merge\n"
      "#SBATCH --job-name=rollrig\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --requeue\n"
      "exec {} campaign run {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads \"$SLURM_CPUS_PER_TASK\" --quiet\n",
      data_->items->count(), show_on_one_line(data_->folder.path), tasks, tasks, quote_for_shell(program),
      quote_for_shell(folder), tasks);
}

}  // namespace rollrig
