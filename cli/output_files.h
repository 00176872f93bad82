#pragma once
/// Single files that a command writes: --json, --html and their like.

#include <string>
#include <vector>

namespace rollrig::cli {

/// An option that names a file to write, and what was given; empty where nothing was.
struct OutputFile {
  const char* option;
  std::string path;
};

/// Whether two names, of files or folders that may not be there yet, mean one place; "-" means standard output.
bool is_same_place(const std::string& a, const std::string& b);

/// The files of one command. An older file at such a place is replaced, as a compiler does, so that a command can be
/// given again; only what the command itself reads is not.
class OutputFiles {
 public:
  /// To be made before the work. Throws InputError where a file could not be written, where two go to one place, or
  /// where one has been read.
  explicit OutputFiles(std::vector<OutputFile> files);

  /// To be called before the first of them, or a folder, is written. Throws InputError where one has been read since.
  void require_no_input() const;

 private:
  std::vector<OutputFile> files_;
};

}  // namespace rollrig::cli
