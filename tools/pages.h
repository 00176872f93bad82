#pragma once
/// The generated pages of docs/. Their text is Markdown, in tools/pages; what the program gives is put into its holes.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "sim/core/file_io.h"

namespace rollrig::tools {

/// Folders of the project.
extern const char* const kProjectFolder;
extern const char* const kPublishedFolder;  // tests/published

/// Rows of a table in Markdown, a line each.
using Rows = std::vector<std::string>;
std::string join(const Rows& rows);
/// Text as it may stand in a cell of such a table.
std::string escape_cell(const std::string& text);

/// tools/pages/<name>.md with `values`, which are named arguments of fmt, in its holes.
template <class... Values>
std::string fill_page(const std::string& name, const Values&... values) {
  const std::string page = read_text_file(fmt::format("{}/tools/pages/{}.md", kProjectFolder, name));
  return fmt::format(fmt::runtime(page), values...);
}

/// docs/physics.md: doc comments of headers that state an equation, equations and sources of all effects, and every
/// number that is marked as assumed.
std::string make_physics_page();

/// docs/reference.md: everything that can be named in a file or on the command line, from the declarations of
/// scenarios, effects, tire and rig.
std::string make_reference_page();

/// docs/published.md: virtual tests beside what the source publishes. Runs some hundred virtual tests.
std::string make_published_page();

/// docs/ex30.md: a certificate of a multi-cycle test beside the same test simulated.
std::string make_ex30_page();

/// docs/epa_fleet.md: a list of test cars of model year 2022, simulated by their public coefficients.
std::string make_epa_fleet_page();

/// docs/source_gap.md: which effect could make the gap of Table 4.3.
std::string make_source_gap_page();

/// docs/independent_validation.md: virtual tires beside sources to which no tire was fitted.
std::string make_independent_page();

}  // namespace rollrig::tools
