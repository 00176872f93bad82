#include "estimation/road_load/recorded_wind.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/road_load_checks.h"
#include "estimation/run_checks/pooled_scatter.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Differences below which nothing is doubted.
struct LeastError {
  double of_any = 0.0;
  double of_frame = 0.0;  // where the records are of the vehicle's frame: nothing else makes the headings opposite
};
constexpr LeastError kLeastWind_m_s{0.5, 0.1};
constexpr LeastError kLeastSlope{0.002, 0.0002};

/// Line over speed through what the force of a run has beyond the parabola of all runs.
struct ForceLine {
  double at_rest_N = 0.0;
  double rise_N_s_per_m = 0.0;
};

Eigen::Vector3d fit_parabola(const std::vector<RunResistance>& runs) {
  std::size_t count = 0;
  for (const RunResistance& run : runs) count += run.speed_m_s.size();
  Eigen::MatrixXd X(static_cast<Eigen::Index>(count), 3);
  Eigen::VectorXd y(static_cast<Eigen::Index>(count));
  Eigen::Index row = 0;
  for (const RunResistance& run : runs) {
    for (std::size_t i = 0; i < run.speed_m_s.size(); ++i, ++row) {
      X.row(row) << 1.0, run.speed_m_s[i], run.speed_m_s[i] * run.speed_m_s[i];
      y(row) = run.force_N[i];
    }
  }
  return X.colPivHouseholderQr().solve(y);
}

std::optional<ForceLine> fit_force_line(const RunResistance& run, const Eigen::Vector3d& parabola) {
  constexpr std::size_t kFewest = 4;
  if (run.speed_m_s.size() < kFewest) return std::nullopt;
  const auto n = static_cast<double>(run.speed_m_s.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < run.speed_m_s.size(); ++i) {
    const double v = run.speed_m_s[i];
    const double rest_N = run.force_N[i] - (parabola(0) + v * (parabola(1) + v * parabola(2)));
    x += v / n;
    y += rest_N / n;
    xx += v * v / n;
    xy += v * rest_N / n;
  }
  const double spread = xx - x * x;
  if (!(spread > 0.0)) return std::nullopt;
  const double rise = (xy - x * y) / spread;
  return ForceLine{y - rise * x, rise};
}

/// What both headings say of a quantity in a session.
struct Comparison {
  double recorded = 0.0;  // mean of both headings
  double against = 0.0;   // half of their difference: the mean if the records are against the vehicle
  double shown = 0.0;
  double reach = 0.0;  // of shown - recorded
  double difference() const { return shown - recorded; }
};

std::optional<Comparison> compare_session(const std::vector<RecordedAndShown>& runs, const std::string& session) {
  constexpr double kUnlikely = 0.005;
  double n[2] = {0.0, 0.0}, recorded[2] = {0.0, 0.0}, shown[2] = {0.0, 0.0};
  std::vector<double> differences[2];
  const auto side = [](const RecordedAndShown& run) { return run.heading > 0 ? 0 : 1; };
  for (const RecordedAndShown& run : runs) {
    if (run.session != session || run.heading == 0) continue;
    n[side(run)] += 1.0;
    recorded[side(run)] += run.recorded;
    shown[side(run)] += run.shown;
    differences[side(run)].push_back(run.shown - run.recorded);
  }
  if (n[0] < 2.0 || n[1] < 2.0) return std::nullopt;
  PooledScatter scatter;
  for (const int i : {0, 1}) {
    recorded[i] /= n[i];
    shown[i] /= n[i];
    scatter.add_group(differences[i]);
  }
  const double sd = 0.5 * std::sqrt(scatter.variance() * (1.0 / n[0] + 1.0 / n[1]));
  const double t = boost::math::quantile(boost::math::students_t(scatter.degrees_of_freedom), 1.0 - 0.5 * kUnlikely);
  return Comparison{0.5 * (recorded[0] + recorded[1]), 0.5 * (recorded[0] - recorded[1]), 0.5 * (shown[0] + shown[1]),
                    t * sd};
}

/// Whether the records have opposite signs in the headings, by the amount that both headings show.
bool is_of_vehicle_frame(const Comparison& at) {
  constexpr double kNear = 0.5;  // Assumed
  const double opposite = std::abs(at.against);
  return opposite > 2.0 * std::abs(at.recorded) && std::abs(std::abs(at.shown) - opposite) <= kNear * opposite;
}

bool does_contradict(const Comparison& at, const LeastError& least) {
  constexpr double kLeastShare = 0.5;
  const double recorded = std::max(std::abs(at.recorded), std::abs(at.against));
  const double least_error = is_of_vehicle_frame(at) ? least.of_frame : least.of_any;
  return std::abs(at.difference()) > std::max({least_error, kLeastShare * recorded, at.reach});
}

/// The mistake that would turn what is shown into what was recorded.
std::string guess_wind_mistake(const Comparison& at) {
  constexpr double kKnot_m_s = 1852.0 / 3600.0;
  constexpr double kNear = 0.3;  // of what is shown
  struct Guess {
    double wind_m_s;
    const char* text;
  };
  const char* frame =
      "it looks as if it were the headwind of the vehicle, which has another sign in each heading. The column is the "
      "wind along the road, positive against the + heading in runs of both headings";
  const char* sign = "its sign looks reversed: it is positive against the + heading";
  const Guess guesses[] = {{-at.recorded, sign},
                           {at.against, frame},
                           {-at.against, frame},
                           {at.recorded / kKmhPerMs, "it looks as if it were in km/h"},
                           {at.recorded * kMph_m_s, "it looks as if it were in mph"},
                           {at.recorded * kKnot_m_s, "it looks as if it were in knots"}};
  const Guess* nearest = std::min_element(std::begin(guesses), std::end(guesses), [&at](const auto& a, const auto& b) {
    return std::abs(a.wind_m_s - at.shown) < std::abs(b.wind_m_s - at.shown);
  });
  if (std::abs(nearest->wind_m_s - at.shown) <= kNear * std::abs(at.shown)) return nearest->text;
  return "are its sign (positive against the + heading), its unit and its place beside the road right?";
}

