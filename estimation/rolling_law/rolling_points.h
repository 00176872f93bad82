#pragma once
/// Points of rolling resistance over speed, load and pressure, from which a law of a tire is fitted.

#include <optional>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// One measured point.
struct RollingPoint {
  double speed_m_s = 0.0;
  double load_N = 0.0;
  double pressure_Pa = 0.0;  // gauge
  double force_N = 0.0;      // rolling resistance, parasitic loss subtracted
  int line = 0;              // of its file; 0 where it is of none
};

/// A point by line and condition: "line 14 (80 km/h, 4600 N, 250 kPa)".
std::string name_point(const RollingPoint& point);

/// Load and pressure at which one number stands for the tire, and the speed of a coefficient.
struct ReferenceCondition {
  double load_N = 0.0;
  double pressure_Pa = 0.0;
  double speed_m_s = 0.0;
};

constexpr double kReferenceLoadShare = 0.7;              // of the maximum load
constexpr double kReferencePressureAboveBase_Pa = 20e3;  // above the base pressure
constexpr double kReferenceSpeed_m_s = 80.0 / 3.6;

/// The standard reference condition of SAE J2452: 70 % of the maximum load, 20 kPa above the base pressure, 80 km/h.
/// Source    second-hand: https://grokipedia.com/page/sae_j2452, which cites the practice
ReferenceCondition make_standard_reference(double maximum_load_N, double base_pressure_Pa);

/// Which pressure of a simulated test is taken: the one that was set on the cold tire, or the warm one.
enum class PressureTaken { kSet, kWarm };

/// Points of a file, and what the file says of the tire.
struct RollingTest {
  std::string path;
  std::string tire;  // empty where the file does not say
  bool is_simulated = false;
  std::vector<RollingPoint> points;
  std::optional<double> maximum_load_N;
  std::optional<double> base_pressure_Pa;
  std::vector<std::string> warnings;
};

/// Reads a CSV file with the columns speed_km_h, load_N, pressure_kPa and rolling_resistance_N, or result.json of the
/// scenarios sae_j2452 and sae_j1269, or the folder that holds it. Other columns are passed over. `taken` is for
/// results; a CSV file has one pressure.
/// Errors   InputError: a missing column, a number outside of its range, another document
/// Checked  tests/estimation/rolling_law_test.cpp, tests/bad_input
RollingTest read_rolling_test(const std::string& path, PressureTaken taken = PressureTaken::kSet);

/// Throws InputError where the median coefficient of rolling resistance is that of no tire: one of the two columns is
/// in another unit, such as kgf.
void require_plausible_coefficient(const std::string& path, const std::vector<RollingPoint>& points);

/// Doubts that hold for each of the fits: units of force, load and pressure, the force of two tires, points that are
/// copies of others, and what doubt_trends() finds.
std::vector<std::string> doubt_points(const std::vector<RollingPoint>& points);

/// Doubts by how the force goes with pressure, load and speed, whatever law is fitted: columns whose values stand in
/// the wrong rows, absolute pressures, a parasitic loss that was not subtracted.
/// Equation  ln F = k + alpha ln P + beta ln Z + gamma ln v + delta (ln v)^2, by least squares, of those that have
///           several values, delta of three speeds or more
/// Assumed:
/// * alpha is not above 0.02, that is 0 with noise
/// * the interval of 95 % of alpha reaches above -0.55: tests in the literature found -0.3 to -0.5 (assets/tires), and
///   absolute pressures turn the -0.4 of a car's tire into some -0.57
/// * beta is 0.7 to 2: tires have 0.8 to 1.5, and a parasitic loss lowers that of a car's tire to 0.53 to 0.75
/// * over the speeds of the test, the force does not fall by more than 5 %
std::vector<std::string> doubt_trends(const std::vector<RollingPoint>& points);

/// Doubts of measured points that do not go with the tire's maximum load and base pressure, as far as these are known:
/// loads of several tires, absolute pressures, or numbers of another tire.
/// Assumed: no load is above 1.2 times the maximum load, where the practices go to 0.9 or 1 times it. No pressure is
/// above 1.5 times the base pressure: cars are tested up to 1.3 times it, and sidewalls permit 1.46. Pressures that all
/// are above the standard reference pressure are absolute, if 101 kPa less would hold it
/// Checked   tests/estimation/rolling_law_test.cpp
std::vector<std::string> doubt_tire_limits(const std::vector<RollingPoint>& points,
                                           const std::optional<double>& maximum_load_N,
                                           const std::optional<double>& base_pressure_Pa);

/// How many values are different, where those within 2 % of the least of their group count as one.
/// Assumed: 2 %, more than a machine misses its set value by, less than the steps of a test
std::size_t count_levels(std::vector<double> values);

}  // namespace rollrig::estimation
