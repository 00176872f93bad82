#include "sim/core/text_cursor.h"

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <locale>

namespace rollrig {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

}  // namespace

template <class Is>
std::optional<std::string> TextCursor::take_run(const Is& is, std::size_t least, std::size_t most) {
  const auto end = std::find_if_not(rest_.begin(), rest_.end(), is);
  const auto length = static_cast<std::size_t>(end - rest_.begin());
  if (length < least || length > most) return std::nullopt;
  std::string run(rest_.substr(0, length));
  rest_.remove_prefix(length);
  return run;
}

std::optional<std::string> TextCursor::take_digits(std::size_t least, std::size_t most) {
  return take_run(&is_digit, least, most);
}

std::optional<std::string> TextCursor::take_letters(std::size_t least, std::size_t most) {
  return take_run(&is_letter, least, most);
}

char TextCursor::take_one_of(std::string_view characters) {
  if (rest_.empty() || characters.find(rest_.front()) == std::string_view::npos) return '\0';
  const char taken = rest_.front();
  rest_.remove_prefix(1);
  return taken;
}

bool TextCursor::take_word(std::string_view word) {
  if (!boost::algorithm::istarts_with(rest_, word, std::locale::classic())) return false;
  rest_.remove_prefix(word.size());
  return true;
}

std::size_t TextCursor::skip_blanks() {
  const std::size_t count = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
  rest_.remove_prefix(count);
  return count;
}

}  // namespace rollrig
