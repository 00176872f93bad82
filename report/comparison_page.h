#pragma once
/// A comparison for the terminal and as a page.

#include <string>
#include <vector>

#include "comparison/compared.h"
#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// What differs in the inputs, or that nothing does.
Table make_comparison_input_table(const Comparison& comparison);
/// The differences of each from the reference, a table for each run and phase, or test.
std::vector<Table> make_comparison_difference_tables(const Comparison& comparison);
/// Both, and where energy goes.
std::vector<Table> make_comparison_tables(const Comparison& comparison);

/// Steps of which something can be seen, with names in words; the others together are one, "other terms".
std::vector<EnergyStep> list_shown_steps(const EnergyWaterfall& waterfall);

/// Why differences have no interval, a sentence for each reason.
std::vector<std::string> list_interval_reasons(const Comparison& comparison);

/// Main difference, inputs, differences as bars and tables, energy, and channels over time.
Page make_comparison_page(const comparison::Compared& compared);

}  // namespace rollrig::report
