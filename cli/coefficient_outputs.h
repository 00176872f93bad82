#pragma once
/// Options of `rollrig export` that write coefficients of rolling resistance for other programs.

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

#include "cli/output_files.h"
#include "rollrig/rolling_law.h"

namespace rollrig::cli {

/// The files that are asked for, and what they need to know.
struct CoefficientOutputs {
  std::string tydex;
  std::string tir;
  std::string simscape;
  std::string fastsim;
  std::string co2mpas;
  CoefficientOptions how;

  void add_to(CLI::App& command);
  /// Each with its option, the empty ones too.
  std::vector<OutputFile> list_files() const;
  bool are_empty() const;
  /// Path and content of each file. Throws InputError.
  std::vector<std::pair<std::string, std::string>> make(const std::string& fit_json) const;
};

}  // namespace rollrig::cli
