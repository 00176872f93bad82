#include "tables/isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>

#include <boost/scope_exit.hpp>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"

namespace rollrig::tables {
namespace {

/// What the child tells the parent, as bytes.
class Writer {
 public:
  void add(std::uint64_t number) { add_bytes(&number, sizeof number); }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  void add(const std::vector<double>& numbers) {
    add(numbers.size());
    add_bytes(numbers.data(), numbers.size() * sizeof(double));
  }
  void add(const std::vector<std::string>& texts) {
    add(texts.size());
    for (const std::string& text : texts) add(text);
  }
  void send(int descriptor) const {
    for (std::size_t done = 0; done < bytes_.size();) {
      const ssize_t n = ::write(descriptor, bytes_.data() + done, bytes_.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return;
      done += static_cast<std::size_t>(n);
    }
  }

 private:
  void add_bytes(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_;
};

/// Throws std::out_of_range where the child did not tell all.
class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  std::string text() {
    const std::uint64_t size = number();
    return {take(size), size};
  }
  std::vector<double> numbers() {
    const std::uint64_t size = number();
    const char* data = take(size * sizeof(double));
    std::vector<double> values(size);
    if (size > 0) std::memcpy(values.data(), data, size * sizeof(double));
    return values;
  }
  std::vector<std::string> texts() {
    std::vector<std::string> values;
    for (std::uint64_t left = number(); left > 0; --left) values.push_back(text());
    return values;
  }

 private:
  const char* take(std::uint64_t size) {
    if (size > bytes_.size() - at_) throw std::out_of_range("a child process told less than it should");
    at_ += size;
    return bytes_.data() + at_ - size;
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

enum : std::uint64_t { kColumns = 1, kError = 2 };

void write_columns(const Columns& columns, Writer& out) {
  out.add(kColumns);
  out.add(columns.size());
  for (const Column& column : columns) {
    out.add(column.name);
    out.add(column.group);
    out.add(static_cast<std::uint64_t>(column.recording));
    out.add(column.unit);
    out.add(column.values.index());
    std::visit([&out](const auto& values) { out.add(values); }, column.values);
  }
}

void write_error(const InputProblem& problem, Writer& out) {
  out.add(kError);
  for (const std::string& text : {problem.what, problem.key, problem.value, problem.allowed}) out.add(text);
}

/// A small file may unpack to more than the machine has. The child gets a few times what the largest table takes,
/// beyond what the program holds already; sanitizers need more than any limit.
void limit_memory() {
#ifndef ROLLRIG_SANITIZED
  constexpr rlim_t kTimes = 4;  // Assumed: values, bytes on their way, and what the libraries hold
  std::ifstream sizes("/proc/self/statm");
  rlim_t total = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;  // pages
  if (!(sizes >> total >> resident >> shared >> text >> library >> data)) return;
  const rlim_t held_bytes = data * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  const rlim_t most_bytes = held_bytes + kTimes * kLargestTable_bytes;
  const rlimit limit{most_bytes, most_bytes};
  ::setrlimit(RLIMIT_DATA, &limit);
#endif
}

/// A damaged file may also keep a library busy forever.
void limit_time() {
  constexpr rlim_t kMost_s = 600;  // Assumed: of the processor; the largest table takes less than a tenth
  const rlimit limit{kMost_s, kMost_s};
  ::setrlimit(RLIMIT_CPU, &limit);
}

void require_small(const Columns& columns, const std::string& path) {
  std::uintmax_t bytes = 0;
  for (const Column& column : columns) bytes += column.size() * sizeof(double);
  require_table_size(bytes, path);
}

/// Ends the child.
[[noreturn]] void carry_out(const std::string& path, const std::function<Columns(const std::string&)>& read,
                            int descriptor) {
  Writer out;
  try {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit_memory();
    limit_time();
    const Columns columns = read(path);
    require_small(columns, path);
    write_columns(columns, out);
  } catch (const InputError& error) {
    write_error(error.problem(), out);
  } catch (const std::bad_alloc&) {
    write_error(make_too_large(path).problem(), out);
  } catch (...) {
    ::_exit(1);  // the parent says that the file is damaged
  }
  out.send(descriptor);
  ::_exit(0);
}

/// All that the child tells. Throws Interrupted.
std::string receive(int descriptor) {
  constexpr int kBetweenLooks_ms = 50;  // at whether Ctrl-C came
  std::string bytes;
  std::array<char, 65536> part;
  for (;;) {
    throw_if_interrupted();
    struct pollfd in {
      descriptor, POLLIN, 0
    };
    if (::poll(&in, 1, kBetweenLooks_ms) <= 0) continue;  // nothing yet, or a signal came
    const ssize_t n = ::read(descriptor, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(part.data(), static_cast<std::size_t>(n));
  }
}

Columns understand(const std::string& path, Reader reader) {
  if (reader.number() == kError) {
    InputProblem problem;
    problem.file = path;
    for (std::string* text : {&problem.what, &problem.key, &problem.value, &problem.allowed}) *text = reader.text();
    throw InputError(problem);
  }
  Columns columns(reader.number());
  for (Column& column : columns) {
    column.name = reader.text();
    column.group = reader.text();
    column.recording = static_cast<int>(reader.number());
    column.unit = reader.text();
    if (reader.number() == 0) {
      column.values = reader.numbers();
    } else {
      column.values = reader.texts();
    }
  }
  return columns;
}

}  // namespace

Columns read_isolated(const std::string& path, const std::function<Columns(const std::string&)>& read) {
  std::array<int, 2> ends;
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a child process");
  const pid_t child = ::fork();
  if (child < 0) {
    for (const int end : ends) ::close(end);
    throw std::runtime_error("no child process");
  }
  if (child == 0) carry_out(path, read, ends[1]);
  ::close(ends[1]);
  std::string bytes;
  {
    bool has_told_all = false;
    BOOST_SCOPE_EXIT_ALL(&) {
      ::close(ends[0]);
      if (!has_told_all) ::kill(child, SIGKILL);
      while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
      }
    };
    bytes = receive(ends[0]);
    has_told_all = true;
  }
  try {
    return understand(path, Reader(std::move(bytes)));
  } catch (const std::out_of_range&) {
    throw InputError({"a damaged file", path, 0, "", "", "a whole file, as its program wrote it", ""});
  }
}

}  // namespace rollrig::tables
