#include "sim/core/file_io.h"

#include <sha256.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "sim/core/error.h"
#include "sim/core/text_encoding.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

InputError file_problem(const std::string& what, const std::string& path, const std::string& allowed = {}) {
  return InputError({what, path, 0, "", "", allowed, ""});
}

/// What read_text_file() has read, from whichever thread.
struct FilesRead {
  std::mutex mutex;
  std::set<fs::path> paths;  // without links
};

FilesRead& files_read() {
  static FilesRead files;
  return files;
}

void note_as_read(const std::string& path) {
  std::error_code code;
  const fs::path canonical = fs::canonical(path, code);
  if (code) return;
  const std::lock_guard<std::mutex> lock(files_read().mutex);
  files_read().paths.insert(canonical);
}

}  // namespace

std::string nearest_file(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::vector<std::string> names;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, code)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::string nearest = nearest_name(fs::path(path).filename().string(), names);
  return nearest.empty() ? "" : (folder / nearest).string();
}

namespace {

/// What is in a file that is there and not empty.
std::string read_bytes(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) {
    throw InputError({fmt::format("no such file '{}'", path), path, 0, "", "", "", nearest_file(path)});
  }
  if (status.type() == fs::file_type::directory) {
    throw file_problem(fmt::format("'{}' is a directory, not a file", path), path);
  }
  if (status.type() == fs::file_type::character || status.type() == fs::file_type::block) {
    throw file_problem(fmt::format("'{}' is a device, not a file", path), path);  // /dev/zero never ends
  }
  spdlog::debug("reads {}", path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw file_problem(fmt::format("cannot read '{}': {}", path, std::strerror(errno)), path);
  note_as_read(path);
  std::ostringstream content;
  content << in.rdbuf();
  std::string text = content.str();
  if (text.empty()) throw file_problem(fmt::format("'{}' is empty", path), path);
  return text;
}

constexpr const char* kUtf8 =
    "UTF-8 text; iconv -f latin1 -t utf-8 (or -f utf-16) makes it of a text of another encoding";

}  // namespace

std::string read_text_file(const std::string& path) {
  std::string text = read_bytes(path);
  const DecodedText decoded = decode_text(text, "utf-8");
  if (!decoded.is_valid || decoded.text != text) {
    throw file_problem(fmt::format("'{}' is not a text file", path), path, kUtf8);
  }
  return text;
}

std::string read_text_file(const std::string& path, const std::string& encoding, const std::string& hint) {
  DecodedText decoded = decode_text(read_bytes(path), encoding);
  if (decoded.is_valid) return std::move(decoded.text);
  throw InputError({fmt::format("'{}' is not a text file in {}", path, encoding), path,
                    static_cast<int>(decoded.valid_lines) + 1, "", "", hint.empty() ? kUtf8 : hint, ""});
}

bool was_read(const std::string& path) {
  const std::lock_guard<std::mutex> lock(files_read().mutex);
  return std::any_of(files_read().paths.begin(), files_read().paths.end(), [&path](const fs::path& read) {
    std::error_code code;
    return fs::equivalent(read, path, code);
  });
}

std::string calc_sha256(const std::string& content) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> hex{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(content.data()), content.size(), hex.data());
  return hex.data();
}

}  // namespace rollrig
