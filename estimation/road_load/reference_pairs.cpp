#include "estimation/road_load/reference_pairs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace rollrig::estimation {
namespace {

using Speeds = std::vector<int>;  // numbers of reference speeds, falling

Speeds list_speeds(const ReferenceRun& run) {
  Speeds speeds;
  for (auto at = run.values.rbegin(); at != run.values.rend(); ++at) speeds.push_back(at->first);
  return speeds;
}

Speeds list_common_speeds(const Speeds& a, const Speeds& b) {
  Speeds common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common), std::greater<>());
  return common;
}

bool go_together(const Speeds& a, const Speeds& b) {
  return 3 * list_common_speeds(a, b).size() > 2 * std::min(a.size(), b.size());
}

std::vector<std::string> name_sessions(const std::vector<ReferenceRun>& runs) {
  std::vector<std::string> sessions;
  for (const ReferenceRun& run : runs) {
    if (std::find(sessions.begin(), sessions.end(), run.session) == sessions.end()) sessions.push_back(run.session);
  }
  return sessions;
}

/// Runs of one heading, and the place of each in the order of the session.
struct WayRuns {
  std::vector<std::size_t> runs;
  std::vector<double> places;
};

/// Pairs of places in both lists, rising in both: as many as possible of runs that go together, and partners as near in
/// the order of the session as possible.
std::vector<std::pair<std::size_t, std::size_t>> match_in_order(const std::vector<ReferenceRun>& runs,
                                                                const WayRuns& plus, const WayRuns& minus) {
  constexpr double kAlone = 1e6;  // of a run without a partner: more than any distance in the order
  const std::size_t n = plus.runs.size(), m = minus.runs.size();
  const auto distance = [&](std::size_t i, std::size_t j) {
    return go_together(list_speeds(runs[plus.runs[i]]), list_speeds(runs[minus.runs[j]]))
               ? std::abs(plus.places[i] - minus.places[j])
               : std::numeric_limits<double>::infinity();
  };
  // least cost of the runs from (i, j) on
  std::vector<std::vector<double>> cost(n + 1, std::vector<double>(m + 1, 0.0));
  for (std::size_t i = n + 1; i-- > 0;) {
    for (std::size_t j = m + 1; j-- > 0;) {
      if (i == n && j == m) continue;
      const double skip_plus = i < n ? kAlone + cost[i + 1][j] : std::numeric_limits<double>::infinity();
      const double skip_minus = j < m ? kAlone + cost[i][j + 1] : std::numeric_limits<double>::infinity();
      cost[i][j] = std::min(skip_plus, skip_minus);
      if (i < n && j < m) cost[i][j] = std::min(cost[i][j], distance(i, j) + cost[i + 1][j + 1]);
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> matches;
  for (std::size_t i = 0, j = 0; i < n && j < m;) {
    if (cost[i][j] == distance(i, j) + cost[i + 1][j + 1]) {
      matches.emplace_back(i++, j++);
    } else if (cost[i][j] == kAlone + cost[i + 1][j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return matches;
}

/// Runs of a session that go together, in their order: more than one group where runs are split.
std::vector<std::vector<std::size_t>> group_session(const std::vector<ReferenceRun>& runs, const std::string& session) {
  std::vector<std::size_t> falling;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].session == session && runs[i].heading != 0 && !runs[i].values.empty()) falling.push_back(i);
  }
  const auto ends = [&runs](std::size_t i) {
    return std::pair(runs[i].values.begin()->first, runs[i].values.rbegin()->first);
  };
  std::stable_sort(falling.begin(), falling.end(), [&](std::size_t a, std::size_t b) { return ends(a) > ends(b); });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t run : falling) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const std::vector<std::size_t>& members) {
      return go_together(list_speeds(runs[members.front()]), list_speeds(runs[run]));
    });
    if (group == groups.end()) {
      groups.push_back({run});
    } else {
      group->push_back(run);
    }
  }
  for (std::vector<std::size_t>& group : groups) {
    std::sort(group.begin(), group.end(), [&runs](std::size_t a, std::size_t b) {
      return std::pair(runs[a].position, a) < std::pair(runs[b].position, b);
    });
  }
  return groups;
}

void pair_group(const std::vector<ReferenceRun>& runs, const std::vector<std::size_t>& in_order, PairedRuns& paired) {
  WayRuns plus, minus;
  for (std::size_t place = 0; place < in_order.size(); ++place) {
    WayRuns& way = runs[in_order[place]].heading > 0 ? plus : minus;
    way.runs.push_back(in_order[place]);
    way.places.push_back(static_cast<double>(place));
  }
  std::set<std::size_t> paired_runs;
  for (const auto& [i, j] : match_in_order(runs, plus, minus)) {
    const std::size_t a = plus.runs[i], b = minus.runs[j];
    paired.pairs.push_back({a, b, list_common_speeds(list_speeds(runs[a]), list_speeds(runs[b])), 0, ""});
    paired_runs.insert({a, b});
  }
  std::copy_if(in_order.begin(), in_order.end(), std::back_inserter(paired.alone),
               [&](std::size_t run) { return paired_runs.count(run) == 0; });
}

/// Numbers the parts from that of the highest speeds on. The first pair of a part stands for it, so that pairs of whole
/// runs do not join the parts of split ones.
void sort_into_parts(std::vector<ReferencePair>& pairs) {
  const auto ends = [](const ReferencePair& pair) { return std::pair(pair.speeds.back(), pair.speeds.front()); };
  std::vector<ReferencePair*> falling;
  for (ReferencePair& pair : pairs) falling.push_back(&pair);
  std::stable_sort(falling.begin(), falling.end(),
                   [&](const ReferencePair* a, const ReferencePair* b) { return ends(*a) > ends(*b); });
  std::vector<Speeds> parts;
  for (ReferencePair* pair : falling) {
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const Speeds& speeds) { return go_together(speeds, pair->speeds); });
    pair->part = static_cast<int>(part - parts.begin());
    if (part == parts.end()) parts.push_back(pair->speeds);
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const ReferencePair& a, const ReferencePair& b) { return a.part < b.part; });
}

}  // namespace

bool ReferencePair::has(int speed) const { return std::find(speeds.begin(), speeds.end(), speed) != speeds.end(); }

PairedRuns pair_runs(const std::vector<ReferenceRun>& runs) {
  PairedRuns paired;
  for (const std::string& session : name_sessions(runs)) {
    for (const std::vector<std::size_t>& group : group_session(runs, session)) pair_group(runs, group, paired);
  }
  std::sort(paired.alone.begin(), paired.alone.end());
  sort_into_parts(paired.pairs);
  return paired;
}

}  // namespace rollrig::estimation
