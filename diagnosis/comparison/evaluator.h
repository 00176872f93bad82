#pragma once
/// Fits hypotheses to a set and says how well each predicts it.

#include "diagnosis/comparison/screen.h"

namespace rollrig::diagnosis {

class Evaluator {
 public:
  explicit Evaluator(const Study& study);

  /// The baseline through the same optimizer as everything else. Throws RunFailure where it cannot be fitted.
  Candidate fit_null() const;

  /// Every chosen term on top of `from`: a few steps each, and those that come near the best to the end.
  std::vector<Candidate> refit_all(const Candidate& from, const std::vector<Screened>& chosen) const;

  /// Log evidence of a candidate where the laws of some of its terms are loose (law_errors.h), the discrepancy as small
  /// as model error; nothing where that cannot be found.
  std::optional<double> weigh_with_loose_laws(const Candidate& candidate, const std::vector<const Term*>& terms) const;

 private:
  void weigh(Candidate& candidate) const;
  void admit_loose_laws(Candidate& candidate) const;
  Candidate fit_once(const Model& model, const RefitStart& start) const;
  Candidate fit_to_end(const Model& model, const Fit& start) const;

  const Study& study_;
  Discrepancy of_conditions_;           // an unknown effect that repeats from run to run
  std::optional<Discrepancy> of_tire_;  // of joined sets: what the tire does on all machines alike
};

}  // namespace rollrig::diagnosis
