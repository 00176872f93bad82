#include "serve/set_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>

#include "serve/refusal.h"
#include "sim/core/error.h"
#include "sim/core/text_encoding.h"

namespace fs = std::filesystem;

namespace rollrig::serve {
namespace {

constexpr std::size_t kLongestName = 120;  // Assumed: of one file or folder
constexpr std::size_t kDeepest = 4;        // Assumed: folders in folders

Refusal refuse_name(const std::string& name, const std::string& why) {
  return Refusal(400, fmt::format("the file '{}' is not taken: {}", name.substr(0, kLongestName), why));
}

void require_part(const std::string& name, const std::string& part) {
  if (part.empty()) throw refuse_name(name, "a part of its name is empty");
  if (part.size() > kLongestName) throw refuse_name(name, "its name is too long");
  if (part.front() == '.') throw refuse_name(name, "a name may not begin with a point");
  const bool has_control = std::any_of(part.begin(), part.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20U || c == '\x7f' || c == '\\';
  });
  if (has_control) throw refuse_name(name, "its name holds a control character or a backslash");
}

}  // namespace

const std::vector<std::string>& taken_endings() {
  static const std::vector<std::string> endings{".csv", ".toml", ".txt", ".tsv",  ".asc",
                                                ".dat", ".mat",  ".h5",  ".hdf5", ".mf4"};
  return endings;
}

void require_file_name(const std::string& name) {
  if (!decode_text(name, "utf-8").is_valid) throw Refusal(400, "the name of a file is not UTF-8 text");
  std::size_t begin = 0;
  std::size_t depth = 0;
  while (true) {
    const std::size_t slash = name.find('/', begin);
    require_part(name, name.substr(begin, slash - begin));
    if (slash == std::string::npos) break;
    if (++depth > kDeepest) throw refuse_name(name, "it lies too deep in folders");
    begin = slash + 1;
  }
  const std::string ending = boost::algorithm::to_lower_copy(fs::path(name).extension().string());
  const auto& endings = taken_endings();
  if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    throw refuse_name(name, fmt::format("its ending is none of {}", fmt::join(endings, ", ")));
  }
}

PrivateFolder::PrivateFolder() {
  std::string path = (fs::temp_directory_path() / "rollrig-serve-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr) {  // for this user alone
    throw InputError({"no folder for dropped files can be made", fs::temp_directory_path().string(), 0, "", "",
                      "a folder of temporary files (TMPDIR) that can be written to", ""});
  }
  path_ = path;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

IncomingFile::IncomingFile(const std::string& folder, const std::string& name) : path_(folder + "/" + name) {
  if (fs::exists(path_)) {
    is_finished_ = true;  // the other one stays
    throw refuse_name(name, "there is such a file already");
  }
  const fs::path above = fs::path(path_).parent_path();
  std::error_code failed;
  fs::create_directories(above, failed);
  if (failed || !fs::is_directory(above, failed)) {
    throw refuse_name(name, "a part of its path is a file, or the disk is full");
  }
  out_.open(path_, std::ios::binary);
  if (!out_) throw Refusal(507, "the dropped file cannot be written");
}

IncomingFile::~IncomingFile() {
  if (is_finished_) return;
  out_.close();
  std::error_code ignored;
  fs::remove(path_, ignored);
}

bool IncomingFile::append(const char* data, std::size_t size) {
  size_ += size;
  return static_cast<bool>(out_.write(data, static_cast<std::streamsize>(size)));
}

void IncomingFile::finish() {
  out_.close();
  if (!out_) throw Refusal(507, "the dropped file cannot be written: the disk is full");
  is_finished_ = true;
}

}  // namespace rollrig::serve
