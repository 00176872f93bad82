#pragma once
/// Plain text: for a terminal, and numbers that a person typed.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rollrig {

/// Characters, not bytes, so that "§" counts once.
std::size_t count_characters(const std::string& text);

/// Text broken into lines of at most `width`, each indented.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width = 80);

/// A text of at most so many characters: of a longer one, its beginning and "...".
std::string shorten(const std::string& text, std::size_t most);

/// "1 run", "2 runs": a number and what it counts, with an s unless it is one.
std::string format_count(std::size_t count, const std::string& what);

/// What follows the last separator of a name, all of it where there is none: the key of "model.A", the folder of a
/// path.
std::string last_part(const std::string& name, char separator = '.');

/// A finite number in decimal or scientific notation, with a sign or without, that is the whole of the text.
/// Checked  tests/core/text_test.cpp
std::optional<double> parse_number(std::string_view text);

}  // namespace rollrig
