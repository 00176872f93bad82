#pragma once
/// Blocks of a page, from what the program's own types hold.

#include <string>
#include <vector>

#include "include/rollrig/result.h"
#include "report/page.h"
#include "sim/core/columns.h"

namespace rollrig::report {

/// Most points of a series on a page: more than a chart has pixels.
constexpr std::size_t kMostPoints = 2000;

/// Six digits, null where not finite.
Json rounded(double value);
Json rounded(const std::vector<double>& values);

/// A channel over time, thinned: {name, t, y}.
Json make_series(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& values,
                 std::size_t most = kMostPoints);

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
/// A document as it stands, folded away.
Section make_document(const Json& document, const std::string& folded);
/// Warnings, where there are some, and tables.
Section make_section(const std::string& title, const std::vector<Table>& tables,
                     const std::vector<std::string>& warnings);
/// Fitted numbers with their intervals; one without a standard deviation is on its bound.
Table make_estimate_table(const std::string& title, const std::vector<ParameterEstimate>& estimates);
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
/// "degC" as "°C", but not in a key such as "ambient_degC".
std::string pretty_unit(std::string symbol);
/// The text with a capital first.
std::string capitalized(std::string text);

}  // namespace rollrig::report
