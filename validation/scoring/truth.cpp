#include "validation/scoring/truth.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/effect.h"
#include "sim/core/error.h"
#include "validation/files.h"

namespace rollrig::validation {
namespace {

double number_or(const Json& json, const char* key, double otherwise) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number() ? at->get<double>() : otherwise;
}

TrueEffect read_effect(const Json& json) {
  TrueEffect effect;
  effect.id = json.at("id").get<std::string>();
  effect.size = number_or(json, "size", effect.size);
  effect.neutral = number_or(json, "neutral", std::numeric_limits<double>::infinity());
  effect.unit = json.value("unit", "");
  effect.size_class = json.value("size_class", "");
  return effect;
}

/// Sets made before the truth held hashes of the cases have none. Throws InputError.
void require_made_files(const std::string& set, const Json& cases) {
  std::vector<std::string> changed;
  for (const auto& [number, of] : cases.items()) {
    if (of.contains("set_sha256") && of["set_sha256"] != hash_case(case_folder(set, number))) changed.push_back(number);
  }
  if (changed.empty()) return;
  throw InputError({fmt::format("{} of {} cases are not the files that were made", changed.size(), cases.size()),
                    set + "/sets", 0, "case", changed.front(), "the files as rollrig_validation make wrote them", ""});
}

Truth read_truth(const std::string& number, const Json& json, const std::vector<std::string>& catalog) {
  Truth truth;
  truth.number = number;
  for (const Json& effect : json.at("effects")) truth.effects.push_back(read_effect(effect));
  truth.kind = json.value("kind", "drum");
  truth.campaign = json.value("campaign_kind", truth.kind);
  for (const auto& [channel, floors] : json.at("signal_floors").items()) {
    if (floors.is_number()) truth.signal_floors = std::max(truth.signal_floors, floors.get<double>());
  }
  for (const TrueEffect& effect : truth.effects) {
    if (std::find(catalog.begin(), catalog.end(), effect.id) == catalog.end()) truth.outside = true;
  }
  return truth;
}

}  // namespace

std::string Truth::name() const { return effects.empty() ? "none" : fmt::format("{}", fmt::join(ids(), "+")); }

std::vector<std::string> Truth::ids() const {
  std::vector<std::string> all;
  for (const TrueEffect& effect : effects) all.push_back(effect.id);
  return all;
}

bool Truth::is_within(const std::vector<std::string>& named) const {
  return !effects.empty() && std::all_of(effects.begin(), effects.end(), [&named](const TrueEffect& effect) {
    return std::find(named.begin(), named.end(), effect.id) != named.end();
  });
}

std::vector<Truth> read_truths(const std::string& set, const std::string& hash) {
  const std::vector<std::string> numbers = list_cases(set);
  const TruthFile opened = open_truth(set, hash);
  const std::string file = set + "/truth.json";
  std::vector<Truth> truths;
  std::vector<std::string> known;
  try {
    const std::vector<std::string> catalog = models::effect_ids();
    for (const auto& [number, of] : opened.cases.items()) {
      truths.push_back(read_truth(number, of, catalog));
      known.push_back(number);
    }
  } catch (const Json::exception& error) {
    throw InputError({fmt::format("not the truth of a validation set: {}", error.what()), file, 0, "", "", "", ""});
  }
  std::sort(known.begin(), known.end());
  if (known != numbers) {
    throw InputError({fmt::format("the truth is of {} cases, the validation set has {}", known.size(), numbers.size()),
                      file, 0, "sets", "", "the cases that were made, all of them", ""});
  }
  require_made_files(set, opened.cases);
  return truths;
}

}  // namespace rollrig::validation
