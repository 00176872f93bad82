#pragma once
/// Files of a report as a dict.

#include <rollrig/result.h>

#include "bindings.h"

namespace rollrig::python {

/// Content by name; empty where there is no function.
py::dict make_files(const std::function<FolderFiles()>& make);

}  // namespace rollrig::python
