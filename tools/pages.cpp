#include "tools/pages.h"

namespace rollrig::tools {

const char* const kProjectFolder = ROLLRIG_SOURCE_DIR;
const char* const kPublishedFolder = ROLLRIG_SOURCE_DIR "/tests/published";

std::string join(const Rows& rows) { return fmt::format("{}", fmt::join(rows, "\n")); }

}  // namespace rollrig::tools
