#pragma once
/// Tables that put virtual tests beside what the source publishes: docs/published.md.

#include <string>

namespace rollrig::tools {

/// The whole page as Markdown. Runs some hundred virtual tests.
std::string make_published_page();

}  // namespace rollrig::tools
