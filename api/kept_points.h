#pragma once
/// The folder in which a sweep keeps the points that are done, so that it can go on after an interruption.

#include <optional>
#include <string>

#include "api/folder_lock.h"

namespace rollrig {

/// The folder of one sweep, which this process alone uses while the object is there. Unless it holds points, it goes
/// with the object.
class KeptPoints {
 public:
  /// Makes the folder, or takes that of an interrupted sweep. `definition` says what the sweep is. Throws InputError:
  /// another process uses it, it holds another sweep's points, it cannot be made.
  KeptPoints(std::string path, const std::string& definition);
  ~KeptPoints();
  KeptPoints(const KeptPoints&) = delete;
  KeptPoints& operator=(const KeptPoints&) = delete;

  /// Removes the points, and the folder unless it has files of somebody else.
  void remove() const;

 private:
  void open();
  void require_definition(const std::string& definition) const;

  std::string path_;
  std::optional<FolderLock> lock_;
};

}  // namespace rollrig
