#pragma once
/// Everything that can be named in a file or on the command line: docs/reference.md.

#include <string>

namespace rollrig::tools {

/// The whole page as Markdown, from the declarations of scenarios, effects, tire and rig.
std::string make_reference_page();

}  // namespace rollrig::tools
