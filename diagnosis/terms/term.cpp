#include "diagnosis/terms/term.h"

#include <algorithm>

#include "diagnosis/terms/unknown_terms.h"
#include "sim/core/error.h"

namespace rollrig::diagnosis {

// The kinds of terms, a file each.
std::vector<const Term*> list_effect_terms();

const std::vector<const Term*>& all_terms() {
  static const std::vector<const Term*> all = [] {
    std::vector<const Term*> terms;
    for (const auto list_kind : {list_effect_terms, list_unknown_terms}) {
      for (const Term* term : list_kind()) terms.push_back(term);
    }
    return terms;
  }();
  return all;
}

std::vector<const Term*> choose_terms(const models::MachineTraits& machine, const models::TireModel& tire,
                                      const std::vector<std::string>& only, const std::vector<std::string>& without) {
  const auto holds = [](const auto& list, const auto& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
  };
  std::vector<const Term*> terms;
  for (const Term* term : all_terms()) {
    if (term->is_unknown()) continue;
    const bool is_seen = models::acts_in(term->info(), machine, tire) && models::is_seen_on(term->info(), machine);
    const bool is_wanted = (only.empty() || holds(only, term->name())) && !holds(without, term->name());
    if (is_seen && is_wanted) terms.push_back(term);
  }
  return terms;
}

std::vector<const Term*> choose_unknown_terms(const models::MachineTraits& machine, const models::TireModel& tire) {
  std::vector<const Term*> terms;
  for (const Term* term : all_terms()) {
    const models::EffectInfo& info = term->info();
    if (term->is_unknown() && models::acts_in(info, machine, tire) && models::is_seen_on(info, machine)) {
      terms.push_back(term);
    }
  }
  return terms;
}

std::vector<std::string> term_names() {
  std::vector<std::string> names;
  for (const Term* term : all_terms()) {
    if (!term->is_unknown()) names.push_back(term->name());
  }
  return names;
}

const Term* look_up_term(const std::string& name) {
  const auto of_name = std::find_if(all_terms().begin(), all_terms().end(),
                                    [&](const Term* term) { return !term->is_unknown() && term->name() == name; });
  return of_name == all_terms().end() ? nullptr : *of_name;
}

const Term& find_term(const std::string& name) {
  const Term* term = look_up_term(name);
  if (term != nullptr) return *term;
  throw InputError(unknown_name("effect", name, term_names()));
}

}  // namespace rollrig::diagnosis
