#pragma once
/// The private folder of a dropped set: files come in under names that cannot lead out of it.

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace rollrig::serve {

/// Limits of a dropped folder. Assumed: all of them.
constexpr std::uint64_t kMostSet_bytes = std::uint64_t{512} << 20;
constexpr std::size_t kMostSetFiles = 500;

/// Endings of files that are taken.
const std::vector<std::string>& taken_endings();

/// A name below the folder, "run.csv" or "runs/run.csv", as it was given. Throws Refusal for one that is empty, too
/// long or absolute, that leads out of the folder, is hidden, holds control characters or a backslash, or has another
/// ending.
/// Checked  tests/serve/set_folder_test.cpp
void require_file_name(const std::string& name);

/// A folder that only this user may read. It is deleted with the object.
class PrivateFolder {
 public:
  /// In the folder of temporary files. Throws InputError.
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// A file that comes in, part by part. Without finish() it is deleted with the object.
class IncomingFile {
 public:
  /// Throws Refusal where there is such a file already.
  IncomingFile(const std::string& folder, const std::string& name);
  ~IncomingFile();
  IncomingFile(const IncomingFile&) = delete;
  IncomingFile& operator=(const IncomingFile&) = delete;

  /// Whether the disk took it.
  bool append(const char* data, std::size_t size);
  void finish();
  std::uint64_t size() const { return size_; }

 private:
  std::string path_;
  std::ofstream out_;
  std::uint64_t size_ = 0;
  bool is_finished_ = false;
};

}  // namespace rollrig::serve
