#pragma once
/// How deep a TOML or JSON text is nested, before a parser reads it: to build and to delete what is nested takes stack
/// for each level.

#include <cstddef>
#include <string>
#include <string_view>

namespace rollrig {

constexpr std::size_t kDeepestNesting = 32;         // Assumed: brackets within brackets; files of rollrig have six
constexpr std::size_t kMostKeyParts = 16;           // Assumed: of a dotted key; files of rollrig have four
constexpr std::size_t kMostFieldsInBraces = 20000;  // Assumed: JSON with keys in order looks each one up among all

/// Throws InputError, with its line, for the first place that goes beyond these limits. It does not otherwise check
/// the text.
/// Checked  tests/core/nesting_test.cpp
void require_shallow(std::string_view text, const std::string& path);

}  // namespace rollrig
