#include "estimation/rolling_law/rolling_output.h"

#include <algorithm>
#include <cmath>

#include "sim/core/csv.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// null where a number is not finite: without freedom there is no standard deviation.
Json law_number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json estimate_json(const ParameterEstimate& estimate) {
  return {{"value", estimate.value},
          {"sd", law_number(estimate.sd)},
          {"ci95", {law_number(estimate.low_95), law_number(estimate.high_95)}},
          {"unit", estimate.unit}};
}

Json force_json(const ForceEstimate& estimate, int freedom) {
  const double reach = calc_student_reach(freedom) * estimate.sd_N;
  Json json = {{"value_N", estimate.value_N}};
  json["sd_N"] = freedom > 0 ? law_number(estimate.sd_N) : Json();
  json["ci95_N"] = {freedom > 0 ? law_number(estimate.value_N - reach) : Json(),
                    freedom > 0 ? law_number(estimate.value_N + reach) : Json()};
  json["half_width_95_N"] = freedom > 0 ? law_number(reach) : Json();
  return json;
}

Json law_coefficients_json(const std::vector<ParameterEstimate>& coefficients) {
  Json json = Json::object();
  for (const ParameterEstimate& coefficient : coefficients) json[coefficient.name] = estimate_json(coefficient);
  return json;
}

Json statistics_json(const std::vector<FittedPoint>& points, const RegressionStatistics& statistics) {
  Json json = {{"points", points.size()},
               {"degrees_of_freedom", statistics.freedom},
               {"residual_sd_N", statistics.freedom > 0 ? Json(statistics.residual_sd_N) : Json()},
               {"largest_residual_percent", 100.0 * statistics.largest_residual},
               {"repeated_points", statistics.repeated_points}};
  if (statistics.lack_of_fit.has_value()) {
    const LackOfFit& lack = *statistics.lack_of_fit;
    json["lack_of_fit"] = {{"pure_error_sd_N", lack.pure_error_sd_N},
                           {"pure_error_degrees_of_freedom", lack.pure_error_freedom},
                           {"F", lack.F},
                           {"p", lack.p}};
  }
  return json;
}

/// Where a law holds: the range of its points.
Json range_json(const std::vector<FittedPoint>& points) {
  const auto range = [&points](double RollingPoint::*member, double factor) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(),
        [member](const FittedPoint& a, const FittedPoint& b) { return a.point.*member < b.point.*member; });
    return Json{factor * low->point.*member, factor * high->point.*member};
  };
  return {{"speed_km_h", range(&RollingPoint::speed_m_s, kKmhPerMs)},
          {"load_N", range(&RollingPoint::load_N, 1.0)},
          {"pressure_kPa", range(&RollingPoint::pressure_Pa, 1e-3)}};
}

Json law_points_json(const std::vector<FittedPoint>& points) {
  return make_list(points, [](const FittedPoint& at) {
    return Json{{"speed_km_h", kKmhPerMs * at.point.speed_m_s},
                {"load_N", at.point.load_N},
                {"pressure_kPa", at.point.pressure_Pa / 1e3},
                {"rolling_resistance_N", at.point.force_N},
                {"fitted_N", at.fitted_N}};
  });
}

Json condition_json(const ReferenceCondition& at) {
  return {{"load_N", at.load_N}, {"pressure_kPa", at.pressure_Pa / 1e3}, {"speed_km_h", kKmhPerMs * at.speed_m_s}};
}

/// RRc at a condition, with half its interval of 95 %.
void put_coefficient(const ForceEstimate& force, const ReferenceCondition& condition, int freedom, Json& json) {
  const double per_N = 1e3 / condition.load_N;
  json["rrc_N_per_kN"] = per_N * force.value_N;
  json["rrc_half_width_95_N_per_kN"] =
      freedom > 0 ? law_number(per_N * calc_student_reach(freedom) * force.sd_N) : Json();
}

void put_end(const RollingTest& test, const std::vector<FittedPoint>& points, const std::vector<std::string>& warnings,
             Json& json) {
  json["points"] = law_points_json(points);
  std::vector<std::string> all = test.warnings;
  all.insert(all.end(), warnings.begin(), warnings.end());
  if (!all.empty()) json["warnings"] = all;
}

