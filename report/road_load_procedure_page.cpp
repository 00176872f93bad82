#include "report/road_load_procedure_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/road_load/road_load_report.h"
#include "estimation/run_checks/doubts_json.h"
#include "report/blocks.h"
#include "sim/core/csv.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using estimation::ProcedurePoint;
using estimation::RoadLoadProcedure;

constexpr const char* kCoefficientKeys[] = {"f0_N", "f1_N_per_km_h", "f2_N_per_km_h2"};
constexpr const char* kCoefficientUnits[] = {"N", "N/(km/h)", "N/(km/h)2"};

bool is_torque(const RoadLoadProcedure& procedure) { return procedure.kind == RoadLoadProcedureKind::kTorqueMeter; }

const char* name_of_procedure(RoadLoadProcedureKind kind) {
  switch (kind) {
    case RoadLoadProcedureKind::kWltp:
      return "wltp";
    case RoadLoadProcedureKind::kJ2263:
      return "j2263";
    case RoadLoadProcedureKind::kJ1263:
      return "j1263";
    case RoadLoadProcedureKind::kTorqueMeter:
      break;
  }
  return "torque-meter";
}

double in_file_unit(int i, double value_SI) { return estimation::road_load_in_file_unit(i, value_SI); }

std::string number_text(double value) { return fmt::format("{:.5g}", value); }

Table make_procedure_coefficients(const RoadLoadProcedure& procedure) {
  Table table{"Road load at reference conditions, with standard deviation and 95 % interval",
              {"", "value", "sd", "from", "to", "unit", "as tested"},
              {}};
  const double per_unit = is_torque(procedure) ? procedure.road_load(0) / procedure.corrected(0) : 1.0;
  const std::vector<ParameterEstimate> estimates = list_procedure_coefficients(procedure);
  for (int i = 0; i < 3; ++i) {
    const ParameterEstimate& at = estimates[static_cast<std::size_t>(i)];
    table.rows.push_back({fmt::format("f{}", i), number_text(at.value), fmt::format("{:.3g}", at.sd),
                          number_text(at.low_95), number_text(at.high_95), at.unit,
                          number_text(in_file_unit(i, per_unit * procedure.as_tested(i)))});
  }
  return table;
}

/// As the WLTP rounds them, and as EPA has them.
Table make_rounded(const RoadLoadProcedure& procedure) {
  Table table{"Rounded, and in lbf and mph", {"", "rounded", "unit", "lbf, mph"}, {}};
  for (int i = 0; i < 3; ++i) {
    constexpr int kDecimals[] = {1, 3, 5};  // Regulation (EU) 2018/1832, 2.4 of Sub-Annex 4
    table.rows.push_back(
        {fmt::format("f{}", i), fmt::format("{:.{}f}", in_file_unit(i, procedure.road_load(i)), kDecimals[i]),
         kCoefficientUnits[i], number_text(estimation::road_load_in_lbf_mph(i, procedure.road_load(i)))});
  }
  return table;
}

Table make_running_resistance(const RoadLoadProcedure& procedure) {
  constexpr const char* kUnits[] = {"Nm", "Nm/(km/h)", "Nm/(km/h)2"};
  Table table{"Running resistance: torque of the driven wheels", {"", "corrected", "as tested", "unit"}, {}};
  for (int i = 0; i < 3; ++i) {
    table.rows.push_back({fmt::format("c{}", i), number_text(in_file_unit(i, procedure.corrected(i))),
                          number_text(in_file_unit(i, procedure.as_tested(i))), kUnits[i]});
  }
  return table;
}

Table make_forces_of_procedure(const RoadLoadProcedure& procedure) {
  Table table{"", {"speed, km/h", "force, N", "sd, N"}, {}};
  for (const double speed_m_s : estimation::shown_speeds_m_s()) {
    table.rows.push_back({fmt::format("{:.0f}", kKmhPerMs * speed_m_s),
                          fmt::format("{:.4g}", procedure.force_N(speed_m_s)),
                          fmt::format("{:.2g}", procedure.force_sd_N(speed_m_s))});
  }
  return table;
}

