#include "sim/core/visible.h"

#include <fmt/format.h>

#include <boost/locale/utf.hpp>

namespace rollrig {
namespace {

using Utf8 = boost::locale::utf::utf_traits<char>;

/// What a terminal carries out, or what changes the direction of the text after it (Unicode bidirectional algorithm,
/// and the separators of lines and paragraphs).
bool is_control(boost::locale::utf::code_point c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0x061C || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

std::string write_out(boost::locale::utf::code_point c) {
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  return c < 0x80 ? fmt::format("\\x{:02x}", static_cast<unsigned>(c))
                  : fmt::format("\\u{:04x}", static_cast<unsigned>(c));
}

std::string show(std::string_view text, bool keeps_layout) {
  std::string shown;
  shown.reserve(text.size());
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    const char* const first = at;
    const boost::locale::utf::code_point c = Utf8::decode(at, end);
    if (!boost::locale::utf::is_valid_codepoint(c)) {
      at = first + 1;
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(*first));
    } else if (is_control(c) && !(keeps_layout && (c == '\n' || c == '\t'))) {
      shown += write_out(c);
    } else {
      shown.append(first, at);
    }
  }
  return shown;
}

}  // namespace

std::string show_controls(std::string_view text) { return show(text, true); }

std::string show_on_one_line(std::string_view text) { return show(text, false); }

}  // namespace rollrig