Json start_json(const char* format, const RollingTest& test) {
  Json json = {{"format", format}, {"source", test.path}};
  if (!test.tire.empty()) json["tire"] = test.tire;
  return json;
}

}  // namespace

J2452Reference evaluate_reference(const J2452Fit& fit, const ReferenceCondition& at, const CycleForces& cycles) {
  const auto mean = [&](const SpeedMoments& moments) { return fit.estimate_mean(at.pressure_Pa, at.load_N, moments); };
  return {at,
          fit.estimate_force(at),
          mean(cycles.urban),
          mean(cycles.highway),
          mean(mix_moments(cycles.urban, kUrbanShare, cycles.highway)),
          cycles};
}

Json make_j2452_json(const RollingTest& test, const J2452Fit& fit, const std::optional<J2452Reference>& reference) {
  Json json = start_json("rollrig-j2452-fit/1", test);
  json["law"] = "F = P^alpha Z^beta (a + b v + c v^2)";
  json["units"] = {{"F", "N"}, {"P", "kPa"}, {"Z", "N"}, {"v", "km/h"}};
  json["coefficients"] = law_coefficients_json(fit.coefficients);
  json["statistics"] = statistics_json(fit.points, fit.statistics);
  if (fit.includes_set_scatter()) {
    json["statistics"]["set_scatter"] = {{"sets", fit.set_scatter->set_count()},
                                         {"degrees_of_freedom", fit.find_freedom()},
                                         {"sd_percent", 100.0 * fit.set_scatter->relative_sd},
                                         {"p", fit.set_scatter->chance}};
  }
  json["range"] = range_json(fit.points);
  if (reference.has_value()) {
    const int freedom = fit.find_freedom();
    Json at = condition_json(reference->condition);
    at["rolling_resistance"] = force_json(reference->force, freedom);
    put_coefficient(reference->force, reference->condition, freedom, at);
    at["merf_urban"] = force_json(reference->urban, freedom);
    at["merf_urban"]["cycle"] = reference->cycles.urban_cycle;
    at["merf_highway"] = force_json(reference->highway, freedom);
    at["merf_highway"]["cycle"] = reference->cycles.highway_cycle;
    at["smerf"] = force_json(reference->combined, freedom);
    at["smerf"]["urban_share"] = kUrbanShare;
    json["reference"] = at;
  }
  put_end(test, fit.points, fit.warnings, json);
  return json;
}

Json make_multipoint_json(const RollingTest& test, const MultipointFit& fit,
                          const std::optional<MultipointReference>& reference) {
  const bool is_bilinear = fit.form == MultipointForm::kBilinear;
  Json json = start_json("rollrig-j1269-fit/1", test);
  json["law"] = is_bilinear ? "F = A0 + A1 Z + A2/P + A3 Z/P" : "F = Z (A1 + A3/P)";
  json["units"] = {{"F", "N"}, {"P", "kPa"}, {"Z", "N"}};
  json["speed_km_h"] = kKmhPerMs * fit.speed_m_s;
  json["coefficients"] = law_coefficients_json(fit.coefficients);
  json["statistics"] = statistics_json(fit.points, fit.statistics);
  json["range"] = range_json(fit.points);
  json["mean_rrc_N_per_kN"] = 1e3 * fit.mean_coefficient;
  if (reference.has_value()) {
    Json at = condition_json(reference->condition);
    at["rolling_resistance"] = force_json(reference->force, fit.statistics.freedom);
    put_coefficient(reference->force, reference->condition, fit.statistics.freedom, at);
    json["reference"] = at;
  }
  put_end(test, fit.points, fit.warnings, json);
  return json;
}

std::string write_rolling_residuals(const std::vector<FittedPoint>& points) {
  CsvWriter csv({"speed_km_h", "load_N", "pressure_kPa", "rolling_resistance_N", "fitted_N", "residual_N", "leverage"});
  for (const FittedPoint& at : points) {
    csv.add_row(kKmhPerMs * at.point.speed_m_s, at.point.load_N, at.point.pressure_Pa / 1e3, at.point.force_N,
                at.fitted_N, CsvWriter::Rounded{at.residual_N(), 4}, CsvWriter::Rounded{at.leverage, 4});
  }
  return csv.take();
}

}  // namespace rollrig::estimation
