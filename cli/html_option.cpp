#include "cli/html_option.h"

#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig::cli {

void HtmlOption::add_to(CLI::App& command) {
  command.add_option("--html", path, "File for a page with charts, for any browser; - for standard output");
}

void HtmlOption::require_writable(const std::string& json) const {
  if (path.empty()) return;
  if (path == json) {
    throw InputError(
        {"--json and --html cannot both go to one place", "command line", 0, "--html", path, "another file", ""});
  }
  rollrig::require_writable(path);
}

void HtmlOption::write(const report::Page& page) const { write_output(path, report::make_html(page)); }

}  // namespace rollrig::cli
