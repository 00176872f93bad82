#include "diagnosis/checks/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/kinds/measurement_kind.h"
#include "sim/core/parallel.h"
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

Repair exchange(const MeasurementSet& set, const rigs::Column& a, const rigs::Column& b) {
  const auto undo = [a, b, a_given = is_given(set, a.quantity), b_given = is_given(set, b.quantity)](MeasuredRun& run) {
    if (!run.has(a.quantity) || !run.has(b.quantity)) return false;
    std::vector<double> as_a = read_as(run.column(b.quantity), b.quantity.file_unit(), a, a_given);
    std::vector<double> as_b = read_as(run.column(a.quantity), a.quantity.file_unit(), b, b_given);
    if (as_a.empty() || as_b.empty()) return false;
    run.column(a.quantity) = std::move(as_a);
    run.column(b.quantity) = std::move(as_b);
    return true;
  };
  return {fmt::format("the columns {} and {} are exchanged", a.quantity.header(), b.quantity.header()), undo};
}

Repair wrong_unit(const WrongUnit& wrong) {
  const auto undo = [wrong](MeasuredRun& run) {
    if (!run.has(wrong.column)) return false;
    const Unit unit = wrong.column.file_unit();
    for (double& value : run.column(wrong.column)) {
      value = unit.to_si(wrong.factor * unit.from_si(value) + wrong.offset);
    }
    return true;
  };
  return {wrong.column.header() + " " + wrong.text, undo};
}

std::vector<Repair> list_mistakes(const MeasurementSet& set, Mistakes which) {
  std::vector<Repair> mistakes;
  if (which == Mistakes::kAll) {
    for (const WrongUnit& wrong : kind_of(set).list_wrong_units()) mistakes.push_back(wrong_unit(wrong));
  }
  const std::vector<rigs::Column> columns = set.kind->columns.all();
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = a + 1; b < columns.size(); ++b) mistakes.push_back(exchange(set, columns[a], columns[b]));
  }
  return mistakes;
}

/// Sum of squares of a run's misfit once the mistake is undone; infinite where a channel stays outside.
double calc_squares_without(const Repair& mistake, const MeasurementSet& set, std::size_t r) {
  MeasuredRun run = set.runs[r];
  if (!mistake.undo(run)) return std::numeric_limits<double>::infinity();
  const RunMisfit misfit = calc_misfit(set, run);
  return misfit.worst() > 1.0 ? std::numeric_limits<double>::infinity() : misfit.sum_of_squares();
}

}  // namespace

std::vector<WrongUnit> list_common_wrong_units() {
  constexpr double kPsi_kPa = 6.894757;  // NIST SP 811
  constexpr double kBar_kPa = 100.0;
  return {{quantities::kSpeed, 3.6, 0.0, "holds m/s"},
          {quantities::kSpeed, 1.0 / 3.6, 0.0, "was multiplied by 3.6 once too often"},
          {quantities::kSpeed, kMile_m / 1e3, 0.0, "holds mph"},
          {quantities::kLoad, kStandardGravity_m_s2, 0.0, "holds kgf"},
          {quantities::kLoad, 1e3, 0.0, "holds kN"},
          {quantities::kCavityPressure, 1.0, -kStandardAtmosphere_Pa / 1e3, "is absolute, not gauge"},
          {quantities::kCavityPressure, kBar_kPa, 0.0, "holds bar"},
          {quantities::kCavityPressure, kPsi_kPa, 0.0, "holds psi"},
          {quantities::kLinerTemperature, 1.0 / 1.8, -32.0 / 1.8, "holds degF"},
          {quantities::kAmbient, 1.0 / 1.8, -32.0 / 1.8, "holds degF"}};
}

std::optional<Repair> find_repair(const MeasurementSet& set, const std::vector<std::size_t>& odd_runs, Mistakes which,
                                  int threads) {
  constexpr double kMuchBetter = 0.1;  // Assumed: of the sum of squares
  const auto calc_squares = [&set](std::size_t r) { return calc_misfit(set, set.runs[r]).sum_of_squares(); };
  double before = 0.0;
  for (const std::size_t r : odd_runs) before += calc_squares(r);
  const std::vector<Repair> mistakes = list_mistakes(set, which);
  std::vector<double> after(mistakes.size(), 0.0);
  parallel_for(mistakes.size(), threads, [&](std::size_t i) {
    for (const std::size_t r : odd_runs) {
      after[i] += calc_squares_without(mistakes[i], set, r);
      if (!(after[i] <= kMuchBetter * before)) return;
    }
  });
  const auto best = std::min_element(after.begin(), after.end());
  if (*best > kMuchBetter * before) return std::nullopt;
  Repair repair = mistakes[static_cast<std::size_t>(best - after.begin())];
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const bool odd = std::find(odd_runs.begin(), odd_runs.end(), r) != odd_runs.end();
    if (odd || calc_squares_without(repair, set, r) <= kMuchBetter * calc_squares(r)) repair.runs.push_back(r);
  }
  return repair;
}

}  // namespace rollrig::diagnosis
