#include "estimation/road_load/road_load_report.h"

#include <cmath>

#include "estimation/run_checks/doubts_json.h"
#include "sim/core/csv.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

const char* force_unit(const RoadLoadFit& fit) { return fit.per_mass ? "m_s2" : "N"; }

std::string heading_text(int heading) { return heading == 0 ? "" : heading > 0 ? "+" : "-"; }

/// A, B, C with standard deviations; a coefficient on a bound has none.
Json coefficients_json(const RoadLoadEstimate& estimate, bool per_mass) {
  Json json = Json::object();
  for (int i = 0; i < 3; ++i) {
    const std::string key = road_load_key(i, per_mass);
    json[key] = road_load_in_file_unit(i, estimate.values()[static_cast<std::size_t>(i)]);
    const double sd = estimate.sd(i);
    json[key + "_sd"] = sd > 0.0 ? Json(road_load_in_file_unit(i, sd)) : Json(nullptr);
  }
  return json;
}

Json correlation_json(const RoadLoadEstimate& estimate) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 3; ++j) {
      const double scale = estimate.sd(i) * estimate.sd(j);
      row.push_back(scale > 0.0 ? estimate.covariance(i, j) / scale : (i == j ? 1.0 : 0.0));
    }
    rows.push_back(row);
  }
  return rows;
}

/// Intervals of A, B, C by their keys.
template <class KeyOf, class Convert>
Json intervals_json(const RoadLoadFit& fit, const KeyOf& key_of, const Convert& convert) {
  Json json = Json::object();
  for (int i = 0; i < 3; ++i) {
    const std::array<double, 2> interval = fit.interval_95(i);
    json[key_of(i)] = {convert(i, interval[0]), convert(i, interval[1])};
  }
  return json;
}

/// The coefficients in the forms of the standards: f0, f1, f2 in N and km/h (WLTP), A, B, C in lbf and mph (EPA).
void put_other_units(const RoadLoadFit& fit, Json& json) {
  if (fit.per_mass) return;
  constexpr const char* kWltpKeys[] = {"f0_N", "f1_N_per_km_h", "f2_N_per_km_h2"};
  Json wltp = Json::object(), epa = Json::object();
  for (int i = 0; i < 3; ++i) {
    const double value = fit.values()[static_cast<std::size_t>(i)];
    const double sd = fit.sd(i);
    const std::string key = road_load_lbf_key(i);
    wltp[kWltpKeys[i]] = road_load_in_file_unit(i, value);
    epa[key] = road_load_in_lbf_mph(i, value);
    epa[key + "_sd"] = sd > 0.0 ? Json(road_load_in_lbf_mph(i, sd)) : Json(nullptr);
  }
  epa["ci95"] = intervals_json(fit, &road_load_lbf_key, &road_load_in_lbf_mph);
  json["f0_f1_f2"] = wltp;
  json["lbf_mph"] = epa;
}

/// What speaks against runs, and the result without them.
void put_doubts(const RoadLoadFit& fit, Json& json) {
  if (!fit.doubts.empty()) json["doubts"] = make_doubts_json(fit.doubts);
  if (fit.others == nullptr) return;
  json["without_doubted_runs"] = coefficients_json(*fit.others, fit.per_mass);
  const auto key_of = [&fit](int i) { return road_load_key(i, fit.per_mass); };
  json["without_doubted_runs"]["ci95"] = intervals_json(*fit.others, key_of, &road_load_in_file_unit);
}

Json number_or_null(const std::optional<double>& value) { return value.has_value() ? Json(*value) : Json(nullptr); }

Json scatter_json(const RoadLoadFit& fit) {
  const std::string unit = force_unit(fit);
  return {{"sample_sd_m_s", number_or_null(fit.scatter.sample_sd_m_s)},
          {"speed_sd_m_s", number_or_null(fit.scatter.speed_sd_m_s)},
          {"gust_" + unit + "_sqrt_s", number_or_null(fit.scatter.gust_N_sqrt_s)},
          {"run_to_run_" + unit, number_or_null(fit.scatter.run_force_N)},
          {"run_to_run_" + unit + "_s_per_m", number_or_null(fit.scatter.run_speed_N_s_per_m)},
          {"session_to_session_" + unit, number_or_null(fit.scatter.session_force_N)},
          {"session_to_session_share", number_or_null(fit.scatter.session_share)}};
}

