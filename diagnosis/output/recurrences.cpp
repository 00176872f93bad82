// Which effects come back from set to set, with the machine or with the tire.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/findings/common_value.h"
#include "diagnosis/output/fleet.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kPrior = 0.02;
constexpr double kRecurs = 0.8;
constexpr double kCertain = 1e-6;  // a comparison is not surer than this

bool names_cause(const FleetMember& member) {
  return member.findings.has_value() && member.findings->verdict == Verdict::kExplained &&
         !member.findings->causes.empty();
}

void average_sizes(const std::vector<ParameterEstimate>& sizes, Recurrence& recurrence) {
  std::vector<Estimate> estimates;
  for (const ParameterEstimate& size : sizes) {
    if (size.sd > 0.0) estimates.push_back({size.value, size.sd * size.sd});
  }
  if (estimates.empty()) return;
  const CommonValue common = find_common_value(estimates);
  recurrence.mean_size = common.mean;
  recurrence.mean_size_sd = common.sd;
  recurrence.unit = sizes.front().unit;
  if (estimates.size() > 1) recurrence.same_size_p = common.chance;
}

struct Group {
  Shared shared;
  std::string name;
  std::vector<const FleetMember*> members;
};

/// Sets that share a machine, a tire or both, two at least; of groups of the same sets the narrowest.
std::vector<Group> make_groups(const std::vector<FleetMember>& members) {
  std::map<std::pair<Shared, std::string>, std::vector<const FleetMember*>> by_name;
  for (const FleetMember& member : members) {
    if (!member.findings.has_value() || !member.findings->doubt.empty()) continue;
    by_name[{Shared::kMachineAndTire, member.tire + " on " + member.machine}].push_back(&member);
    by_name[{Shared::kMachine, member.machine}].push_back(&member);
    by_name[{Shared::kTire, member.tire}].push_back(&member);
  }
  std::set<std::vector<const FleetMember*>> of_both;
  for (const auto& [what, sharing] : by_name) {
    if (what.first == Shared::kMachineAndTire) of_both.insert(sharing);
  }
  std::vector<Group> groups;
  for (const auto& [what, sharing] : by_name) {
    const bool as_both = what.first != Shared::kMachineAndTire && of_both.count(sharing) > 0;
    if (sharing.size() >= 2 && !as_both) groups.push_back({what.first, what.second, sharing});
  }
  return groups;
}

/// Effects that one set at least names.
std::set<std::string> find_named(const std::vector<FleetMember>& members) {
  std::set<std::string> named;
  for (const FleetMember& member : members) {
    if (!names_cause(member)) continue;
    for (const std::string& id : member.findings->causes.front().effects) named.insert(id);
  }
  return named;
}

Recurrence judge(const std::string& effect, const Group& group) {
  Recurrence recurrence;
  recurrence.effect = effect;
  recurrence.shared = group.shared;
  recurrence.name = group.name;
  std::vector<double> in_sets;
  std::vector<ParameterEstimate> sizes;
  for (const FleetMember* member : group.members) {
    const auto& probability = member->findings->probability;
    const auto at = probability.find(effect);
    if (at != probability.end()) in_sets.push_back(at->second);
    if (!names_cause(*member)) continue;
    if (const auto* size = find_size(member->findings->causes.front(), effect)) sizes.push_back(*size);
  }
  recurrence.sets = in_sets.size();
  recurrence.named_in = sizes.size();
  recurrence.probability = calc_recurrence_probability(in_sets, kPrior);
  average_sizes(sizes, recurrence);
  return recurrence;
}

}  // namespace

double calc_recurrence_probability(const std::vector<double>& in_sets, double prior) {
  const double prior_odds = prior / (1.0 - prior);
  double log_odds = std::log(prior_odds);
  for (const double in_set : in_sets) {
    const double p = std::clamp(in_set, kCertain, 1.0 - kCertain);
    const double factor = p / (1.0 - p) / prior_odds;
    log_odds += std::log(factor / (prior * factor + 1.0 - prior));
  }
  return 1.0 / (1.0 + std::exp(-log_odds));
}

std::vector<Recurrence> find_recurrences(const std::vector<FleetMember>& members) {
  std::vector<Recurrence> found;
  const std::vector<Group> groups = make_groups(members);
  for (const std::string& effect : find_named(members)) {
    std::optional<Recurrence> widest;
    for (const Group& group : groups) {
      const Recurrence one = judge(effect, group);
      if (one.sets < 2 || one.probability <= kRecurs || one.named_in == 0) continue;
      const bool wider =
          !widest || one.sets > widest->sets || (one.sets == widest->sets && one.probability > widest->probability);
      if (wider) widest = one;
    }
    if (widest) found.push_back(*widest);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Recurrence& a, const Recurrence& b) { return a.probability > b.probability; });
  return found;
}

}  // namespace rollrig::diagnosis
