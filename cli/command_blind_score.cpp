#include "cli/command_blind_score.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include "proof/report.h"
#include "proof/score.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

struct Options {
  proof::ScoreOrder order;
  proof::ScoreOptions how;
  std::string baselines;
  std::string json;
  std::string markdown;
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
}

/// rollrig-blind-baselines/1: under "best" a number for each id of a figure.
void read_baselines(Options& options) {
  if (options.baselines.empty()) return;
  try {
    const Json json = Json::parse(read_text_file(options.baselines));
    for (const auto& [id, value] : json.at("best").items()) options.how.baselines[id] = value.get<double>();
  } catch (const Json::exception& error) {
    throw InputError({std::string("not figures of baselines: ") + error.what(), options.baselines, 0, "--baselines",
                      options.baselines, "rollrig-blind-baselines/1", ""});
  }
}

int score_command(Options options) {
  require_writable(options.json);
  require_writable(options.markdown);
  fill_folders(options);
  read_baselines(options);
  const proof::Score score = proof::score_cases(proof::read_cases(options.order), options.how);
  if (!options.json.empty()) write_output(options.json, proof::make_score_json(score).dump(1) + "\n");
  if (!options.markdown.empty()) write_output(options.markdown, proof::format_score_markdown(score));
  if (!options.quiet && options.json != "-" && options.markdown != "-") std::cout << proof::format_score(score);
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
  command->add_option("--ceiling", order.ceiling, "File with what an ideal observer makes of each set");
  command->add_option("--baselines", options->baselines, "File with the best baseline's figures");
  command->add_option("--detectable-floors", options->how.detectable_floors,
                      "Signal from which an effect is to be found where no d' is known, in noise floors [1]");
  command->add_option("--json", options->json, "File for everything, - for standard output");
  command->add_option("--markdown", options->markdown, "File for the tables of a page, - for standard output");
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  command->callback([options, &action] { action = [options] { return score_command(*options); }; });
}

}  // namespace rollrig::cli
