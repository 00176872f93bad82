#pragma once
/// --only and --without: which effects are in the comparison, shared by diagnose and validation.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace rollrig::cli {

struct ComparisonOptions {
  std::vector<std::string> only;
  std::vector<std::string> without;

  void add_to(CLI::App& command);
  /// Throws InputError: an effect that there is not, with the nearest; one that is asked for and left out.
  void check() const;
};

}  // namespace rollrig::cli
