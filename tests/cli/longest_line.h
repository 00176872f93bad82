#pragma once
/// How wide a printed text is.

#include <algorithm>
#include <sstream>
#include <string>

namespace rollrig::tests {

/// Characters of the longest line of a text in UTF-8.
inline std::size_t longest_line(const std::string& text) {
  std::istringstream in(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(in, line);) {
    const auto characters =
        std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

}  // namespace rollrig::tests
