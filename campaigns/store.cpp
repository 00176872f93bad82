#include "campaigns/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

#include "campaigns/design.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"

namespace rollrig::campaigns {
namespace {

/// In the header of the file, by which `file` and others tell whose it is: "roll" in ASCII.
constexpr int kApplication = 0x726f6c6c;
/// How long to wait for a process that reads a file.
constexpr int kPatience_ms = 2000;  // Assumed: reading takes less
/// How long to wait before a file counts as being written.
constexpr std::chrono::milliseconds kProbe{200};  // Assumed: another process that probes takes less
constexpr std::chrono::seconds kBetweenSyncs{1};

/// Whether files of a folder can be locked. Of a drive that has no locks, SQLite says the same as of a file that
/// another process has locked. A new file is tried: to close the results file would give up its locks.
bool can_lock_in(const std::string& folder) {
  std::string name = (std::filesystem::path(folder) / ".rollrig-lock-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) return true;  // something else is wrong
  unlink(name.c_str());
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_len = 1;
  const bool is_locked = fcntl(file, F_SETLK, &lock) == 0;
  close(file);
  return is_locked;
}

/// Calls `use`, and turns an error of SQLite into an InputError about the file. `busy` says what the user can do while
/// another process writes the file.
template <class Use>
auto with_file(const std::string& path, const char* busy, const Use& use) {
  try {
    return use();
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    const bool is_full = code == SQLITE_FULL;
    std::string what = fmt::format("cannot {} this results file: {}", is_full ? "write" : "use", error.what());
    std::string allowed = "a file that rollrig campaign has written, in a folder that can be written to";
    if (code == SQLITE_BUSY) {
      const std::string folder = std::filesystem::path(path).parent_path().string();
      if (!can_lock_in(folder)) {
        throw InputError({"the drive of the campaign's folder does not lock files", folder, 0, "", "",
                          "a folder on a drive with locks: a local one, or NFS mounted with locks", ""});
      }
      throw FileInUse({"another process is writing this results file", path, 0, "", "", busy, ""});
    }
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
      what = "this is not a results file of a campaign, or it is damaged";
      allowed = "a file that rollrig campaign has written; without it, its items are carried out again";
    } else if (is_full) {
      allowed = "room on the disk; what was written before is safe";
    } else if (code == SQLITE_IOERR) {
      allowed = "a disk that works, with room for your files (a quota may be full); what was written before is safe";
    }
    throw InputError({what, path, 0, "", "", allowed, ""});
  }
}

constexpr const char* kOnePartEach =
    "to wait until it has ended; in a campaign, give each process its own part (--shard I/N)";
constexpr const char* kWait = "to wait until the process has ended; see rollrig campaign status";

/// Opens a file for this process alone. In this mode, set before the file is first read, SQLite needs no memory that
/// is shared between processes.
SQLite::Database open_alone(const std::string& path, int flags, int patience_ms = kPatience_ms) {
  note_as_read(path);  // it is not to be replaced by an output
  SQLite::Database database(path, flags, patience_ms);
  database.exec("PRAGMA locking_mode = EXCLUSIVE");
  return database;
}

/// Writes the content of the log of a file into the file, and removes the log. The content is on the disk before the
/// file is marked as one without a log. The mark need not wait for the disk: is_marked_as_logged() finds a file
/// without.
void checkpoint_log(SQLite::Database& database) {
  database.exec("PRAGMA wal_checkpoint(TRUNCATE)");
  database.exec("PRAGMA synchronous = OFF");
  database.exec("PRAGMA journal_mode = DELETE");
}

/// Whether a file has a log: a process writes it, or was killed as it did.
bool has_log(const std::string& path) { return is_there(path + "-wal") || is_there(path + "-journal"); }

/// Whether the header of a file says that it has a log. It may say so without a log: a process can be killed after it
/// has removed the log and before it has changed the header.
/// Source  the file format of SQLite, 1.3.3: byte 18 is 2 then
bool is_marked_as_logged(const std::string& path) {
  constexpr std::streamoff kWriteVersion = 18;
  std::ifstream in(path, std::ios::binary);
  in.seekg(kWriteVersion);
  return in.get() == 2;
}

/// Whether another process writes a file, or is checking at this moment whether one does. Also writes the log that a
/// killed process has left into the file.
bool is_locked(const std::string& path) {
  if (!has_log(path)) return false;
  try {
    SQLite::Database file = open_alone(path, SQLite::OPEN_READWRITE, 0);
    checkpoint_log(file);
    return false;
  } catch (const SQLite::Exception& error) {
    return error.getErrorCode() == SQLITE_BUSY;
  }
}

/// Opens a file that no process writes and that may be in a folder in which nothing can be written.
SQLite::Database open_unchanged(const std::string& path) {
  std::string escaped;
  for (const char c : path) escaped += c == '%' || c == '?' || c == '#' ? fmt::format("%{:02X}", c) : std::string(1, c);
  return SQLite::Database("file:" + escaped + "?immutable=1", SQLite::OPEN_READONLY | SQLite::OPEN_URI, kPatience_ms);
}

/// Whether a file could not be written, as where the disk is full. Of a quota, and of a network drive that tells it
/// late, SQLite says only that writing failed.
bool has_failed_to_write(const SQLite::Exception& error) {
  const int code = error.getExtendedErrorCode();
  return error.getErrorCode() == SQLITE_FULL || code == SQLITE_IOERR_WRITE || code == SQLITE_IOERR_FSYNC;
}

/// Opens a file to read it, beside others that read it. What a killed process has left in the log is written into the
/// file first; where that fails, it is read from the log, and other processes meanwhile take the file for one that is
/// being written.
SQLite::Database open_to_read(const std::string& path) {
  if (!is_there(path)) {
    throw InputError({"this results file no longer exists: another process has merged or removed it", path, 0, "", "",
                      "the same command once more", ""});
  }
  const bool has_its_log = has_log(path);
  if (has_its_log || is_marked_as_logged(path)) {
    try {
      SQLite::Database database = open_alone(path, SQLite::OPEN_READWRITE);
      try {
        checkpoint_log(database);
      } catch (const SQLite::Exception& error) {
        if (!has_failed_to_write(error)) throw;
        return database;
      }
    } catch (const SQLite::Exception& error) {
      if (has_its_log || error.getErrorCode() == SQLITE_BUSY) throw;
      note_as_read(path);
      return open_unchanged(path);
    }
  }
  note_as_read(path);
  return SQLite::Database(path, SQLite::OPEN_READONLY, kPatience_ms);
}

/// Whether the file has its tables: not where a process was killed as it made the file. Throws InputError where they
/// are another campaign's, or something else.
bool has_tables(SQLite::Database& database, const std::string& path, const std::string& definition) {
  if (!database.tableExists("campaign")) {
    if (database.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0) return false;
    throw InputError({"this is not a results file of a campaign", path, 0, "", "",
                      "a file that rollrig campaign has written; or move this one away", ""});
  }
  SQLite::Statement query(database, "SELECT definition FROM campaign");
  if (query.executeStep()) {
    const std::string stored = query.getColumn(0).getString();
    if (stored == definition || calc_sha256(stored) == definition) return true;  // older files hold the whole text
  }
  throw InputError({"these are the results of another campaign", path, 0, "", "",
                    "results of the campaign whose campaign.json is in the same folder", ""});
}

void make_tables(SQLite::Database& database, const std::string& definition) {
  SQLite::Transaction all(database);
  database.exec(fmt::format("PRAGMA application_id = {}", kApplication));
  database.exec("CREATE TABLE campaign (definition TEXT NOT NULL)");
  // In the order in which they are written, which takes the same time whatever their order; the index is small.
  database.exec(
      "CREATE TABLE items (item INTEGER NOT NULL UNIQUE, identity TEXT NOT NULL, seed INTEGER NOT NULL, "
      "result TEXT NOT NULL, failure TEXT NOT NULL)");
  SQLite::Statement insert(database, "INSERT INTO campaign VALUES (?)");
  insert.bind(1, definition);
  insert.exec();
  all.commit();
}

void visit_items(SQLite::Database& database, const std::function<void(std::size_t item, bool has_failed)>& visit) {
  SQLite::Statement query(database, "SELECT item, failure <> '' FROM items ORDER BY item");
  while (query.executeStep()) {
    visit(static_cast<std::size_t>(query.getColumn(0).getInt64()), query.getColumn(1).getInt() != 0);
  }
}

Record read_row(SQLite::Statement& row) {
  Record record;
  record.item = static_cast<std::size_t>(row.getColumn(0).getInt64());
  record.identity = row.getColumn(1).getString();
  record.seed = static_cast<std::uint64_t>(row.getColumn(2).getInt64());
  record.result = row.getColumn(3).getString();
  record.failure = row.getColumn(4).getString();
  return record;
}

/// Adds the records of a file with first <= item < end to `block`.
void add_records(const std::string& path, std::int64_t first, std::int64_t end, std::map<std::size_t, Record>& block) {
  SQLite::Database file = open_to_read(path);
  if (!file.tableExists("items")) return;
  SQLite::Statement query(file, "SELECT * FROM items WHERE item >= ? AND item < ? ORDER BY item");
  query.bind(1, first);
  query.bind(2, end);
  while (query.executeStep()) {
    const Record record = read_row(query);
    const auto [known, is_new] = block.emplace(record.item, record);
    const bool is_same = known->second.identity == record.identity && known->second.result == record.result &&
                         known->second.failure == record.failure;
    if (is_new || is_same) continue;
    throw InputError({fmt::format("item {} has another result than in another file of the campaign", record.item + 1),
                      path, 0, "", "", "results of one program on machines of one kind", ""});
  }
}

}  // namespace

struct Store::Database {
  std::string path;
  SQLite::Database file;
  std::unique_ptr<SQLite::Statement> insert = {};
  std::chrono::steady_clock::time_point next_sync = {};
};

Store::Store(const std::string& path, const std::string& definition) {
  with_file(path, kOnePartEach, [&] {
    const bool is_new = !is_there(path);
    database_ =
        std::make_unique<Database>(Database{path, open_alone(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)});
    SQLite::Database& file = database_->file;
    // A loss of power cannot destroy results before there are any, so making the file does not wait for the disk.
    file.exec(is_new ? "PRAGMA synchronous = OFF" : "PRAGMA synchronous = NORMAL");
    file.exec("PRAGMA journal_mode = WAL");
    if (!has_tables(file, path, definition)) make_tables(file, definition);
    file.exec("PRAGMA synchronous = NORMAL");
    database_->next_sync = std::chrono::steady_clock::now() + kBetweenSyncs;
    note_as_read(path);  // which it could not be before it was made
    // An item that another file had, and that was carried out again, has the same record.
    database_->insert =
        std::make_unique<SQLite::Statement>(file, "INSERT OR REPLACE INTO items VALUES (?, ?, ?, ?, ?)");
  });
}

Store::~Store() {
  try {
    close();
  } catch (const InputError&) {  // all records are in the file and its log
  }
}

void Store::close() {
  if (database_ == nullptr) return;
  with_file(database_->path, kOnePartEach, [this] {
    database_->insert.reset();
    checkpoint_log(database_->file);
  });
  database_.reset();  // which lets go of the file
}

void Store::write(const Record& record) {
  with_file(database_->path, kOnePartEach, [&] {
    SQLite::Statement& insert = *database_->insert;
    insert.tryReset();  // where the last one failed, as on a full disk
    insert.bind(1, static_cast<std::int64_t>(record.item));
    insert.bindNoCopy(2, record.identity);
    insert.bind(3, static_cast<std::int64_t>(record.seed));
    insert.bindNoCopy(4, record.result);
    insert.bindNoCopy(5, record.failure);
    insert.exec();
    insert.reset();
    const auto now = std::chrono::steady_clock::now();
    if (now < database_->next_sync) return;
    database_->file.exec("PRAGMA wal_checkpoint(PASSIVE)");  // which waits for the disk
    database_->next_sync = now + kBetweenSyncs;
  });
}

void Store::list_items(const std::function<void(std::size_t item, bool has_failed)>& visit) const {
  with_file(database_->path, kOnePartEach, [&] { visit_items(database_->file, visit); });
}

std::vector<std::string> list_in_use(const std::vector<std::string>& paths) {
  std::vector<std::string> in_use;
  std::copy_if(paths.begin(), paths.end(), std::back_inserter(in_use), &is_locked);
  if (in_use.empty()) return in_use;
  std::this_thread::sleep_for(kProbe);
  in_use.erase(std::remove_if(in_use.begin(), in_use.end(), [](const std::string& path) { return !is_locked(path); }),
               in_use.end());
  return in_use;
}

void read_items(const std::string& path, const std::string& definition,
                const std::function<void(std::size_t item, bool has_failed)>& visit) {
  with_file(path, kWait, [&] {
    SQLite::Database file = open_to_read(path);
    if (has_tables(file, path, definition)) visit_items(file, visit);
  });
}

void read_records(const std::vector<std::string>& paths, const std::string& definition,
                  const std::function<void(const Record&)>& visit) {
  // One file after the other for each block of items: however many files there are, one is open.
  constexpr std::int64_t kBlock = 20000;  // Assumed: some 20 MB of records
  std::int64_t last = -1;
  for (const std::string& path : paths) {
    with_file(path, kWait, [&] {
      SQLite::Database file = open_to_read(path);
      if (!has_tables(file, path, definition)) return;
      const std::int64_t lowest = file.execAndGet("SELECT ifnull(min(item), 0) FROM items").getInt64();
      const std::int64_t highest = file.execAndGet("SELECT ifnull(max(item), -1) FROM items").getInt64();
      last = std::max(last, highest);
      if (lowest >= 0 && highest < static_cast<std::int64_t>(kMostItems)) return;
      throw InputError(
          {fmt::format("the results have an item {}", lowest < 0 ? lowest : highest), path, 0, "", "",
           fmt::format("items from 0 on, below {}; without the file, its items are carried out again", kMostItems),
           ""});
    });
  }
  for (std::int64_t first = 0; first <= last; first += kBlock) {
    std::map<std::size_t, Record> block;
    for (const std::string& path : paths) {
      with_file(path, kWait, [&] { add_records(path, first, first + kBlock, block); });
    }
    for (const auto& [item, record] : block) {
      throw_if_interrupted();
      visit(record);
    }
  }
}

void remove_if_contained(const std::string& path, const std::string& definition,
                         const std::function<bool(std::size_t item)>& has) {
  with_file(path, kWait, [&] {
    SQLite::Database file = open_alone(path, SQLite::OPEN_READWRITE);
    checkpoint_log(file);
    bool is_contained = true;
    const auto check = [&](std::size_t item, bool /*has_failed*/) { is_contained = is_contained && has(item); };
    if (has_tables(file, path, definition)) visit_items(file, check);
    if (is_contained) std::filesystem::remove(path);  // while nobody else can open it
  });
}

}  // namespace rollrig::campaigns
