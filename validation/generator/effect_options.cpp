#include "validation/generator/effect_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <set>

#include "validation/generator/effect.h"
#include "validation/generator/problem.h"

namespace blind {
namespace {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  if (!list.empty()) boost::algorithm::split(parts, list, boost::algorithm::is_any_of(","));
  return parts;
}

std::vector<std::string> known_effects() {
  std::vector<std::string> ids{kNone};
  for (const EffectKind* kind : effect_kinds()) ids.push_back(kind->id);
  return ids;
}

}  // namespace

std::vector<std::string> read_effects(const std::string& list) {
  std::vector<std::string> ids = split(list);
  const std::vector<std::string> known = known_effects();
  for (const std::string& id : ids) {
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    throw InputError({fmt::format("unknown effect '{}'", id), "--effect", id, fmt::format("{}", fmt::join(known, ", ")),
                      find_nearest(id, known)});
  }
  if (std::set<std::string>(ids.begin(), ids.end()).size() != ids.size()) {
    throw InputError({"an effect is named twice", "--effect", list, "each effect once", ""});
  }
  if (ids.size() > 1 && std::find(ids.begin(), ids.end(), kNone) != ids.end()) {
    throw InputError({"'none' stands with other effects", "--effect", list, "none alone, or effects", ""});
  }
  if (ids.size() == 1 && ids.front() == kNone) ids.clear();
  return ids;
}

std::vector<std::optional<double>> read_sizes(const std::string& list, const std::vector<std::string>& ids) {
  const std::size_t effects = ids.size();
  std::vector<std::optional<double>> sizes(effects);
  const std::vector<std::string> parts = split(list);
  if (parts.empty()) return sizes;
  if (parts.size() != effects) {
    throw InputError({fmt::format("{} sizes for {} effects", parts.size(), effects), "--size", list,
                      "one number an effect, in its order", ""});
  }
  for (std::size_t i = 0; i < effects; ++i) {
    double value = 0.0;
    if (!CLI::detail::lexical_cast(parts[i], value) || std::isnan(value)) {
      throw InputError({fmt::format("'{}' is not a number", parts[i]), "--size", parts[i],
                        "a number in the unit of the effect's size, see rollrig_blind list", ""});
    }
    const EffectKind& kind = *find_effect_kind(ids[i]);
    if (value < kind.lowest || value > kind.highest) {
      throw InputError({fmt::format("the size of {} is out of range", ids[i]), "--size", parts[i],
                        fmt::format("{:g} to {:g} {}: {}", kind.lowest, kind.highest, kind.unit, kind.meaning), ""});
    }
    sizes[i] = value;
  }
  return sizes;
}

std::vector<std::string> read_forms(const std::string& list, const std::vector<std::string>& ids) {
  std::vector<std::string> forms = split(list);
  if (!forms.empty() && forms.size() != ids.size()) {
    throw InputError({fmt::format("{} forms for {} effects", forms.size(), ids.size()), "--form", list,
                      "one form an effect, in its order", ""});
  }
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const EffectKind& kind = *find_effect_kind(ids[i]);
    if (find_form(kind, forms[i]) != nullptr) continue;
    std::vector<std::string> known;
    for (const Form& form : kind.forms) known.emplace_back(form.name);
    throw InputError({fmt::format("{} has no form '{}'", ids[i], forms[i]), "--form", forms[i],
                      fmt::format("{}", fmt::join(known, ", ")), find_nearest(forms[i], known)});
  }
  return forms;
}

}  // namespace blind
