#include "estimation/road_load/session_differences.h"

#include <cmath>
#include <set>

#include <fmt/format.h>
#include <boost/math/distributions/fisher_f.hpp>

#include "estimation/road_load/road_load_checks.h"
#include "estimation/run_checks/pooled_scatter.h"

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

std::size_t count_headings(const std::map<std::string, HeadingGroups>& sessions) {
  std::set<int> all;
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) all.insert(heading);
  }
  return all.size();
}

/// Those that have all headings that there are: a slope or a wind shifts a heading alone.
std::map<std::string, HeadingGroups> keep_whole(std::map<std::string, HeadingGroups> sessions) {
  const std::size_t all = count_headings(sessions);
  for (auto session = sessions.begin(); session != sessions.end();) {
    session = session->second.size() < all ? sessions.erase(session) : std::next(session);
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

/// Of the runs about the mean of their session and heading.
PooledScatter find_scatter_within(const std::map<std::string, HeadingGroups>& sessions) {
  PooledScatter scatter;
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) scatter.add_group(values);
  }
  return scatter;
}

/// Of the means of session and heading about what their session and their heading make of them: that of single runs, or
/// less.
PooledScatter find_scatter_of_pairs(const std::map<std::string, HeadingGroups>& sessions) {
  const std::vector<SessionMean> means = list_session_means(sessions);
  std::map<int, double> heading_means;
  double mean = 0.0;
  for (const SessionMean& session : means) mean += session.value / static_cast<double>(means.size());
  for (const auto& [name, headings] : sessions) {
    for (const auto& [heading, values] : headings) {
      heading_means[heading] += calc_mean(values) / static_cast<double>(sessions.size());
    }
  }
  PooledScatter scatter;
  for (const SessionMean& session : means) {
    for (const auto& [heading, values] : sessions.at(session.name)) {
      const double rest = calc_mean(values) - session.value - heading_means.at(heading) + mean;
      scatter.squares += rest * rest;
    }
  }
  scatter.degrees_of_freedom =
      (static_cast<double>(sessions.size()) - 1.0) * (static_cast<double>(heading_means.size()) - 1.0);
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

/// Says so if the air of the session that is farthest was not that of those that it is compared with; else empty.
std::string describe_air(const CoastdownData& data, const std::map<std::size_t, double>& deviations,
                         const std::string& farthest) {
  constexpr double kLeast_K = 2.0;  // Assumed: the rolling resistance changes by about 1 % a kelvin
  std::map<std::string, std::vector<double>> air_K;
  for (const auto& [session, headings] : keep_whole(group_by_heading(data, deviations))) air_K[session];
  for (const auto& [run, deviation] : deviations) {
    const auto session = air_K.find(data.runs[run].session);
    if (data.runs[run].conditions.ambient_K.empty()) return "";
    if (session != air_K.end()) session->second.push_back(calc_mean(data.runs[run].conditions.ambient_K));
  }
  std::vector<double> others_K;
  for (const auto& [session, values_K] : air_K) {
    if (session != farthest) others_K.push_back(calc_mean(values_K));
  }
  const double difference_K = calc_mean(air_K.at(farthest)) - calc_mean(others_K);
  if (std::abs(difference_K) < kLeast_K) return "";
  return fmt::format(". The air in session '{}' was {:.1f} K {}", farthest, std::abs(difference_K),
                     difference_K > 0.0 ? "warmer" : "colder");
}

}  // namespace

std::optional<SessionDifference> compare_sessions(const CoastdownData& data,
                                                  const std::map<std::size_t, double>& deviations, SessionWinds winds) {
  const std::map<std::string, HeadingGroups> all = group_by_heading(data, deviations);
  const std::map<std::string, HeadingGroups> whole = keep_whole(all);
  const std::vector<SessionMean> means = list_session_means(whole);
  const double between_freedom = static_cast<double>(means.size()) - 1.0;
  PooledScatter runs = find_scatter_within(all);
  if (winds == SessionWinds::kInDeviations && !means.empty()) {
    const PooledScatter of_pairs = find_scatter_of_pairs(whole);
    if (of_pairs.degrees_of_freedom > runs.degrees_of_freedom) runs = of_pairs;
  }
  if (between_freedom < 1.0 || runs.degrees_of_freedom < 1.0) return std::nullopt;
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
  const boost::math::fisher_f distribution(between_freedom, runs.degrees_of_freedom);
  difference.p_value =
      boost::math::cdf(boost::math::complement(distribution, between / between_freedom / runs.variance()));
  return difference;
}

std::vector<std::string> list_partial_sessions(const CoastdownData& data,
                                               const std::map<std::size_t, double>& deviations) {
  const std::map<std::string, HeadingGroups> sessions = group_by_heading(data, deviations);
  const std::size_t all = count_headings(sessions);
  std::vector<std::string> partial;
  for (const auto& [name, headings] : sessions) {
    if (headings.size() < all) partial.push_back(name);
  }
  return partial;
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
      "in session '{}' is {:.1f} % {} than {}. Where sessions cover different speeds, the difference bends the curve{}",
      100.0 * found->relative_sd, found->farthest, 100.0 * std::abs(found->relative),
      found->relative > 0.0 ? "higher" : "lower",
      found->other.empty() ? "the mean of the others" : fmt::format("in session '{}'", found->other),
      describe_air(data, deviations, found->farthest));
}

}  // namespace rollrig::estimation
