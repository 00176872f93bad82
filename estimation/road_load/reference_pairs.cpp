#include "estimation/road_load/reference_pairs.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
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

std::size_t count_unshared_speeds(const Speeds& a, const Speeds& b) {
  return a.size() + b.size() - 2 * list_common_speeds(a, b).size();
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

/// Of the free runs that go with a run, the first of those with the fewest other speeds; the end where none goes.
std::vector<std::size_t>::iterator find_partner(const std::vector<ReferenceRun>& runs, std::size_t run,
                                                std::vector<std::size_t>& free) {
  const Speeds speeds = list_speeds(runs[run]);
  auto partner = free.end();
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (auto other = free.begin(); other != free.end(); ++other) {
    const Speeds others = list_speeds(runs[*other]);
    const std::size_t unshared = count_unshared_speeds(speeds, others);
    if (!go_together(speeds, others) || unshared >= fewest) continue;
    partner = other;
    fewest = unshared;
  }
  return partner;
}

void pair_session(const std::vector<ReferenceRun>& runs, const std::string& session, PairedRuns& paired) {
  std::vector<std::size_t> plus, minus;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].session != session || runs[i].heading == 0 || runs[i].values.empty()) continue;
    (runs[i].heading > 0 ? plus : minus).push_back(i);
  }
  for (const std::size_t run : plus) {
    const auto partner = find_partner(runs, run, minus);
    if (partner == minus.end()) {
      paired.alone.push_back(run);
      continue;
    }
    const Speeds common = list_common_speeds(list_speeds(runs[run]), list_speeds(runs[*partner]));
    paired.pairs.push_back({run, *partner, common, 0, ""});
    minus.erase(partner);
  }
  paired.alone.insert(paired.alone.end(), minus.begin(), minus.end());
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
  for (const std::string& session : name_sessions(runs)) pair_session(runs, session, paired);
  std::sort(paired.alone.begin(), paired.alone.end());
  sort_into_parts(paired.pairs);
  return paired;
}

}  // namespace rollrig::estimation
