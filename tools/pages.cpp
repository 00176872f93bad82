#include "tools/pages.h"

#include <boost/algorithm/string/replace.hpp>

namespace rollrig::tools {

const char* const kProjectFolder = ROLLRIG_SOURCE_DIR;
const char* const kPublishedFolder = ROLLRIG_SOURCE_DIR "/tests/published";

std::string join(const Rows& rows) { return fmt::format("{}", fmt::join(rows, "\n")); }

std::string escape_cell(const std::string& text) { return boost::algorithm::replace_all_copy(text, "|", "\\|"); }

}  // namespace rollrig::tools
