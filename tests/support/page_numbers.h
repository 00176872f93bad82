#pragma once
/// Compares generated pages: words to the letter, numbers to their digits.

#include <string>

namespace rollrig::tests {

/// Checks that two pages have the same words, and numbers within 0.2 % or 0.02.
void check_page(const std::string& written, const std::string& now);

}  // namespace rollrig::tests
