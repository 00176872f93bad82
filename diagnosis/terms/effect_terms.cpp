/// Effects of the catalog as terms of hypotheses.
#include "diagnosis/terms/term.h"

namespace rollrig::diagnosis {
namespace {

class EffectTerm : public Term {
 public:
  explicit EffectTerm(const models::Effect& effect) : effect_(effect) {}
  const models::EffectInfo& info() const override { return effect_.info; }
  const models::Effect& effect() const override { return effect_; }

 private:
  const models::Effect& effect_;
};

}  // namespace

std::vector<const Term*> list_effect_terms() {
  static const std::vector<EffectTerm> catalog = [] {
    std::vector<EffectTerm> terms;
    for (const models::Effect* effect : models::all_effects()) terms.emplace_back(*effect);
    return terms;
  }();
  std::vector<const Term*> terms;
  for (const EffectTerm& term : catalog) terms.push_back(&term);
  return terms;
}

}  // namespace rollrig::diagnosis
