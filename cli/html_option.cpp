#include "cli/html_option.h"

#include <fmt/format.h>

#include "sim/core/file_io.h"

namespace rollrig::cli {

void HtmlOption::add_to(CLI::App& command) {
  command.add_option("--html", path, "File for a page with charts, for any browser; - for standard output");
}

std::string HtmlOption::note() const {
  return is_wanted() && !is_standard_output() ? fmt::format("  page written to {}\n", path) : "";
}

void HtmlOption::write(const std::string& page) const { write_output(path, page); }

}  // namespace rollrig::cli
