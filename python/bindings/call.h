#pragma once
/// Work of the library without the GIL: other threads of Python go on.

#include <rollrig/progress.h>

#include <functional>
#include <optional>
#include <utility>

#include "bindings.h"

namespace rollrig::python {

/// Does work that may take long in a thread of its own, which never touches Python. This thread waits without the GIL,
/// looks for Ctrl-C, and calls `show(done, stage)` several times a second where it is not None.
/// Errors  what the work throws; what a signal handler or `show` raises: the work is stopped before it is passed on.
///         KeyboardInterrupt of the main thread stops all calls of the process.
void carry_out(const py::object& show, const std::function<void(const Progress&)>& work);

/// The same for work that returns something.
template <class Work>
auto call(const py::object& show, Work&& work) {
  std::optional<decltype(work(Progress()))> result;
  carry_out(show, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

/// Does short work in this thread.
void do_without_gil(const std::function<void()>& work);

/// Stops all calls, and waits some seconds for their end: afterwards Python ends, and the objects of the library are
/// destroyed. Threads that were in a call never return to Python, which would end them in the midst of C++. Later calls
/// throw.
void end_calls();

}  // namespace rollrig::python
