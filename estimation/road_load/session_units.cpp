#include "estimation/road_load/session_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <Eigen/QR>

#include "estimation/road_load/road_force_reference.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Points of force over speed, and a parabola through them beside a force with opposite signs in the headings. Points
/// without a positive force do not count.
class ForceCurve {
 public:
  void add(double speed_m_s, double force_N, int heading) {
    if (!(force_N > 0.0)) return;
    low_m_s_ = std::min(low_m_s_, speed_m_s);
    high_m_s_ = std::max(high_m_s_, speed_m_s);
    points_.push_back({speed_m_s, force_N, static_cast<double>(heading)});
  }

  void add(const ForceCurve& other) {
    for (const auto& [speed_m_s, force_N, heading] : other.points_) add(speed_m_s, force_N, static_cast<int>(heading));
  }

  /// By least squares of the relative deviations; false where the points do not decide it.
  bool fit() {
    constexpr std::size_t kFewest = 5;
    if (points_.size() < kFewest) return false;
    const double heading = points_.front()[2];
    const bool has_both = std::any_of(points_.begin(), points_.end(), [&](const auto& at) { return at[2] != heading; });
    Eigen::MatrixXd X(points_.size(), 4);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto& [speed_m_s, force_N, way] = points_[i];
      X.row(static_cast<Eigen::Index>(i)) << 1.0, speed_m_s, speed_m_s * speed_m_s, way;
      X.row(static_cast<Eigen::Index>(i)) /= force_N;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts(has_both ? X : X.leftCols(3));
    if (parts.rank() < parts.cols()) return false;
    load_ = parts.solve(Eigen::VectorXd::Ones(X.rows())).head(3);
    return true;
  }

  double force_N(double speed_m_s) const { return load_(0) + speed_m_s * (load_(1) + speed_m_s * load_(2)); }
  double low_m_s() const { return low_m_s_; }
  double high_m_s() const { return high_m_s_; }

 private:
  std::vector<std::array<double, 3>> points_;
  Eigen::Vector3d load_ = Eigen::Vector3d::Zero();
  double low_m_s_ = std::numeric_limits<double>::infinity();
  double high_m_s_ = 0.0;
};

/// Factors that correct speeds and forces if the column is in another unit but was read as km/h.
struct Conversion {
  double speed = 1.0;
  double force = 1.0;
};

/// e of doubt_session_units(); infinite where the two have too few speeds in common.
double calc_difference(const ForceCurve& sessions, const ForceCurve& others, const Conversion& conversion) {
  constexpr double kLeastRatio = 1.5;
  constexpr int kSpeeds = 25;
  const double low_m_s = std::max(conversion.speed * sessions.low_m_s(), others.low_m_s());
  const double high_m_s = std::min(conversion.speed * sessions.high_m_s(), others.high_m_s());
  if (!(high_m_s > kLeastRatio * low_m_s)) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (int i = 0; i < kSpeeds; ++i) {
    const double speed_m_s = low_m_s + (high_m_s - low_m_s) * i / (kSpeeds - 1);
    const double other_N = others.force_N(speed_m_s);
    if (!(other_N > 0.0)) return std::numeric_limits<double>::infinity();
    squares += std::pow(conversion.force * sessions.force_N(speed_m_s / conversion.speed) / other_N - 1.0, 2);
  }
  return std::sqrt(squares / kSpeeds);
}

constexpr double kAgreement = 0.05;

/// Sessions that agree with the others in another unit.
struct UnitDoubt {
  std::vector<std::string> sessions;
  std::string unit;
  double as_it_stands = 0.0;
  double in_unit = 0.0;
};

