#include "api/unfinished_sweep.h"

#include <fmt/format.h>

#include <cerrno>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

#include "campaigns/items.h"
#include "include/rollrig/error.h"
#include "sim/core/file_io.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr const char* kDefinitionFile = "sweep_definition.json";

InputError folder_problem(const std::string& path, const std::string& what, const std::string& allowed) {
  return InputError({fmt::format("'{}' {}", path, what), "command line", 0, "--out", path, allowed, ""});
}

}  // namespace

UnfinishedSweep::UnfinishedSweep(std::string path, const std::string& definition) : path_(std::move(path)) {
  open();
  require_definition(definition);
}

UnfinishedSweep::~UnfinishedSweep() {
  try {
    if (lock_->is_in_place() && campaigns::CampaignFolder{path_, "", 0}.list_files().empty()) remove();
  } catch (const std::exception&) {  // the folder has gone meanwhile, or may not be read: there is nothing to remove
  }
}

/// Opens the folder, and makes it if need be. Another process may remove it between these two steps: then once more.
void UnfinishedSweep::open() {
  do {
    lock_.reset();
    std::error_code error;
    fs::create_directories(path_, error);
    lock_.emplace(path_);
    if (lock_->error() != 0 && lock_->error() != ENOENT) {
      throw folder_problem(path_, fmt::format("cannot be used: {}", std::generic_category().message(lock_->error())),
                           "a folder that can be written to");
    }
    if (lock_->error() != 0 && error) {
      throw folder_problem(path_, fmt::format("cannot be made: {}", error.message()), "a folder that can be made");
    }
    // Where the file system knows no locks, two processes meet at the results files, which have their own.
    if (lock_->is_taken()) {
      throw folder_problem(path_, "is in use: another process runs a sweep with the same --out",
                           "to wait for it, or another --out");
    }
  } while (!lock_->is_in_place());
}

void UnfinishedSweep::require_definition(const std::string& definition) const {
  const std::string file = (fs::path(path_) / kDefinitionFile).string();
  if (!holds_files(path_)) {
    write_file_atomically(file, definition);
  } else if (!is_there(file) || read_text_file(file) != definition) {
    throw folder_problem(path_, "holds the points of another, unfinished sweep",
                         "the settings, files and version of that sweep, to continue it; or delete the folder");
  }
}

void UnfinishedSweep::remove() const {
  std::error_code ignored;  // what cannot be removed does no harm
  for (const std::string& results : campaigns::CampaignFolder{path_, "", 0}.list_files()) fs::remove(results, ignored);
  fs::remove(fs::path(path_) / kDefinitionFile, ignored);
  remove_staging_files(path_);
  fs::remove(path_, ignored);  // unless it holds files of somebody else
}

}  // namespace rollrig
