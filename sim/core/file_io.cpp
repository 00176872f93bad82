#include "sim/core/file_io.h"

#include <fcntl.h>
#include <sha256.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <boost/scope_exit.hpp>

#include "sim/core/error.h"
#include "sim/core/text_encoding.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

InputError file_problem(const std::string& what, const std::string& path, const std::string& allowed = {}) {
  return InputError({what, path, 0, "", "", allowed, ""});
}

InputError write_problem(const std::string& path, int error_number) {
  return file_problem(fmt::format("cannot write '{}': {}", path, std::strerror(error_number)), path,
                      "a place with room where this user may write");
}

void write_all(int descriptor, const std::string& path, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = ::write(descriptor, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw write_problem(path, errno);
    done += static_cast<std::size_t>(n);
  }
}

void write_new_file(const std::string& path, const std::string& content, int flags) {
  constexpr mode_t kReadableByAll = 0644;
  const int descriptor = ::open(path.c_str(), flags, kReadableByAll);
  if (descriptor < 0) throw write_problem(path, errno);
  bool closed = false;
  BOOST_SCOPE_EXIT_ALL(&) {
    if (!closed) ::close(descriptor);
  };
  write_all(descriptor, path, content);
  closed = true;
  if (::close(descriptor) != 0) throw write_problem(path, errno);
}

std::string staging_name(const fs::path& target) {
  fs::path name = target.filename().empty() ? target.parent_path().filename() : target.filename();
  const fs::path parent = target.filename().empty() ? target.parent_path().parent_path() : target.parent_path();
  return (parent / fmt::format(".{}.partial-{}", name.string(), ::getpid())).string();
}

/// The nearest folder on the way to `path` that exists.
fs::path find_existing_ancestor(const fs::path& path) {
  fs::path ancestor = fs::absolute(path);
  while (!fs::exists(ancestor) && ancestor.has_relative_path()) ancestor = ancestor.parent_path();
  return ancestor;
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

bool holds_files(const fs::path& path) { return fs::exists(path) && !fs::is_empty(path); }

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

void require_writable(const std::string& path) {
  if (path.empty() || path == "-") return;
  if (fs::is_directory(path)) {
    throw file_problem(fmt::format("'{}' is a directory, not a file", path), path, "a file name");
  }
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) throw file_problem(fmt::format("no such folder '{}'", folder.string()), path);
  // A file is replaced as a whole, which its folder must allow; what is no file (/dev/null) is written to as it is.
  const bool is_replaced = !fs::exists(path) || fs::is_regular_file(path);
  if (::access((is_replaced ? folder.string() : path).c_str(), W_OK) != 0) {
    throw file_problem(fmt::format("cannot write '{}': {}", path, std::strerror(errno)), path);
  }
}

void write_file_atomically(const std::string& path, const std::string& content) {
  if (fs::is_directory(path)) {
    throw file_problem(fmt::format("'{}' is a directory, not a file", path), path, "a file name");
  }
  const std::string temporary = staging_name(path);
  try {
    write_new_file(temporary, content, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    fs::rename(temporary, path);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    if (const auto* system = dynamic_cast<const fs::filesystem_error*>(&error)) {
      throw write_problem(path, system->code().value());
    }
    throw;
  }
}

void write_output(const std::string& path, const std::string& content) {
  if (path == "-") {
    std::cout << content << std::flush;
    if (!std::cout) throw file_problem("cannot write to standard output", path);
    return;
  }
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  const bool is_device = fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  if (is_device) {
    write_new_file(path, content, O_WRONLY | O_CLOEXEC);
  } else {
    write_file_atomically(path, content);
  }
}

OutputFolder::OutputFolder(std::string path, bool force) : path_(std::move(path)), staging_(staging_name(path_)) {
  if (fs::exists(path_) && !fs::is_directory(path_)) {
    throw file_problem(fmt::format("'{}' is a file, not a folder", path_), path_, "a folder name");
  }
  std::error_code code;
  if (!force && fs::exists(path_) && !fs::is_empty(path_, code)) {
    throw file_problem(fmt::format("folder '{}' holds files already", path_), path_,
                       "an empty or new folder, or --force to overwrite files of the same name");
  }
  const fs::path parent = find_existing_ancestor(fs::absolute(path_).lexically_normal().parent_path());
  const fs::path probe = parent / fmt::format(".rollrig-probe-{}", ::getpid());
  fs::create_directory(probe, code);
  if (code) throw write_problem(path_, code.value());
  fs::remove(probe, code);
}

void OutputFolder::add(const std::string& file_name, std::string content) { files_[file_name] = std::move(content); }

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!written_.empty()) fs::remove_all(staging_, ignored);
}

void OutputFolder::attempt(const std::function<void()>& act) const {
  try {
    act();
  } catch (const fs::filesystem_error& error) {
    throw write_problem(path_, error.code().value());
  }
}

void OutputFolder::move_into_existing() const {
  for (const std::string& name : written_) {
    fs::create_directories((fs::path(path_) / name).parent_path());
    fs::rename(fs::path(staging_) / name, fs::path(path_) / name);
  }
  fs::remove_all(staging_);
}

void OutputFolder::flush() {
  spdlog::debug("writes {} files to {}", files_.size(), path_);
  attempt([this] {
    for (const auto& [name, content] : files_) {
      const fs::path file = fs::path(staging_) / name;
      written_.insert(name);
      fs::create_directories(file.parent_path());
      write_new_file(file.string(), content, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    }
  });
  files_.clear();
}

void OutputFolder::commit() {
  flush();
  attempt([this] {
    fs::create_directories(staging_);
    if (holds_files(path_)) {
      move_into_existing();
    } else {
      fs::rename(staging_, path_);
    }
  });
}

}  // namespace rollrig
