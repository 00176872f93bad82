// The writing half of file_io.h.
#include <fcntl.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iostream>
#include <random>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <boost/scope_exit.hpp>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"

namespace fs = std::filesystem;

namespace rollrig {
namespace {

constexpr mode_t kReadableByAll = 0644;  // less the umask
constexpr mode_t kFolderOfAll = 0777;    // likewise

InputError place_problem(const std::string& what, const std::string& path, const std::string& allowed = {}) {
  return InputError({what, path, 0, "", "", allowed, ""});
}

InputError write_problem(const std::string& path, int error_number) {
  return place_problem(fmt::format("cannot write '{}': {}", path, std::strerror(error_number)), path,
                       "a place with free space where this user may write");
}

InputError folder_taken(const std::string& path, bool meanwhile) {
  return place_problem(
      fmt::format("folder '{}' holds files {}", path, meanwhile ? "that another program has just written" : "already"),
      path, "an empty or new folder, or --force to overwrite files of the same name");
}

/// Calls `act` with errors of the file system as InputError.
template <class Act>
auto attempt(const std::string& path, Act&& act) {
  try {
    return act();
  } catch (const fs::filesystem_error& error) {
    throw write_problem(path, error.code().value());
  }
}

constexpr std::chrono::milliseconds kBetweenLooks{50};  // at whether the other end of a pipe is there, or Ctrl-C came

/// Of a file or of what open_direct() has opened.
void write_all(int descriptor, const std::string& path, const std::string& content) {
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = ::write(descriptor, content.data() + done, content.size() - done);
    if (n >= 0) {
      done += static_cast<std::size_t>(n);
    } else if (errno == EAGAIN) {  // a pipe that is full
      throw_if_interrupted();
      struct pollfd out {
        descriptor, POLLOUT, 0
      };
      ::poll(&out, 1, static_cast<int>(kBetweenLooks.count()));
    } else if (errno != EINTR) {
      throw write_problem(path, errno);
    }
  }
}

/// Opens a device or a pipe for writing. Waits for the reader of a pipe until the user stops the program.
int open_direct(const std::string& path) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor >= 0) return descriptor;
    const int error_number = errno;
    std::error_code code;
    const bool has_no_reader = error_number == ENXIO && fs::is_fifo(path, code);
    if (error_number != EINTR && !has_no_reader) throw write_problem(path, error_number);
    throw_if_interrupted();
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

/// To the disk, as far as the file system knows that: some folders and devices cannot be synchronized.
void synchronize_descriptor(int descriptor, const std::string& path) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS) return;
  throw write_problem(path, errno);
}

void synchronize_path(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;  // written already, and not ours to read
  BOOST_SCOPE_EXIT_ALL(&) { ::close(descriptor); };
  synchronize_descriptor(descriptor, path.string());
}

enum class Durability { kLater, kNow };

/// Writes to a file that this process has made, or to what open_direct() has opened.
void write_descriptor(const std::string& path, int descriptor, const std::string& content, Durability durability) {
  bool closed = false;
  BOOST_SCOPE_EXIT_ALL(&) {
    if (!closed) ::close(descriptor);
  };
  write_all(descriptor, path, content);
  if (durability == Durability::kNow) synchronize_descriptor(descriptor, path);
  closed = true;
  if (::close(descriptor) != 0) throw write_problem(path, errno);
}

/// `shown` is the name that the file will have, for errors.
void write_staged_file(const std::string& path, const std::string& content, const std::string& shown) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, kReadableByAll);
  if (descriptor < 0) throw write_problem(shown, errno);
  write_descriptor(shown, descriptor, content, Durability::kLater);
}

