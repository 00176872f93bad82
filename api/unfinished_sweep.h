#pragma once
/// The folder with the finished points of a sweep, from which it can continue after an interruption.

#include <optional>
#include <string>

#include "api/folder_lock.h"

namespace rollrig {

/// The folder of one sweep. As long as the object lives, no other process uses it. The destructor removes a folder
/// without points.
class UnfinishedSweep {
 public:
  /// Makes the folder, or opens that of an interrupted sweep. `definition` says what the sweep is. Throws InputError:
  /// another process uses it, it holds points of another sweep, it cannot be made.
  UnfinishedSweep(std::string path, const std::string& definition);
  ~UnfinishedSweep();
  UnfinishedSweep(const UnfinishedSweep&) = delete;
  UnfinishedSweep& operator=(const UnfinishedSweep&) = delete;

  /// Removes the points, and the folder unless it has files of somebody else.
  void remove() const;

 private:
  void open();
  void require_definition(const std::string& definition) const;

  std::string path_;
  std::optional<FolderLock> lock_;
};

}  // namespace rollrig
