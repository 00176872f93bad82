#pragma once
/// Runs the built program as a user would.

#include <string>

namespace rollrig::tests {

struct ProgramResult {
  int status = -1;  // exit status; 128 + signal when it was killed
  std::string out;
  std::string err;
};

/// Runs `rollrig <arguments>` through a shell in `folder`; `prefix` stands before it ("ulimit -f 8;").
ProgramResult run_program(const std::string& arguments, const std::string& folder = "/tmp",
                          const std::string& prefix = "");

/// A fresh folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Names of everything inside, hidden files included.
  std::size_t entry_count() const;

 private:
  std::string path_;
};

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& content);

}  // namespace rollrig::tests
