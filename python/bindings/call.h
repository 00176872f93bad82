#pragma once
/// A call of the library that may take long: without the GIL, with Ctrl-C and with progress.

#include <rollrig/progress.h>

#include <functional>
#include <optional>
#include <utility>

#include "bindings.h"

namespace rollrig::python {

/// Does the work in a thread of its own, which never touches Python. This thread waits without the GIL, looks for
/// Ctrl-C, and calls `show(done, stage)` several times a second where it is not None.
/// Errors  what the work throws; KeyboardInterrupt, or what `show` raises: the work is stopped before it is passed on
void carry_out(const py::object& show, const std::function<void(const Progress&)>& work);

/// The same for work that returns something.
template <class Work>
auto call(const py::object& show, Work&& work) {
  std::optional<decltype(work(Progress()))> result;
  carry_out(show, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

}  // namespace rollrig::python
