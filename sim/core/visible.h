#pragma once
/// Text from files as a terminal may have it: what a terminal would carry out is shown instead.

#include <string>
#include <string_view>

namespace rollrig {

/// The text with its control characters written out: "\x1b" for escape, "\r" for carriage return, "\u009b" and
/// "\u202e" for control characters and changes of direction beyond ASCII, "\xff" for a byte that is not UTF-8. New
/// lines and tabs stay, for layout.
/// Checked  tests/core/visible_test.cpp
std::string show_controls(std::string_view text);

/// Likewise, with new lines and tabs written out as well: for a name or a value, which must not look like further
/// lines.
/// Checked  tests/core/visible_test.cpp
std::string show_on_one_line(std::string_view text);

}  // namespace rollrig