Json options_json(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  Json json = {{"reference_temperature_degC", options.reference_temperature_K - kZeroCelsius_K},
               {"reference_pressure_kPa", 1e-3 * options.reference_pressure_Pa},
               {"rolling_fall_per_K", options.rolling_fall_per_K},
               {"speed_from_km_h", kKmhPerMs * options.speed_from_m_s},
               {"bin_width_km_h", kKmhPerMs * options.bin_width_m_s},
               {"drag_area_m2", number_or_null(options.drag_area_m2)},
               {"mass_kg", number_or_null(options.mass_kg)}};
  json["effective_mass_kg"] = fit.per_mass ? Json(nullptr) : Json(fit.effective_mass_kg);
  json["rotating_mass_assumed"] = !fit.per_mass && !options.rotating_mass_kg.has_value();
  if (!options.leave_out.empty()) json["leave_out"] = options.leave_out;
  for (int i = 0; i < 3 && options.target.has_value(); ++i) {
    const double value = (*options.target)[static_cast<std::size_t>(i)];
    json["target"][road_load_key(i, false)] = road_load_in_file_unit(i, value);
    json["target"][road_load_lbf_key(i)] = road_load_in_lbf_mph(i, value);
  }
  if (std::isfinite(options.speed_to_m_s)) json["speed_to_km_h"] = kKmhPerMs * options.speed_to_m_s;
  if (!options.bounds.has_value()) return json;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto edge = [i](double value) {
      return std::isfinite(value) ? Json(road_load_in_file_unit(i, value)) : Json(nullptr);
    };
    json["bounds"][road_load_key(i, fit.per_mass)] = {edge(options.bounds->lower[at]), edge(options.bounds->upper[at])};
  }
  return json;
}

Json forces_json(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  const std::string key = std::string("force_") + force_unit(fit);
  return make_list(list_shown_forces(options, fit), [&key](const ShownForce& at) {
    Json force = {{"speed_km_h", kKmhPerMs * at.speed_m_s}, {key, at.force_N}, {key + "_sd", at.sd_N}};
    if (at.target_N.has_value()) {
      force["target_N"] = *at.target_N;
      force["over_target_percent"] = at.calc_over_target_percent();
    }
    force["outside_the_data"] = at.is_outside;
    return force;
  });
}

Json points_json(const CoastdownFile& file, const RoadLoadFit& fit) {
  const std::string unit = force_unit(fit);
  Json points = Json::array();
  for (const RoadLoadPoint& point : fit.points) {
    const CoastdownRun& run = file.data.runs[point.run];
    points.push_back({{"run", run.id},
                      {"session", run.session},
                      {"heading", heading_text(run.heading)},
                      {"speed_km_h", kKmhPerMs * point.speed_m_s},
                      {"force_" + unit, point.force_N},
                      {"fit_" + unit, point.fit_N},
                      {"residual_" + unit, point.residual_N},
                      {"weight", 1.0 / (point.sd_N * point.sd_N)}});
  }
  return points;
}

void put_checks(const RoadLoadChecks& checks, Json& json) {
  json["checks"] = Json::array();
  for (const RoadLoadCheck& check : checks.checks) {
    json["checks"].push_back({{"name", check.name},
                              {"status", name_of(check.status)},
                              {"found", check.found},
                              {"limit", check.limit},
                              {"clause", check.clause}});
  }
  json["session_drift"] = Json::array();
  for (const SessionDrift& drift : checks.drifts) {
    json["session_drift"].push_back({{"session", drift.session},
                                     {"runs", drift.runs},
                                     {"time_change_percent", 100.0 * drift.time_change},
                                     {"ci95", {100.0 * drift.lower_95, 100.0 * drift.upper_95}},
                                     {"per_run_percent", 100.0 * drift.per_run}});
  }
  json["pair_precision"] = Json::array();
  for (const PairPrecision& precision : checks.precisions) {
    json["pair_precision"].push_back({{"speed_km_h", kKmhPerMs * precision.speed_m_s},
                                      {"pairs", precision.pairs},
                                      {"mean_time_s", precision.mean_time_s},
                                      {"precision_percent", 100.0 * precision.precision}});
  }
}

}  // namespace

