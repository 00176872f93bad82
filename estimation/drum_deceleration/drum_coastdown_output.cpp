
#include "estimation/drum_deceleration/drum_coastdown.h"
#include "estimation/run_checks/doubts_json.h"
#include "sim/core/csv.h"

namespace rollrig::estimation {
namespace {

const char* name_of(CoastBody body) { return body == CoastBody::kDrum ? "drum" : "wheel"; }
const char* name_of(CoastState state) { return state == CoastState::kLoaded ? "loaded" : "lifted"; }

Json to_json(const Interval& interval) {
  return {{"value", interval.value}, {"sd", interval.sd}, {"ci95", {interval.lower, interval.upper}}};
}

void put(Json& json, const char* key, const std::optional<Interval>& interval) {
  if (interval.has_value()) json[key] = to_json(*interval);
}

Json to_json(const PressureLevel& level) {
  Json json = {{"pressure_kPa", level.pressure_Pa / 1e3},
               {"runs", level.runs},
               {"in_range_left_out", level.in_range_left_out},
               {"loaded_m_s2", level.loaded_m_s2},
               {"net_m_s2", to_json(level.net_m_s2)}};
  if (level.load_N > 0.0) json["load_N"] = level.load_N;
  put(json, "force_N", level.force_N);
  put(json, "ratio", level.ratio);
  return json;
}

Json to_json(const SpeedPoint& point) {
  Json json = {{"speed_km_h", 3.6 * point.speed_m_s}};
  put(json, "drum_alone_m_s2", point.drum_alone_m_s2);
  put(json, "drum_alone_repeatability", point.drum_repeatability);
  put(json, "wheel_alone_m_s2", point.wheel_alone_m_s2);
  json["pressures"] = make_list(point.levels, [](const PressureLevel& level) { return to_json(level); });
  json["repeat_scatter"] = point.repeat_scatter;
  if (point.pressure_exponent.has_value()) {
    json["pressure_exponent"] = to_json(*point.pressure_exponent);
    json["pressure_exponent"]["per_wheel_mass_ratio"] = point.exponent_per_mass_ratio;
    if (point.exponent_by_repeats.has_value()) {
      json["pressure_exponent"]["ci95_by_repeats_alone"] = {point.exponent_by_repeats->lower,
                                                            point.exponent_by_repeats->upper};
    }
    if (point.level_scatter.has_value()) json["pressure_exponent"]["scatter_about_law"] = *point.level_scatter;
    if (point.lack_of_fit_p.has_value()) json["pressure_exponent"]["lack_of_fit_p"] = *point.lack_of_fit_p;
  }
  put(json, "direction_difference", point.direction_ratio);
  if (point.direction_ratio.has_value()) json["direction_difference"]["sd_of_one"] = point.direction_sd;
  return json;
}

Json to_json(const CoastSet& set, const CoastAnalysis& analysis) {
  const Coast& coast = analysis.coast;
  return {{"file", set.runs[analysis.run].id}, {"body", name_of(analysis.body)}, {"coast_start_s", coast.start_s},
          {"rows", coast.time_s.size()},       {"missed_pulses", coast.missed},  {"double_pulses", coast.doubled},
          {"other_rejected", coast.other},     {"rows_at_rest", coast.stopped}};
}

}  // namespace

Json make_coastdown_json(const CoastSet& set, const DrumCoastdownFit& fit) {
  Json json = {{"format", "rollrig-drum-coastdown-fit/1"},
               {"set", set.name},
               {"reference_pressure_kPa", fit.reference_pressure_Pa / 1e3},
               {"reference_speed_km_h", 3.6 * set.reference_speed_m_s},
               {"wheel_mass_ratio", fit.mass_ratio}};
  if (const std::optional<double> mass_kg = set.calc_drum_mass_kg()) json["drum_mass_kg"] = *mass_kg;
  if (fit.directions.size() == 2) json["directions"] = fit.directions;
  json["resonances"] = Json::array();
  for (const FoundResonance& found : fit.resonances) {
    const Resonance& resonance = found.resonance;
    json["resonances"].push_back({{"state", name_of(found.state)},
                                  {"pressure_kPa", found.pressure_Pa > 0.0 ? Json(found.pressure_Pa / 1e3) : Json()},
                                  {"speed_km_h", 3.6 * resonance.peak_m_s},
                                  {"excess", resonance.excess},
                                  {"sd", resonance.sd},
                                  {"from_km_h", 3.6 * resonance.range.from_m_s},
                                  {"to_km_h", 3.6 * resonance.range.to_m_s}});
  }
  json["speeds"] = make_list(fit.points, [](const SpeedPoint& point) { return to_json(point); });
  json["runs"] = make_list(fit.analyses, [&set](const CoastAnalysis& analysis) { return to_json(set, analysis); });
  if (!fit.doubts.empty()) json["doubts"] = make_doubts_json(fit.doubts);
  if (fit.others != nullptr) {
    json["without_doubted_runs"] = make_list(fit.others->points, [](const SpeedPoint& at) { return to_json(at); });
  }
  json["bad_rows"] = make_list(list_runs_with_bad_rows(set), [](const CoastRun* run) {
    return measurements::make_left_out_json(run->left_out, run->file);
  });
  if (!fit.warnings.empty()) json["warnings"] = fit.warnings;
  return json;
}

std::string make_deceleration_csv(const CoastSet& set, const DrumCoastdownFit& fit) {
  CsvWriter csv({"file", "state", "direction", "pressure_kPa", "body", "speed_km_h", "deceleration_m_s2", "sd_m_s2",
                 "scatter_m_s", "rows", "missing_because"});
  for (const CoastAnalysis& analysis : fit.analyses) {
    const CoastRun& run = set.runs[analysis.run];
    for (std::size_t i = 0; i < analysis.decelerations.size(); ++i) {
      const DecelerationFit& at = analysis.decelerations[i];
      const double none = std::nan("");
      csv.add_row(run.id, name_of(run.state), run.direction, run.pressure_Pa > 0.0 ? run.pressure_Pa / 1e3 : none,
                  name_of(analysis.body), 3.6 * set.speeds_m_s[i], at.available ? at.value_m_s2 : none,
                  at.available ? at.sd_m_s2 : none, at.available ? at.scatter_m_s : none, static_cast<double>(at.rows),
                  at.why);
    }
  }
  return csv.take();
}

std::string make_residual_csv(const CoastSet& set, const DrumCoastdownFit& fit) {
  CsvWriter csv({"file", "body", "about_km_h", "time_s", "speed_km_h", "fitted_km_h", "residual_km_h", "weight"});
  for (const CoastAnalysis& analysis : fit.analyses) {
    for (std::size_t i = 0; i < analysis.decelerations.size(); ++i) {
      for (const FittedRow& row : analysis.decelerations[i].residuals) {
        csv.add_row(set.runs[analysis.run].id, name_of(analysis.body), 3.6 * set.speeds_m_s[i], row.time_s,
                    3.6 * row.speed_m_s, 3.6 * row.fitted_m_s,
                    CsvWriter::Rounded{3.6 * (row.speed_m_s - row.fitted_m_s), 4}, CsvWriter::Rounded{row.weight, 3});
      }
    }
  }
  return csv.take();
}

}  // namespace rollrig::estimation