/// The fit at the conditions of the test, in N or N m.
double calc_as_tested(const RoadLoadProcedure& procedure, double speed_m_s) {
  return procedure.as_tested(0) + speed_m_s * (procedure.as_tested(1) + speed_m_s * procedure.as_tested(2));
}

Table make_reference_table(const RoadLoadProcedure& procedure) {
  const bool torque = is_torque(procedure);
  Table table{
      "Reference speeds",
      {"km/h", "pairs", torque ? "torque, Nm" : "time, s", "precision", torque ? "mean, Nm" : "force, N", "fit"},
      {}};
  for (std::size_t i = 0; i < procedure.reference.speeds.size(); ++i) {
    const estimation::ReferencePrecision& at = procedure.reference.precisions[i];
    table.rows.push_back({fmt::format("{:.4g}", kKmhPerMs * procedure.reference_speeds_m_s[i]),
                          fmt::format("{}", at.pairs), fmt::format("{:.4g}", at.mean),
                          fmt::format("{:.2f} %", 100.0 * at.precision),
                          fmt::format("{:.1f}", procedure.reference.resistances[i]),
                          fmt::format("{:.1f}", calc_as_tested(procedure, procedure.reference_speeds_m_s[i]))});
  }
  return table;
}

Table make_conditions(const RoadLoadProcedure& procedure) {
  const estimation::ReferenceCorrection& at = procedure.correction;
  Table list;
  const auto add = [&list](const char* label, const std::string& text) { list.rows.push_back({label, text}); };
  add("mass as tested", fmt::format("{:.6g} kg", at.mass_kg));
  if (at.corrected_to_mass_kg != at.mass_kg) {
    add("corrected to the mass", fmt::format("{:.6g} kg", at.corrected_to_mass_kg));
  }
  add("rotating mass", fmt::format("{:.4g} kg{}", procedure.rotating_mass_kg,
                                   procedure.rotating_mass_assumed ? ", 3 % of the mass (Assumed)" : ""));
  if (is_torque(procedure)) add("dynamic radius", fmt::format("{:.4f} m", procedure.wheel_radius_m));
  if (at.ambient_K.has_value()) {
    add("air",
        fmt::format("{:.1f} degC, {}", *at.ambient_K - kZeroCelsius_K,
                    at.ambient_pressure_Pa.has_value() ? fmt::format("{:.2f} kPa", 1e-3 * *at.ambient_pressure_Pa)
                                                       : std::string("pressure of reference (Assumed)")));
    add("factor of f0 and f1; of f2", fmt::format("{:.4f}; {:.4f}", at.rolling_factor(), at.air_factor()));
  }
  add("wind that both headings have",
      procedure.wind_m_s.has_value() ? fmt::format("{:.2f} m/s", *procedure.wind_m_s) : std::string("not measured"));
  add("reference", fmt::format("{:.4g} degC, {:.5g} kPa", at.reference_temperature_K - kZeroCelsius_K,
                               1e-3 * at.reference_pressure_Pa));
  for (const estimation::FurtherCoefficient& further : procedure.further) {
    list.rows.push_back({further.label, further.sd > 0.0 ? fmt::format("{:.4g} +- {:.2g}", further.value, further.sd)
                                                         : fmt::format("{:.4g}", further.value)});
  }
  return list;
}

/// Standard deviations by where they come from.
Table make_budget(const RoadLoadProcedure& procedure) {
  Table table{"Uncertainty: standard deviations", {"from", "f0, N", "f1, N/(km/h)", "f2, N/(km/h)2"}, {}};
  const auto add = [&table](const std::string& name, const Eigen::Vector3d& sd) {
    std::vector<std::string> row{name};
    for (int i = 0; i < 3; ++i) row.push_back(fmt::format("{:.2g}", std::abs(in_file_unit(i, sd(i)))));
    table.rows.push_back(row);
  };
  add("scatter of the runs", procedure.repeatability.diagonal().cwiseSqrt());
  for (const estimation::SensorContribution& sensor : procedure.sensors) add(sensor.sensor.name, sensor.change);
  return table;
}

Table make_procedure_checks(const RoadLoadProcedure& procedure) {
  Table table{"Checks", {"check", "", "found", "limit", "clause"}, {}, 1};
  for (const estimation::RoadLoadCheck& check : procedure.checks) {
    table.rows.push_back({check.name, estimation::name_of(check.status), check.found, check.limit, check.clause});
  }
  return table;
}

