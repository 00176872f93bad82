#include "estimation/rolling_law/rolling_points.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "estimation/rolling_law/regression.h"
#include "estimation/run_checks/robust_statistics.h"
#include "sim/core/csv.h"
#include "sim/core/error.h"
#include "sim/core/limits.h"
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

/// Throws InputError if the median pressure is too low for kPa, as if it were in bar or psi.
void refuse_pressures_in_bar_or_psi(const CsvTable& table, const std::string& path) {
  constexpr double kLeast_kPa = 50.0;  // as of kPressure
  constexpr double kMost_bar = 15.0;   // Assumed: no tire is tested above 15 bar, or below 15 psi
  const std::vector<double> pressures_Pa = table.numbers({kPressure.key, any_number(), kPressure.doc});
  const double median = calc_median(pressures_Pa) / 1e3;  // as it stands in the file
  if (median <= 0.0 || median >= kLeast_kPa) return;
  throw InputError({fmt::format("the pressures, {:g} on the median, are too low for tires in kPa: are they in {}?",
                                median, median < kMost_bar ? "bar" : "psi"),
                    path, table.line_of(0), kPressure.key, fmt::format("{:g}", pressures_Pa.front() / 1e3),
                    kPressure.range.to_string() + ", gauge", ""});
}

RollingTest read_csv_points(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  refuse_pressures_in_bar_or_psi(table, path);
  const std::vector<double> speed_m_s = table.numbers(kSpeed);
  const std::vector<double> load_N = table.numbers(kLoad);
  const std::vector<double> pressure_Pa = table.numbers(kPressure);
  const std::vector<double> force_N = table.numbers(kForce);
  RollingTest test;
  test.path = path;
  for (std::size_t i = 0; i < table.row_count(); ++i) {
    test.points.push_back({speed_m_s[i], load_N[i], pressure_Pa[i], force_N[i], table.line_of(i)});
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
                           number("rolling_resistance_N", kForce), 0});
  }
  test.maximum_load_N = find_result_number(result, "maximum_load_N");
  test.base_pressure_Pa = find_result_number(result, "base_pressure_kPa");
  const Json tire = json.value("tire", Json());
  if (tire.is_string()) test.tire = tire.get<std::string>();
  test.is_simulated = true;
  return test;
}

}  // namespace

std::string name_point(const RollingPoint& point) {
  const std::string condition = fmt::format("{:.4g} km/h, {:.0f} N, {:.0f} kPa", kKmhPerMs * point.speed_m_s,
                                            point.load_N, point.pressure_Pa / 1e3);
  return point.line > 0 ? fmt::format("line {} ({})", point.line, condition) : fmt::format("a point ({})", condition);
}

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
std::vector<RollingPoint> find_copies(const std::vector<RollingPoint>& points) {
  std::set<std::array<double, 4>> seen;
  std::vector<RollingPoint> copies;
  for (const RollingPoint& point : points) {
    const bool is_new = seen.insert({point.speed_m_s, point.load_N, point.pressure_Pa, point.force_N}).second;
    if (!is_new) copies.push_back(point);
  }
  return copies;
}

/// Decimal digits that a number is written with, zeros at either end left out.
std::size_t count_digits(double value) {
  std::string digits;
  for (const char c : fmt::format("{:.15g}", value)) {
    if (c == 'e') break;
    if (c >= '0' && c <= '9') digits += c;
  }
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? 0 : digits.find_last_not_of('0') - first + 1;
}

/// Copies that are no chance: a share of all points, or forces with more digits than two readings agree in.
std::optional<std::string> doubt_copies(const std::vector<RollingPoint>& points) {
  constexpr double kMostCopies = 0.2;      // Assumed: of coarsely rounded readings, fewer agree by chance
  constexpr std::size_t kExactDigits = 6;  // Assumed: readings scatter in the fourth
  const std::vector<RollingPoint> copies = find_copies(points);
  const bool is_exact = std::any_of(copies.begin(), copies.end(), [](const RollingPoint& point) {
    return count_digits(point.force_N) >= kExactDigits;
  });
  const bool are_many = static_cast<double>(copies.size()) > kMostCopies * static_cast<double>(points.size());
  if (!is_exact && !are_many) return std::nullopt;
  return fmt::format(
      "{} of {} points are copies of others, the first {}: if they were not measured again, all standard deviations "
      "are too small",
      copies.size(), points.size(), name_point(copies.front()));
}

