#include "validation/generator/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <limits>
#include <set>

#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::generator {
namespace {

InputError refuse(const std::string& what, const char* option, const std::string& value, const std::string& allowed) {
  return InputError({what, "command line", 0, option, value, allowed, ""});
}

/// Throws InputError where `name` is not among the known.
void require_known(const char* what, const char* option, const std::string& name,
                   const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  InputProblem problem = unknown_name(what, name, known);
  problem.key = option;
  throw InputError(problem);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  if (!list.empty()) boost::algorithm::split(parts, list, boost::algorithm::is_any_of(","));
  return parts;
}

/// Values of "a,b", one of each effect; none where the list is empty.
std::vector<std::string> split_for(const std::vector<std::string>& ids, const std::string& list, const char* option) {
  std::vector<std::string> parts = split(list);
  if (parts.empty() || parts.size() == ids.size()) return parts;
  throw refuse(fmt::format("{} values for {} effects", parts.size(), ids.size()), option, list,
               "one of each effect, in their order");
}

double read_size(const EffectKind& kind, const std::string& text) {
  const auto value = text == "inf" ? std::numeric_limits<double>::infinity() : parse_number(text);
  if (!value.has_value()) {
    throw refuse(fmt::format("'{}' is not a number", text), "--size", text,
                 "a number in the unit of the effect's size, see rollrig_validation list");
  }
  const EffectSize& size = kind.size;
  if (*value >= size.lowest && *value <= size.highest) return *value;
  throw refuse(fmt::format("the size of {} is out of range", kind.id), "--size", text,
               fmt::format("{:g} to {:g} {}: {}", size.lowest, size.highest, size.unit, size.meaning));
}

void require_form(const EffectKind& kind, const std::string& form) {
  std::vector<std::string> known;
  for (const Form& one : kind.forms) known.emplace_back(one.name);
  require_known(fmt::format("form of {}", kind.id).c_str(), "--form", form, known);
}

/// Throws InputError where one of the effects has no place on a machine; with `drawn`, where sets do not have it.
void check_grounds(const std::vector<std::string>& ids, const Machine& machine, bool drawn) {
  for (const std::string& id : ids) {
    if (find_common_laws({id}, machine, drawn).any()) continue;
    const EffectKind& effect = *find_effect_kind(id);
    throw refuse(fmt::format("{} has no {} on a {}", id, drawn ? "visible trace" : "place", machine.word), "--kind",
                 machine.word, list_grounds(drawn ? effect.drawn : effect.acts));
  }
}

/// Whether the law of a road set is a constant coefficient, where that is said.
std::optional<bool> read_baseline(const std::string& name, const Machine& machine, const Laws& common) {
  if (name.empty()) return std::nullopt;
  if (!machine.has_constant_law) {
    throw refuse(fmt::format("a {} set has the combined law alone", machine.word), "--baseline", name,
                 fmt::format("no baseline, or another kind: {}", list_grounds(against_constant_law)));
  }
  require_known("baseline", "--baseline", name, {"combined", "constant_rrc"});
  const bool is_constant = name == "constant_rrc";
  if (is_constant ? common.constant_rrc : common.combined) return is_constant;
  throw refuse("the effect has no place against this law", "--baseline", name,
               is_constant ? "combined" : "constant_rrc");
}

}  // namespace

std::vector<std::string> read_effects(const std::string& list) {
  std::vector<std::string> ids = split(list);
  std::vector<std::string> known{kNone};
  for (const EffectKind* kind : effect_kinds()) known.emplace_back(kind->id);
  for (const std::string& id : ids) require_known("effect", "--effect", id, known);
  if (std::set<std::string>(ids.begin(), ids.end()).size() != ids.size()) {
    throw refuse("an effect is named twice", "--effect", list, "each effect once");
  }
  if (ids.size() > 1 && std::find(ids.begin(), ids.end(), kNone) != ids.end()) {
    throw refuse("'none' stands with other effects", "--effect", list, "none alone, or effects");
  }
  if (ids.size() == 1 && ids.front() == kNone) ids.clear();
  return ids;
}

void read_case(const CaseWords& words, SetOrder& order) {
  order.effects = read_effects(words.effects);
  order.sizes.resize(order.effects.size());
  const std::vector<std::string> sizes = split_for(order.effects, words.sizes, "--size");
  order.forms = split_for(order.effects, words.forms, "--form");
  for (std::size_t i = 0; i < order.effects.size(); ++i) {
    const EffectKind& kind = *find_effect_kind(order.effects[i]);
    if (!sizes.empty()) order.sizes[i] = read_size(kind, sizes[i]);
    if (!order.forms.empty()) require_form(kind, order.forms[i]);
  }
  order.machine = &find_machine(words.kind, "--kind");
  check_grounds(order.effects, *order.machine, false);
  const Laws common = find_common_laws(order.effects, *order.machine, false);
  if (!common.any()) throw refuse("these effects are not found against one law", "--effect", words.effects, "");
  order.constant_rrc = read_baseline(words.baseline, *order.machine, common);
}

std::vector<CampaignChoice> read_campaigns(const std::string& name) {
  if (name == kMixed) return mixed_campaigns();
  std::vector<std::string> known = machine_words();
  known.insert(known.begin(), kMixed);
  require_known("kind", "--kind", name, known);
  return {{"", &find_machine(name, "--kind")}};
}

OutsideList read_outside_list(const std::string& name) {
  require_known("list of outside effects", "--outside-list", name,
                {kOutsideListNames.begin(), kOutsideListNames.end()});
  const auto at = std::find(kOutsideListNames.begin(), kOutsideListNames.end(), name);
  return static_cast<OutsideList>(at - kOutsideListNames.begin());
}

namespace {

/// Whether any three of the effects can be drawn together.
bool has_triple(const ValidationSetOrder& order) {
  const std::vector<std::string>& ids = order.effects;
  const auto is_drawn = [&order](const std::vector<std::string>& triple) {
    return std::any_of(order.campaigns.begin(), order.campaigns.end(), [&triple](const CampaignChoice& campaign) {
      return find_common_laws(triple, *campaign.machine, true).any();
    });
  };
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        if (is_drawn({ids[i], ids[j], ids[k]})) return true;
      }
    }
  }
  return false;
}

}  // namespace

void check_drawn(const ValidationSetOrder& order) {
  for (const std::string& id : order.effects) {
    const bool is_drawn = std::any_of(all_machines().begin(), all_machines().end(), [&](const Machine* machine) {
      return find_common_laws({id}, *machine, true).any();
    });
    if (is_drawn) continue;
    throw refuse(fmt::format("{} has no visible trace on any kind", id), "--effects", id, "other effects");
  }
  if (order.kind != kMixed) check_grounds(order.effects, *order.campaigns.front().machine, true);
  if (order.singles > 0 && order.effects.empty()) {
    throw refuse("there is no effect for the singles", "--singles", std::to_string(order.singles),
                 "one or more --effects");
  }
  if (order.pairs > 0 && order.effects.size() < 2) {
    throw refuse("a pair needs two effects", "--pairs", std::to_string(order.pairs), "two or more --effects");
  }
  if (order.triples > 0 && !has_triple(order)) {
    throw refuse("no three of the effects act on one machine", "--triples", std::to_string(order.triples),
                 "three or more --effects of one kind");
  }
  const std::size_t all =
      static_cast<std::size_t>(order.each) * order.effects.size() +
      static_cast<std::size_t>(order.singles + order.none + order.pairs + order.triples + order.outside);
  if (all == 0) throw refuse("the validation set has no cases", "--each", "0", "one case at least");
}

}  // namespace rollrig::generator
