#pragma once
/// Which effects are in a comparison.

#include <string>
#include <vector>

namespace rollrig {

/// Throws InputError for an effect that is asked for and left out.
void require_apart(const std::vector<std::string>& only, const std::vector<std::string>& without);

}  // namespace rollrig
