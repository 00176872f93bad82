#pragma once
/// What came out of a campaign's items, in files of SQLite: one file for each process that works, which alone writes
/// it.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "include/rollrig/error.h"

namespace rollrig::campaigns {

/// Another process writes a results file now.
class FileInUse : public InputError {
 public:
  using InputError::InputError;
};

/// An item that was carried out.
struct Record {
  std::size_t item = 0;  // from 0
  std::string identity;  // SHA-256 of all that it depends on
  std::uint64_t seed = 0;
  std::string result;   // JSON on one line; empty where it failed
  std::string failure;  // why; empty where it did not fail
};

/// A file of records that this process writes.
///
/// It is kept as a write-ahead log in exclusive locking mode. A record is safe from a kill of the process once write()
/// has returned. The disk is written to at most once a second, by write(), and by close(): a loss of power can lose the
/// records since then. No memory is shared with other processes, so the file may be on a network drive that supports
/// locks. A second process that opens it is refused.
/// Source   sqlite.org/wal.html, "Use of WAL Without Shared-Memory"
class Store {
 public:
  /// Opens a file, or makes it. `definition` is that of CampaignFolder. Throws InputError: the file is another
  /// campaign's, is no such file, cannot be written, or another process has it open.
  Store(const std::string& path, const std::string& definition);
  /// As close(), without an error where that fails: all records are then in the file and its log.
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Throws InputError where it cannot be written, such as on a full disk.
  void write(const Record& record);
  /// Calls `visit` for each item that the file has.
  void list_items(const std::function<void(std::size_t item, bool has_failed)>& visit) const;
  /// Writes the content of the log into the file, which is then complete without it. Throws InputError where that
  /// cannot be. Nothing can be written afterwards.
  void close();

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

/// The files that another process is writing, in the same order. Takes a fifth of a second where there are any,
/// however many.
std::vector<std::string> list_in_use(const std::vector<std::string>& paths);

/// Calls `visit` for each record of the files in order of their items, once for each item. Throws InputError: a file is
/// another campaign's, is no such file, is written by a process now; two files have different records of one item.
void read_records(const std::vector<std::string>& paths, const std::string& definition,
                  const std::function<void(const Record&)>& visit);

/// Calls `visit` for each item of a file in order, with whether it failed. Throws InputError as read_records() does.
void read_items(const std::string& path, const std::string& definition,
                const std::function<void(std::size_t item, bool has_failed)>& visit);

/// Removes a file of which `has` has every item; one with a further item stays. Throws InputError where a process
/// writes it now, or it is no file of this campaign.
void remove_if_contained(const std::string& path, const std::string& definition,
                         const std::function<bool(std::size_t item)>& has);

}  // namespace rollrig::campaigns