/// Tries unpredictable hidden names in a folder until `make` has made a file or folder with one of them: `make` returns
/// a number below 0, and sets errno, where it has not. Returns the name.
std::string make_hidden(const fs::path& folder, const std::string& name, const std::string& path,
                        const std::function<int(const char*)>& make) {
  constexpr int kTries = 100;
  constexpr std::size_t kLongest = 200;  // of 255 bytes that a name may have
  std::random_device random;
  for (int i = 0; i < kTries; ++i) {
    const fs::path tried =
        folder / fmt::format(".{}.partial-{:08x}{:08x}", name.substr(0, kLongest), random(), random());
    if (make(tried.c_str()) >= 0) return tried.string();
    if (errno != EEXIST) break;
  }
  throw write_problem(path, errno);
}

/// The nearest folder on the way to `path` that exists.
fs::path find_existing_ancestor(fs::path ancestor) {
  while (!fs::exists(ancestor) && ancestor.has_relative_path()) ancestor = ancestor.parent_path();
  return ancestor;
}

bool is_staging(const fs::path& path) {
  constexpr std::string_view kMark = ".partial-";  // then the digits of make_hidden()
  constexpr std::size_t kDigits = 16;
  const std::string name = path.filename().string();
  const std::size_t mark = name.rfind(kMark);
  return name.front() == '.' && mark != std::string::npos && mark + kMark.size() + kDigits == name.size() &&
         name.find_first_not_of("0123456789abcdef", mark + kMark.size()) == std::string::npos;
}

/// Whether a folder can be replaced by another: it is empty, and not a mount point, the working folder or that of
/// another user.
bool can_be_replaced(const fs::path& folder) {
  struct stat own {};
  struct stat parent {};
  if (::stat(folder.c_str(), &own) != 0 || ::stat(folder.parent_path().c_str(), &parent) != 0) return false;
  std::error_code code;
  const bool is_here = fs::equivalent(folder, fs::current_path(code), code);
  return own.st_dev == parent.st_dev && own.st_uid == ::geteuid() && !is_here && fs::is_empty(folder) &&
         ::access(folder.parent_path().c_str(), W_OK) == 0;
}

/// Without links, dots and a slash at the end, as far as it is there.
fs::path find_place(const std::string& path) {
  const fs::path place = fs::weakly_canonical(fs::absolute(path)).lexically_normal();
  return place.filename().empty() ? place.parent_path() : place;
}

/// rename(), but errno EEXIST where there is something.
int rename_to_free(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return -1;
  // A file system without that: a second name, which must be new, then the first one goes.
  if (::link(from.c_str(), to.c_str()) != 0) return -1;
  return ::unlink(from.c_str());
}

/// Whether a file may be replaced in a folder that may be written to. In one with the sticky bit, such as /tmp, the
/// owners of the file and of the folder alone may, and root.
bool may_replace(const std::string& path, const std::string& folder) {
  struct stat file {};
  struct stat around {};
  if (::lstat(path.c_str(), &file) != 0 || ::stat(folder.c_str(), &around) != 0) return true;
  const uid_t user = ::geteuid();
  return (around.st_mode & S_ISVTX) == 0 || user == 0 || user == file.st_uid || user == around.st_uid;
}

/// Throws InputError where a path stands for a file that a process has open, such as /dev/stdout of a command whose
/// output goes to a file: that file cannot be replaced by another, and the link in /dev should not be.
void require_no_open_file(const std::string& path) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return;
  constexpr int kMostLinks = 40;  // as Linux follows
  fs::path at = path;
  for (int i = 0; i < kMostLinks && fs::is_symlink(at, code); ++i) {
    const fs::path folder = at.has_parent_path() ? at.parent_path() : fs::path(".");
    struct statfs system {};
    if (::statfs(folder.c_str(), &system) == 0 && system.f_type == PROC_SUPER_MAGIC) {
      throw place_problem(fmt::format("'{}' stands for a file that is open already", path), path,
                          "the name of that file, or - for standard output");
    }
    at = folder / fs::read_symlink(at, code);  // the latter alone where it is absolute
  }
}