std::string road_load_key(int i, bool per_mass) {
  constexpr const char* kForce[] = {"A_N", "B_N_per_km_h", "C_N_per_km_h2"};
  constexpr const char* kPerMass[] = {"A_m_s2", "B_m_s2_per_km_h", "C_m_s2_per_km_h2"};
  return per_mass ? kPerMass[i] : kForce[i];
}

double road_load_in_file_unit(int i, double si_value) { return unit_of_key(road_load_key(i, false)).from_si(si_value); }

double road_load_in_lbf_mph(int i, double si_value) { return si_value / road_load_from_lbf_mph(i, 1.0); }

double road_load_from_lbf_mph(int i, double value) { return value * kPoundForce_N / std::pow(kMph_m_s, i); }

std::string road_load_lbf_key(int i) {
  constexpr const char* kKeys[] = {"A_lbf", "B_lbf_per_mph", "C_lbf_per_mph2"};
  return kKeys[i];
}

std::vector<ParameterEstimate> list_coefficients_lbf_mph(const RoadLoadFit& fit) {
  constexpr const char* kUnits[] = {"lbf", "lbf/mph", "lbf/mph2"};
  std::vector<ParameterEstimate> coefficients;
  for (int i = 0; i < 3; ++i) {
    const auto shown = [i](double value) { return road_load_in_lbf_mph(i, value); };
    const std::array<double, 2> interval = fit.interval_95(i);
    coefficients.push_back({road_load_lbf_key(i), shown(fit.values()[static_cast<std::size_t>(i)]), shown(fit.sd(i)),
                            shown(interval[0]), shown(interval[1]), kUnits[i]});
  }
  return coefficients;
}

std::vector<ParameterEstimate> list_coefficients(const RoadLoadFit& fit) {
  std::vector<ParameterEstimate> coefficients;
  for (int i = 0; i < 3; ++i) {
    const std::string key = road_load_key(i, fit.per_mass);
    const auto shown = [i](double value) { return road_load_in_file_unit(i, value); };
    const std::array<double, 2> interval = fit.interval_95(i);
    coefficients.push_back({key, shown(fit.values()[static_cast<std::size_t>(i)]), shown(fit.sd(i)), shown(interval[0]),
                            shown(interval[1]), unit_of_key(key).symbol});
  }
  return coefficients;
}

const char* name_of(CheckStatus status) {
  if (status == CheckStatus::kNotChecked) return "not checked";
  return status == CheckStatus::kPass ? "pass" : "fail";
}

const std::vector<double>& shown_speeds_m_s() {
  static const std::vector<double> speeds{20.0 / kKmhPerMs, 50.0 / kKmhPerMs, 80.0 / kKmhPerMs, 100.0 / kKmhPerMs,
                                          130.0 / kKmhPerMs};
  return speeds;
}

std::vector<ShownForce> list_shown_forces(const RoadLoadFitOptions& options, const RoadLoadFit& fit) {
  constexpr double kMargin_m_s = 0.1;  // Assumed: speeds of the data's ends are not sharper than this
  std::vector<ShownForce> forces;
  for (const double speed_m_s : shown_speeds_m_s()) {
    ShownForce at{speed_m_s, fit.force_N(speed_m_s), fit.force_sd_N(speed_m_s), {}};
    if (options.target.has_value()) {
      const auto& target = *options.target;
      at.target_N = target[0] + speed_m_s * (target[1] + speed_m_s * target[2]);
    }
    at.is_outside = speed_m_s < fit.low_m_s - kMargin_m_s || speed_m_s > fit.high_m_s + kMargin_m_s;
    forces.push_back(at);
  }
  return forces;
}

