#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/html_option.h"
#include "cli/output_files.h"
#include "sim/core/file_io.h"
#include "validation/program/commands.h"
#include "validation/program/score_page.h"
#include "validation/scoring/baselines/comparison.h"
#include "validation/scoring/report.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

struct Options {
  ScoreOrder order;
  ScoreOptions how;
  std::string json;
  std::string markdown;
  cli::HtmlOption html;
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
  if (order.truth_was_left_out || order.answers != place_in(order.set, "answers")) return;
  const auto find_tests = [&](Choice choice) {
    const std::string name = folder_of(choice);
    return is_there(name + "/plans.json") ? place_in(order.set, name) : "";
  };
  order.next_tests = find_tests(Choice::kProposed);
  order.drawn_tests = find_tests(Choice::kDrawn);
}

int score_command(Options options) {
  const cli::OutputFiles files(
      {{"--json", options.json}, {"--markdown", options.markdown}, {"--html", options.html.path}});
  fill_places(options.order);
  Score score = score_cases(read_cases(options.order), options.how);
  put_beside(score_baselines(options.order, options.how), score);
  files.require_no_input();
  if (!options.json.empty()) write_output(options.json, make_score_json(score).dump(1) + "\n");
  if (!options.markdown.empty()) write_output(options.markdown, format_score_markdown(score));
  if (options.html.is_wanted()) options.html.write(report::make_html(make_score_page(score, options.order.set)));
  const bool is_output_taken = options.json == "-" || options.markdown == "-" || options.html.is_standard_output();
  if (!options.quiet && !is_output_taken) std::cout << format_score(score) << options.html.note();
  return cli::kDone;
}

}  // namespace

void add_score_command(CLI::App& app, cli::Action& action) {
  auto options = std::make_shared<Options>();
  ScoreOrder& order = options->order;
  CLI::App* command = add_set_command(app, "score", "Open the truth and score the answers", order.set);
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
  command->add_option("--json", options->json, "File for everything, - for standard output");
  options->html.add_to(*command);
  command->add_option("--markdown", options->markdown, "File for the tables of a page, - for standard output");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return score_command(*options); }; });
}

}  // namespace rollrig::validation
