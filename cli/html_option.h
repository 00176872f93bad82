#pragma once
/// --html: the result as a page, one file that needs nothing else.

#include <CLI/CLI.hpp>

#include <string>

#include "report/page.h"

namespace rollrig::cli {

struct HtmlOption {
  std::string path;  // empty: none wanted

  void add_to(CLI::App& command);
  /// To be called before the work. Throws InputError where the page could not be written, or where `json` goes to the
  /// same file or to standard output too.
  void require_writable(const std::string& json) const;
  bool is_wanted() const { return !path.empty(); }
  bool is_standard_output() const { return path == "-"; }
  void write(const report::Page& page) const;
};

}  // namespace rollrig::cli
