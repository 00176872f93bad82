#pragma once
/// Questions to a diagnosis that tests ask.

#include <algorithm>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace rollrig::tests {

using Ids = std::vector<std::string>;

inline diagnosis::DiagnosisOptions only(const Ids& ids, int threads = 0) {
  diagnosis::DiagnosisOptions options;
  options.only = ids;
  options.threads = threads;
  return options;
}

inline bool contains(const Ids& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

inline bool names(const diagnosis::Diagnosis& found, const std::string& id) {
  if (found.verdict != diagnosis::Verdict::kExplained || found.causes.empty()) return false;
  return contains(found.causes.front().effects, id) || contains(found.causes.front().indistinguishable_from, id);
}

}  // namespace rollrig::tests
