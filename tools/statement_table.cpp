#include <algorithm>
#include <cmath>

#include "tools/drive_tables.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

using PerTire = std::map<std::string, double>;

PerTire measure_statement(const Drives& drives, double (*find)(const TireDrive&)) {
  PerTire values;
  for (const auto& [tire, drive] : drives) values[tire] = find(drive);
  return values;
}

class StatementTable {
 public:
  void add(const std::string& place, const std::string& statement, const std::string& found, bool holds) {
    rows_.push_back(fmt::format("| {} | {} | {} | {} |", place, statement, found, holds ? "holds" : "does not hold"));
  }
  /// a40 above a50 above a60.
  void add_order(const std::string& place, const std::string& statement, PerTire v, const char* unit, int digits = 1) {
    add(place, statement, list(v, unit, digits), v["a40"] > v["a50"] && v["a50"] > v["a60"]);
  }
  /// Each tire's value within a limit.
  void add_limit(const std::string& place, const std::string& statement, PerTire v, double limit, const char* unit) {
    add(place, statement, list(v, unit, 1),
        std::all_of(v.begin(), v.end(), [limit](const auto& each) { return std::abs(each.second) <= limit; }));
  }
  static std::string list(PerTire v, const char* unit, int digits) {
    return fmt::format("{:.{}f} / {:.{}f} / {:.{}f} {}", v["a40"], digits, v["a50"], digits, v["a60"], digits, unit);
  }
  const Rows& rows() const { return rows_; }

 private:
  Rows rows_;
};

/// Half the range of a section's temperature.
double find_half_range(const DriveSection& section) { return 0.5 * (section.highest_degC() - section.lowest_degC()); }

void add_dyno_setting(StatementTable& table) {
  Drives drives;
  for (const std::string& tire : kTires) drives[tire] = drive_dyno_setting(tire);
  const char* place = "§4.3.1";
  table.add_order(place, "temperatures a40 > a50 > a60 (mean)", measure_statement(drives, find_mean_degC), "degC");
  table.add_limit(place, "within ±2 degC over the second highway section (half its range)",
                  measure_statement(drives, [](const TireDrive& d) { return find_half_range(d[1]); }), 2.0, "degC");
  table.add_order(place, "a40 varies most, then a50, a60 (range)", measure_statement(drives, find_range_K), "degC");
}

double find_last_rise(const DriveSection& section) {
  constexpr double kRamp_s = 40.0;  // the way back to standstill
  const double end_s = section.time_s.back() - kRamp_s;
  return section.at_degC(end_s) - section.at_degC(end_s - 600.0);
}

/// Least rise over sections driven without stops, and over the city's second hill (UDDS, 190 to 330 s).
double find_least_rise(const TireDrive& drive) {
  double least = 1e9;
  for (const DriveSection& section : select(drive, "highway"))
    least = std::min(least, section.highest_degC() - section.start_degC());
  for (const DriveSection& section : select(drive, "constant"))
    least = std::min(least, section.highest_degC() - section.start_degC());
  for (const DriveSection& section : select(drive, "city"))
    least = std::min(least, section.at_degC(330.0) - section.at_degC(190.0));
  return least;
}

