#pragma once
/// Cases with known answers, for tests of the score.

#include <utility>

#include "validation/scoring/case.h"

namespace rollrig::tests {

/// A drum set with these effects, which shows `floors`.
inline validation::Case make_case(const std::string& set, const std::vector<std::string>& effects,
                                  double floors = 10.0) {
  validation::Case made;
  made.truth.number = set;
  made.truth.kind = "drum";
  made.truth.campaign = "full_drum";
  made.truth.signal_floors = effects.empty() ? 0.0 : floors;
  for (const std::string& id : effects) made.truth.effects.push_back({id, 2.0, 0.0, "N", ""});
  made.answer.number = set;
  made.answer.cpu_seconds = 4.0;
  return made;
}

inline validation::Case say_no_gap(validation::Case one, double probability = 0.95) {
  one.answer.diagnosis.verdict = diagnosis::Verdict::kNoGap;
  one.answer.diagnosis.probability = {{"none", probability}, {"unknown", 1.0 - probability}};
  return one;
}

inline validation::Case say_unexplained(validation::Case one, double probability = 0.95) {
  one.answer.diagnosis.verdict = diagnosis::Verdict::kUnexplained;
  one.answer.diagnosis.probability = {{"none", 1.0 - probability}, {"unknown", probability}};
  return one;
}

/// The first cause is `effects`, not told from `twins`.
inline validation::Case say_cause(validation::Case one, const std::vector<std::string>& effects, double probability,
                                  const std::vector<std::string>& twins = {}) {
  one.answer.diagnosis.verdict = diagnosis::Verdict::kExplained;
  diagnosis::Cause cause;
  cause.effects = effects;
  cause.probability = probability;
  cause.indistinguishable_from = twins;
  one.answer.diagnosis.causes = {cause};
  one.answer.diagnosis.probability = {{"none", 0.0}, {"unknown", 1.0 - probability}};
  for (const std::string& id : effects) one.answer.diagnosis.probability[id] = probability;
  return one;
}

inline validation::Case say_size(validation::Case one, const std::string& parameter, double value, double half_width) {
  one.answer.diagnosis.causes.front().parameters = {
      {parameter, value, half_width / 2.0, value - half_width, value + half_width, "N"}};
  return one;
}

}  // namespace rollrig::tests
