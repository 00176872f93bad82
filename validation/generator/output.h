#pragma once
/// Folders and files that appear whole or not at all.

#include <string>

#include "validation/generator/measurement_set.h"

namespace blind {

/// A folder that is filled under a temporary name beside the final one and then renamed. What is not committed
/// goes with the object.
class StagedFolder {
 public:
  /// Throws InputError when something stands at `path` already, or when it cannot be written to.
  StagedFolder(std::string path, const std::string& option);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /// `name` may have folders in it.
  void write(const std::string& name, const std::string& content) const;
  void write(const std::string& folder, const Files& files) const;
  void commit();

 private:
  std::string path_;
  std::string staging_;
  bool committed_ = false;
};

/// Throws InputError when a file at `path` could not be written: to be asked before the work.
void require_writable(const std::string& path, const std::string& option);
/// Writes a file whole or not at all.
void write_file(const std::string& path, const std::string& content, const std::string& option);
/// Whether `path` lies in `folder`.
bool lies_within(const std::string& path, const std::string& folder);

/// All of a bank's file. Throws InputError.
std::string read_whole(const std::string& path);

std::string calc_sha256(const std::string& content);
/// SHA-256 over names and contents of all files of a set, as rollrig takes it of a folder.
std::string hash_files(const Files& files);

}  // namespace blind
