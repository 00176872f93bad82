#pragma once
/// Pages of `rollrig sweep` and `rollrig regress`.

#include <string>
#include <vector>

#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Keys of the results that one point of a sweep's document has at least, in order. Here and below, the results of the
/// document are flat (scenarios::flatten_results).
std::vector<std::string> list_numbers(const Json& sweep);
/// Those that are not the same at every point, headlines of the scenario first; times of evaluation do not count.
std::vector<std::string> list_changing(const Json& sweep);

/// Of those that change the ones that have a chart where none is named: those that are in no list, else the first of
/// lists.
std::vector<std::string> choose_charts(const Json& sweep);

/// A row a point of a sweep's document: what is set, then the results of `keys`.
Table make_sweep_table(const Json& sweep, const std::string& title, const std::vector<std::string>& keys);

/// Of the sweep's document (rollrig-sweep/1): results over what is varied, and a table of all points. `shown` are the
/// results that have a chart; where none is named, those of choose_drawn_results(). The document has their
/// sensitivities (list_sensitivities).
Page make_sweep_page(const Json& sweep, std::vector<std::string> shown, const std::string& subtitle);

/// A row a run of the comparison's document: its status and its worst difference.
Table make_regress_table(const Json& regression);

/// Of the comparison's document (rollrig-regression/1): whether all runs are as they were, and what is not.
Page make_regress_page(const Json& regression);

}  // namespace rollrig::report
