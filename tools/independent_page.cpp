/// docs/independent_validation.md: what other sources say, and what virtual tires do.
#include <algorithm>
#include <cmath>
#include <functional>

#include "tools/independent.h"
#include "tools/pages.h"

namespace rollrig::tools {
namespace {

using namespace independent;
using Measure = std::function<double(const StudyTire&)>;
using Holds = std::function<bool(double)>;

/// Shown as `factor` times the value with `digits` digits.
struct Format {
  double factor = 1.0;
  int digits = 2;
};
constexpr Format kPercent{100.0, 1};

enum class Tires { kCars, kTruck, kAll };

bool is_meant(Tires tires, const std::string& name) {
  return tires == Tires::kAll || (name == kTruckTire) == (tires == Tires::kTruck);
}

/// A row for each statement, a column for each tire, and for which of them it holds.
class StatementRows {
 public:
  void add(const std::string& source, const std::string& statement, Tires tires, Format format, const Measure& measure,
           const Holds& holds) {
    Rows cells, holding;
    std::size_t count = 0;
    for (const std::string& name : kStudyTires) {
      if (!is_meant(tires, name)) {
        cells.push_back("");
        continue;
      }
      const double value = measure(read_study_tire(name));
      cells.push_back(fmt::format("{:.{}f}", format.factor * value, format.digits));
      ++count;
      if (holds(value)) holding.push_back(name);
    }
    std::string verdict = "does not hold";
    if (!holding.empty()) verdict = fmt::format("holds for {}", fmt::join(holding, ", "));
    if (holding.size() == count) verdict = "holds";
    rows_.push_back(fmt::format("| {} | {} | {} | {} |", source, statement, fmt::join(cells, " | "), verdict));
  }
  std::string join_rows() const { return join(rows_); }

