#pragma once
/// What a user says about the effects of a set, checked.

#include <optional>
#include <string>
#include <vector>

namespace blind {

constexpr const char* kNone = "none";

/// The effects of "a,b"; none of "none". Throws InputError.
std::vector<std::string> read_effects(const std::string& list);

/// Sizes of "1,2", one of each effect; none where the list is empty. Throws InputError.
std::vector<std::optional<double>> read_sizes(const std::string& list, const std::vector<std::string>& ids);

/// Functional forms of "a,b", one of each effect; none where the list is empty. Throws InputError.
std::vector<std::string> read_forms(const std::string& list, const std::vector<std::string>& ids);

}  // namespace blind
