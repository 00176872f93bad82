#include "rollrig/run_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include <boost/algorithm/string/replace.hpp>

#include "api/campaign_definition.h"
#include "api/item_table.h"
#include "api/run_items.h"
#include "campaigns/items.h"
#include "campaigns/sensitivity.h"
#include "campaigns/store.h"
#include "exports/tree.h"
#include "sim/core/columns.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kFileName = "campaign.json";

/// A word as a shell reads it.
std::string quote_word(const std::string& word) {
  return "'" + boost::algorithm::replace_all_copy(word, "'", "'\\''") + "'";
}

/// "0.31 (0.27 to 0.35)"
std::string show(const campaigns::Index& index) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", index.value, index.low_95, index.high_95);
}

Json to_json(const campaigns::Index& index) {
  return {{"value", index.value}, {"low_95", index.low_95}, {"high_95", index.high_95}};
}

/// Factors by the size of an index, the largest first.
std::vector<std::size_t> order_by(const std::vector<campaigns::Index>& indices) {
  std::vector<std::size_t> order(indices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&indices](std::size_t a, std::size_t b) { return indices[a].value > indices[b].value; });
  return order;
}

Report report_indices(const std::string& result, const campaigns::DesignInput& design,
                      const campaigns::SobolIndexes& indices) {
  Json json{{"format", "rollrig-sensitivity/1"}, {"result", result},     {"design", design.name},
            {"points", indices.points},          {"mean", indices.mean}, {"sd", std::sqrt(indices.variance)},
            {"factors", Json::array()}};
  Table table{fmt::format("Sobol' indices of {}", result), {"factor", "by itself", "with others"}, {}};
  for (const std::size_t f : order_by(indices.total)) {
    json["factors"].push_back(
        {{"key", design.factors[f].key}, {"first", to_json(indices.first[f])}, {"total", to_json(indices.total[f])}});
    table.rows.push_back({design.factors[f].key, show(indices.first[f]), show(indices.total[f])});
  }
  Report report;
  report.json = to_text(json) + "\n";
  report.text =
      format_table(table) +
      wrap(fmt::format("Shares of the variance of {}, with intervals of 95 % from {} points. Mean {:.5g}, standard "
                       "deviation {:.3g}.",
                       result, indices.points, indices.mean, std::sqrt(indices.variance)),
           0);
  return report;
}

Report report_effects(const std::string& result, const campaigns::DesignInput& design,
                      const campaigns::MorrisMeasures& measures) {
  Json json{{"format", "rollrig-sensitivity/1"},
            {"result", result},
            {"design", design.name},
            {"points", measures.points},
            {"factors", Json::array()}};
  Table table{fmt::format("Elementary effects on {}", result), {"factor", "mean size", "mean", "sd"}, {}};
  for (const std::size_t f : order_by(measures.mean_size)) {
    json["factors"].push_back({{"key", design.factors[f].key},
                               {"mean_size", to_json(measures.mean_size[f])},
                               {"mean", measures.mean[f]},
                               {"sd", measures.deviation[f]}});
    table.rows.push_back({design.factors[f].key, show(measures.mean_size[f]), fmt::format("{:+.3g}", measures.mean[f]),
                          fmt::format("{:.3g}", measures.deviation[f])});
  }
  Report report;
  report.json = to_text(json) + "\n";
  report.text = format_table(table) +
                wrap(fmt::format("Change of {} as a factor goes up by half of its probability, from {} trajectories.",
                                 result, measures.points),
                     0);
  return report;
}

campaigns::Share to_share(const CampaignShare& share) { return {share.part, share.parts}; }
CampaignShare from_share(const campaigns::Share& share) { return {share.part, share.parts}; }

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
  state.text = wrap(fmt::format("{}: {} of {} done{}{}", of, tally.done, format_count(tally.items, "item"),
                                tally.failed > 0 ? fmt::format(", {} of them failed", tally.failed) : "",
                                running.empty() ? "" : ", " + format_count(running.size(), "process") + " at work"),
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

  ItemTable read_table() const { return read_item_table(list_filled_files(), folder.definition); }
};

CampaignShare read_campaign_share(const std::string& text) { return from_share(campaigns::read_share(text)); }

std::optional<CampaignShare> find_campaign_share() {
  const auto share = campaigns::find_share([](const char* name) -> const char* { return std::getenv(name); });
  if (!share.has_value()) return std::nullopt;
  return from_share(*share);
}

void define_run_campaign(const RunCampaignInput& input, const std::string& folder) {
  const CampaignDefinition definition = make_definition(input);
  RunItems(definition).check();
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
  require_unchanged(definition, path);
  data_ = std::make_shared<Data>(Data{definition, RunItems(definition), {folder, content, definition.design.seed}});
}

RunCampaignState RunCampaign::carry_out(const CampaignShare& share, int threads, const Progress& progress) const {
  const auto advance = [&progress](double done) {
    if (progress) progress(done, "");
  };
  const campaigns::Tally tally =
      campaigns::carry_out_items(data_->items, data_->folder, to_share(share), threads, advance);
  const std::string of = share.parts == 1
                             ? data_->folder.path
                             : fmt::format("{}, part {} of {}", data_->folder.path, share.part, share.parts);
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
  const std::string partial = merged + ".partial";
  fs::remove(partial);
  {
    campaigns::Store store(partial, data_->folder.definition);
    campaigns::read_records(files, data_->folder.definition,
                            [&store](const campaigns::Record& record) { store.write(record); });
  }
  fs::rename(partial, merged);
  for (const std::string& file : files) {
    if (file != merged) fs::remove(file);
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
    for (const std::string& value : data_->items.calc_values(table.items[row])) csv.add(value);
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
    for (const std::size_t item : table.items) {
      texts.push_back(data_->items.calc_values(item)[f]);
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
  const auto known = std::find(table.results.begin(), table.results.end(), result);
  if (known == table.results.end()) {
    InputProblem problem = unknown_name("result", result, table.results);
    problem.file = "command line";
    problem.key = "--result";
    throw InputError(problem);
  }
  const exports::Column& column = table.numbers[static_cast<std::size_t>(known - table.results.begin())];
  campaigns::ItemResults values(data_->items.count(), std::nan(""));
  for (std::size_t row = 0; row < table.items.size(); ++row) values[table.items[row]] = column[row];
  return is_sobol
             ? report_indices(result, design, campaigns::calc_sobol_indices(values, design.factors.size(), design.seed))
             : report_effects(result, design,
                              campaigns::calc_morris_measures(values, design.factors.size(), design.seed));
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
      "exec {} campaign run {} --threads \"$SLURM_CPUS_PER_TASK\" --quiet\n",
      data_->items.count(), data_->definition.run.scenario_or_file, tasks, tasks, quote_word(program),
      quote_word(folder));
}

}  // namespace rollrig
