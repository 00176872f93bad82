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
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "sim/core/error.h"
#include "sim/core/text_encoding.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

FileProblem file_problem(const std::string& what, const std::string& path, const std::string& allowed = {}) {
  return FileProblem({what, path, 0, "", "", allowed, ""});
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

thread_local ReadRecorder* innermost_recorder = nullptr;

}  // namespace

void note_as_read(const std::string& path) {
  std::error_code code;
  const fs::path canonical = fs::canonical(path, code);
  if (code) return;
  const std::lock_guard<std::mutex> lock(files_read().mutex);
  files_read().paths.insert(canonical);
  if (innermost_recorder != nullptr) innermost_recorder->add(canonical.string());
}

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

FileProblem read_problem(const std::string& path, int error_number) {
  return file_problem(fmt::format("cannot read '{}': {}", path, std::strerror(error_number)), path);
}

}  // namespace

void require_file(const std::string& path) {
  if (!decode_text(path, "utf-8").is_valid) {
    throw file_problem("the name of a file is not UTF-8 text", path, "a name in UTF-8; rename the file or its folder");
  }
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) {
    throw FileProblem({fmt::format("no such file '{}'", path), path, 0, "", "", "", nearest_file(path)});
  }
  if (status.type() == fs::file_type::directory) {
    throw file_problem(fmt::format("'{}' is a directory, not a file", path), path);
  }
  if (code) throw read_problem(path, code.value());
  if (status.type() == fs::file_type::character || status.type() == fs::file_type::block) {
    throw file_problem(fmt::format("'{}' is a device, not a file", path), path);  // /dev/zero never ends
  }
  if (status.type() != fs::file_type::regular) {
    throw file_problem(fmt::format("'{}' is a pipe, not a file", path), path,
                       "a file: it is read more than once; write what the pipe gives to one first");
  }
}

namespace {

FileProblem too_large(const std::string& path, std::uintmax_t largest_bytes) {
  return file_problem(fmt::format("'{}' is too large", path), path,
                      fmt::format("at most {} MiB in a file of this kind", largest_bytes >> 20));
}

/// What is in a file that is there and not empty.
std::string read_bytes(const std::string& path, std::uintmax_t largest_bytes) {
  require_file(path);
  spdlog::debug("reads {}", path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw read_problem(path, errno);
  note_as_read(path);
  std::error_code code;
  const std::uintmax_t size = fs::file_size(path, code);  // those of /proc say 0, whatever is in them
  if (!code && size > largest_bytes) throw too_large(path, largest_bytes);
  std::string bytes;
  // A byte more than the file should have, so that its end is seen at the first reading.
  constexpr std::size_t kLargestPiece = 1 << 16;
  const std::size_t piece = code || size == 0 ? kLargestPiece : std::min<std::size_t>(size + 1, kLargestPiece);
  if (!code) bytes.reserve(size + piece);
  while (in) {
    const std::size_t before = bytes.size();
    bytes.resize(before + piece);
    in.read(bytes.data() + before, static_cast<std::streamsize>(piece));
    bytes.resize(before + static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > largest_bytes) throw too_large(path, largest_bytes);
  }
  if (in.bad()) throw read_problem(path, errno);
  if (bytes.size() < kLargestPiece) bytes.shrink_to_fit();
  if (bytes.empty()) throw file_problem(fmt::format("'{}' is empty", path), path);
  return bytes;
}

constexpr const char* kUtf8 =
    "UTF-8 text; iconv -f latin1 -t utf-8 (or -f utf-16) makes it of a text of another encoding";

std::string read_utf8(const std::string& path, std::uintmax_t largest_bytes) {
  std::string bytes = read_bytes(path, largest_bytes);
  const bool is_utf16 = has_utf16_mark(bytes);
  DecodedText decoded = decode_text(std::move(bytes), "utf-8");
  if (decoded.is_valid && !is_utf16) return std::move(decoded.text);
  throw file_problem(fmt::format("'{}' is not a text file", path), path, kUtf8);
}

}  // namespace

std::string read_text_file(const std::string& path) { return read_utf8(path, kLargestText_bytes); }

std::string read_table_file(const std::string& path) { return read_utf8(path, kLargestTable_bytes); }

std::string read_text_file(const std::string& path, const std::string& encoding, const std::string& hint) {
  DecodedText decoded = decode_text(read_bytes(path, kLargestTable_bytes), encoding);
  if (decoded.is_valid) return std::move(decoded.text);
  throw InputError({fmt::format("'{}' is not a text file in {}", path, encoding), path,
                    static_cast<int>(decoded.valid_lines) + 1, "", "", hint.empty() ? kUtf8 : hint, ""});
}

std::string read_binary_file(const std::string& path) { return read_bytes(path, kLargestTable_bytes); }

bool is_there(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::none) throw read_problem(path, code.value());
  return fs::exists(status);
}

bool was_read(const std::string& path) {
  const std::lock_guard<std::mutex> lock(files_read().mutex);
  return std::any_of(files_read().paths.begin(), files_read().paths.end(), [&path](const fs::path& read) {
    std::error_code code;
    return fs::equivalent(read, path, code);
  });
}

ReadRecorder::ReadRecorder() : outer_(std::exchange(innermost_recorder, this)) {}

ReadRecorder::~ReadRecorder() {
  innermost_recorder = outer_;
  if (outer_ != nullptr) outer_->paths_.insert(paths_.begin(), paths_.end());
}

std::string calc_sha256(const std::string& content) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> hex{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(content.data()), content.size(), hex.data());
  return hex.data();
}

}  // namespace rollrig
