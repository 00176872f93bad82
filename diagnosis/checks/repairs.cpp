#include "diagnosis/checks/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "measurements/sample_selection.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

namespace quantities = models::quantities;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

bool is_given(const MeasurementSet& set, const Quantity& quantity) {
  const std::vector<rigs::Column>& measured = set.kind->columns.measured;
  return std::none_of(measured.begin(), measured.end(),
                      [&](const rigs::Column& column) { return column.quantity == quantity; });
}

/// The numbers of a file under another heading, in SI units; empty where one is out of that column's range.
/// An input is needed in every row: gaps take the sample before (or the first).
std::vector<double> read_as(const std::vector<double>& values, const Unit& from, const rigs::Column& column,
                            bool given) {
  const Unit unit = column.quantity.file_unit();
  std::vector<double> out;
  double last = std::nan("");
  for (const double value : values) {
    if (!std::isnan(value) && std::isnan(last)) last = from.from_si(value);
  }
  for (const double value : values) {
    const double number = from.from_si(value);
    if (!std::isnan(number)) last = number;
    const double read = given ? last : number;
    if (std::isnan(read) ? given : !column.range.contains(read)) return {};
    out.push_back(unit.to_si(read));
  }
  return out;
}

Mistake exchange(const MeasurementSet& set, const rigs::Column& a, const rigs::Column& b) {
  constexpr double kWeight = 0.3;  // Assumed: there are many pairs
  const auto undo = [a, b, a_given = is_given(set, a.quantity), b_given = is_given(set, b.quantity)](MeasuredRun& run) {
    if (!run.has(a.quantity) || !run.has(b.quantity)) return false;
    std::vector<double> as_a = read_as(run.column(b.quantity), b.quantity.file_unit(), a, a_given);
    std::vector<double> as_b = read_as(run.column(a.quantity), a.quantity.file_unit(), b, b_given);
    if (as_a.empty() || as_b.empty()) return false;
    run.column(a.quantity) = std::move(as_a);
    run.column(b.quantity) = std::move(as_b);
    return true;
  };
  const std::string text = fmt::format("the columns {} and {} are exchanged", a.quantity.header(), b.quantity.header());
  return {text, kWeight, {a.quantity, b.quantity}, true, {}, undo};
}

Mistake make_wrong_unit(const WrongUnit& wrong, const Range& range) {
  const auto undo = [wrong, range](MeasuredRun& run) {
    if (!run.has_samples(wrong.column)) return false;
    const Unit unit = wrong.column.file_unit();
    for (double& value : run.column(wrong.column)) {
      const double number = wrong.factor * unit.from_si(value) + wrong.offset;
      if (!std::isnan(number) && !range.contains(number)) return false;
      value = unit.to_si(number);
    }
    return true;
  };
  return {wrong.column.header() + " " + wrong.text,           wrong.weight, {wrong.column}, false,
          {{wrong.column, std::log(std::abs(wrong.factor))}}, undo};
}

/// Times in another unit, where rows are then a tenth of a second to a minute apart.
Mistake make_wrong_time(double factor, const std::string& text) {
  static constexpr Quantity kTime{"time", "s"};
  const auto undo = [factor](MeasuredRun& run) {
    constexpr double kDensest_s = 0.01;
    constexpr double kWidest_s = 60.0;
    const double interval_s = factor * measurements::calc_mean_interval_s(run);
    if (interval_s < kDensest_s || interval_s > kWidest_s) return false;
    for (double& time_s : run.time_s) time_s *= factor;
    return true;
  };
  return {"time_s " + text, 1.0, {kTime}, false, {}, undo};
}

}  // namespace

std::vector<WrongUnit> list_common_wrong_units() {
  constexpr double kPsi_kPa = 6.894757;  // NIST SP 811
  constexpr double kBar_kPa = 100.0;
  constexpr double kNauticalMile_km = 1.852;  // exact
  constexpr double kRare = 0.2;               // Assumed
  constexpr double kVeryRare = 0.02;          // Assumed: units that ships and aircraft use, and few others
  return {{quantities::kSpeed, 3.6, 0.0, "holds m/s"},
          {quantities::kSpeed, 1.0 / 3.6, 0.0, "was multiplied by 3.6 once too often", kRare},
          {quantities::kSpeed, kMile_m / 1e3, 0.0, "holds mph"},
          {quantities::kSpeed, kNauticalMile_km, 0.0, "holds knots", kVeryRare},  // as NMEA 0183 has it
          {quantities::kLoad, kStandardGravity_m_s2, 0.0, "holds kgf"},
          {quantities::kLoad, 1e3, 0.0, "holds kN"},
          {quantities::kLoad, kPoundForce_N, 0.0, "holds lbf"},
          {quantities::kCavityPressure, 1.0, -kStandardAtmosphere_Pa / 1e3, "is absolute, not gauge"},
          {quantities::kCavityPressure, kBar_kPa, 0.0, "holds bar"},
          {quantities::kCavityPressure, kPsi_kPa, 0.0, "holds psi"},
          {quantities::kLinerTemperature, 1.0 / 1.8, -32.0 / 1.8, "holds degF"},
          {quantities::kLinerTemperature, 1.0, -kZeroCelsius_K, "holds K", kRare},
          {quantities::kAmbient, 1.0 / 1.8, -32.0 / 1.8, "holds degF"}};
}

std::vector<WrongUnit> list_mixed_up_lever(const Quantity& force, double factor, const std::string& text) {
  constexpr double kNear = 0.3;  // Assumed: of the logarithm; effects change a force by less
  if (std::abs(std::log(factor)) < kNear) return {};
  return {{force, factor, 0.0, text}};
}

std::vector<Mistake> list_mistakes(const MeasurementSet& set) {
  std::vector<Mistake> mistakes;
  const std::vector<rigs::Column> columns = set.kind->columns.all();
  for (const WrongUnit& wrong : kind_of(set).list_wrong_units(set)) {
    for (const rigs::Column& column : columns) {
      if (column.quantity == wrong.column) mistakes.push_back(make_wrong_unit(wrong, column.range));
    }
  }
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = a + 1; b < columns.size(); ++b) mistakes.push_back(exchange(set, columns[a], columns[b]));
  }
  mistakes.push_back(make_wrong_time(1e-3, "holds ms"));
  mistakes.push_back(make_wrong_time(60.0, "holds min"));
  return mistakes;
}

Mistake combine(const Mistake& a, const Mistake& b) {
  Mistake both = a;
  both.text += " and " + b.text;
  both.weight *= b.weight;
  both.columns.insert(both.columns.end(), b.columns.begin(), b.columns.end());
  both.log_factors.insert(b.log_factors.begin(), b.log_factors.end());
  both.is_exchange = a.is_exchange && b.is_exchange;
  both.undo = [of_a = a.undo, of_b = b.undo](MeasuredRun& run) { return of_a(run) && of_b(run); };
  return both;
}

bool have_common_column(const Mistake& a, const Mistake& b) {
  return std::any_of(a.columns.begin(), a.columns.end(), [&](const Quantity& column) {
    return std::find(b.columns.begin(), b.columns.end(), column) != b.columns.end();
  });
}

}  // namespace rollrig::diagnosis
