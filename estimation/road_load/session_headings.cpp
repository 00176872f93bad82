#include "estimation/road_load/session_headings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/road_load_checks.h"

namespace rollrig::estimation {
namespace {

/// Slopes that the runs of a session show, by heading.
struct SessionSlopes {
  std::vector<double> plus, minus;
  double mean() const { return 0.5 * (calc_mean(plus) + calc_mean(minus)); }
  bool has_both() const { return !plus.empty() && !minus.empty(); }
};

/// Standard deviation of single runs within session and heading, with its degrees of freedom.
struct RunScatter {
  double sd = 0.0;
  double freedom = 0.0;
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

RunScatter find_slope_scatter(const std::map<std::string, SessionSlopes>& sessions) {
  double squares = 0.0, freedom = 0.0;
  for (const auto& [name, session] : sessions) {
    for (const std::vector<double>* slopes : {&session.plus, &session.minus}) {
      if (slopes->empty()) continue;
      const double mean = calc_mean(*slopes);
      for (const double slope : *slopes) squares += (slope - mean) * (slope - mean);
      freedom += static_cast<double>(slopes->size()) - 1.0;
    }
  }
  return {freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0, freedom};
}

bool is_beyond_scatter(const SessionSlopes& session, const RunScatter& scatter) {
  constexpr double kUnlikely = 0.005, kLeastSlope = 0.001;
  const double t = boost::math::quantile(boost::math::students_t(scatter.freedom), 1.0 - 0.5 * kUnlikely);
  const double sd =
      0.5 * scatter.sd *
      std::sqrt(1.0 / static_cast<double>(session.plus.size()) + 1.0 / static_cast<double>(session.minus.size()));
  return std::abs(session.mean()) > std::max(kLeastSlope, t * sd);
}

/// Sessions that show slopes of one sign.
struct OneSign {
  std::vector<std::string> names;
  std::vector<double> slopes;
};

std::string list_sessions_with_slope(const OneSign& sign) {
  return fmt::format("{:+.4f} in {} '{}'", calc_mean(sign.slopes), sign.names.size() == 1 ? "session" : "sessions",
                     fmt::join(sign.names, "', '"));
}

}  // namespace

std::optional<std::string> doubt_session_headings(const CoastdownData& data, const std::vector<RunResistance>& runs,
                                                  double mass_kg) {
  constexpr double kLikeSize = 2.0;
  const bool has_records = std::any_of(data.runs.begin(), data.runs.end(),
                                       [](const CoastdownRun& run) { return !run.conditions.slope.empty(); });
  if (has_records) return std::nullopt;
  const std::map<std::string, SessionSlopes> sessions = sort_by_session(data, runs, mass_kg);
  const RunScatter scatter = find_slope_scatter(sessions);
  if (scatter.freedom < 1.0) return std::nullopt;
  OneSign more, fewer;
  for (const auto& [name, session] : sessions) {
    if (!session.has_both() || !is_beyond_scatter(session, scatter)) continue;
    OneSign& sign = session.mean() > 0.0 ? more : fewer;
    sign.names.push_back(name);
    sign.slopes.push_back(session.mean());
  }
  if (more.names.empty() || fewer.names.empty()) return std::nullopt;
  if (more.names.size() < fewer.names.size()) std::swap(more, fewer);
  const double ratio = std::abs(calc_mean(more.slopes) / calc_mean(fewer.slopes));
  if (ratio > kLikeSize || ratio < 1.0 / kLikeSize) return std::nullopt;
  const bool is_tie = more.names.size() == fewer.names.size();
  return fmt::format("the headings show a slope of {} and of {}: are the headings of {} exchanged?",
                     list_sessions_with_slope(more), list_sessions_with_slope(fewer),
                     is_tie                    ? "one or the other"
                     : fewer.names.size() == 1 ? fmt::format("session '{}'", fewer.names.front())
                                               : "the latter");
}

}  // namespace rollrig::estimation
