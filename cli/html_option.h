#pragma once
/// --html: the result as a page, one file that needs nothing else.

#include <CLI/CLI.hpp>

#include <string>

namespace rollrig::cli {

struct HtmlOption {
  std::string path;  // empty: none wanted

  void add_to(CLI::App& command);
  bool is_wanted() const { return !path.empty(); }
  bool is_standard_output() const { return path == "-"; }
  void write(const std::string& page) const;
  /// A line that says where the page is; empty where there is none, or where it went to standard output.
  std::string note() const;
};

}  // namespace rollrig::cli
