#pragma once
/// Pages of `rollrig sweep` and `rollrig regress`.

#include <string>
#include <vector>

#include "report/page.h"

namespace rollrig::report {

/// Of the sweep's document (rollrig-sweep/1): results over what is varied, and a table of all points. `shown` are the
/// results that have a chart; where none is named, those that change.
Page make_sweep_page(const Json& sweep, std::vector<std::string> shown, const std::string& subtitle);

/// Of the comparison's document (rollrig-regression/1): whether all runs are as they were, and what is not.
Page make_regress_page(const Json& regression);

}  // namespace rollrig::report