Json interval_json(const std::array<double, 2>& interval, int i) {
  return {in_file_unit(i, interval[0]), in_file_unit(i, interval[1])};
}

Block make_resistance_chart(const RoadLoadProcedure& procedure) {
  constexpr int kPoints = 40;
  double low_m_s = 1e9, high_m_s = 0.0;
  for (const ProcedurePoint& point : procedure.points) {
    low_m_s = std::min(low_m_s, point.speed_m_s);
    high_m_s = std::max(high_m_s, point.speed_m_s);
  }
  Json series = Json::array();
  if (!is_torque(procedure)) {
    constexpr double kWide = 1.96;  // of a normal interval of 95 %
    ChartSeries curve;
    for (int i = 0; i <= kPoints; ++i) {
      const double speed_m_s = low_m_s + (high_m_s - low_m_s) * i / kPoints;
      const double force_N = procedure.force_N(speed_m_s);
      const double half_N = kWide * procedure.force_sd_N(speed_m_s);
      curve.add(kKmhPerMs * speed_m_s, force_N, force_N - half_N, force_N + half_N);
    }
    series.push_back(curve.finish("f0 + f1 v + f2 v² at reference conditions, 95 % band", "line"));
  }
  for (const auto& [heading, name] : {std::pair(1, "runs in + heading"), {-1, "runs in - heading"}}) {
    ChartSeries points;
    for (const ProcedurePoint& point : procedure.points) {
      if (point.heading == heading) points.add(kKmhPerMs * point.speed_m_s, point.measured);
    }
    if (!points.x.empty()) series.push_back(points.finish(name));
  }
  return make_curves({"Speed", "km/h"},
                     {is_torque(procedure) ? "Torque" : "Force", is_torque(procedure) ? "Nm" : "N", true}, series,
                     "Points: as tested, with the wind, the slope and the weather of their run.");
}

/// Checks that failed: "reference speeds (20 to 120 km/h; limit: 20 to 130 km/h)", the first three.
std::string list_failed_checks(const RoadLoadProcedure& procedure, bool with_limits) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> failed;
  for (const estimation::RoadLoadCheck& check : procedure.checks) {
    if (check.status != estimation::CheckStatus::kFail) continue;
    failed.push_back(with_limits ? fmt::format("{} ({}; limit: {})", check.name, check.found, check.limit)
                                 : check.name);
  }
  const std::size_t more = failed.size() - std::min(failed.size(), kMost);
  failed.resize(failed.size() - more);
  return fmt::format("{}{}", fmt::join(failed, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

Block make_procedure_tiles(const RoadLoadProcedure& procedure) {
  constexpr const char* kNotes[] = {"force at standstill; +- is one standard deviation, in all these tiles",
                                    "rise with speed", "rise with the square of speed"};
  std::vector<Tile> tiles;
  const std::vector<ParameterEstimate> coefficients = list_procedure_coefficients(procedure);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const ParameterEstimate& at = coefficients[i];
    tiles.push_back({fmt::format("f{}", i),
                     show_with_sd(at.value, at.sd),
                     at.unit,
                     kNotes[i],
                     "",
                     {"/" + at.name, "/" + at.name + "_sd"}});
  }
  const auto failed = std::count_if(procedure.checks.begin(), procedure.checks.end(),
                                    [](const auto& check) { return check.status == estimation::CheckStatus::kFail; });
  tiles.push_back({"Checks of the standard",
                   failed == 0 ? "none failed" : fmt::format("{} failed", failed),
                   "",
                   "of " + format_count(procedure.checks.size(), "check") +
                       (failed == 0 ? "" : ": " + list_failed_checks(procedure, true)),
                   failed == 0 ? "good" : "bad",
                   {}});
  return make_tiles(tiles);
}

/// The road load in a sentence, and whether the test meets its standard.
Block make_procedure_lead(const RoadLoadProcedure& procedure) {
  const std::vector<ParameterEstimate> coefficients = list_procedure_coefficients(procedure);
  const auto show = [&](std::size_t i) {
    return fmt::format("{:.4g} {}", coefficients[i].value, coefficients[i].unit);
  };
  const auto failed = std::count_if(procedure.checks.begin(), procedure.checks.end(),
                                    [](const auto& check) { return check.status == estimation::CheckStatus::kFail; });
  const std::string checks =
      failed == 0 ? "No check of the standard failed."
                  : fmt::format("{} of {} of the standard failed: {}.", failed,
                                format_count(procedure.checks.size(), "check"), list_failed_checks(procedure, false));
  return make_lead(failed == 0 ? "good" : "bad",
                   fmt::format("The road load at reference conditions is f0 = {}, f1 = {}, f2 = {}. {}", show(0),
                               show(1), show(2), checks));
}

}  // namespace

