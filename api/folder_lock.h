#pragma once
/// An exclusive lock on a folder.

#include <string>

namespace rollrig {

/// Locks a folder against other processes that lock it, for as long as the object is there. Where the file system has
/// no locks for folders, as on some network drives, every process gets the lock.
class FolderLock {
 public:
  explicit FolderLock(const std::string& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Why the folder cannot be opened, as errno says it; 0 where it is open.
  int error() const { return error_; }
  /// Whether another process has locked it.
  bool is_taken() const { return is_taken_; }
  /// Whether the folder that is open is still the one at the path.
  bool is_in_place() const;

 private:
  std::string path_;
  int descriptor_ = -1;
  int error_ = 0;
  bool is_taken_ = false;
};

}  // namespace rollrig
