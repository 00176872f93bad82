#include "sim/core/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "sim/core/visible.h"

namespace rollrig {

std::size_t count_characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string wrap(const std::string& text, std::size_t indent, std::size_t width) {
  std::istringstream words(show_controls(text));
  std::string out;
  std::string line(indent, ' ');
  std::string word;
  bool empty = true;
  while (words >> word) {
    if (!empty && count_characters(line) + 1 + count_characters(word) > width) {
      out += line + "\n";
      line.assign(indent, ' ');
      empty = true;
    }
    if (!empty) line += ' ';
    line += word;
    empty = false;
  }
  return out + line + "\n";
}

std::string shorten(const std::string& text, std::size_t most) {
  if (count_characters(text) <= most) return text;
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    const bool begins_one = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;
    if (begins_one && ++characters > most - 3) break;
  }
  return text.substr(0, end) + "...";
}

std::string format_count(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string last_part(const std::string& name, char separator) { return name.substr(name.rfind(separator) + 1); }

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // which from_chars does not take
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace rollrig
