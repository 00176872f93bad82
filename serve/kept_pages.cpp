#include "serve/kept_pages.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <filesystem>

#include "serve/refusal.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig::serve {
namespace {

/// Letters and digits of a text, others as one '-'.
std::string make_file_name(const std::string& title) {
  constexpr std::size_t kLongest = 60;
  std::string name;
  for (const char c : title) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (is_plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  name.resize(std::min(name.size(), kLongest));
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "page" : name;
}

}  // namespace

std::string KeptPages::keep(const std::string& title, const std::string& html) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed) {
    throw InputError({fmt::format("the folder of kept pages cannot be made: {}", failed.message()), folder_, 0,
                      "--keep", "", "a folder that can be written to", ""});
  }
  const std::string start =
      fmt::format("{}-{:%Y%m%d-%H%M%S}", make_file_name(title), fmt::localtime(std::time(nullptr)));
  std::string name = start + ".html";
  for (int i = 2; fs::exists(fs::path(folder_) / name); ++i) name = fmt::format("{}-{}.html", start, i);
  const std::string path = (fs::path(folder_) / name).string();
  StagedOutput(path, html, StagedOutput::Existing::kKeep).commit();
  paths_[name] = path;
  return name;
}

std::string KeptPages::read(const std::string& name) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto at = paths_.find(name);
  if (at == paths_.end()) throw Refusal(404, "no such page was kept since the start");
  return read_text_file(at->second);
}

}  // namespace rollrig::serve
