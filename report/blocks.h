#pragma once
/// Blocks of a page, from what the program's own types hold.

#include <string>
#include <vector>

#include "report/page.h"
#include "scenarios/run/scenario.h"

namespace rollrig::report {

/// Most points of a series on a page: more than a chart has pixels.
constexpr std::size_t kMostPoints = 2000;

/// Six digits, null where not finite.
Json rounded(double value);
Json rounded(const std::vector<double>& values);

/// A channel over time, thinned: {name, t, y}.
Json make_series(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& values,
                 std::size_t most = kMostPoints);

Block make_lines(const std::vector<scenarios::ResultLine>& lines);
Block make_table(const Table& table);

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
/// A document as it stands, folded away.
Section make_document(const Json& document, const std::string& folded);
/// A section that begins with warnings, where there are some.
Section begin_section(const std::string& title, const std::vector<std::string>& warnings);
Block make_warnings(const std::vector<std::string>& warnings);
Block make_paragraph(const std::string& text);
/// A sentence on top; tone: good, doubt or bad.
Block make_lead(const std::string& tone, const std::string& text, const std::string& more = "");
/// All inputs, from a manifest or the like.
Section make_inputs(const Json& groups);

/// Values in the unit of a key: "load_kN" takes N.
std::vector<double> in_unit_of(const std::string& key, std::vector<double> values_SI);
/// The unit of a key as a person reads it: "°C" of "ambient_degC".
std::string shown_unit(const std::string& key);
/// "degC" in a unit's symbol as "°C".
std::string pretty_unit(std::string symbol);
/// The text with a capital first.
std::string capitalized(std::string text);

}  // namespace rollrig::report
