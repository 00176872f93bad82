#pragma once
/// A comparison for the terminal and as a page.

#include <string>
#include <vector>

#include "comparison/compared.h"
#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// What differs in the inputs, the differences of each from the reference, and where energy goes.
std::vector<Table> make_comparison_tables(const Comparison& comparison);

/// Why differences have no interval, a sentence for each reason.
std::vector<std::string> list_interval_reasons(const Comparison& comparison);

/// Main difference, inputs, differences as bars and tables, energy, and channels over time.
Page make_comparison_page(const comparison::Compared& compared);

}  // namespace rollrig::report
