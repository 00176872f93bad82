#include "diagnosis/findings/lead.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
namespace {

/// The hypothesis itself, and those with as many effects that the set leaves open beside it and cannot tell from it;
/// the hypothesis alone where all these together would be too many effects to be named.
std::vector<const Candidate*> find_stand_ins(const Study& study, const std::vector<const Candidate*>& fitted,
                                             const Candidate& hypothesis) {
  const std::size_t terms = hypothesis.fit.hypothesis.terms.size();
  std::vector<const Candidate*> stand_ins;
  std::map<std::string, double> beside;
  for (const Candidate* other : fitted) {
    if (other->fit.hypothesis.terms.size() != terms || !is_open_beside(hypothesis, *other)) continue;
    if (is_told_apart(study, hypothesis, *other)) continue;
    stand_ins.push_back(other);
    for (const std::string& name : other->fit.hypothesis.names()) beside[name] += other->posterior();
  }
  const auto named = find_named_beside(hypothesis.fit.hypothesis.names(), hypothesis.posterior(), std::move(beside));
  if (terms + named.size() > thresholds::kLongSet) return {&hypothesis};
  return stand_ins;
}

/// Those effects of a hypothesis that act with at least half of the probability that any of them acts (the median
/// probability model). What stands in for the hypothesis counts for all of its effects.
std::vector<std::string> list_likely(const NamedHypotheses& all, const Candidate& hypothesis,
                                     const std::vector<const Candidate*>& stand_ins) {
  const std::vector<std::string> names = hypothesis.fit.hypothesis.names();
  std::map<std::string, double> acts;
  double any_acts = 0.0;
  const auto add = [&](const std::vector<std::string>& of, bool stands_in, double probability) {
    bool has_any = false;
    for (const std::string& name : names) {
      if (!stands_in && !contains_all(of, {name})) continue;
      acts[name] += probability;
      has_any = true;
    }
    if (has_any) any_acts += probability;
  };
  for (const Candidate* one : all.fitted) {
    add(one->fit.hypothesis.names(), std::count(stand_ins.begin(), stand_ins.end(), one) > 0, one->probability);
  }
  for (const Unfitted& one : all.unfitted) add(one.names, false, one.probability);
  std::vector<std::string> likely;
  std::copy_if(names.begin(), names.end(), std::back_inserter(likely),
               [&](const std::string& name) { return acts[name] > 0.0 && acts[name] >= 0.5 * any_acts; });
  return likely;
}

/// The first of so many terms that has all these effects.
std::vector<const Candidate*>::const_iterator find_with(const std::vector<const Candidate*>& fitted,
                                                        const std::vector<std::string>& effects, std::size_t terms) {
  return std::find_if(fitted.begin(), fitted.end(), [&](const Candidate* one) {
    const Hypothesis& hypothesis = one->fit.hypothesis;
    return hypothesis.terms.size() == terms && contains_all(hypothesis.names(), effects);
  });
}

bool is_likely_whole(const Study& study, const NamedHypotheses& all, const Candidate& hypothesis) {
  const std::vector<const Candidate*> stand_ins = find_stand_ins(study, all.fitted, hypothesis);
  return list_likely(all, hypothesis, stand_ins).size() == hypothesis.fit.hypothesis.terms.size();
}

}  // namespace

double expected_log_bayes_factor(const Study& study, const Candidate& a, const Candidate& b) {
  Eigen::VectorXd difference = a.fit.residuals - b.fit.residuals;
  study.discrepancy.whiten(a.amplitudes, difference);
  return 0.5 * difference.squaredNorm();
}

std::vector<std::string> find_named_beside(const std::vector<std::string>& lead, double lead_weight,
                                           std::map<std::string, double> beside) {
  for (const std::string& id : lead) beside.erase(id);
  double total = lead_weight;
  for (const auto& [id, weight] : beside) total += weight;
  double left_out = 0.0;
  while (lead.size() + beside.size() > thresholds::kLongSet) {
    const auto least = std::min_element(beside.begin(), beside.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
    if (beside.empty() || left_out + least->second > thresholds::kLeftOutOfLongSet * total) break;
    left_out += least->second;
    beside.erase(least);
  }
  std::vector<std::string> ids;
  for (const auto& [id, weight] : beside) ids.push_back(id);
  return ids;
}

bool is_open_beside(const Candidate& lead, const Candidate& other) {
  return other.posterior() >= std::exp(-thresholds::kToldApart_nats) * lead.posterior();
}

bool is_told_apart(const Study& study, const Candidate& lead, const Candidate& other) {
  return &other != &lead && expected_log_bayes_factor(study, lead, other) >= thresholds::kToldApart_nats;
}

const Candidate* choose_lead(const Study& study, const NamedHypotheses& all, const Candidate& likeliest) {
  const std::vector<std::string> names = likeliest.fit.hypothesis.names();
  const auto larger = find_with(all.fitted, names, names.size() + 1);
  if (larger != all.fitted.end() && is_likely_whole(study, all, **larger)) return *larger;
  if (is_likely_whole(study, all, likeliest)) return &likeliest;
  const std::vector<std::string> likely = list_likely(all, likeliest, {});
  const auto smaller = find_with(all.fitted, likely, likely.size());
  return smaller == all.fitted.end() ? &likeliest : choose_lead(study, all, **smaller);
}

}  // namespace rollrig::diagnosis
