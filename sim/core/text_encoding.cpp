#include "sim/core/text_encoding.h"

#include <iconv.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <boost/scope_exit.hpp>
#include <stdexcept>
#include <string_view>

namespace rollrig {
namespace {

DecodedText give_up_at(const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(byte);
  return {"", false, static_cast<std::size_t>(std::count(text.begin(), end, '\n'))};
}

/// By the converter of the C library.
DecodedText convert(const std::string& bytes, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == iconv_t(-1)) throw std::runtime_error(std::string("this system cannot convert ") + encoding);
  BOOST_SCOPE_EXIT_ALL(&) { iconv_close(converter); };
  std::string in = bytes;
  std::string out(3 * bytes.size() + 4, '\0');  // more than any character becomes
  char* from = in.data();
  char* to = out.data();
  std::size_t left = in.size();
  std::size_t room = out.size();
  const std::size_t failed = iconv(converter, &from, &left, &to, &room);
  out.resize(out.size() - room);
  if (failed == static_cast<std::size_t>(-1)) return give_up_at(out, out.size());
  return {out, true, 0};
}

std::size_t find_wrong_utf8(const std::string& text) {
  auto it = text.begin();
  while (it != text.end()) {
    const auto at = it;
    const auto code = boost::locale::utf::utf_traits<char>::decode(it, text.end());
    if (code == boost::locale::utf::illegal || code == boost::locale::utf::incomplete) {
      return static_cast<std::size_t>(at - text.begin());
    }
  }
  return std::string::npos;
}

}  // namespace

const std::vector<std::string>& encoding_names() {
  static const std::vector<std::string> names{"utf-8", "utf-16", "windows-1252"};
  return names;
}

bool has_utf16_mark(const std::string& bytes) {
  const std::string_view start = std::string_view(bytes).substr(0, 2);
  return start == "\xFF\xFE" || start == "\xFE\xFF";
}

DecodedText decode_text(std::string bytes, const std::string& encoding) {
  const bool is_utf16 = has_utf16_mark(bytes);
  DecodedText decoded{std::move(bytes), true, 0};
  if (is_utf16) {
    decoded = convert(decoded.text, "UTF-16");
  } else if (encoding == "windows-1252") {
    decoded = convert(decoded.text, "WINDOWS-1252");
  } else if (encoding == "utf-16") {
    return {"", false, 0};  // without a mark, the order of the bytes is not known
  }
  if (!decoded.is_valid) return decoded;
  const std::size_t wrong = std::min(find_wrong_utf8(decoded.text), decoded.text.find('\0'));
  if (wrong != std::string::npos) return give_up_at(decoded.text, wrong);
  return decoded;  // not by a conditional operator, which would copy the text
}

}  // namespace rollrig
