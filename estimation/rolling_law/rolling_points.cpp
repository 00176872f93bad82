#include "estimation/rolling_law/rolling_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <set>

#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/parse_json.h"
#include "sim/core/units.h"

namespace fs = std::filesystem;

namespace rollrig::estimation {
namespace {

constexpr const char* kSources =
    "a CSV file with speed_km_h, load_N, pressure_kPa and rolling_resistance_N, or the folder or result.json of a run "
    "of sae_j2452 or sae_j1269";

// Assumed: ranges far beyond those of tires, so that most mistaken units are refused
const Field kSpeed{"speed_km_h", between(1.0, 300.0), "Speed of the surface"};
const Field kLoad{"load_N", between(100.0, 100000.0), "Load on the tire"};
const Field kPressure{"pressure_kPa", between(50.0, 1500.0), "Gauge pressure"};
const Field kForce{"rolling_resistance_N", {0.0, 5000.0, true, false}, "Rolling resistance"};

RollingTest read_csv_points(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  const std::vector<double> speed_m_s = table.numbers(kSpeed);
  const std::vector<double> load_N = table.numbers(kLoad);
  const std::vector<double> pressure_Pa = table.numbers(kPressure);
  const std::vector<double> force_N = table.numbers(kForce);
  RollingTest test;
  test.path = path;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    test.points.push_back({speed_m_s[i], load_N[i], pressure_Pa[i], force_N[i]});
  }
  return test;
}

/// A number of a record in SI units, checked against the range of its field.
double read_record_number(const Json& record, const char* key, const Field& field, const std::string& path,
                          std::size_t index) {
  const auto found = record.is_object() ? record.find(key) : record.end();
  const bool is_number = record.is_object() && found != record.end() && found->is_number();
  const double value = is_number ? found->get<double>() : 0.0;
  if (is_number && field.range.contains(value)) return unit_of_key(field.key).to_si(value);
  throw InputError({is_number ? fmt::format("{} of step {} is out of range", key, index + 1)
                              : fmt::format("step {} has no {}", index + 1, key),
                    path, 0, fmt::format("result.steps[{}].{}", index, key), is_number ? fmt::format("{}", value) : "",
                    field.range.to_string(), ""});
}

std::optional<double> find_result_number(const Json& result, const char* key) {
  const auto found = result.find(key);
  if (found == result.end() || !found->is_number()) return std::nullopt;
  return unit_of_key(key).to_si(found->get<double>());
}

RollingTest read_result_points(const std::string& path, PressureTaken taken) {
  const Json json = read_json(path);
  const Json format = json.is_object() ? json.value("format", Json()) : Json();
  if (format != "rollrig-result/1") {
    throw InputError({"not a result of a run", path, 0, "format", format.is_string() ? format.get<std::string>() : "",
                      kSources, ""});
  }
  const Json scenario = json.value("scenario", Json());
  const Json result = json.value("result", Json::object());
  const Json steps = result.is_object() ? result.value("steps", Json()) : Json();
  if (!steps.is_array() || steps.empty()) {
    throw InputError({"the result has no steps of speed, load and pressure", path, 0, "result.steps",
                      scenario.is_string() ? scenario.get<std::string>() : "", kSources, ""});
  }
  const char* pressure_key = taken == PressureTaken::kSet ? "pressure_set_kPa" : "cavity_pressure_kPa";
  RollingTest test;
  test.path = path;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto number = [&](const char* key, const Field& field) {
      return read_record_number(steps[i], key, field, path, i);
    };
    test.points.push_back({number("speed_km_h", kSpeed), number("load_N", kLoad), number(pressure_key, kPressure),
                           number("rolling_resistance_N", kForce)});
  }
  test.maximum_load_N = find_result_number(result, "maximum_load_N");
  test.base_pressure_Pa = find_result_number(result, "base_pressure_kPa");
  const Json tire = json.value("tire", Json());
  if (tire.is_string()) test.tire = tire.get<std::string>();
  test.is_simulated = true;
  return test;
}

}  // namespace

ReferenceCondition make_standard_reference(double maximum_load_N, double base_pressure_Pa) {
  return {kReferenceLoadShare * maximum_load_N, base_pressure_Pa + kReferencePressureAboveBase_Pa, kReferenceSpeed_m_s};
}

