#pragma once
/// What a page says in numbers about a recording: values of its rows, not of the thinned lines of its charts.

#include <vector>

#include "report/page.h"
#include "sim/recording.h"

namespace rollrig::report {

/// Times of all rows as stretches of equal steps: [[start_s, step_s, number of rows], ...].
Json make_row_times(const std::vector<double>& time_s);

/// A channel as {row, y}, from which the page has the value of every row: rows that lie on the straight line of their
/// neighbors are left out. Of a recording of more than 16,000 rows, `thin` selects as many.
/// Accuracy  half of the last of five digits, of the largest value
/// Checked   tests/report/readings_test.cpp
Json make_recorded(const std::vector<double>& time_s, const std::vector<double>& values);

/// For each phase of a recording [mean over time, least, most, last] of its rows, or null where it has no value. The
/// first row of a phase is a mean over the end of the phase before it, too, and counts in neither, unless it is the
/// only one of its phase.
/// Checked  tests/report/readings_test.cpp
Json summarize_phases(const sim::Recording<double>& recording, const std::vector<double>& values);
/// The same of spans of time, each with the rows after its start and before its end; of the last, its end too.
Json summarize_spans(const std::vector<double>& time_s, const std::vector<double>& values,
                     const std::vector<std::pair<double, double>>& spans_s);

}  // namespace rollrig::report
