#pragma once

#include <rollrig/bad_rows.h>

namespace rollrig::python {

inline BadRows to_bad_rows(bool skip) { return skip ? BadRows::kLeaveOut : BadRows::kRefuse; }

}  // namespace rollrig::python