/// Gives a new file the owner and the permissions of the file that it replaces. Where the owner or the group cannot be
/// kept, the group has no permissions.
void keep_permissions(const std::string& path, const std::string& replaced) {
  struct stat former {};
  if (::lstat(replaced.c_str(), &former) != 0 || !S_ISREG(former.st_mode)) return;
  const bool has_owner = ::chown(path.c_str(), former.st_uid, former.st_gid) == 0;
  ::chmod(path.c_str(), former.st_mode & (has_owner ? 0777U : 0707U));
}

/// The permissions with which to make a file that will take the place of another. If the other is not readable by
/// everybody, only this user may read the new one until keep_permissions().
mode_t choose_first_permissions(const std::string& replaced) {
  struct stat former {};
  if (::lstat(replaced.c_str(), &former) != 0 || !S_ISREG(former.st_mode)) return kReadableByAll;
  return (former.st_mode & S_IROTH) != 0 ? kReadableByAll : S_IRUSR | S_IWUSR;
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

bool holds_files(const std::string& folder) {
  if (!fs::exists(folder)) return false;
  return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return !is_staging(entry.path()); });
}

void remove_staging_files(const std::string& folder) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (is_staging(entry.path())) leftovers.push_back(entry.path());
  }
  for (const fs::path& leftover : leftovers) fs::remove_all(leftover, ignored);
}

void synchronize_folder(const std::string& folder) { synchronize_path(folder); }

StagedOutput::StagedOutput(std::string path, std::string content, Existing existing)
    : path_(std::move(path)), existing_(existing) {
  std::error_code code;
  require_no_open_file(path_);
  const fs::file_status status = fs::status(path_, code);
  if (fs::is_directory(status) && path_ != "-") {
    throw place_problem(fmt::format("'{}' is a directory, not a file", path_), path_, "a file name");
  }
  is_direct_ = path_ == "-" || (fs::exists(status) && !fs::is_regular_file(status));
  if (is_direct_) {
    content_ = std::move(content);
    return;
  }
  int descriptor = -1;
  const fs::path place(path_);
  const mode_t permissions = choose_first_permissions(path_);
  staging_ = make_hidden(place.parent_path(), place.filename().string(), path_, [&](const char* tried) {
    return descriptor = ::open(tried, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, permissions);
  });
  try {
    write_descriptor(path_, descriptor, content, Durability::kNow);
  } catch (...) {
    ::unlink(staging_.c_str());  // the destructor does not run
    throw;
  }
}

StagedOutput::StagedOutput(StagedOutput&& other) noexcept
    : path_(std::move(other.path_)),
      content_(std::move(other.content_)),
      staging_(std::move(other.staging_)),
      existing_(other.existing_),
      is_direct_(other.is_direct_),
      is_appended_(other.is_appended_) {
  other.staging_.clear();
}

StagedOutput::~StagedOutput() {
  if (!staging_.empty()) ::unlink(staging_.c_str());
}

void StagedOutput::append(const std::string& content) {
  if (is_direct_) {
    content_ += content;
    return;
  }
  const int descriptor = ::open(staging_.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) throw write_problem(path_, errno);
  write_descriptor(path_, descriptor, content, Durability::kLater);
  is_appended_ = true;
}

void StagedOutput::commit() {
  if (path_ == "-") {
    flush_standard_output();
    // As it is: what is printed through std::cout has its control characters shown (visible.h).
    const bool is_written = std::fwrite(content_.data(), 1, content_.size(), stdout) == content_.size();
    if ((std::fflush(stdout) != 0 || !is_written) && !is_reader_gone()) {
      throw place_problem("cannot write to standard output", path_);
    }
    return;
  }
  if (is_direct_) {
    write_descriptor(path_, open_direct(path_), content_, Durability::kLater);
    return;
  }
  keep_permissions(staging_, path_);
  if (is_appended_) synchronize_path(staging_);
  const bool keeps = existing_ == Existing::kKeep;
  if ((keeps ? rename_to_free(staging_, path_) : std::rename(staging_.c_str(), path_.c_str())) != 0) {
    if (keeps && errno == EEXIST) {
      throw place_problem(fmt::format("'{}' is there already", path_), path_, "another file, or --force to replace it");
    }
    throw write_problem(path_, errno);
  }
  staging_.clear();
  synchronize_path(folder_of(path_));
}