std::string guess_slope_mistake(const Comparison& at) {
  constexpr double kPercent = 100.0;
  if (is_of_vehicle_frame(at)) {
    return "it looks as if it were the slope in the direction of travel, which has another sign in each heading. The "
           "column is that of the road, positive uphill in the + heading in runs of both headings";
  }
  if (std::abs(at.recorded + at.shown) < kLeastSlope.of_any) {
    return "its sign looks reversed: it is positive uphill in the + heading";
  }
  if (std::abs(at.recorded / kPercent - at.shown) < kLeastSlope.of_any) {
    return "it looks as if it were in percent; it is rise over run";
  }
  return "are its sign (positive uphill in the + heading) and its unit (rise over run) right?";
}

std::vector<std::string> list_sessions(const std::vector<RecordedAndShown>& runs) {
  std::vector<std::string> sessions;
  for (const RecordedAndShown& run : runs) {
    if (std::find(sessions.begin(), sessions.end(), run.session) == sessions.end()) sessions.push_back(run.session);
  }
  return sessions;
}

/// What contradicts in the sessions, each described by `describe`.
template <class Describe>
std::vector<std::string> doubt_records_of_sessions(const std::vector<RecordedAndShown>& runs, const LeastError& least,
                                                   const Describe& describe) {
  const std::vector<std::string> sessions = list_sessions(runs);
  std::vector<std::string> doubts;
  for (const std::string& session : sessions) {
    const std::optional<Comparison> at = compare_session(runs, session);
    if (!at.has_value() || !does_contradict(*at, least)) continue;
    doubts.push_back((sessions.size() > 1 ? fmt::format("session '{}': ", session) : std::string()) + describe(*at));
  }
  return doubts;
}

}  // namespace

std::vector<RecordedAndShown> list_winds_by_force(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double drag_N_s2_per_m2) {
  std::vector<RecordedAndShown> winds;
  if (!(drag_N_s2_per_m2 > 0.0) || runs.empty()) return winds;
  const Eigen::Vector3d parabola = fit_parabola(runs);
  for (const RunResistance& of_run : runs) {
    const CoastdownRun& run = data.runs[of_run.run];
    const std::optional<ForceLine> line = fit_force_line(of_run, parabola);
    if (run.conditions.wind_m_s.empty() || !line.has_value()) continue;
    winds.push_back({run.heading, run.session, calc_mean(run.conditions.wind_m_s),
                     run.heading * line->rise_N_s_per_m / (2.0 * drag_N_s2_per_m2)});
  }
  return winds;
}

bool has_recorded_slopes(const CoastdownData& data) {
  return std::any_of(data.runs.begin(), data.runs.end(),
                     [](const CoastdownRun& run) { return !run.conditions.slope.empty(); });
}

std::vector<ShownSlope> list_shown_slopes(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                          double mass_kg) {
  std::vector<ShownSlope> slopes;
  if (runs.empty()) return slopes;
  const Eigen::Vector3d parabola = fit_parabola(runs);
  for (const RunResistance& run : runs) {
    const std::optional<ForceLine> line = fit_force_line(run, parabola);
    if (!line.has_value()) continue;
    slopes.push_back({run.run, data.runs[run.run].heading * line->at_rest_N / (mass_kg * kStandardGravity_m_s2)});
  }
  return slopes;
}

std::vector<RecordedAndShown> list_slopes_by_force(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                   double mass_kg, SlopeForce slope_force) {
  std::vector<RecordedAndShown> slopes;
  for (const ShownSlope& shown : list_shown_slopes(data, runs, mass_kg)) {
    const CoastdownRun& run = data.runs[shown.run];
    if (run.conditions.slope.empty()) continue;
    const double recorded = calc_mean(run.conditions.slope);
    slopes.push_back(
        {run.heading, run.session, recorded, shown.slope + (slope_force == SlopeForce::kSubtracted ? recorded : 0.0)});
  }
  return slopes;
}

std::optional<double> find_contradiction(const std::vector<RecordedAndShown>& runs, double least) {
  for (const std::string& session : list_sessions(runs)) {
    const std::optional<Comparison> at = compare_session(runs, session);
    if (at.has_value() && does_contradict(*at, {least, least})) return at->difference();
  }
  return std::nullopt;
}

std::vector<std::string> doubt_winds(const std::vector<RecordedAndShown>& runs, const std::string& shown_by,
                                     const std::string& column) {
  return doubt_records_of_sessions(runs, kLeastWind_m_s, [&](const Comparison& at) {
    return fmt::format("{} {:+.1f} m/s where {} has {:+.1f} m/s on average of both headings: {}", shown_by, at.shown,
                       column, at.recorded, guess_wind_mistake(at));
  });
}

std::vector<std::string> doubt_slopes(const std::vector<RecordedAndShown>& runs) {
  return doubt_records_of_sessions(runs, kLeastSlope, [](const Comparison& at) {
    return fmt::format(
        "the headings show a slope of {:+.4f} where the column slope has {:+.4f} on average of both headings: {}",
        at.shown, at.recorded, guess_slope_mistake(at));
  });
}

}  // namespace rollrig::estimation
