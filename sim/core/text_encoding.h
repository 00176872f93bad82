#pragma once
/// Encodings of text files.

#include <cstddef>
#include <string>
#include <vector>

namespace rollrig {

/// "utf-8", "utf-16" and "windows-1252". UTF-8 may begin with a byte order mark, UTF-16 must.
const std::vector<std::string>& encoding_names();

struct DecodedText {
  std::string text;  // UTF-8
  bool is_valid = true;
  std::size_t valid_lines = 0;  // whole lines before the first byte that is wrong
};

/// Bytes in one of these encodings as UTF-8. Bytes that begin with the byte order mark of UTF-16 are in UTF-16,
/// whatever `encoding` says. A zero byte is no text.
/// Checked  tests/core/text_encoding_test.cpp
DecodedText decode_text(std::string bytes, const std::string& encoding);

/// Whether bytes begin with the byte order mark of UTF-16.
bool has_utf16_mark(const std::string& bytes);

}  // namespace rollrig
