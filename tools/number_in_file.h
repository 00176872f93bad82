#pragma once
/// Numbers of a TOML file, replaced in place.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "sim/core/error.h"

namespace rollrig::tools {

/// The text with another number of `key` in [table]; a comment keeps its place. Throws RunFailure without such a key.
inline std::string replace_number(const std::string& text, const std::string& table, const std::string& key,
                                  double value) {
  const std::size_t header = text.find("\n[" + table + "]");
  const std::size_t line = text.find("\n" + key + " = ", header);
  if (header == std::string::npos || line == std::string::npos || line > text.find("\n[", header + 1)) {
    throw RunFailure("no key " + key + " in [" + table + "]");
  }
  const std::size_t end = std::min(text.find('\n', line + 1), text.size());
  const std::string old = text.substr(line + 1, end - line - 1);
  const std::size_t comment = old.find('#');
  std::string fresh = fmt::format("{} = {:.7g}", key, value);
  constexpr std::size_t kCommentColumn = 37;  // as in the assets
  if (comment != std::string::npos) fresh = fmt::format("{:<{}} {}", fresh, kCommentColumn, old.substr(comment));
  return text.substr(0, line + 1) + fresh + text.substr(end);
}

}  // namespace rollrig::tools
