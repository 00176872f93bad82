#include "validation/scoring/bank.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "models/effect.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/json.h"

namespace fs = std::filesystem;

namespace rollrig::proof {
namespace {

constexpr const char* kBankFormat = "rollrig-blind-bank/1";

InputError problem(const std::string& what, const std::string& file, const std::string& key, const std::string& value,
                   const std::string& allowed) {
  return InputError({what, file, 0, key, value, allowed, ""});
}

/// Whatever is in a file; nothing where it cannot be read.
std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

/// The hash that truth.json must have. Throws InputError.
std::string find_seal(const std::string& bank, const std::string& given) {
  constexpr std::size_t kDigits = 64;
  const std::string file = (fs::path(bank) / "seal.sha256").string();
  if (given.empty() && !fs::exists(file)) {
    throw problem(fmt::format("'{}' has no seal.sha256", bank), file, "", "",
                  "--seal and the SHA-256 that was printed when the bank was made");
  }
  const std::string seal =
      boost::algorithm::to_lower_copy(given.empty() ? read_text_file(file).substr(0, kDigits) : given);
  if (seal.size() != kDigits || seal.find_first_not_of("0123456789abcdef") != std::string::npos) {
    throw problem("a seal that is no SHA-256", given.empty() ? file : "command line", given.empty() ? "" : "--seal",
                  seal, "64 hexadecimal digits");
  }
  return seal;
}

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

/// Banks made before the seal covered the sets have no hashes of them. Throws InputError.
void require_sealed_files(const std::string& bank, const Json& sets) {
  std::vector<std::string> changed;
  for (const auto& [set, of] : sets.items()) {
    const bool is_sealed = of.contains("set_sha256");
    if (is_sealed && of["set_sha256"] != hash_set(set_folder(bank, set))) changed.push_back(set);
  }
  if (changed.empty()) return;
  throw problem(
      fmt::format("the seal is broken: {} of {} sets are not the files that were sealed", changed.size(), sets.size()),
      (fs::path(bank) / "sets").string(), "set", changed.front(), "the files as rollrig blind make wrote them");
}

Truth read_truth(const std::string& set, const Json& json, const std::vector<std::string>& catalog) {
  Truth truth;
  truth.set = set;
  for (const Json& effect : json.at("effects")) truth.effects.push_back(read_effect(effect));
  truth.campaign = json.value("campaign_kind", json.value("kind", "drum"));
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

std::vector<std::string> list_sets(const std::string& bank) {
  const fs::path folder = fs::path(bank) / "sets";
  if (!fs::is_directory(folder)) {
    throw problem(fmt::format("no folder '{}'", folder.string()), bank, "bank", bank,
                  "a folder made by rollrig blind make, with its sets in sets/");
  }
  std::vector<std::string> sets;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) sets.push_back(entry.path().filename().string());
  }
  if (sets.empty()) throw problem(fmt::format("'{}' holds no sets", folder.string()), bank, "bank", bank, "");
  std::sort(sets.begin(), sets.end());
  return sets;
}

std::string set_folder(const std::string& bank, const std::string& set) {
  return (fs::path(bank) / "sets" / set).string();
}

std::string hash_set(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder).generic_string());
  }
  std::string all;
  for (const std::string& name : names) {
    all += fmt::format("{}  {}\n", calc_sha256(read_bytes(fs::path(folder) / name)), name);
  }
  return calc_sha256(all);
}

std::vector<Truth> open_truth(const std::string& bank, const std::string& seal) {
  const std::vector<std::string> sets = list_sets(bank);
  const std::string expected = find_seal(bank, seal);
  const std::string file = (fs::path(bank) / "truth.json").string();
  const std::string text = read_text_file(file);
  const std::string found = calc_sha256(text);
  if (found != expected) {
    throw problem("the seal is broken: truth.json is not the file that was sealed", file, "SHA-256", found, expected);
  }
  std::vector<Truth> truths;
  Json sealed_sets;
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kBankFormat) throw problem("not the truth of a bank", file, "format", "", kBankFormat);
    const std::vector<std::string> catalog = models::effect_ids();
    sealed_sets = json.at("sets");
    for (const auto& [set, of] : sealed_sets.items()) truths.push_back(read_truth(set, of, catalog));
  } catch (const Json::exception& error) {
    throw problem(fmt::format("not the truth of a bank: {}", error.what()), file, "", "", kBankFormat);
  }
  std::vector<std::string> sealed;
  for (const Truth& truth : truths) sealed.push_back(truth.set);
  std::sort(sealed.begin(), sealed.end());
  if (sealed != sets) {
    throw problem(fmt::format("the truth is of {} sets, the bank has {}", sealed.size(), sets.size()), file, "sets", "",
                  "the sets that were sealed, all of them");
  }
  require_sealed_files(bank, sealed_sets);
  return truths;
}

}  // namespace rollrig::proof
