#pragma once
/// Words for a shell.

#include <string>

namespace rollrig {

/// A word as a shell reads it: in quotes where it holds anything that a shell takes apart.
std::string quote_for_shell(const std::string& word);

}  // namespace rollrig
