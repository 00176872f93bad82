#include "estimation/road_load/session_headings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/road_load_checks.h"
#include "estimation/run_checks/pooled_scatter.h"

namespace rollrig::estimation {
namespace {

/// Slopes that the runs of a session show, by heading.
struct SessionSlopes {
  std::vector<double> plus, minus;
  double mean() const { return 0.5 * (calc_mean(plus) + calc_mean(minus)); }
  bool has_both() const { return !plus.empty() && !minus.empty(); }
};

std::map<std::string, SessionSlopes> sort_by_session(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                     double mass_kg) {
  std::map<std::string, SessionSlopes> sessions;
  for (const ShownSlope& at : list_shown_slopes(data, runs, mass_kg)) {
    const CoastdownRun& run = data.runs[at.run];
    SessionSlopes& session = sessions[run.session];
    if (run.heading != 0) (run.heading > 0 ? session.plus : session.minus).push_back(at.slope);
  }
  return sessions;
}

PooledScatter find_slope_scatter(const std::map<std::string, SessionSlopes>& sessions) {
  PooledScatter scatter;
  for (const auto& [name, session] : sessions) {
    scatter.add_group(session.plus);
    scatter.add_group(session.minus);
  }
  return scatter;
}

bool is_beyond_scatter(const SessionSlopes& session, const PooledScatter& scatter) {
  constexpr double kUnlikely = 0.005, kLeastSlope = 0.001;
  const boost::math::students_t student(scatter.degrees_of_freedom);
  const double t = boost::math::quantile(student, 1.0 - 0.5 * kUnlikely);
  const double of_mean =
      1.0 / static_cast<double>(session.plus.size()) + 1.0 / static_cast<double>(session.minus.size());
  return std::abs(session.mean()) > std::max(kLeastSlope, t * 0.5 * std::sqrt(scatter.variance() * of_mean));
}

/// Sessions that show slopes of one sign.
struct SlopesOfOneSign {
  std::vector<std::string> names;
  std::vector<double> slopes;

  void add(const std::string& name, double slope) {
    names.push_back(name);
    slopes.push_back(slope);
  }
};

std::string list_sessions_with_slope(const SlopesOfOneSign& sign) {
  return fmt::format("{:+.4f} in {} '{}'", calc_mean(sign.slopes), sign.names.size() == 1 ? "session" : "sessions",
                     fmt::join(sign.names, "', '"));
}

/// Asks about the sessions in `fewer`; if both groups are equally large, about either.
std::string describe_exchanged_headings(const SlopesOfOneSign& more, const SlopesOfOneSign& fewer) {
  const bool is_tie = more.names.size() == fewer.names.size();
  const bool is_one = fewer.names.size() == 1;
  const std::string asked = is_tie && is_one ? "one or the other"
                            : is_tie         ? "the former or of the latter sessions"
                            : is_one         ? fmt::format("session '{}'", fewer.names.front())
                                             : "the latter sessions";
  return fmt::format("the headings show a slope of {} and of {}: are the headings of {} exchanged?",
                     list_sessions_with_slope(more), list_sessions_with_slope(fewer), asked);
}

}  // namespace

std::optional<std::string> doubt_session_headings(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double mass_kg) {
  constexpr double kLikeSize = 2.0;
  const std::map<std::string, SessionSlopes> sessions = sort_by_session(data, runs, mass_kg);
  const PooledScatter scatter = find_slope_scatter(sessions);
  if (scatter.degrees_of_freedom < 1.0) return std::nullopt;
  SlopesOfOneSign uphill, downhill;
  for (const auto& [name, session] : sessions) {
    if (!session.has_both() || !is_beyond_scatter(session, scatter)) continue;
    (session.mean() > 0.0 ? uphill : downhill).add(name, session.mean());
  }
  if (uphill.names.empty() || downhill.names.empty()) return std::nullopt;
  const double ratio = std::abs(calc_mean(uphill.slopes) / calc_mean(downhill.slopes));
  if (ratio > kLikeSize || ratio < 1.0 / kLikeSize) return std::nullopt;
  return uphill.names.size() >= downhill.names.size() ? describe_exchanged_headings(uphill, downhill)
                                                      : describe_exchanged_headings(downhill, uphill);
}

}  // namespace rollrig::estimation
