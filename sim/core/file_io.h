#pragma once
/// Files in and out: reading with errors that say what is wrong, writing all or nothing.

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "include/rollrig/error.h"

namespace rollrig {

constexpr std::uintmax_t kLargestText_bytes = std::uintmax_t{64} << 20;  // Assumed: of TOML, JSON and other documents
constexpr std::uintmax_t kLargestTable_bytes = std::uintmax_t{1} << 30;  // Assumed: of tables, such as CSV logs

/// A file that cannot be read, whatever it holds: it is missing, not a regular file, unreadable, empty or too large.
class FileProblem : public InputError {
 public:
  using InputError::InputError;
};

/// The whole of a text file of at most kLargestText_bytes. Throws InputError when it is missing, a directory, a device,
/// a pipe, unreadable, empty, too large, or not UTF-8 text.
std::string read_text_file(const std::string& path);

/// The same of a table, which may have kLargestTable_bytes.
std::string read_table_file(const std::string& path);

/// The same of a table in one of the encodings of text_encoding.h, as UTF-8, of at most kLargestTable_bytes. `hint` is
/// for errors: where the user can set the encoding.
std::string read_text_file(const std::string& path, const std::string& encoding, const std::string& hint);

/// The bytes of a table in a binary format, of at most kLargestTable_bytes. Throws InputError as read_text_file() does.
std::string read_binary_file(const std::string& path);

/// Throws InputError where a path is not that of a regular file: nothing is there, or a directory, a device or a pipe,
/// which may never end, or which nobody may ever write to. For what opens a file by itself.
void require_file(const std::string& path);

/// Whether something is at a path. Throws InputError where the system cannot tell: the name is too long, its links go
/// round in a loop, a folder on the way may not be searched.
bool is_there(const std::string& path);

/// Counts a file as read that was read by other means than these functions.
void note_as_read(const std::string& path);

/// Whether read_text_file() has read this very file, by whatever name, since the program started.
bool was_read(const std::string& path);

/// The files that this thread reads while the object is there, by absolute path without links, in order of their names.
class ReadRecorder {
 public:
  ReadRecorder();
  ~ReadRecorder();
  ReadRecorder(const ReadRecorder&) = delete;
  ReadRecorder& operator=(const ReadRecorder&) = delete;

  std::vector<std::string> list_files() const { return {paths_.begin(), paths_.end()}; }
  void add(const std::string& path) { paths_.insert(path); }

 private:
  std::set<std::string> paths_;
  ReadRecorder* outer_;  // which records them, too
};

/// The path of the same folder whose name is nearest to that of `path`, which is not there; empty when none is near.
std::string nearest_file(const std::string& path);

/// SHA-256 of a string, in hexadecimal.
std::string calc_sha256(const std::string& content);

/// Text that is written beside its place and put there by commit(): standard output for `-`, a device such as
/// /dev/null or a pipe, or a file, which then stands there whole. It keeps owner and permissions of the file that it
/// replaces, as far as that is allowed; a link is replaced itself. What is not committed goes with the object.
class StagedOutput {
 public:
  /// Whether a file that stands there already is replaced.
  enum class Existing { kReplace, kKeep };

  /// Writes a file beside its place, under a name that nobody can foresee. Throws InputError (no permission, no space,
  /// no such folder, a file that is open).
  StagedOutput(std::string path, std::string content, Existing existing = Existing::kReplace);
  ~StagedOutput();
  StagedOutput(StagedOutput&& other) noexcept;
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  /// Adds to the end of what was staged, so that memory need not hold all of a file. Throws InputError.
  void append(const std::string& content);
  /// Whether it goes to standard output or a device: it then is written as it is, and cannot be taken back.
  bool is_direct() const { return is_direct_; }
  /// Throws InputError as the constructor does, or where a file is there and Existing is kKeep; Interrupted where a
  /// pipe takes no more and the user stops the program.
  void commit();

 private:
  std::string path_;
  std::string content_;  // of what is direct
  std::string staging_;  // empty where there is none
  Existing existing_;
  bool is_direct_ = false;
  bool is_appended_ = false;
};

/// Whether a folder holds more than staging files of a program that was killed. False where there is no folder.
bool holds_files(const std::string& folder);
/// Removes such staging files, as far as that is allowed. For a folder that no other program writes to.
void remove_staging_files(const std::string& folder);
/// Returns when the names in a folder are on the disk, such as after a rename. Throws InputError.
void synchronize_folder(const std::string& folder);

/// Writes one file whole. Throws InputError; what stood there before is kept then.
void write_file_atomically(const std::string& path, const std::string& content);

/// Writes text to standard output for `-`, else to a file atomically; a device such as /dev/null is
/// written to in place.
void write_output(const std::string& path, const std::string& content);

/// Writes what waits for standard output. Throws InputError where that cannot be, but not where its reader has gone,
/// such as `head`: it has what it wanted.
void flush_standard_output();
/// Whether standard output is a pipe that nobody reads any more.
bool is_reader_gone();

/// Throws InputError when write_output() could not write there: no such folder, no permission, a directory.
/// To be called before work whose result would otherwise be lost.
void require_writable(const std::string& path);

/// A result folder that appears whole or not at all: files are collected and written into a folder beside the final
/// one, which commit() renames. What is not committed goes with the object. Into a folder that holds files, and into
/// one that cannot be replaced (a mount point, the working folder), commit() moves file by file.
class OutputFolder {
 public:
  /// Throws InputError when the folder holds files and `force` is off, or when it cannot be made.
  OutputFolder(std::string path, bool force);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  void add(const std::string& file_name, std::string content);
  /// Writes what was added, so that memory need not hold all of it. Throws InputError as commit() does.
  void flush();
  /// Puts the folder in its place. Throws InputError where it cannot, and, unless `force` is on, where another program
  /// has put files there meanwhile, of which none is touched.
  void commit();
  const std::string& path() const { return path_; }

 private:
  void make_staging();
  void require_room() const;
  void synchronize() const;
  void move_whole();
  void move_into_existing();

  std::string path_;   // as given
  std::string place_;  // the same, absolute
  bool force_;
  bool is_filled_in_place_ = false;
  std::string staging_;                       // empty where there is none
  std::vector<std::string> parents_;          // folders made on the way to it
  std::map<std::string, std::string> files_;  // not written yet
  std::set<std::string> written_;
};

}  // namespace rollrig
