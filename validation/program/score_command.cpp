#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "cli/output_files.h"
#include "report/blocks.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"
#include "validation/program/commands.h"
#include "validation/scoring/baselines/baselines.h"
#include "validation/scoring/report.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

using report::Block;
using report::rounded;
using report::Section;

Block make_block(const Table& table) { return report::make_table({"", table.columns, table.rows}); }

/// Shares with their intervals, beside target and best baseline.
Block make_shares(const Score& score) {
  Json names = Json::array(), values = Json::array(), low = Json::array(), high = Json::array(),
       targets = Json::array();
  for (const Figure& figure : score.figures) {
    if (!figure.value.has_value() || !figure.interval.has_value()) continue;
    names.push_back(figure.label);
    values.push_back(rounded(100.0 * *figure.value));
    low.push_back(rounded(100.0 * figure.interval->low));
    high.push_back(rounded(100.0 * figure.interval->high));
    targets.push_back(figure.target.has_value() ? rounded(100.0 * *figure.target) : Json(nullptr));
  }
  return report::make_bars({"Shares of cases", "%"}, names,
                           {{{"name", "share, 95 % interval"}, {"values", values}, {"low", low}, {"high", high}},
                            {{"name", "target"}, {"values", targets}}});
}

Block make_reliability(const Score& score) {
  report::ChartSeries points;
  for (const ReliabilityBin& bin : score.reliability) {
    if (bin.cases == 0) continue;
    const Interval interval = calc_wilson_95(bin.right, bin.cases);
    points.add(bin.mean_probability, bin.right_share(), interval.low, interval.high);
  }
  Block block = report::make_curves(
      {"Stated probability", "", true}, {"Share that was right", "", true}, Json::array({points.finish("cases")}),
      "On the dashed line a stated probability is what it says. Whiskers: 95 % intervals.");
  block["diagonal"] = 1.0;
  return block;
}

Block make_lead(const Score& score) {
  constexpr std::size_t kFew = 100;  // Assumed: one case of fewer moves most shares by more than a target leaves
  const auto is_judged = [](const Figure& figure) { return figure.value.has_value() && figure.target.has_value(); };
  const auto judged = std::count_if(score.figures.begin(), score.figures.end(), is_judged);
  const auto met = std::count_if(score.figures.begin(), score.figures.end(), [&](const Figure& figure) {
    return is_judged(figure) && figure.meets(figure.target);
  });
  const bool is_few = score.cases < kFew;
  std::string text = fmt::format("{} of {} targets are met.", met, judged);
  if (is_few) text += fmt::format(" {} prove nothing: see the intervals.", format_count(score.cases, "case"));
  return report::make_lead(met == judged && !is_few ? "good" : "doubt", text);
}

/// Every figure beside its target and the best baseline, shares with their intervals, reliability of the stated
/// probabilities, tallies by effect, campaign and size, confusions, and what was missed.
report::Page make_score_page(const Score& score, const std::string& set) {
  report::Page page{"score", "Score of a validation set",
                    fmt::format("Validation set {}, {}", set, format_count(score.cases, "case"))};
  const std::vector<Table> tables = make_score_tables(score);
  Section result{"Result", "", {make_lead(score)}};
  if (!score.warnings.empty()) result.blocks.push_back(report::make_warnings(score.warnings));
  result.blocks.push_back(make_block(tables.front()));
  result.blocks.push_back(make_shares(score));
  page.add(std::move(result));
  for (std::size_t i = 1; i < tables.size(); ++i) {
    Section section{tables[i].title, "", {make_block(tables[i])}};
    if (section.title == "Reliability") section.blocks.insert(section.blocks.begin(), make_reliability(score));
    if (section.title == "Missed") section.folded = format_count(tables[i].rows.size(), "case");
    page.add(std::move(section));
  }
  return page;
}

struct ScoreCommandOptions {
  ScoreOrder order;
  ScoreOptions how;
  std::string json;
  std::string markdown;
  std::string html;
  bool quiet = false;
};

/// Folders and files of which nothing is said.
void fill_places(ScoreOrder& order) {
  const auto is_there = [&order](const std::string& name) { return fs::exists(place_in(order.set, name)); };
  order.answers = place_in(order.set, order.truth_was_left_out ? kLeftOutFolder : "answers", order.answers);
  if (order.known_cause.empty() && is_there(kAloneFolder)) order.known_cause = place_in(order.set, kAloneFolder);
  for (const char* name : {"upper_bound.json", "ceiling.json"}) {  // the second is of older sets
    if (order.upper_bound.empty() && is_there(name)) order.upper_bound = place_in(order.set, name);
  }
  if (is_there(kLocationsFile)) order.locations = place_in(order.set, kLocationsFile);
  if (order.truth_was_left_out || order.answers != place_in(order.set, "answers")) return;
  const auto find_tests = [&](Choice choice) {
    const std::string name = folder_of(choice);
    return is_there(name + "/plans.json") ? place_in(order.set, name) : "";
  };
  order.next_tests = find_tests(Choice::kProposed);
  order.drawn_tests = find_tests(Choice::kDrawn);
}

int score_command(ScoreCommandOptions options) {
  const cli::OutputFiles files({{"--json", options.json}, {"--markdown", options.markdown}, {"--html", options.html}});
  fill_places(options.order);
  Score score = score_cases(read_cases(options.order), options.how);
  put_beside(score_baselines(options.order, options.how), score);
  files.require_no_input();
  std::vector<StagedOutput> staged;
  if (!options.json.empty()) staged.emplace_back(options.json, to_text(make_score_json(score), 1));
  if (!options.markdown.empty()) staged.emplace_back(options.markdown, format_score_markdown(score));
  if (!options.html.empty()) {
    staged.emplace_back(options.html, report::make_html(make_score_page(score, options.order.set)));
  }
  cli::commit_all(staged);
  const bool is_output_taken = options.json == "-" || options.markdown == "-" || options.html == "-";
  if (!options.quiet && !is_output_taken) std::cout << format_score(score) << cli::note_page(options.html);
  return cli::kDone;
}

}  // namespace

void add_score_command(CLI::App& app, cli::Action& action) {
  const auto [command, options] = cli::add_command<ScoreCommandOptions>(
      app, action, "score", "Open the truth and score the answers", score_command);
  ScoreOrder& order = options->order;
  add_set_to(*command, order.set);
  command->add_option("--hash", order.hash, "SHA-256 that truth.json must have [what truth.sha256 says]");
  command->add_option("--seal", order.hash)->group("");
  command->add_option("--answers", order.answers, "Folder of the answers [answers in the validation set]");
  command->add_option("--known-cause", order.known_cause, "Answers of known-cause, for the shrinkage [where they are]");
  command->add_option("--oracle", order.known_cause)->group("");
  command->add_flag("--left-out", order.truth_was_left_out,
                    "Score the answers of known-cause --cause left_out: no cause is right");
  command->add_option("--upper-bound", order.upper_bound,
                      "What an ideal observer makes of each case, by upper-bound [where it is]");
  command->add_option("--ceiling", order.upper_bound)->group("");
  command->add_option("--detectable-floors", options->how.detectable_floors,
                      "Signal from which an effect is to be found where no d' is known, in noise floors [1]");
  cli::add_output_option(*command, "--json", options->json, "File for everything, - for standard output");
  cli::add_html_option(*command, options->html);
  cli::add_output_option(*command, "--markdown", options->markdown,
                         "File for the tables of a page, - for standard output");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::validation
