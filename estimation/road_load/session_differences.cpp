#include "estimation/road_load/session_differences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/math/distributions/fisher_f.hpp>

#include "estimation/road_load/road_load_checks.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Deviations of the runs of a session, by their heading.
using HeadingGroups = std::map<int, std::vector<double>>;

std::map<std::string, HeadingGroups> group_by_heading(const CoastdownData& data,
                                                      const std::map<std::size_t, double>& deviations) {
  std::map<std::string, HeadingGroups> sessions;
  for (const auto& [run, deviation] : deviations) {
    sessions[data.runs[run].session][data.runs[run].heading].push_back(deviation);
  }
  return sessions;
}

/// Those that have all headings that there are: a slope or a wind shifts a heading alone.
std::map<std::string, HeadingGroups> keep_whole(std::map<std::string, HeadingGroups> sessions) {
  std::set<int> all;
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) all.insert(heading);
  }
  for (auto session = sessions.begin(); session != sessions.end();) {
    session = session->second.size() < all.size() ? sessions.erase(session) : std::next(session);
  }
  return sessions;
}

/// The mean of the means of a session's headings, and the inverse of its variance in units of that of a run.
struct SessionMean {
  std::string name;
  double value = 0.0;
  double weight = 0.0;
};

std::vector<SessionMean> list_session_means(const std::map<std::string, HeadingGroups>& sessions) {
  std::vector<SessionMean> means;
  for (const auto& [name, headings] : sessions) {
    const auto count = static_cast<double>(headings.size());
    SessionMean mean{name, 0.0, 0.0};
    double variance = 0.0;
    for (const auto& [heading, values] : headings) {
      mean.value += calc_mean(values) / count;
      variance += 1.0 / (count * count * static_cast<double>(values.size()));
    }
    mean.weight = 1.0 / variance;
    means.push_back(mean);
  }
  return means;
}

struct Scatter {
  double squares = 0.0;
  double freedom = 0.0;
};

/// Of the runs about the mean of their session and heading.
Scatter find_scatter_within(const std::map<std::string, HeadingGroups>& sessions) {
  Scatter scatter;
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) {
      const double mean = calc_mean(values);
      for (const double value : values) scatter.squares += (value - mean) * (value - mean);
      scatter.freedom += static_cast<double>(values.size()) - 1.0;
    }
  }
  return scatter;
}

/// Of the means of session and heading about what their session and their heading make of them: that of single runs, or
/// less.
Scatter find_scatter_of_pairs(const std::map<std::string, HeadingGroups>& sessions) {
  const std::vector<SessionMean> means = list_session_means(sessions);
  std::map<int, double> heading_means;
  double mean = 0.0;
  for (const SessionMean& session : means) mean += session.value / static_cast<double>(means.size());
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) {
      heading_means[heading] += calc_mean(values) / static_cast<double>(sessions.size());
    }
  }
  Scatter scatter;
  for (const SessionMean& session : means) {
    for (const auto& [heading, values] : sessions.at(session.name)) {
      const double rest = calc_mean(values) - session.value - heading_means.at(heading) + mean;
      scatter.squares += rest * rest;
    }
  }
  scatter.freedom = (static_cast<double>(sessions.size()) - 1.0) * (static_cast<double>(heading_means.size()) - 1.0);
  return scatter;
}

/// Fills in the session that is farthest from the mean of the others.
void put_farthest(const std::vector<SessionMean>& means, SessionDifference& difference) {
  const auto others = static_cast<double>(means.size()) - 1.0;
  double sum = 0.0;
  for (const SessionMean& mean : means) sum += mean.value;
  for (const SessionMean& mean : means) {
    const double relative = mean.value - (sum - mean.value) / others;
    if (!difference.farthest.empty() && std::abs(relative) <= std::abs(difference.relative)) continue;
    difference.farthest = mean.name;
    difference.relative = relative;
  }
  if (means.size() != 2) return;  // else both are equally far: the later one, against the first
  difference.farthest = means[1].name;
  difference.other = means[0].name;
  difference.relative = means[1].value - means[0].value;
}