std::string title_of(RoadLoadProcedureKind kind) {
  switch (kind) {
    case RoadLoadProcedureKind::kWltp:
      return "WLTP coastdown (UN GTR 15, UN R154)";
    case RoadLoadProcedureKind::kJ2263:
      return "speed traces with anemometer (SAE J2263)";
    case RoadLoadProcedureKind::kJ1263:
      return "speed traces with mean wind (SAE J1263)";
    case RoadLoadProcedureKind::kTorqueMeter:
      break;
  }
  return "WLTP torque-meter method (UN GTR 15, UN R154)";
}

std::vector<ParameterEstimate> list_procedure_coefficients(const RoadLoadProcedure& procedure) {
  std::vector<ParameterEstimate> list;
  for (int i = 0; i < 3; ++i) {
    const std::array<double, 2> interval = procedure.interval_95(i);
    list.push_back({kCoefficientKeys[i], in_file_unit(i, procedure.road_load(i)), in_file_unit(i, procedure.sd(i)),
                    in_file_unit(i, interval[0]), in_file_unit(i, interval[1]), kCoefficientUnits[i]});
  }
  return list;
}

std::vector<Table> make_procedure_tables(const RoadLoadProcedure& procedure) {
  std::vector<Table> tables{make_procedure_coefficients(procedure), make_rounded(procedure)};
  if (is_torque(procedure)) tables.push_back(make_running_resistance(procedure));
  tables.push_back(make_forces_of_procedure(procedure));
  if (!procedure.reference.speeds.empty()) tables.push_back(make_reference_table(procedure));
  tables.insert(tables.end(), {make_conditions(procedure), make_budget(procedure), make_procedure_checks(procedure)});
  return tables;
}