 private:
  Rows rows_;
};

Holds is_near(double published, double margin) {
  return [=](double value) { return std::abs(value - published) <= margin; };
}
bool is_positive(double value) { return value > 0.0; }

Measure change_pressure(double from_psi, double to_psi, double drum_m = 2.0) {
  return [=](StudyTire tire) {
    tire.change_drum(drum_m);
    return find_pressure_change(tire, from_psi, to_psi);
  };
}

std::string list_pressure() {
  StatementRows rows;
  const std::string schuring = "Schuring (1980) in TRB 286";
  rows.add("LDTP 78-11",
           "conditions only: from 45 to 26 psi on a roll of 48 inches (less pressure, more resistance); change, %",
           Tires::kCars, kPercent, change_pressure(45.0, 26.0, kEpaRoll_m), &is_positive);
  rows.add("Mullins (2010)", "less pressure, more resistance: from 50 to 20 psi; change, %", Tires::kCars, kPercent,
           change_pressure(50.0, 20.0), &is_positive);
  rows.add(schuring, "24 to 29 psi: -10 % (±2.5 points); change, %", Tires::kCars, kPercent,
           change_pressure(24.0, 29.0), is_near(-0.10, 0.025));
  rows.add(
      schuring, "1.4 % more for each psi less, from 36 to 24 psi (±0.3 points); mean, %", Tires::kCars, {100.0, 2},
      [](const StudyTire& tire) { return find_rise_per_psi(tire, 36.0, 24.0); }, is_near(0.014, 0.003));
  rows.add(
      schuring, "more than that below 24 psi; mean from 24 to 20 psi less the above, points", Tires::kCars, {100.0, 2},
      [](const StudyTire& tire) { return find_rise_per_psi(tire, 24.0, 20.0) - find_rise_per_psi(tire, 36.0, 24.0); },
      &is_positive);
  rows.add("LaClair in TRB 286, by a forum", "resistance in proportion to p^-0.4 (±0.1); exponent", Tires::kCars,
           {1.0, 2}, find_pressure_exponent, is_near(-0.4, 0.1));
  rows.add("TST 6 (1978) 163", "linear in 1/p (within 1 % of the loss); largest difference, %", Tires::kAll, {100.0, 2},
           find_bend_over_inverse_pressure, is_near(0.0, 0.01));
  rows.add("EPA-AA-SDSB-80-9",
           "28 instead of 20 psi gives 3 % more fuel economy, that is at least 15 % less "
           "resistance; change, %",
           Tires::kCars, kPercent, change_pressure(20.0, 28.0), [](double value) { return value <= -0.15; });
  return rows.join_rows();
}

std::string list_load_and_speed() {
  StatementRows rows;
  rows.add("TST 6 (1978) 163", "linear in the load (within 1 % of the loss); largest difference, %", Tires::kAll,
           {100.0, 2}, find_bend_over_load, is_near(0.0, 0.01));
  rows.add("VECTO", "in proportion to load^0.9 at equal pressure (±0.05; fitted); exponent", Tires::kTruck, {1.0, 3},
           find_load_exponent, is_near(0.9, 0.05));
  rows.add("Engineering ToolBox", "by its formula 27 to 29 % more at 120 than at 80 km/h (±5 points); rise, %",
           Tires::kCars, kPercent, find_speed_rise, is_near(0.28, 0.05));
  return rows.join_rows();
}

std::string list_air() {
  StatementRows rows;
  const auto slope = [](const StudyTire& tire) { return find_air_slope_per_K(tire, &SteadyLoss::reported_N); };
  rows.add("UN R117, ISO 28580", "class C1: 0.8 % less for each degC, 20 to 30 degC (±0.2 points); slope, %",
           Tires::kCars, {100.0, 2}, slope, is_near(0.008, 0.002));
  rows.add("UN R117, ISO 28580", "class C3, load index above 121: 0.6 % (±0.15 points); slope, %", Tires::kTruck,
           {100.0, 2}, slope, is_near(0.006, 0.0015));
  for (const double air_degC : {15.0, -5.0}) {
    const std::string statement = fmt::format("more loss at {:.0f} than at 25 degC; excess, %", air_degC);
    rows.add(
        "Ejsmont et al. (2024)", statement, Tires::kAll, kPercent,
        [=](const StudyTire& tire) { return find_air_excess(tire, air_degC); }, &is_positive);
  }
  for (const double air_degC : {25.0, 5.0, -15.0}) {
    const std::string statement =
        fmt::format("from {:.0f} to {:.0f} degC more loss; rise, %", air_degC, air_degC - 15.0);
    rows.add(
        "Hyttinen et al. (2022)", statement, Tires::kTruck, kPercent,
        [=](const StudyTire& tire) {
          return (1.0 + find_air_excess(tire, air_degC - 15.0)) / (1.0 + find_air_excess(tire, air_degC)) - 1.0;
        },
        &is_positive);
  }
  return rows.join_rows();
}

std::string list_cold() {
  StatementRows rows;
  for (const double speed_km_h : {20.0, 50.0, 80.0, 120.0}) {
    rows.add(
        fmt::format("{:.0f} km/h", speed_km_h), "more than 1, at most 1.45; ratio", Tires::kAll, {1.0, 3},
        [=](const StudyTire& tire) { return find_cold_ratio(tire, speed_km_h); },
        [](double ratio) { return ratio > 1.0 && ratio <= 1.45; });
  }
  return rows.join_rows();
}

std::string list_cooling() {
  const std::vector<SpeedStep> insulated = step_truck_tire(kInsulated), sprayed = step_truck_tire(kSprayed);
  Rows rows;
  for (std::size_t i = 0; i < insulated.size(); ++i) {
    const RollingState &usual = insulated[i].usual, &warm = insulated[i].changed, &wet = sprayed[i].changed;
    const bool holds = warm.loss_N < usual.loss_N && warm.tread_K > usual.tread_K && warm.carcass_K > usual.carcass_K &&
                       warm.pressure_Pa > usual.pressure_Pa && wet.loss_N > usual.loss_N;
    rows.push_back(
        fmt::format("| {:.0f} | {:.1f} / {:.1f} / {:.1f} | {:.1f} / {:.1f} / {:.1f} | {:.1f} / {:.1f} / {:.1f} | "
                    "{:.0f} / {:.0f} / {:.0f} | {} |",
                    insulated[i].speed_km_h, usual.loss_N, warm.loss_N, wet.loss_N, usual.tread_K - kZeroCelsius_K,
                    warm.tread_K - kZeroCelsius_K, wet.tread_K - kZeroCelsius_K, usual.carcass_K - kZeroCelsius_K,
                    warm.carcass_K - kZeroCelsius_K, wet.carcass_K - kZeroCelsius_K, usual.pressure_Pa / 1e3,
                    warm.pressure_Pa / 1e3, wet.pressure_Pa / 1e3, holds ? "holds" : "does not hold"));
  }
  return join(rows);
}

std::string list_j2452() {
  Rows rows;
  for (const std::string& name : kStudyTires) {
    const J2452Fit fit = fit_j2452(read_study_tire(name));
    rows.push_back(fmt::format("| {} | {:.2f} | {:.2f} | {:.4g} | {:.3g} | {:.3g} | {:.1f} | {:.1f} | {} |", name,
                               fit.alpha, fit.beta, fit.a, fit.b, fit.c, 100.0 * fit.rms, 100.0 * fit.worst,
                               fit.rms <= 0.02 ? "holds" : "does not hold"));
  }
  return join(rows);
}

/// Largest difference between the relative changes of true and reported losses, points.
double compare_losses() {
  double largest = 0.0;
  for (const std::string& name : kStudyTires) {
    const StudyTire tire = read_study_tire(name);
    const SteadyLoss usual = measure_steady(tire, make_iso_conditions(tire));
    TestConditions other = make_iso_conditions(tire);
    other.pressure_Pa *= 0.75;
    const SteadyLoss soft = measure_steady(tire, other);
    largest = std::max(largest, std::abs(soft.true_N / usual.true_N - soft.reported_N / usual.reported_N));
  }
  return 100.0 * largest;
}

}  // namespace

std::string make_independent_page() {
  const Correlation correlation = correlate_truck_tire();
  using fmt::literals::operator""_a;
  return fill_page("independent_validation", "pressure"_a = list_pressure(), "load"_a = list_load_and_speed(),
                   "air"_a = list_air(), "cold"_a = list_cold(), "cooling"_a = list_cooling(), "j2452"_a = list_j2452(),
                   "with_tread"_a = fmt::format("{:.2f}", correlation.with_tread),
                   "with_air"_a = fmt::format("{:.2f}", correlation.with_air),
                   "insulated"_a = fmt::format("{:.1f}", kInsulated), "sprayed"_a = fmt::format("{:.0f}", kSprayed),
                   "true_less_reported"_a = fmt::format("{:.2f}", compare_losses()));
}

}  // namespace rollrig::tools
