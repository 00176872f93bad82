#pragma once
/// Work of the library without the GIL: other threads of Python go on.

#include <rollrig/progress.h>

#include <functional>
#include <optional>
#include <utility>

#include "bindings.h"

namespace rollrig::python {

/// Does long work in a new thread, which never touches Python. The calling thread waits for it without the GIL. Several
/// times a second it takes the GIL, runs Python's signal handlers and, unless `show` is None, calls `show(done,
/// stage)`.
/// Errors  what the work throws, or what a signal handler or `show` raises; either of these stops the work first.
///         Ctrl-C stops all calls of the process, since the handler raises KeyboardInterrupt in the main thread alone.
///         A KeyboardInterrupt that `show` raises stops this call alone, as every other exception of `show`.
void carry_out(const py::object& show, const std::function<void(const Progress&)>& work);

/// The same for work that returns something.
template <class Work>
auto call(const py::object& show, Work&& work) {
  std::optional<decltype(work(Progress()))> result;
  carry_out(show, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

/// Does short work in the calling thread. Ctrl-C is noticed after it.
void do_without_gil(const std::function<void()>& work);

/// Stops all calls and waits until they have ended, but not longer than some seconds. To be called when Python ends,
/// since the objects of the library are destroyed after that. A thread that was in a call never returns to Python:
/// Python would end the thread while C++ functions are still on its stack. Later calls throw.
void end_calls();

}  // namespace rollrig::python
