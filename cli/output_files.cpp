#include "cli/output_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "sim/core/error.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig::cli {
namespace {

InputError bad_place(const std::string& what, const OutputFile& file) {
  return InputError({what, "command line", 0, file.option, file.path, "another file", ""});
}

}  // namespace

bool is_same_place(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  // Absolute first: of what is not there yet only the parts that are there become canonical.
  const auto full = [](const std::string& path) {
    return (fs::weakly_canonical(fs::absolute(path)) / "").lexically_normal();
  };
  return full(a) == full(b);
}

OutputFiles::OutputFiles(std::vector<OutputFile> files) : files_(std::move(files)) {
  files_.erase(std::remove_if(files_.begin(), files_.end(), [](const OutputFile& file) { return file.path.empty(); }),
               files_.end());
  for (auto file = files_.begin(); file != files_.end(); ++file) {
    for (auto other = files_.begin(); other != file; ++other) {
      if (!is_same_place(other->path, file->path)) continue;
      throw bad_place(fmt::format("{} and {} cannot both go to one place", other->option, file->option), *file);
    }
    require_writable(file->path);
  }
  require_no_input();
}

void OutputFiles::require_no_input() const {
  for (const OutputFile& file : files_) {
    if (file.path == "-" || !was_read(file.path)) continue;
    throw bad_place(fmt::format("'{}' is read by this command, and would be lost", file.path), file);
  }
}

}  // namespace rollrig::cli
