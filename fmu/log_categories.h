#pragma once
/// Categories of the messages of an FMU, which an importer switches on and off.

#include <array>
#include <cstddef>

namespace rollrig::fmu {

enum class LogCategory { kError, kDiscard };

struct LogCategoryInfo {
  const char* name;  // of the standard
  const char* doc;
};

/// In the order of LogCategory.
constexpr std::array<LogCategoryInfo, 2> kLogCategories{
    {{"logStatusError", "Calls that failed"}, {"logStatusDiscard", "Questions about a step that have no answer"}}};

/// How many of them a version of the interface has: in version 3, no function discards anything.
constexpr std::size_t count_log_categories(int fmi_version) { return fmi_version == 2 ? 2 : 1; }

}  // namespace rollrig::fmu
