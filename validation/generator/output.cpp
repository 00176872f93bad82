#include "validation/generator/output.h"

#include <fmt/format.h>
#include <sha256.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "validation/generator/problem.h"

namespace fs = std::filesystem;

namespace blind {
namespace {

InputError cannot_write(const std::string& path, const std::string& option, const std::string& why) {
  return InputError(
      {fmt::format("cannot write '{}': {}", path, why), option, path, "a place where this user may write", ""});
}

void write_whole(const std::string& path, const std::string& content, const std::string& option) {
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  if (!out) throw cannot_write(path, option, std::strerror(errno));
}

fs::path absolute_without_end_slash(const std::string& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.filename().empty() ? normal.parent_path() : normal;
}

std::string staging_name(const std::string& path) {
  const fs::path target = absolute_without_end_slash(path);
  return (target.parent_path() / fmt::format(".{}.partial-{}", target.filename().string(), ::getpid())).string();
}

}  // namespace

StagedFolder::StagedFolder(std::string path, const std::string& option)
    : path_(std::move(path)), staging_(staging_name(path_)) {
  if (fs::exists(path_) && !(fs::is_directory(path_) && fs::is_empty(path_))) {
    throw InputError({fmt::format("'{}' is there already", path_), option, path_, "an empty or new folder", ""});
  }
  std::error_code code;
  fs::create_directories(staging_, code);
  if (code) throw cannot_write(path_, option, code.message());
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(staging_, ignored);
}

void StagedFolder::write(const std::string& name, const std::string& content) const {
  const fs::path file = fs::path(staging_) / name;
  fs::create_directories(file.parent_path());
  write_whole(file.string(), content, "--out");
}

void StagedFolder::write(const std::string& folder, const Files& files) const {
  for (const auto& [name, content] : files) write(folder.empty() ? name : folder + "/" + name, content);
}

void StagedFolder::commit() {
  fs::rename(staging_, absolute_without_end_slash(path_));
  committed_ = true;
}

void require_writable(const std::string& path, const std::string& option) {
  const fs::path target = absolute_without_end_slash(path);
  if (fs::is_directory(target)) throw InputError({"'" + path + "' is a folder", option, path, "a file name", ""});
  if (!fs::is_directory(target.parent_path())) {
    throw InputError({"no such folder '" + target.parent_path().string() + "'", option, path, "", ""});
  }
  if (::access(target.parent_path().c_str(), W_OK) != 0) throw cannot_write(path, option, std::strerror(errno));
}

void write_file(const std::string& path, const std::string& content, const std::string& option) {
  const std::string staging = staging_name(path);
  try {
    write_whole(staging, content, option);
    fs::rename(staging, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(staging, ignored);
    throw;
  }
}

bool lies_within(const std::string& path, const std::string& folder) {
  const fs::path relative = fs::weakly_canonical(absolute_without_end_slash(path))
                                .lexically_relative(fs::weakly_canonical(absolute_without_end_slash(folder)));
  return !relative.empty() && *relative.begin() != "..";
}

std::string read_whole(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) {
    throw InputError({fmt::format("cannot read '{}'", path), "bank", fs::path(path).parent_path().string(),
                      "a folder made by rollrig_blind bank", ""});
  }
  return text.str();
}

std::string calc_sha256(const std::string& content) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> hex{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(content.data()), content.size(), hex.data());
  return hex.data();
}

std::string hash_files(const Files& files) {
  std::string all;
  for (const auto& [name, content] : files) all += fmt::format("{}  {}\n", calc_sha256(content), name);
  return calc_sha256(all);
}

}  // namespace blind