void write_file_atomically(const std::string& path, const std::string& content) {
  StagedOutput(path == "-" ? "./-" : path, content).commit();
}

void write_output(const std::string& path, const std::string& content) { StagedOutput(path, content).commit(); }

bool is_reader_gone() {
  struct pollfd out {};
  out.fd = STDOUT_FILENO;
  return ::poll(&out, 1, 0) > 0 && (out.revents & POLLERR) != 0;
}

void flush_standard_output() {
  if (std::cout.flush() || is_reader_gone()) return;
  throw InputError({"standard output cannot be written to", "", 0, "", "", "space for it", ""});
}

void require_writable(const std::string& path) {
  if (path.empty() || path == "-") return;
  attempt(path, [&path] {
    if (fs::is_directory(path)) {
      throw place_problem(fmt::format("'{}' is a directory, not a file", path), path, "a file name");
    }
    require_no_open_file(path);
    const std::string folder = folder_of(path);
    if (!fs::is_directory(folder)) throw place_problem(fmt::format("no such folder '{}'", folder), path);
    // A file is replaced as a whole, which its folder must allow; what is no file (/dev/null) is written to as it is.
    const bool is_replaced = !fs::exists(path) || fs::is_regular_file(path);
    if (::access((is_replaced ? folder : path).c_str(), W_OK) != 0) {
      throw place_problem(fmt::format("cannot write '{}': {}", path, std::strerror(errno)), path);
    }
    if (is_replaced && !may_replace(path, folder)) {
      throw place_problem(fmt::format("cannot write '{}': it belongs to another user", path), path);
    }
  });
}

OutputFolder::OutputFolder(std::string path, bool force) : path_(std::move(path)), force_(force) {
  attempt(path_, [this] {
    if (fs::exists(path_) && !fs::is_directory(path_)) {
      throw place_problem(fmt::format("'{}' is a file, not a folder", path_), path_, "a folder name");
    }
    if (!fs::exists(path_) && fs::is_symlink(path_)) {
      throw place_problem(fmt::format("'{}' is a broken symbolic link", path_), path_, "a folder name");
    }
    place_ = find_place(path_).string();
    if (!force_ && holds_files(place_)) throw folder_taken(path_, false);
    is_filled_in_place_ = fs::exists(place_) && !can_be_replaced(place_);
    const fs::path place(place_);
    const fs::path around = is_filled_in_place_ ? place : find_existing_ancestor(place.parent_path());
    const std::string probe =
        make_hidden(around, "rollrig", path_, [](const char* tried) { return ::mkdir(tried, kFolderOfAll); });
    ::rmdir(probe.c_str());
  });
}

void OutputFolder::add(const std::string& file_name, std::string content) { files_[file_name] = std::move(content); }

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  for (auto parent = parents_.rbegin(); parent != parents_.rend(); ++parent) ::rmdir(parent->c_str());  // if empty
}

void OutputFolder::make_staging() {
  if (!staging_.empty()) return;
  const fs::path place(place_);
  const fs::path around = is_filled_in_place_ ? place : place.parent_path();
  std::vector<fs::path> missing;
  for (fs::path parent = around; !fs::exists(parent); parent = parent.parent_path()) missing.push_back(parent);
  for (auto parent = missing.rbegin(); parent != missing.rend(); ++parent) {
    if (fs::create_directory(*parent)) parents_.push_back(parent->string());
  }
  // What an empty folder of this name hides, the folder that will take its place hides from the beginning.
  struct stat former {};
  const bool replaces = !is_filled_in_place_ && ::stat(place_.c_str(), &former) == 0 && S_ISDIR(former.st_mode);
  const mode_t permissions = replaces ? (former.st_mode & kFolderOfAll) | S_IRWXU : kFolderOfAll;
  staging_ = make_hidden(around, place.filename().string(), path_,
                         [permissions](const char* tried) { return ::mkdir(tried, permissions); });
}