/// A parabola over speed and a part that the headings have with opposite signs.
class ForceCurve {
 public:
  void add(double speed_m_s, double force_N, int heading) {
    if (!(force_N > 0.0)) return;
    low_m_s_ = std::min(low_m_s_, speed_m_s);
    high_m_s_ = std::max(high_m_s_, speed_m_s);
    points_.push_back({speed_m_s, force_N, static_cast<double>(heading)});
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

/// Root of the mean square of the relative difference of two curves, where the speeds of the first are `factor` times
/// those that it has, and its forces `force_factor` times; infinite where they have too few speeds in common.
double calc_difference(const ForceCurve& session, const ForceCurve& others, double factor, double force_factor) {
  constexpr double kLeastRatio = 1.5;
  constexpr int kSpeeds = 25;
  const double low_m_s = std::max(factor * session.low_m_s(), others.low_m_s());
  const double high_m_s = std::min(factor * session.high_m_s(), others.high_m_s());
  if (!(high_m_s > kLeastRatio * low_m_s)) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (int i = 0; i < kSpeeds; ++i) {
    const double speed_m_s = low_m_s + (high_m_s - low_m_s) * i / (kSpeeds - 1);
    const double other_N = others.force_N(speed_m_s);
    if (!(other_N > 0.0)) return std::numeric_limits<double>::infinity();
    squares += std::pow(force_factor * session.force_N(speed_m_s / factor) / other_N - 1.0, 2);
  }
  return std::sqrt(squares / kSpeeds);
}

/// The question for the unit of one session, where there is one.
std::optional<std::string> doubt_unit_of(const std::string& name, const ForceCurve& session, const ForceCurve& others,
                                         bool several_others, const MeasuredForce& force) {
  constexpr double kApart = 0.1, kAgree = 0.05, kClearly = 3.0;
  struct Unit {
    const char* name;
    double km_h;
  };
  const double as_it_stands = calc_difference(session, others, 1.0, 1.0);
  if (as_it_stands < kApart) return std::nullopt;
  for (const Unit& unit : {Unit{"mph", kMph_m_s * kKmhPerMs}, Unit{"m/s", kKmhPerMs}}) {
    const auto agrees = [&](double factor) {
      const double there = calc_difference(session, others, factor, force.is_from_speeds ? factor : 1.0);
      return there < kAgree && there * kClearly < as_it_stands;
    };
    const bool is_session = agrees(unit.km_h);
    if (!is_session && !(several_others && agrees(1.0 / unit.km_h))) continue;
    return fmt::format(
        "the forces of session '{}' over speed {}, and agree with them within 5 % if {} in {}: are they?", name,
        std::isfinite(as_it_stands)
            ? fmt::format("differ from those of the others by {:.0f} %", 100.0 * as_it_stands)
            : "have hardly a speed in common with those of the others",
        is_session ? fmt::format("its values of {} are", force.speed_columns)
                   : fmt::format("its values of {} are in km/h and those of the others", force.speed_columns),
        unit.name);
  }
  return std::nullopt;
}

}  // namespace

std::optional<SessionDifference> compare_sessions(const CoastdownData& data,
                                                  const std::map<std::size_t, double>& deviations,
                                                  SessionWinds winds) {
  const std::map<std::string, HeadingGroups> all = group_by_heading(data, deviations);
  const std::map<std::string, HeadingGroups> whole = keep_whole(all);
  const std::vector<SessionMean> means = list_session_means(whole);
  const double between_freedom = static_cast<double>(means.size()) - 1.0;
  Scatter runs = find_scatter_within(all);
  if (winds == SessionWinds::kInDeviations && !means.empty()) {
    const Scatter of_pairs = find_scatter_of_pairs(whole);
    if (of_pairs.freedom > runs.freedom) runs = of_pairs;
  }
  if (between_freedom < 1.0 || runs.freedom < 1.0) return std::nullopt;
  double weights = 0.0, weighted = 0.0, plain = 0.0;
  for (const SessionMean& mean : means) {
    weights += mean.weight;
    weighted += mean.weight * mean.value;
    plain += mean.value / static_cast<double>(means.size());
  }
  double between = 0.0, squares = 0.0;
  for (const SessionMean& mean : means) {
    between += mean.weight * std::pow(mean.value - weighted / weights, 2);
    squares += std::pow(mean.value - plain, 2);
  }
  SessionDifference difference;
  difference.relative_sd = std::sqrt(squares / between_freedom);
  put_farthest(means, difference);
  if (!(runs.squares > 0.0)) {
    difference.p_value = between > 0.0 ? 0.0 : 1.0;
    return difference;
  }
  const boost::math::fisher_f distribution(between_freedom, runs.freedom);
  difference.p_value = boost::math::cdf(
      boost::math::complement(distribution, between / between_freedom / (runs.squares / runs.freedom)));
  return difference;
}

std::optional<std::string> doubt_session_difference(const CoastdownData& data,
                                                    const std::map<std::size_t, double>& deviations,
                                                    SessionWinds winds) {
  constexpr double kUnlikely = 0.01;     // Assumed
  constexpr double kLeastShare = 0.001;  // Assumed: less matters to no one, and may be rounding
  const std::optional<SessionDifference> found = compare_sessions(data, deviations, winds);
  if (!found.has_value() || found->p_value >= kUnlikely || found->relative_sd < kLeastShare) return std::nullopt;
  return fmt::format(
      "the sessions differ by a standard deviation of {:.1f} % of the force, more than their noise explains: the force "
      "in session '{}' is {:.1f} % {} than {}. Where sessions cover different speeds, this bends the curve",
      100.0 * found->relative_sd, found->farthest, 100.0 * std::abs(found->relative),
      found->relative > 0.0 ? "higher" : "lower",
      found->other.empty() ? "the mean of the others" : fmt::format("in session '{}'", found->other));
}

MeasuredForce force_of_coastdowns(const CoastdownData& data) {
  return {true, data.runs.front().bins.empty() ? "speed_km_h" : "v_hi_kmh and v_lo_kmh"};
}

std::vector<std::string> doubt_session_units(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                             const MeasuredForce& force) {
  std::map<std::string, ForceCurve> sessions;
  for (const RunResistance& run : runs) sessions[data.runs[run.run].session];
  if (sessions.size() < 2) return {};
  std::map<std::string, ForceCurve> others = sessions;
  for (const RunResistance& run : runs) {
    const CoastdownRun& of_data = data.runs[run.run];
    for (std::size_t i = 0; i < run.speed_m_s.size(); ++i) {
      for (auto& [name, curve] : sessions) {
        (name == of_data.session ? curve : others.at(name)).add(run.speed_m_s[i], run.force_N[i], of_data.heading);
      }
    }
  }
  std::vector<std::string> doubts;
  for (auto& [name, curve] : sessions) {
    ForceCurve& rest = others.at(name);
    if (!curve.fit() || !rest.fit()) continue;
    if (const auto doubt = doubt_unit_of(name, curve, rest, sessions.size() > 2, force)) doubts.push_back(*doubt);
  }
  return doubts;
}

}  // namespace rollrig::estimation