/// Doubts of units by the load over its pressure, which is about the area of contact.
std::optional<std::string> doubt_area(const std::vector<RollingPoint>& points) {
  constexpr double kLeast_m2 = 0.0100;  // Assumed: small car tires have 0.014, truck tires with loads in lbf 0.009
  constexpr double kMost_m2 = 0.1500;   // Assumed: wide tires of off-road trucks have 0.13; truck tires in psi 0.26
  double area_m2 = 0.0;
  for (const RollingPoint& point : points) area_m2 = std::max(area_m2, point.load_N / point.pressure_Pa);
  if (area_m2 >= kLeast_m2 && area_m2 <= kMost_m2) return std::nullopt;
  return fmt::format(
      "the largest load over its pressure is {:.0f} cm2, a contact patch of a tire has some 200 (cars) to 400 "
      "(trucks): {}",
      1e4 * area_m2,
      area_m2 < kLeast_m2 ? "is the load in lbf or kg and not in N?" : "is the pressure in psi and not in kPa?");
}

double calc_median_coefficient(const std::vector<RollingPoint>& points) {
  std::vector<double> coefficients;
  for (const RollingPoint& point : points) coefficients.push_back(point.force_N / point.load_N);
  return calc_median(std::move(coefficients));
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
  constexpr double kWorst = 15e-3;  // Assumed: a quarter above the 12 N/kN of stage 1 of UN R117 (docs/label.md)
  if (coefficient > kWorst) {
    doubts.push_back(fmt::format(
        "rolling resistance over load is {:.3g} N/kN (median), more than that of warm tires, 4 to 15: is the "
        "force that of two tires, or the load in lbf and not in N?",
        1e3 * coefficient));
  }
  if (const auto doubt = doubt_area(points)) doubts.push_back(*doubt);
  if (const auto doubt = doubt_copies(points)) doubts.push_back(*doubt);
  for (const std::string& doubt : doubt_trends(points)) doubts.push_back(doubt);
  return doubts;
}

namespace {

/// How the force goes with pressure, load and speed; empty where the points do not decide it.
struct Trends {
  std::optional<double> alpha, beta;
  double alpha_reach = 0.0;      // half the interval of 95 % of alpha
  std::optional<double> change;  // of the force from the lowest to the highest speed, over that at the lowest
};

/// Logarithms of one quantity less their mean; nothing where the points have one level of it.
std::optional<Eigen::VectorXd> center_logarithms(const std::vector<RollingPoint>& points,
                                                 double RollingPoint::*member) {
  std::vector<double> values;
  for (const RollingPoint& point : points) values.push_back(point.*member);
  if (count_levels(values) < 2) return std::nullopt;
  const Eigen::VectorXd logarithms =
      Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size())).log();
  return logarithms.array() - logarithms.mean();
}

Eigen::MatrixXd join_columns(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd joined(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) joined.col(static_cast<Eigen::Index>(i)) = columns[i];
  return joined;
}

Trends find_trends(const std::vector<RollingPoint>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  std::vector<Eigen::VectorXd> terms{Eigen::VectorXd::Ones(rows)};
  const auto add = [&](const std::optional<Eigen::VectorXd>& term) {
    if (term.has_value()) terms.push_back(*term);
    return term.has_value() ? static_cast<Eigen::Index>(terms.size()) - 1 : 0;
  };
  const Eigen::Index at_alpha = add(center_logarithms(points, &RollingPoint::pressure_Pa));
  const Eigen::Index at_beta = add(center_logarithms(points, &RollingPoint::load_N));
  const std::optional<Eigen::VectorXd> log_speed = center_logarithms(points, &RollingPoint::speed_m_s);
  const Eigen::Index at_speed = add(log_speed);
  std::vector<double> speeds_m_s;
  for (const RollingPoint& point : points) speeds_m_s.push_back(point.speed_m_s);
  const bool bends = count_levels(speeds_m_s) > 2;
  if (bends) terms.push_back(log_speed->cwiseAbs2());
  const Eigen::MatrixXd design = join_columns(terms);
  Eigen::VectorXd log_force(rows);
  for (Eigen::Index i = 0; i < rows; ++i) log_force(i) = std::log(points[static_cast<std::size_t>(i)].force_N);
  Trends trends;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(design);
  if (rows <= design.cols() || solver.rank() < design.cols()) return trends;
  const Eigen::VectorXd found = solver.solve(log_force);
  if (at_alpha > 0) {
    const auto freedom = static_cast<int>(rows - design.cols());
    const double variance = (log_force - design * found).squaredNorm() / freedom;
    const Eigen::MatrixXd inverse = (design.transpose() * design).inverse();
    trends.alpha = found(at_alpha);
    trends.alpha_reach = calc_student_reach(freedom) * std::sqrt(variance * inverse(at_alpha, at_alpha));
  }
  if (at_beta > 0) trends.beta = found(at_beta);
  if (at_speed > 0) {
    const double low = log_speed->minCoeff(), high = log_speed->maxCoeff();
    const double bend = bends ? found(at_speed + 1) * (high * high - low * low) : 0.0;
    trends.change = std::exp(found(at_speed) * (high - low) + bend) - 1.0;
  }
  return trends;
}

}  // namespace

