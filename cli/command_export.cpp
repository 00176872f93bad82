#include <fmt/format.h>

#include <iostream>

#include "cli/command.h"
#include "cli/output_files.h"
#include "rollrig/export.h"
#include "sim/core/columns.h"

namespace rollrig::cli {
namespace {

struct ExportOptions {
  std::string source;
  std::string mat;
  std::string hdf5;
  BadRows bad_rows = BadRows::kRefuse;
  bool quiet = false;
};

int export_command(const ExportOptions& options) {
  if (options.mat.empty() && options.hdf5.empty()) {
    throw usage_error("no file to write is given", "", "", "--mat FILE, --hdf5 FILE, or both");
  }
  const OutputFiles files({{"--mat", options.mat}, {"--hdf5", options.hdf5}});
  const Export made = read_export(options.source, options.bad_rows);
  // Both are made before one is written.
  const std::string mat = options.mat.empty() ? "" : made.make_mat();
  const std::string hdf5 = options.hdf5.empty() ? "" : made.make_hdf5();
  files.require_no_input();
  std::vector<StagedOutput> staged;
  if (!mat.empty()) staged.emplace_back(options.mat, mat);
  if (!hdf5.empty()) staged.emplace_back(options.hdf5, hdf5);
  commit_all(staged);
  if (options.quiet || options.mat == "-" || options.hdf5 == "-") return kDone;
  std::cout << format_warnings(made.warnings);
  for (const std::string& file : {options.mat, options.hdf5}) {
    if (!file.empty()) std::cout << fmt::format("written to {}\n", file);
  }
  return kDone;
}

}  // namespace

void add_export_command(CLI::App& app, Action& action) {
  const auto [command, options] = add_command<ExportOptions>(
      app, action, "export", "Write a result, a measurement set or a recording for MATLAB (.mat) or as HDF5",
      &export_command);
  command
      ->add_option("source", options->source,
                   "Folder that run --out or --write-set wrote, a measurement set, or a recording.csv")
      ->required();
  add_output_option(*command, "--mat", options->mat, "File for MATLAB, version 5; - for standard output");
  add_output_option(*command, "--hdf5", options->hdf5, "File in HDF5; - for standard output");
  add_skip_bad_rows(*command, options->bad_rows);
  command->add_flag("--quiet", options->quiet, "Print nothing but errors");
}

}  // namespace rollrig::cli
