#pragma once
/// Files in and out: reading with errors that say what is wrong, writing all or nothing.

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace rollrig {

/// The whole of a text file. Throws InputError when it is missing, a directory, unreadable, empty, or
/// not UTF-8 text.
std::string read_text_file(const std::string& path);

/// The same of a text in one of the encodings of text_encoding.h, as UTF-8. `hint` is for errors: where to say the
/// encoding.
std::string read_text_file(const std::string& path, const std::string& encoding, const std::string& hint);

/// Whether read_text_file() has read this very file, by whatever name, since the program started.
bool was_read(const std::string& path);

/// The path of the same folder whose name is nearest to that of `path`, which is not there; empty when none is near.
std::string nearest_file(const std::string& path);

/// SHA-256 of a string, in hexadecimal.
std::string calc_sha256(const std::string& content);

/// Writes one file: to a temporary name beside it, then renamed. Throws InputError (no permission, no
/// space, no such folder); what stood there before is kept then.
void write_file_atomically(const std::string& path, const std::string& content);

/// Writes text to standard output for `-`, else to a file atomically; a device such as /dev/null is
/// written to in place.
void write_output(const std::string& path, const std::string& content);

/// Throws InputError when write_output() could not write there: no such folder, no permission, a directory.
/// To be called before work whose result would else be lost.
void require_writable(const std::string& path);

/// A result folder that appears whole or not at all: files are collected and written into a folder beside the final
/// one, which commit() renames. What is not committed goes with the object.
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
  void commit();
  const std::string& path() const { return path_; }

 private:
  void move_into_existing() const;
  /// Calls `act` with errors of the file system as InputError.
  void attempt(const std::function<void()>& act) const;

  std::string path_;
  std::string staging_;
  std::map<std::string, std::string> files_;  // not written yet
  std::set<std::string> written_;
};

}  // namespace rollrig