/// Splits the sessions into those that match the reference, one of them, after conversion and those that match it as
/// they stand. Compares the two groups.
std::optional<UnitDoubt> test_unit_against(const std::map<std::string, ForceCurve>& sessions,
                                           const ForceCurve& reference, const Conversion& conversion) {
  constexpr double kApart = 0.1, kClearly = 3.0, kCloseAgreement = 0.02, kSameTop = 0.2;
  ForceCurve others, doubted;
  UnitDoubt doubt;
  for (const auto& [name, curve] : sessions) {
    const double as_it_stands = calc_difference(curve, reference, {});
    const double in_unit = calc_difference(curve, reference, conversion);
    if (in_unit < kApart && in_unit < as_it_stands) {
      doubted.add(curve);
      doubt.sessions.push_back(name);
    } else if (as_it_stands < kApart) {
      others.add(curve);
    }
  }
  if (doubt.sessions.empty() || !doubted.fit() || !others.fit()) return std::nullopt;
  doubt.as_it_stands = calc_difference(doubted, others, {});
  doubt.in_unit = calc_difference(doubted, others, conversion);
  const double top_ratio = conversion.speed * doubted.high_m_s() / others.high_m_s();
  const bool is_clear =
      std::isfinite(doubt.as_it_stands)
          ? doubt.as_it_stands >= kApart && doubt.in_unit < kAgreement && kClearly * doubt.in_unit < doubt.as_it_stands
          : doubt.in_unit < kCloseAgreement && std::abs(top_ratio - 1.0) < kSameTop;
  return is_clear ? std::make_optional(doubt) : std::nullopt;
}

/// Takes each session as the reference and keeps the split whose groups agree best.
std::optional<UnitDoubt> find_unit_doubt(const std::map<std::string, ForceCurve>& sessions, const std::string& unit,
                                         const Conversion& conversion) {
  std::optional<UnitDoubt> best;
  for (const auto& [name, reference] : sessions) {
    std::optional<UnitDoubt> doubt = test_unit_against(sessions, reference, conversion);
    if (!doubt.has_value() || (best.has_value() && best->in_unit <= doubt->in_unit)) continue;
    best = std::move(doubt);
    best->unit = unit;
  }
  return best;
}

std::string describe_unit_doubt(const UnitDoubt& doubt, const ForceSource& source) {
  const bool is_one = doubt.sessions.size() == 1;
  return fmt::format(
      "the forces of {} '{}' over speed {}, and agree with them within {:.0f} % if {} values of {} are in {}: are "
      "they?",
      is_one ? "session" : "sessions", fmt::join(doubt.sessions, "', '"),
      std::isfinite(doubt.as_it_stands)
          ? fmt::format("differ from those of the others by {:.0f} %", 100.0 * doubt.as_it_stands)
          : "have hardly a speed in common with those of the others",
      100.0 * kAgreement, is_one ? "its" : "their", source.speed_columns, doubt.unit);
}

/// Those whose points decide a curve.
std::map<std::string, ForceCurve> fit_sessions(const CoastdownData& data, const std::vector<RunResistance>& runs) {
  std::map<std::string, ForceCurve> sessions;
  for (const RunResistance& run : runs) {
    const CoastdownRun& of_data = data.runs[run.run];
    for (std::size_t i = 0; i < run.speed_m_s.size(); ++i) {
      sessions[of_data.session].add(run.speed_m_s[i], run.force_N[i], of_data.heading);
    }
  }
  for (auto session = sessions.begin(); session != sessions.end();) {
    session = session->second.fit() ? std::next(session) : sessions.erase(session);
  }
  return sessions;
}

}  // namespace

std::vector<std::string> doubt_session_units(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                             const ForceSource& source) {
  const std::map<std::string, ForceCurve> sessions = fit_sessions(data, runs);
  std::vector<std::string> doubts;
  for (const auto& [unit, factor] : {std::pair("mph", kMph_m_s * kKmhPerMs), std::pair("m/s", kKmhPerMs)}) {
    const Conversion conversion{factor, source.is_from_speeds ? factor : 1.0};
    if (const auto doubt = find_unit_doubt(sessions, unit, conversion))
      doubts.push_back(describe_unit_doubt(*doubt, source));
  }
  return doubts;
}

std::vector<std::string> doubt_session_units(const CoastdownData& data) {
  constexpr double kMass_kg = 1.0;  // forces are compared with each other
  std::vector<RunResistance> runs;
  for (const FitRun& run : make_fit_runs(data, RoadLoadFitOptions(), kMass_kg)) {
    runs.push_back({run.index, {}, {}});
    for (const FitBin& bin : run.bins) {
      const std::optional<BinForce> found = find_bin_force(run, bin, kMass_kg);
      if (!found.has_value()) continue;
      runs.back().speed_m_s.push_back(found->speed_m_s);
      runs.back().force_N.push_back(found->force_N);
    }
  }
  const bool is_trace = data.runs.front().bins.empty();
  return doubt_session_units(data, runs, {/*is_from_speeds=*/true, is_trace ? "speed_km_h" : "v_hi_kmh and v_lo_kmh"});
}

}  // namespace rollrig::estimation
