#include "campaigns/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace rollrig::campaigns {
namespace {

/// In the header of the file, by which `file` and others tell whose it is: "roll" in ASCII.
constexpr int kApplication = 0x726f6c6c;

/// Calls `use`; what goes wrong with the file is told as an error of it.
template <class Use>
auto with_file(const std::string& path, const Use& use) {
  try {
    return use();
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    std::string what = fmt::format("cannot use the file of results: {}", error.what());
    std::string allowed = "a file that rollrig campaign has written, in a folder that can be written to";
    if (code == SQLITE_BUSY) {
      what = "another process works on this part of the campaign";
      allowed = "one process for each part: --shard I/N, each with its own I";
    } else if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
      what = "this is no file of a campaign's results, or it is damaged";
      allowed = "a file that rollrig campaign has written; without it, its items are carried out again";
    } else if (code == SQLITE_FULL) {
      allowed = "room on the disk; what was written before is safe";
    }
    throw InputError({what, path, 0, "", "", allowed, ""});
  }
}

/// How long to wait for a process that reads a file.
constexpr int kPatience_ms = 2000;  // Assumed: reading takes less

/// Opens a file for this process alone. In this mode, set before the file is first read, SQLite needs no memory that
/// is shared between processes.
SQLite::Database open_alone(const std::string& path, int flags, int patience_ms = kPatience_ms) {
  SQLite::Database database(path, flags, patience_ms);
  database.exec("PRAGMA locking_mode = EXCLUSIVE");
  return database;
}

/// Whether a file has a log: a process writes it, or was killed as it did.
bool has_log(const std::string& path) { return is_there(path + "-wal"); }

/// Opens a file to read it, beside others. What a killed process has left in the log is taken into the file first.
SQLite::Database open_to_read(const std::string& path) {
  if (has_log(path)) return open_alone(path, SQLite::OPEN_READWRITE);
  return SQLite::Database(path, SQLite::OPEN_READONLY, kPatience_ms);
}

void require_definition(SQLite::Database& database, const std::string& path, const std::string& definition) {
  SQLite::Statement query(database, "SELECT definition FROM campaign");
  if (query.executeStep() && query.getColumn(0).getString() == definition) return;
  throw InputError(
      {"the results are those of another campaign", path, 0, "", "", "results of the campaign.json beside them", ""});
}

Record make_record(SQLite::Statement& row) {
  Record record;
  record.item = static_cast<std::size_t>(row.getColumn(0).getInt64());
  record.identity = row.getColumn(1).getString();
  record.seed = static_cast<std::uint64_t>(row.getColumn(2).getInt64());
  record.result = row.getColumn(3).getString();
  record.failure = row.getColumn(4).getString();
  return record;
}

}  // namespace

struct Store::Database {
  std::string path;
  SQLite::Database file;
  std::unique_ptr<SQLite::Statement> insert = {};
};

Store::Store(const std::string& path, const std::string& definition) {
  with_file(path, [&] {
    const bool is_new = !is_there(path);
    database_ =
        std::make_unique<Database>(Database{path, open_alone(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)});
    SQLite::Database& file = database_->file;
    file.exec("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
    if (is_new || !file.tableExists("items")) {
      SQLite::Transaction all(file);
      file.exec(fmt::format("PRAGMA application_id = {}", kApplication));
      file.exec("CREATE TABLE campaign (definition TEXT NOT NULL)");
      file.exec(
          "CREATE TABLE items (item INTEGER PRIMARY KEY, identity TEXT NOT NULL, seed INTEGER NOT NULL, "
          "result TEXT NOT NULL, failure TEXT NOT NULL)");
      SQLite::Statement insert(file, "INSERT INTO campaign VALUES (?)");
      insert.bind(1, definition);
      insert.exec();
      all.commit();
    }
    require_definition(file, path, definition);
    database_->insert =
        std::make_unique<SQLite::Statement>(file, "INSERT OR REPLACE INTO items VALUES (?, ?, ?, ?, ?)");
  });
}

Store::~Store() {
  if (database_ == nullptr || database_->insert == nullptr) return;
  try {
    database_->insert.reset();
    database_->file.exec("PRAGMA journal_mode = DELETE");  // all in one file, which can be read without being written
  } catch (const SQLite::Exception&) {                     // all records are in the file and its log
  }
}

void Store::write(const Record& record) {
  with_file(database_->path, [&] {
    SQLite::Statement& insert = *database_->insert;
    insert.bind(1, static_cast<std::int64_t>(record.item));
    insert.bindNoCopy(2, record.identity);
    insert.bind(3, static_cast<std::int64_t>(record.seed));
    insert.bindNoCopy(4, record.result);
    insert.bindNoCopy(5, record.failure);
    insert.exec();
    insert.reset();
  });
}

bool is_in_use(const std::string& path) {
  if (!has_log(path)) return false;
  try {
    SQLite::Database file = open_alone(path, SQLite::OPEN_READWRITE, 0);
    file.tableExists("items");
    return false;
  } catch (const SQLite::Exception& error) {
    return error.getErrorCode() == SQLITE_BUSY;
  }
}

void read_items(const std::string& path, const std::string& definition,
                const std::function<void(std::size_t item, bool has_failed)>& take) {
  with_file(path, [&] {
    SQLite::Database file = open_to_read(path);
    require_definition(file, path, definition);
    SQLite::Statement query(file, "SELECT item, failure <> '' FROM items ORDER BY item");
    while (query.executeStep()) {
      take(static_cast<std::size_t>(query.getColumn(0).getInt64()), query.getColumn(1).getInt() != 0);
    }
  });
}

void read_records(const std::vector<std::string>& paths, const std::string& definition,
                  const std::function<void(const Record&)>& take) {
  // One file after the other for each block of items: however many files there are, one is open.
  constexpr std::int64_t kBlock = 20000;  // Assumed: some 20 MB of records
  std::int64_t last = -1;
  for (const std::string& path : paths) {
    with_file(path, [&] {
      SQLite::Database file = open_to_read(path);
      require_definition(file, path, definition);
      last = std::max(last, file.execAndGet("SELECT ifnull(max(item), -1) FROM items").getInt64());
    });
  }
  for (std::int64_t first = 0; first <= last; first += kBlock) {
    std::map<std::size_t, Record> block;
    for (const std::string& path : paths) {
      with_file(path, [&] {
        SQLite::Database file = open_to_read(path);
        SQLite::Statement query(file, "SELECT * FROM items WHERE item >= ? AND item < ? ORDER BY item");
        query.bind(1, first);
        query.bind(2, first + kBlock);
        while (query.executeStep()) {
          const Record record = make_record(query);
          const auto [known, is_new] = block.emplace(record.item, record);
          const bool is_same = known->second.identity == record.identity && known->second.result == record.result &&
                               known->second.failure == record.failure;
          if (is_new || is_same) continue;
          throw InputError(
              {fmt::format("item {} came out otherwise than in another file of the campaign", record.item + 1), path, 0,
               "", "", "results of one program on machines of one kind", ""});
        }
      });
    }
    for (const auto& [item, record] : block) take(record);
  }
}

}  // namespace rollrig::campaigns
