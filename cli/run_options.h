#pragma once
/// Options that describe a run, shared by run and sweep.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "scenarios/run/run_spec.h"

namespace rollrig::cli {

struct RunOptions {
  std::string scenario_or_file;
  std::string tire;
  std::string rig;
  std::string vehicle;
  std::string fidelity;
  std::string baseline;
  std::string sensors;
  std::string seed;
  std::vector<std::string> assignments;

  void add_to(CLI::App& command);
  /// The run document: the file's, or an empty one for a scenario, with the options put in.
  ConfigTable make_document() const;
  /// Folder to which paths in the document are relative.
  std::string base_folder() const;
};

}  // namespace rollrig::cli
