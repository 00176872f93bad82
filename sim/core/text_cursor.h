#pragma once
/// A place in a text that moves on as parts of a grammar are taken. It looks at each character once, so that no text
/// is too long for it: std::regex would recurse for each character.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rollrig {

/// A blank, a tab or a line end.
constexpr const char* kBlanks = " \t\n\v\f\r";

/// Keeps a view of the text.
/// Checked  tests/core/text_cursor_test.cpp
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

  /// The next digits, if there are so many of them; else none, and the place stays.
  std::optional<std::string> take_digits(std::size_t least, std::size_t most = std::string_view::npos);
  /// The next letters (ASCII) likewise.
  std::optional<std::string> take_letters(std::size_t least, std::size_t most = std::string_view::npos);
  /// The next character, if it is one of these; else 0, and the place stays.
  char take_one_of(std::string_view characters);
  bool take(char character) { return take_one_of({&character, 1}) != '\0'; }
  /// A word in capital or small letters (ASCII); else the place stays.
  bool take_word(std::string_view word);
  /// How many blanks were passed over.
  std::size_t skip_blanks();

 private:
  template <class Is>
  std::optional<std::string> take_run(const Is& is, std::size_t least, std::size_t most);

  std::string_view rest_;
};

}  // namespace rollrig
