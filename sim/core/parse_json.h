#pragma once
/// JSON files in.

#include <string>

#include "sim/core/json.h"

namespace rollrig {

/// The document in a text; `path` stands for its file in messages. Throws InputError with its line: not JSON, nested
/// too deeply (sim/core/nesting.h), a number beyond what a double holds.
/// Checked  tests/core/parse_json_test.cpp
Json parse_json(const std::string& text, const std::string& path);

/// The document in a file. Throws InputError also as read_text_file() does.
Json read_json(const std::string& path);

}  // namespace rollrig