void OutputFolder::flush() {
  spdlog::debug("writes {} files to {}", files_.size(), path_);
  attempt(path_, [this] {
    make_staging();
    for (const auto& [name, content] : files_) {
      const fs::path file = fs::path(staging_) / name;
      written_.insert(name);
      fs::create_directories(file.parent_path());
      write_staged_file(file.string(), content, (fs::path(path_) / name).string());
    }
  });
  files_.clear();
}

/// Everything in the staging folder, to the disk. Of many files the whole file system at once, which is quicker.
void OutputFolder::synchronize() const {
  constexpr std::size_t kFewFiles = 16;  // Assumed: 3 to 5 ms each, measured on ext4
  if (written_.size() > kFewFiles) {
    const int descriptor = ::open(staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) throw write_problem(path_, errno);
    BOOST_SCOPE_EXIT_ALL(&) { ::close(descriptor); };
    if (::syncfs(descriptor) != 0) throw write_problem(path_, errno);
    return;
  }
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) synchronize_path(entry.path());
  synchronize_path(staging_);
}

void OutputFolder::commit() {
  flush();
  attempt(path_, [this] {
    synchronize();
    if (is_filled_in_place_) {
      move_into_existing();
    } else {
      move_whole();
    }
    staging_.clear();
    for (const std::string& parent : parents_) synchronize_path(fs::path(parent).parent_path());
    parents_.clear();
    synchronize_path(fs::path(place_).parent_path());
  });
}

/// A folder takes the place of none or of an empty one, and never of one that holds files.
void OutputFolder::move_whole() {
  std::error_code code;
  const fs::file_status former = fs::status(place_, code);
  if (fs::is_directory(former)) fs::permissions(staging_, former.permissions());
  if (std::rename(staging_.c_str(), place_.c_str()) == 0) return;
  if (errno != ENOTEMPTY && errno != EEXIST) throw write_problem(path_, errno);
  if (!force_ && holds_files(place_)) throw folder_taken(path_, true);
  move_into_existing();
}

/// What would stop a move in the middle.
void OutputFolder::require_room() const {
  if (!force_ && holds_files(place_)) throw folder_taken(path_, true);
  for (const std::string& name : written_) {
    const fs::path to = fs::path(place_) / name;
    if (fs::is_directory(to)) throw write_problem(to.string(), EISDIR);
    const fs::path parent = to.parent_path();
    if (fs::exists(parent) && !fs::is_directory(parent)) throw write_problem(parent.string(), ENOTDIR);
  }
}

void OutputFolder::move_into_existing() {
  const int lock = ::open(place_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) throw write_problem(path_, errno);
  BOOST_SCOPE_EXIT_ALL(&) { ::close(lock); };
  // So that the files of two programs do not mix; a file system may have no locks.
  while (::flock(lock, LOCK_EX) != 0 && errno == EINTR) {
  }
  require_room();
  std::vector<fs::path> moved;
  std::set<fs::path> folders{place_};
  try {
    for (const std::string& name : written_) {
      const fs::path to = fs::path(place_) / name;
      fs::create_directories(to.parent_path());
      const fs::path from = fs::path(staging_) / name;
      keep_permissions(from.string(), to.string());
      fs::rename(from, to);
      moved.push_back(to);
      folders.insert(to.parent_path());
    }
  } catch (const fs::filesystem_error&) {
    for (const fs::path& gone : moved) {
      if (!force_) ::unlink(gone.c_str());
    }
    throw;
  }
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  for (const fs::path& folder : folders) synchronize_path(folder);
}

}  // namespace rollrig