Json make_procedure_json(const RoadLoadProcedure& procedure) {
  const estimation::ReferenceCorrection& at = procedure.correction;
  Json json = {{"format", "rollrig-road-load-procedure/2"}, {"procedure", name_of_procedure(procedure.kind)}};
  for (int i = 0; i < 3; ++i) {
    json[kCoefficientKeys[i]] = in_file_unit(i, procedure.road_load(i));
    json[std::string(kCoefficientKeys[i]) + "_sd"] = in_file_unit(i, procedure.sd(i));
    json["ci95"][kCoefficientKeys[i]] = interval_json(procedure.interval_95(i), i);
    json["lbf_mph"][estimation::road_load_lbf_key(i)] = estimation::road_load_in_lbf_mph(i, procedure.road_load(i));
    json["sd_of_runs"][kCoefficientKeys[i]] = in_file_unit(i, std::sqrt(procedure.repeatability(i, i)));
    constexpr const char* kTorqueKeys[] = {"c0_Nm", "c1_Nm_per_km_h", "c2_Nm_per_km_h2"};
    const char* key = is_torque(procedure) ? kTorqueKeys[i] : kCoefficientKeys[i];
    json["as_tested"][key] = in_file_unit(i, procedure.as_tested(i));
    if (is_torque(procedure)) json["running_resistance"][key] = in_file_unit(i, procedure.corrected(i));
  }
  json["sensors"] = make_list(procedure.sensors, [](const estimation::SensorContribution& sensor) {
    Json entry = {{"from", sensor.sensor.name}};
    for (int i = 0; i < 3; ++i) {
      entry[std::string(kCoefficientKeys[i]) + "_sd"] = std::abs(in_file_unit(i, sensor.change(i)));
    }
    return entry;
  });
  for (const estimation::FurtherCoefficient& further : procedure.further) {
    json["further"][further.key] = further.value;
    if (further.sd > 0.0) json["further"][further.key + "_sd"] = further.sd;
  }
  json["mass_kg"] = at.mass_kg;
  json["rotating_mass_kg"] = procedure.rotating_mass_kg;
  json["rotating_mass_assumed"] = procedure.rotating_mass_assumed;
  json["corrected_to_mass_kg"] = at.corrected_to_mass_kg;
  if (is_torque(procedure)) json["wheel_radius_m"] = procedure.wheel_radius_m;
  json["ambient_degC"] = at.ambient_K.has_value() ? Json(*at.ambient_K - kZeroCelsius_K) : Json(nullptr);
  json["ambient_pressure_kPa"] = at.ambient_pressure_Pa.has_value() ? Json(1e-3 * *at.ambient_pressure_Pa) : Json();
  json["wind_m_s"] = procedure.wind_m_s.has_value() ? Json(*procedure.wind_m_s) : Json(nullptr);
  json["reference_temperature_degC"] = at.reference_temperature_K - kZeroCelsius_K;
  json["reference_pressure_kPa"] = 1e-3 * at.reference_pressure_Pa;
  json["forces"] = make_list(estimation::shown_speeds_m_s(), [&procedure](double speed_m_s) -> Json {
    return {{"speed_km_h", kKmhPerMs * speed_m_s},
            {"force_N", procedure.force_N(speed_m_s)},
            {"force_N_sd", procedure.force_sd_N(speed_m_s)}};
  });
  json["reference_speeds"] = Json::array();
  for (std::size_t i = 0; i < procedure.reference.speeds.size(); ++i) {
    const estimation::ReferencePrecision& precision = procedure.reference.precisions[i];
    json["reference_speeds"].push_back(
        {{"speed_km_h", kKmhPerMs * procedure.reference_speeds_m_s[i]},
         {"pairs", precision.pairs},
         {is_torque(procedure) ? "torque_Nm" : "time_s", precision.mean},
         {"precision_percent", 100.0 * precision.precision},
         {is_torque(procedure) ? "mean_Nm" : "force_N", procedure.reference.resistances[i]},
         {is_torque(procedure) ? "fit_Nm" : "fit_N", calc_as_tested(procedure, procedure.reference_speeds_m_s[i])}});
  }
  json["pairs"] = make_list(procedure.reference.pairs, [&procedure](const estimation::ReferencePair& pair) -> Json {
    return {{"plus", procedure.run_names[pair.plus]},
            {"minus", procedure.run_names[pair.minus]},
            {"part", pair.part + 1},
            {"rejected", pair.rejected.empty() ? Json(nullptr) : Json(pair.rejected)}};
  });
  json["checks"] = make_list(procedure.checks, [](const estimation::RoadLoadCheck& check) -> Json {
    return {{"name", check.name},
            {"status", estimation::name_of(check.status)},
            {"found", check.found},
            {"limit", check.limit},
            {"clause", check.clause}};
  });
  if (!procedure.doubts.empty()) json["doubts"] = estimation::make_doubts_json(procedure.doubts);
  json["warnings"] = procedure.warnings;
  return json;
}

std::string write_procedure_points(const RoadLoadProcedure& procedure) {
  const std::string unit = is_torque(procedure) ? "_Nm" : "_N";
  CsvWriter csv({"run", "heading", "speed_km_h", "measured" + unit, "fitted" + unit});
  for (const ProcedurePoint& point : procedure.points) {
    csv.add_row(point.run, std::string(point.heading > 0 ? "+" : "-"), kKmhPerMs * point.speed_m_s, point.measured,
                point.fitted);
  }
  return csv.take();
}

Page make_procedure_page(const RoadLoadProcedure& procedure, const std::string& source) {
  Page page{"fit road-load", "Road load: " + title_of(procedure.kind), source};
  Section result = make_section("Result", make_procedure_tables(procedure), procedure.warnings);
  put_first({make_procedure_lead(procedure), make_procedure_tiles(procedure), make_resistance_chart(procedure)},
            result);
  page.add(std::move(result));
  page.add(make_document(make_procedure_json(procedure), "The result as JSON"));
  return page;
}

}  // namespace rollrig::report
