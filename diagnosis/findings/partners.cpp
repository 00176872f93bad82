#include "diagnosis/findings/partners.h"

#include <algorithm>
#include <map>

#include "diagnosis/thresholds.h"

namespace rollrig::diagnosis {
void find_partners(const Comparison& comparison, const Candidate& lead, rollrig::Cause& cause) {
  const std::vector<std::string> own = lead.fit.hypothesis.names();
  std::map<std::string, double> with;  // of each effect that acts beside all of the lead's
  double acts = 0.0;
  double alone = 0.0;
  const auto add = [&](const std::vector<std::string>& names, double probability) {
    if (!contains_all(names, own)) return;
    acts += probability;
    if (names.size() == own.size()) alone += probability;
    if (names.size() != own.size() + 1) return;
    for (const std::string& name : names) {
      if (std::count(own.begin(), own.end(), name) == 0) with[name] += probability;
    }
  };
  for (const Candidate& candidate : comparison.candidates) add(candidate.fit.hypothesis.names(), candidate.probability);
  for (const Unfitted& unfitted : comparison.unfitted) add(unfitted.names, unfitted.probability);
  cause.acts = acts;
  cause.alone = alone;
  for (const auto& [effect, probability] : with) {
    if (probability >= thresholds::kWorthPartner) cause.partners.push_back({effect, probability});
  }
  std::stable_sort(cause.partners.begin(), cause.partners.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

}  // namespace rollrig::diagnosis
