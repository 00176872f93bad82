#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "cli/command.h"
#include "cli/message.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "rollrig/item_campaign.h"
#include "rollrig/measurement_set.h"
#include "sim/core/columns.h"
#include "sim/core/shell_word.h"
#include "sim/core/text.h"

namespace rollrig::cli {
namespace {

struct NewCampaignOptions {
  RunCampaignInput input;
  std::vector<std::string> vary;
  std::string folder;
  bool quiet = false;
};

struct NewDiagnosesOptions {
  std::string folder;
  std::string sets;
  ComparisonOptions comparison;
  DiagnosisCampaignInput input;
  bool quiet = false;
};

struct CampaignRunOptions {
  std::string folder;
  bool is_over_mpi = false;
  std::string shard;
  int threads = 0;
  bool has_program_progress = false;
  OutputOptions output;
};

struct CampaignFolderOptions {
  std::string folder;
  OutputOptions output;
};

struct CampaignExportOptions {
  std::string folder;
  std::string csv;
  std::string mat;
  std::string hdf5;
  bool quiet = false;
};

struct SensitivityOptions {
  std::string folder;
  std::string result;
  OutputOptions output;
};

struct SlurmOptions {
  std::string folder;
  std::size_t tasks = 1;
};

void say_next(const std::string& folder) {
  std::cout << ItemCampaign(folder).read_state().text
            << wrap(fmt::format("Next: rollrig campaign run {}", quote_for_shell(folder)), 0);
}

int new_campaign_command(const NewCampaignOptions& options) {
  RunCampaignInput input = options.input;
  for (const std::string& text : options.vary) input.axes.push_back(read_sweep_axis(text));
  define_run_campaign(input, options.folder);
  if (!options.quiet) say_next(options.folder);
  return kDone;
}

int new_diagnoses_command(const NewDiagnosesOptions& options) {
  options.comparison.check();
  DiagnosisCampaignInput input = options.input;
  input.sets = find_sets(options.sets);
  input.only = options.comparison.only;
  input.without = options.comparison.without;
  if (input.sets.empty()) {
    throw usage_error(fmt::format("'{}' is no folder of measurement sets", options.sets), "sets", options.sets,
                      "a folder of folders that have a set.toml");
  }
  if (!options.quiet) warn_of_undescribed(options.sets);
  const std::vector<std::string> warnings = define_diagnosis_campaign(input, options.folder);
  if (options.quiet) return kDone;
  for (const std::string& warning : warnings) std::cerr << "warning: this set will fail: " << warning << '\n';
  say_next(options.folder);
  return kDone;
}

/// As asked for, else as a batch system or a launcher says, else all.
CampaignPart choose_part(const std::string& asked) {
  if (!asked.empty()) return read_campaign_part(asked);
  return find_campaign_part().value_or(CampaignPart{});
}

/// Becomes the program that shares the items over MPI, which stands beside this one.
void start_over_mpi(const CampaignRunOptions& options) {
  if (!options.shard.empty() || options.threads > 0) {
    throw usage_error("with --mpi, the first process hands out the items, to one thread of each of the others",
                      options.shard.empty() ? "--threads" : "--shard",
                      options.shard.empty() ? std::to_string(options.threads) : options.shard, "--mpi alone");
  }
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "rollrig_mpi").string();
  std::vector<std::string> words{program};
  if (options.has_program_progress) words.emplace_back("--progress");
  if (options.output.quiet) words.emplace_back("--quiet");
  if (!options.output.json.empty()) words.insert(words.end(), {"--json", options.output.json});
  words.insert(words.end(), {"--", options.folder});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  if (errno != ENOENT) {
    throw usage_error(fmt::format("cannot start {}: {}", program, std::strerror(errno)), "--mpi", "",
                      "a program that may be started; or --shard");
  }
  throw usage_error("this rollrig was built without MPI", "--mpi", "",
                    "--shard; or to install Open MPI (libopenmpi-dev, openmpi-bin) and to build rollrig anew");
}

int campaign_run_command(const CampaignRunOptions& options) {
  if (options.is_over_mpi) start_over_mpi(options);
  const ItemCampaign campaign(options.folder);
  const CampaignPart part = choose_part(options.shard);
  // mpirun and srun stop all other processes where one of them ends with another status than 0.
  const bool is_one_of_several = options.shard.empty() && find_launched_part().value_or(CampaignPart{}).count > 1;
  if (is_one_of_several && !options.output.json.empty() && options.output.json != "-") {
    throw usage_error("each process would write this file", "--json", options.output.json,
                      "rollrig campaign status --json afterwards");
  }
  Output output(options.output);
  CampaignState state;
  try {
    ProgressLine progress("campaign", options.output.quiet,
                          options.has_program_progress ? ProgressReader::kProgram : ProgressReader::kPerson);
    state = campaign.carry_out(part, options.threads, progress.callback());
  } catch (const Interrupted&) {
    std::cerr << wrap_message("stopped: the finished items are saved; the same command continues");
    return kInterrupted;
  }
  output.show(state);
  return state.failed == 0 || is_one_of_several ? kDone : kRunFailed;
}

int campaign_status_command(const CampaignFolderOptions& options) {
  Output output(options.output);
  output.show(ItemCampaign(options.folder).read_state());
  return kDone;
}

int campaign_merge_command(const CampaignFolderOptions& options) {
  Output output(options.output);
  output.show(ItemCampaign(options.folder).merge());
  return kDone;
}

int campaign_export_command(const CampaignExportOptions& options) {
  if (options.csv.empty() && options.mat.empty() && options.hdf5.empty()) {
    throw usage_error("no file to write is given", "", "", "--csv FILE, --mat FILE, --hdf5 FILE");
  }
  const OutputFiles files({{"--csv", options.csv}, {"--mat", options.mat}, {"--hdf5", options.hdf5}});
  const ItemCampaign campaign(options.folder);
  const CampaignState state = campaign.read_state();
  std::vector<StagedOutput> staged;
  if (!options.csv.empty()) {
    staged.emplace_back(options.csv, "");
    campaign.write_csv([&staged](const std::string& rows) { staged.back().append(rows); });
  }
  if (!options.mat.empty() || !options.hdf5.empty()) {
    const Export made = campaign.make_export();
    if (!options.mat.empty()) staged.emplace_back(options.mat, made.make_mat());
    if (!options.hdf5.empty()) staged.emplace_back(options.hdf5, made.make_hdf5());
  }
  files.require_no_input();
  commit_all(staged);
  const std::vector<std::string> written{options.csv, options.mat, options.hdf5};
  if (options.quiet || std::find(written.begin(), written.end(), "-") != written.end()) return kDone;
  for (const std::string& file : written) {
    if (!file.empty()) std::cout << fmt::format("written to {}\n", file);
  }
  if (state.done < state.items) {
    std::cout << wrap(
        fmt::format("{} of {} items are in the table: the others are not carried out yet", state.done, state.items), 0);
  }
  return kDone;
}

int sensitivity_command(const SensitivityOptions& options) {
  Output output(options.output);
  output.show(ItemCampaign(options.folder).calc_sensitivity(options.result));
  return kDone;
}

int summary_command(const CampaignFolderOptions& options) {
  Output output(options.output);
  output.show(ItemCampaign(options.folder).summarize_diagnoses());
  return kDone;
}

int slurm_command(const SlurmOptions& options) {
  std::cout << ItemCampaign(options.folder)
                   .make_slurm_job(options.tasks, std::filesystem::read_symlink("/proc/self/exe").string());
  return kDone;
}

template <class Options>
void add_folder(CLI::App& command, Options& options) {
  command.add_option("folder", options.folder, "Folder of the campaign")->required();
}

/// --json and --quiet.
void add_json(CLI::App& command, OutputOptions& output, const char* doc) {
  add_output_option(command, "--json", output.json, doc);
  command.add_flag("--quiet", output.quiet, "Print nothing but errors");
}

void add_new_campaign(CLI::App& campaign, Action& action) {
  const auto [command, options] = add_command<NewCampaignOptions>(
      campaign, action, "new", "Say what a campaign consists of, before anything is run", &new_campaign_command);
  RunCampaignInput& input = options->input;
  command->add_option("folder", options->folder, "Folder to make")->required();
  add_run_options(*command, input.run);
  command->add_option("--vary", options->vary, "Of a grid: key=a,b,c or key=from:to:step; may be repeated")
      ->expected(1)
      ->take_all();
  command->add_option("--list", input.list, "CSV file with a column for each setting and a row for each item");
  command->add_option("--draw", input.drawn, "key=uniform:LOW:HIGH or key=normal:MEAN:SD; may be repeated")
      ->expected(1)
      ->take_all();
  split_names(
      command->add_option("--draw-sd", input.drawn_sd,
                          "tire, rig, vehicle, with commas: every number of that file beside its standard uncertainty, "
                          "as a normal distribution"))
      ->allow_extra_args(false);
  command->get_option("--seed")->description("Seed of the draws; those of the items' sensors follow from it [1]");
  command->add_option("--design", input.design,
                      fmt::format("{} [grid; with --list, list; where something is drawn, monte_carlo]",
                                  fmt::join(campaign_designs(), ", ")));
  command->add_option("--points", input.points, "Points of a design that draws")->check(in_range(1, 10000000));
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

void add_new_diagnoses(CLI::App& campaign, Action& action) {
  const auto [command, options] = add_command<NewDiagnosesOptions>(
      campaign, action, "new-diagnoses", "Define a campaign that diagnoses many measurement sets",
      &new_diagnoses_command);
  command->add_option("folder", options->folder, "Folder to make")->required();
  command->add_option("sets", options->sets, "Folder of folders with measurement sets")->required();
  options->comparison.add_to(*command);
  add_smallest_effect(*command, options->input.smallest_effect_percent);
  add_skip_bad_rows(*command, options->input.bad_rows);
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace

void add_campaign_command(CLI::App& app, Action& action) {
  CLI::App* campaign =
      app.add_subcommand("campaign", "Many runs of a scenario, or many diagnoses: shared among processes, resumable");
  campaign->require_subcommand(1);
  add_new_campaign(*campaign, action);
  add_new_diagnoses(*campaign, action);
  {
    const auto [command, options] = add_command<CampaignRunOptions>(
        *campaign, action, "run", "Carry out what is not done, of all items or of a part; also after an interruption",
        &campaign_run_command);
    command->alias("resume");
    add_folder(*command, *options);
    command->add_option("--shard", options->shard,
                        "I/N: part I of N parts [what Slurm, Grid Engine, srun or mpirun says, else all]");
    command->add_flag("--mpi", options->is_over_mpi,
                      "Under mpirun: the first process hands out the items to the others, a few at a time");
    add_threads(*command, options->threads);
    command->add_flag("--progress", options->has_program_progress,
                      "Each second a line of JSON on standard error: the fraction that is done, and the seconds left");
    add_json(*command, options->output, "File for the counts of items, - for standard output");
  }
  {
    const auto [command, options] = add_command<CampaignFolderOptions>(
        *campaign, action, "status", "How many items are done", &campaign_status_command);
    add_folder(*command, *options);
    add_json(*command, options->output, "File for the counts of items, - for standard output");
  }
  {
    const auto [command, options] = add_command<CampaignFolderOptions>(
        *campaign, action, "merge", "Put the results of all processes into one file", &campaign_merge_command);
    add_folder(*command, *options);
    add_json(*command, options->output, "File for the counts of items, - for standard output");
  }
  {
    const auto [command, options] = add_command<CampaignExportOptions>(
        *campaign, action, "export", "Write all results as a table", &campaign_export_command);
    add_folder(*command, *options);
    add_output_option(*command, "--csv", options->csv, "File in CSV; - for standard output");
    add_output_option(*command, "--mat", options->mat, "File for MATLAB, version 5; - for standard output");
    add_output_option(*command, "--hdf5", options->hdf5, "File in HDF5; - for standard output");
    command->add_flag("--quiet", options->quiet, "Print nothing but errors");
  }
  {
    const auto [command, options] =
        add_command<SensitivityOptions>(*campaign, action, "sensitivity",
                                        "How much of a result's spread comes from which factor", &sensitivity_command);
    add_folder(*command, *options);
    command->add_option("--result", options->result, "A result, by its name in the exported table")->required();
    add_json(*command, options->output, "File for the indices, - for standard output");
    add_html_option(*command, options->output.html);
  }
  {
    const auto [command, options] = add_command<CampaignFolderOptions>(
        *campaign, action, "summary", "Of diagnoses: the verdict on each set, and which effects come back",
        &summary_command);
    add_folder(*command, *options);
    add_json(*command, options->output, "File for all diagnoses, - for standard output");
    add_html_option(*command, options->output.html);
  }
  {
    const auto [command, options] = add_command<SlurmOptions>(
        *campaign, action, "slurm", "Print a job array for Slurm, to be given to sbatch", &slurm_command);
    add_folder(*command, *options);
    command->add_option("--tasks", options->tasks, "Tasks of the array")->required()->check(in_range(1, 1000000));
  }
}

}  // namespace rollrig::cli