void add_drive_cycle(StatementTable& table, const Drives& drives) {
  const char* place = "§4.4.1";
  table.add_order(place, "temperatures a40 > a50 > a60 (mean)", measure_statement(drives, find_mean_degC), "degC");
  table.add_limit(place, "steady state in the constant-speed sections (change in the last 10 min, 105 km/h)",
                  measure_statement(drives, [](const TireDrive& d) { return find_last_rise(d[3]); }), 0.5, "degC");
  table.add_limit(place, "the same at 80 km/h",
                  measure_statement(drives, [](const TireDrive& d) { return find_last_rise(d[7]); }), 0.5, "degC");
  PerTire rise = measure_statement(drives, find_least_rise);
  table.add(place, "rises in highway and constant-speed sections and in the city's continuous part (least rise)",
            StatementTable::list(rise, "degC", 1),
            std::all_of(rise.begin(), rise.end(), [](const auto& v) { return v.second > 0.0; }));
  PerTire loss = measure_statement(drives, [](const TireDrive& d) {
    double least = 1e9;
    for (const DriveSection& city : select(d, "city")) least = std::min(least, city.highest_degC() - city.end_degC());
    return least;
  });
  table.add(place, "stops of the city let the temperature fall from its height (least fall to the end)",
            StatementTable::list(loss, "degC", 1),
            std::all_of(loss.begin(), loss.end(), [](const auto& v) { return v.second > 0.0; }));
  for (const std::string& tire : kTires) {
    const TireDrive city = select(drives.at(tire), "city");
    const double m[4] = {city[0].mean_degC(), city[1].mean_degC(), city[2].mean_degC(), city[3].mean_degC()};
    table.add(place, "City 3 > City 2 ≈ City 4 > City 1, " + tire + " (means; ≈: 1 degC)",
              fmt::format("{:.1f} > {:.1f} ≈ {:.1f} > {:.1f} degC", m[2], m[1], m[3], m[0]),
              m[2] > m[1] && m[2] > m[3] && std::abs(m[1] - m[3]) < 1.0 && m[1] > m[0] && m[3] > m[0]);
  }
  table.add_order(place, "a40 varies most, then a50, a60 (range)", measure_statement(drives, find_range_K), "degC");
}

double find_rrc(const std::string& tire, double speed_km_h, double degC) {
  return calc_law_rrc_N_per_kN(make_source_drive(tire).tire, speed_km_h, degC);
}

void add_city_comparison(StatementTable& table, const Drives& drives) {
  const char* place = "§4.4.3";
  PerTire by_speed, by_temperature;
  for (const std::string& tire : kTires) {
    const double degC = select(drives.at(tire), "city")[1].start_degC();
    by_speed[tire] = find_rrc(tire, 90.0, degC) - find_rrc(tire, 40.0, degC);
    by_temperature[tire] = find_rrc(tire, 90.0, degC) - find_rrc(tire, 90.0, degC + 6.0);
  }
  table.add(place, "a40: about 4 N/kN for 50 km/h (40 to 90 km/h, temperature at the start of City 2; ±25 %)",
            fmt::format("{:.2f} N/kN", by_speed["a40"]), std::abs(by_speed["a40"] - 4.0) <= 1.0);
  table.add(place, "a40: about 1 N/kN for 6 degC (at 90 km/h, from there; ±25 %)",
            fmt::format("{:.2f} N/kN", by_temperature["a40"]), std::abs(by_temperature["a40"] - 1.0) <= 0.25);
  table.add_order("§4.4.3, §4.3.2", "dependence on speed a40 > a50 > a60 (for the same 50 km/h)", by_speed, "N/kN", 2);
  table.add_order(place, "dependence on temperature a40 > a50 > a60 (for the same 6 degC)", by_temperature, "N/kN", 2);
  table.add_limit(place, "City 2 ends about where it starts (within 1 degC)",
                  measure_statement(drives, [](const TireDrive& d) { return d[2].end_degC() - d[2].start_degC(); }),
                  1.0, "degC");
  const PerTire source{{"a40", 10.0}, {"a50", 7.0}, {"a60", 5.0}};
  for (const std::string& tire : kTires) {
    const DriveSection& city_3 = drives.at(tire)[4];
    const double fall = city_3.start_degC() - city_3.end_degC();
    table.add(place, fmt::format("City 3 ends ~{:.0f} degC below its start, {} (±20 %; fitted)", source.at(tire), tire),
              fmt::format("{:.1f} degC", fall), std::abs(fall - source.at(tire)) <= 0.2 * source.at(tire));
  }
}

}  // namespace

Rows list_statements(const Drives& drives) {
  StatementTable table;
  add_dyno_setting(table);
  add_drive_cycle(table, drives);
  add_city_comparison(table, drives);
  return table.rows();
}

}  // namespace rollrig::tools
