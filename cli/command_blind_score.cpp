#include "cli/command_blind_score.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/html_option.h"
#include "cli/output_files.h"
#include "report/score_page.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "validation/scoring/baselines/comparison.h"
#include "validation/scoring/report.h"
#include "validation/scoring/score.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct Options {
  proof::ScoreOrder order;
  proof::ScoreOptions how;
  std::string json;
  std::string markdown;
  HtmlOption html;
  bool quiet = false;
};

std::string in_bank(const Options& options, const char* name) { return (fs::path(options.order.bank) / name).string(); }

/// Folders that nothing is said of.
void fill_folders(Options& options) {
  proof::ScoreOrder& order = options.order;
  if (order.answers.empty()) order.answers = in_bank(options, order.truth_was_left_out ? kLeftOutFolder : "answers");
  if (order.oracle.empty() && fs::is_directory(in_bank(options, kAloneFolder))) {
    order.oracle = in_bank(options, kAloneFolder);
  }
  if (order.ceiling.empty() && fs::is_regular_file(in_bank(options, "ceiling.json"))) {
    order.ceiling = in_bank(options, "ceiling.json");
  }
  if (order.truth_was_left_out) return;
  for (const proof::Choice choice : {proof::Choice::kProposed, proof::Choice::kDrawn}) {
    std::string& folder = choice == proof::Choice::kDrawn ? order.drawn_tests : order.next_tests;
    const bool is_there = fs::is_regular_file(in_bank(options, proof::folder_of(choice)) + "/plans.json");
    if (is_there && order.answers == in_bank(options, "answers")) folder = in_bank(options, proof::folder_of(choice));
  }
}

int score_command(Options options) {
  const OutputFiles files({{"--json", options.json}, {"--markdown", options.markdown}, {"--html", options.html.path}});
  fill_folders(options);
  proof::Score score = proof::score_cases(proof::read_cases(options.order), options.how);
  proof::put_beside(proof::score_baselines(options.order, options.how), score);
  files.require_no_input();
  if (!options.json.empty()) write_output(options.json, proof::make_score_json(score).dump(1) + "\n");
  if (!options.markdown.empty()) write_output(options.markdown, proof::format_score_markdown(score));
  if (options.html.is_wanted()) options.html.write(report::make_score_page(score, options.order.bank));
  const bool is_output_taken = options.json == "-" || options.markdown == "-" || options.html.is_standard_output();
  if (!options.quiet && !is_output_taken) std::cout << proof::format_score(score) << options.html.note();
  return kDone;
}

}  // namespace

void add_blind_score(CLI::App& blind, Action& action) {
  CLI::App* command = blind.add_subcommand("score", "Open the seal of a bank and score the answers to it");
  auto options = std::make_shared<Options>();
  proof::ScoreOrder& order = options->order;
  command->add_option("bank", order.bank, "Folder made by rollrig blind make")->required();
  command->add_option("--seal", order.seal, "SHA-256 that truth.json must have [what seal.sha256 says]");
  command->add_option("--answers", order.answers, "Folder of the answers [answers in the bank]");
  command->add_option("--oracle", order.oracle, "Answers of rollrig blind oracle, for the shrinkage [where they are]");
  command->add_flag("--left-out", order.truth_was_left_out,
                    "Score the answers of rollrig blind oracle --race left_out: no cause is right");
  command->add_option("--ceiling", order.ceiling,
                      "What an ideal observer makes of each set, by rollrig_blind ceiling [where it is]");
  command->add_option("--detectable-floors", options->how.detectable_floors,
                      "Signal from which an effect is to be found where no d' is known, in noise floors [1]");
  command->add_option("--json", options->json, "File for everything, - for standard output");
  options->html.add_to(*command);
  command->add_option("--markdown", options->markdown, "File for the tables of a page, - for standard output");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return score_command(*options); }; });
}

}  // namespace rollrig::cli