Json make_road_load_json(const CoastdownFile& file, const RoadLoadFitOptions& options, const RoadLoadFit& fit,
                         const RoadLoadChecks& checks) {
  Json json = {{"format", "rollrig-road-load/1"}, {"input", file.is_trace ? "trace" : "bins"}};
  json.update(coefficients_json(fit, fit.per_mass));
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::array<double, 2> interval = fit.interval_95(i);
    const std::string key = road_load_key(i, fit.per_mass);
    if (fit.is_cut(i)) json["cut_at_bound"].push_back(key);
    if (fit.on_bound[at]) json["on_bound"].push_back(key);
    json["ci95"][key] = {road_load_in_file_unit(i, interval[0]), road_load_in_file_unit(i, interval[1])};
    json["degrees_of_freedom"][key] =
        !fit.on_bound[at] && std::isfinite(fit.degrees_freedom[at]) ? Json(fit.degrees_freedom[at]) : Json(nullptr);
  }
  put_other_units(fit, json);
  put_doubts(fit, json);
  json["correlation"] = correlation_json(fit);
  json["chi2_per_dof"] = fit.chi2_per_dof;
  json["as_tested"] = Json::object();
  const std::array<double, 3> tested{fit.as_tested.A_N, fit.as_tested.B_N_s_per_m, fit.as_tested.C_N_s2_per_m2};
  for (int i = 0; i < 3; ++i) {
    json["as_tested"][road_load_key(i, fit.per_mass)] = road_load_in_file_unit(i, tested[static_cast<std::size_t>(i)]);
  }
  json["corrected"] = {{"ambient", fit.ambient_corrected}, {"measured_wind", fit.wind_corrected}};
  json["options"] = options_json(options, fit);
  json["forces"] = forces_json(options, fit);
  json["scatter"] = scatter_json(fit);
  json["slope"] = number_or_null(fit.slope);
  if (fit.slope.has_value()) json["slope_sd"] = fit.slope_sd;
  json["winds"] = make_list(fit.winds, [](const SessionWind& wind) -> Json {
    return {{"session", wind.session}, {"wind_m_s", wind.wind_m_s}, {"wind_m_s_sd", wind.sd_m_s}};
  });
  json["headings"] = Json::array();
  for (const HeadingFit& heading : fit.headings) {
    Json part = coefficients_json(heading.estimate, fit.per_mass);
    part["heading"] = heading_text(heading.heading);
    part["runs"] = heading.runs;
    json["headings"].push_back(part);
  }
  put_checks(checks, json);
  json["residuals"] = points_json(file, fit);
  json["bad_rows"] = Json::array();
  if (!file.left_out.problems.empty()) {
    json["bad_rows"].push_back(measurements::make_left_out_json(file.left_out, file.path));
  }
  json["warnings"] = fit.warnings;
  return json;
}

std::string write_road_load_residuals(const CoastdownFile& file, const RoadLoadFit& fit) {
  const std::string unit = force_unit(fit);
  CsvWriter csv({"run", "session", "heading", "v_hi_km_h", "v_lo_km_h", "duration_s", "speed_km_h", "force_" + unit,
                 "fit_" + unit, "residual_" + unit, "sd_" + unit, "weight"});
  for (const RoadLoadPoint& point : fit.points) {
    const CoastdownRun& run = file.data.runs[point.run];
    csv.add_row(run.id, run.session, heading_text(run.heading), kKmhPerMs * point.high_m_s, kKmhPerMs * point.low_m_s,
                point.duration_s, kKmhPerMs * point.speed_m_s, point.force_N, point.fit_N, point.residual_N, point.sd_N,
                1.0 / (point.sd_N * point.sd_N));
  }
  return csv.take();
}

}  // namespace rollrig::estimation