std::vector<std::string> doubt_trends(const std::vector<RollingPoint>& points) {
  constexpr double kMostAlpha = 0.02;
  constexpr double kLeastAlpha = -0.55;
  constexpr double kLeastBeta = 0.7;
  constexpr double kMostBeta = 2.0;
  constexpr double kMostFall = 0.05;
  std::vector<std::string> doubts;
  const Trends trends = find_trends(points);
  if (trends.alpha.value_or(0.0) > kMostAlpha) {
    doubts.push_back(fmt::format(
        "rolling resistance rises with pressure (to the power {:.2g}), where that of tires on a hard surface "
        "falls: are pressures exchanged between points?",
        *trends.alpha));
  }
  if (trends.alpha.value_or(0.0) + trends.alpha_reach < kLeastAlpha) {
    doubts.push_back(fmt::format(
        "rolling resistance goes with pressure to the power {:.2g}, where tests of tires found -0.3 to -0.5: "
        "are the pressures absolute and not gauge, {:.0f} kPa too high?",
        *trends.alpha, kStandardAtmosphere_Pa / 1e3));
  }
  const double beta = trends.beta.value_or(1.0);
  if (beta < kLeastBeta || beta > kMostBeta) {
    doubts.push_back(fmt::format(
        "rolling resistance goes with load to the power {:.2g}, where tires have 0.8 to 1.5: {}are loads exchanged "
        "between points?",
        beta, beta < kLeastBeta ? "is the parasitic loss not subtracted, which does not depend on load, or " : ""));
  }
  if (trends.change.value_or(0.0) >= -kMostFall) return doubts;
  const auto [slow, fast] = std::minmax_element(
      points.begin(), points.end(), [](const auto& one, const auto& other) { return one.speed_m_s < other.speed_m_s; });
  doubts.push_back(
      fmt::format("rolling resistance falls by some {:.0f} % from {:.0f} to {:.0f} km/h: in a coastdown the tire stays "
                  "warm, and it rises. Are the speeds in the order of the points?",
                  -1e2 * *trends.change, kKmhPerMs * slow->speed_m_s, kKmhPerMs * fast->speed_m_s));
  return doubts;
}

namespace {

/// Loads above what the tire may carry.
std::optional<std::string> doubt_loads(const std::vector<RollingPoint>& points, double maximum_load_N) {
  constexpr double kMostShare = 1.2;
  double load_N = 0.0;
  for (const RollingPoint& point : points) load_N = std::max(load_N, point.load_N);
  if (is_at_most(load_N, kMostShare * maximum_load_N)) return std::nullopt;
  return fmt::format(
      "the largest load, {:.0f} N, is {:.2g} times the maximum load of the tire, {:.0f} N: is it the load of two tires "
      "or of an axle, or is the maximum load that of another tire, or not in N?",
      load_N, load_N / maximum_load_N, maximum_load_N);
}

/// Pressures above what the tire is tested at.
std::optional<std::string> doubt_pressures(const std::vector<RollingPoint>& points, double base_pressure_Pa) {
  constexpr double kMostShare = 1.5;
  double low_Pa = points.front().pressure_Pa, high_Pa = low_Pa;
  for (const RollingPoint& point : points) {
    low_Pa = std::min(low_Pa, point.pressure_Pa);
    high_Pa = std::max(high_Pa, point.pressure_Pa);
  }
  const double reference_Pa = base_pressure_Pa + kReferencePressureAboveBase_Pa;
  const double less_Pa = kStandardAtmosphere_Pa;
  const bool would_hold = low_Pa - less_Pa <= reference_Pa && reference_Pa <= high_Pa - less_Pa;
  const bool is_absolute = low_Pa > reference_Pa && would_hold;
  if (!is_absolute && is_at_most(high_Pa, kMostShare * base_pressure_Pa)) return std::nullopt;
  return fmt::format(
      "the pressures, {:.0f} to {:.0f} kPa, are high for a base pressure of {:.0f} kPa{}: are they absolute and not "
      "gauge, or is the base pressure that of another tire?",
      low_Pa / 1e3, high_Pa / 1e3, base_pressure_Pa / 1e3,
      would_hold ? fmt::format(", and {:.0f} kPa less would go with it", less_Pa / 1e3) : "");
}

}  // namespace

std::vector<std::string> doubt_tire_limits(const std::vector<RollingPoint>& points,
                                           const std::optional<double>& maximum_load_N,
                                           const std::optional<double>& base_pressure_Pa) {
  std::vector<std::string> doubts;
  if (points.empty()) return doubts;
  const auto of_load = maximum_load_N.has_value() ? doubt_loads(points, *maximum_load_N) : std::nullopt;
  const auto of_pressure = base_pressure_Pa.has_value() ? doubt_pressures(points, *base_pressure_Pa) : std::nullopt;
  for (const auto& doubt : {of_load, of_pressure}) {
    if (doubt.has_value()) doubts.push_back(*doubt);
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
