#pragma once
/// Results of a scenario side by side.

#include <string>
#include <vector>

#include "comparison/compared.h"

namespace rollrig::comparison {

/// Folders of results; `names` are theirs. Throws InputError.
Compared compare_results(const std::vector<std::string>& folders, const std::vector<std::string>& names);

}  // namespace rollrig::comparison