RollingTest read_rolling_test(const std::string& path, PressureTaken taken) {
  RollingTest test;
  if (fs::is_directory(path)) {
    const std::string file = (fs::path(path) / "result.json").string();
    if (!fs::exists(file)) throw InputError({"the folder holds no result.json", path, 0, "", "", kSources, ""});
    test = read_result_points(file, taken);
  } else if (fs::path(path).extension() == ".json") {
    test = read_result_points(path, taken);
  } else {
    test = read_csv_points(path);
  }
  require_plausible_coefficient(path, test.points);
  test.warnings = doubt_points(test.points);
  return test;
}

namespace {

/// Points that agree with an earlier one to the last digit.
std::size_t count_copies(const std::vector<RollingPoint>& points) {
  std::set<std::array<double, 4>> seen;
  for (const RollingPoint& point : points) {
    seen.insert({point.speed_m_s, point.load_N, point.pressure_Pa, point.force_N});
  }
  return points.size() - seen.size();
}

double calc_median_coefficient(const std::vector<RollingPoint>& points) {
  std::vector<double> coefficients;
  for (const RollingPoint& point : points) coefficients.push_back(point.force_N / point.load_N);
  const auto middle = coefficients.begin() + static_cast<std::ptrdiff_t>(coefficients.size() / 2);
  std::nth_element(coefficients.begin(), middle, coefficients.end());
  return *middle;
}

}  // namespace

void require_plausible_coefficient(const std::string& path, const std::vector<RollingPoint>& points) {
  constexpr double kLeast = 2.5e-3;  // Assumed: below it is no road tire; the best have 4 N/kN
  constexpr double kMost = 30e-3;    // Assumed: of a cold tire at low pressure
  if (points.empty()) return;
  const double middle = calc_median_coefficient(points);
  if (middle >= kLeast && middle <= kMost) return;
  throw InputError({"rolling resistance over load is that of no tire: are both in N?", path, 0, "rolling_resistance_N",
                    fmt::format("{:.3g} N/kN, the median of rolling_resistance_N / load_N", 1e3 * middle),
                    fmt::format("{:g} to {:g} N/kN; tires have 4 to 15", 1e3 * kLeast, 1e3 * kMost), ""});
}

std::vector<std::string> doubt_points(const std::vector<RollingPoint>& points) {
  constexpr double kMostCopies = 0.2;  // Assumed: of coarsely rounded readings, fewer agree by chance
  if (points.empty()) return {};
  std::vector<std::string> doubts;
  constexpr double kBest = 3.5e-3;  // Assumed: the best tires have 4 N/kN (class A of C3); 15 N/kN in lbf are 3.4
  const double coefficient = calc_median_coefficient(points);
  if (coefficient < kBest) {
    doubts.push_back(
        fmt::format("rolling resistance over load is {:.2g} N/kN (median), less than that of the best tires, 4: is the "
                    "force in lbf and not in N?",
                    1e3 * coefficient));
  }
  constexpr double kLeastArea_m2 = 0.0075;  // Assumed: load over pressure; car tires at full load have 0.02
  double area_m2 = 0.0;
  for (const RollingPoint& point : points) area_m2 = std::max(area_m2, point.load_N / point.pressure_Pa);
  if (area_m2 < kLeastArea_m2) {
    doubts.push_back(
        fmt::format("the largest load over its pressure is {:.0f} cm2, a contact patch of a tire of a car has some 200: "
                    "is the load in lbf or kg and not in N?",
                    1e4 * area_m2));
  }
  const std::size_t copies = count_copies(points);
  if (static_cast<double>(copies) > kMostCopies * static_cast<double>(points.size())) {
    doubts.push_back(
        fmt::format("{} of {} points are copies of others: if they were not measured again, all standard deviations "
                    "are too small",
                    copies, points.size()));
  }
  return doubts;
}

std::size_t count_levels(std::vector<double> values) {
  constexpr double kSame = 0.02;
  std::sort(values.begin(), values.end());
  std::size_t levels = 0;
  double start = 0.0;
  for (const double value : values) {
    if (levels > 0 && value <= start * (1.0 + kSame)) continue;
    start = value;
    ++levels;
  }
  return levels;
}

}  // namespace rollrig::estimation
