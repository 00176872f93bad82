#pragma once
/// Blocks of a page, from what the program's own types hold.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "include/rollrig/result.h"
#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Six digits, null where not finite.
Json rounded(double value);

/// A channel over time, thinned: {name, t, y}.
Json make_series(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& values,
                 std::size_t most = 2000);

/// Rows as a line is drawn through them. A row is a mean over its sample. Where a phase begins with a jump and with
/// shorter samples, the straight line from the row before would be a ramp that nothing has: the value before is held.
struct DrawnRows {
  std::vector<double> time_s;
  std::vector<double> values;
  std::vector<double> held_s;  // times of points that are no rows
};
DrawnRows hold_to_jumps(const std::vector<double>& time_s, const std::vector<double>& values);

/// Indices of the rows of a series that are kept, in order; at most `most` of them (at least 8), none of its extremes
/// lost.
///
/// The first and the last row are kept. The rows between are cut into equal stretches, and of each the first, the last,
/// the least and the greatest value stay, and both sides of its two greatest steps, so that every peak and every jump
/// of the series is at its own time and a line drawn through them looks as through all; a stretch with a gap (not
/// finite) keeps one row of it. What then lies on the straight line of its neighbors, to `tolerance`, is left out: a
/// series at rest is two points.
/// Source   Jugel et al., Proc. VLDB 7 (2014) 797 (M4)
/// Checked  tests/report/thinning_test.cpp
std::vector<std::size_t> thin(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t most,
                              double tolerance = 0.0);

/// One figure that a page says at a glance.
struct Tile {
  std::string label;
  std::string value;      // as it is shown: "7.12", "7.12 +- 0.05", or words
  std::string unit = {};  // as units.h spells it
  std::string note = {};  // a sentence below
  std::string tone = {};  // good, doubt or bad
  /// Where the JSON of --json has the value's numbers, as JSON pointers in their order.
  std::vector<std::string> from = {};
};

/// Tiles side by side, in their order.
Block make_tiles(const std::vector<Tile>& tiles);

Block make_table(const Table& table);

/// A growing series of a chart: points, or a line, with intervals or without.
struct ChartSeries {
  Json x = Json::array(), y = Json::array(), low = Json::array(), high = Json::array();

  void add(double at, double value);
  void add(double at, double value, double from, double to);
  Json finish(const std::string& name, const char* kind = "points") const;
};

/// What an axis of a chart shows.
struct Axis {
  std::string label;
  std::string unit;
  bool from_zero = false;
};

/// Lines or points over a quantity.
Block make_curves(const Axis& x, const Axis& y, Json series, const std::string& caption = "");
/// Bars over categories.
Block make_bars(const Axis& y, Json categories, Json series, const std::string& caption = "");
/// A value at an end of a waterfall, or a signed change on the way.
struct WaterfallBar {
  std::string name;
  double value = 0.0;
  std::optional<std::array<double, 2>> limits = {};  // of a change: its lower and upper limit
};

/// A waterfall: from one value to another, change by change.
/// Errors   std::logic_error where the changes do not lead from the first value to the last, to rounding
/// Checked  tests/report/waterfall_test.cpp
Block make_waterfall(const Axis& value, const WaterfallBar& start, const std::vector<WaterfallBar>& steps,
                     const WaterfallBar& end, const std::string& caption = "");

/// A document as it stands, folded away.
Section make_document(const Json& document, const std::string& folded);
/// Warnings, where there are some, and tables.
Section make_section(const std::string& title, const std::vector<Table>& tables,
                     const std::vector<std::string>& warnings);
/// Names of numbers of files as a person reads them: "heat capacity" of "thermal.heat_capacity_J_per_K"; with the name
/// of the table before it where two would be the same.
std::vector<std::string> name_numbers(const std::vector<std::string>& keys);
/// The name of a measurement set in a title. A set with the id of a scenario as its name has that scenario's title.
std::string name_set(const std::string& name);
/// Fitted numbers with their intervals; one without a standard deviation is on its bound.
Table make_estimate_table(const std::string& title, const std::vector<ParameterEstimate>& estimates);
/// Typeset equations of a procedure, by their name in report/web/equations.json; nothing where it has none.
Block make_equations(const std::string& of);
Block make_warnings(const std::vector<std::string>& warnings);
Block make_paragraph(const std::string& text);
/// A sentence on top; tone: good, doubt or bad.
Block make_lead(const std::string& tone, const std::string& text, const std::string& more = "");

/// Puts blocks before those that the section has: what it says in a sentence, its tiles, its first chart.
void put_first(std::vector<Block> blocks, Section& section);

/// Values in the unit of a key: "load_kN" takes N.
std::vector<double> in_unit_of(const std::string& key, std::vector<double> values_SI);
/// The unit of a key as a person reads it: "°C" of "ambient_degC".
std::string shown_unit(const std::string& key);
/// "degC" as "°C", but not in a key such as "ambient_degC".
std::string pretty_unit(std::string symbol);
/// The text with a capital first.
std::string capitalized(std::string text);
/// "316.10 +- 0.73": two digits of the standard deviation, and the value with as many decimals (GUM, 7.2.6).
std::string show_with_sd(double value, double sd);

}  // namespace rollrig::report
