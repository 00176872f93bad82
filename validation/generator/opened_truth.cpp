#include "validation/generator/opened_truth.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "validation/generator/effect.h"
#include "validation/generator/kind_options.h"
#include "validation/generator/output.h"
#include "validation/generator/problem.h"

namespace fs = std::filesystem;

namespace blind {
namespace {

using Json = nlohmann::ordered_json;

InputError no_truth(const std::string& what) {
  return InputError({"not the truth of a bank: " + what, "bank", "", "a folder made by this rollrig_blind bank", ""});
}

DynoRuns read_dyno_runs(const Json& truth) {
  const std::string name = truth.value("campaign_kind", "");
  for (const CampaignChoice& campaign : kMixedCampaigns) {
    if (name == campaign.name) return campaign.dyno_runs;
  }
  return DynoRuns::kAsUsual;
}

void read_effect(const Json& effect, SetOrder& order) {
  const auto id = effect.at("id").get<std::string>();
  const auto form = effect.at("form").get<std::string>();
  const EffectKind* kind = find_effect_kind(id);
  if (kind == nullptr) throw no_truth(fmt::format("no effect '{}'", id));
  if (find_form(*kind, form) == nullptr) throw no_truth(fmt::format("{} has no form '{}'", id, form));
  order.effects.push_back(id);
  order.forms.push_back(form);
  order.sizes.emplace_back(effect.at("size").get<double>());
}

}  // namespace

OpenedTruth open_truth(const std::string& bank) {
  const std::string text = read_whole((fs::path(bank) / "truth.json").string());
  std::istringstream seal(read_whole((fs::path(bank) / "seal.sha256").string()));
  OpenedTruth opened;
  opened.sha256 = calc_sha256(text);
  std::string sealed;
  if (!(seal >> sealed) || sealed != opened.sha256) {
    throw InputError({"truth.json is not the file that was sealed", "bank", bank, "SHA-256 " + sealed, ""});
  }
  try {
    opened.sets = Json::parse(text).at("sets");
  } catch (const Json::exception& error) {
    throw no_truth(error.what());
  }
  return opened;
}

SetOrder read_order(const Json& truth) {
  SetOrder order;
  try {
    order.name = truth.at("name").get<std::string>();
    order.seed = truth.at("seed").get<std::uint64_t>();
    order.runs = truth.at("runs").get<int>();
    order.noise_free = truth.at("noise_free").get<bool>();
    order.kind = read_kind(truth.value("kind", name_of(Kind::kDrum)));
    order.dyno_runs = read_dyno_runs(truth);
    if (truth.contains("baseline")) order.constant_rrc = truth.at("baseline") == "constant_rrc";
    for (const Json& effect : truth.at("effects")) read_effect(effect, order);
  } catch (const Json::exception& error) {
    throw no_truth(error.what());
  }
  return order;
}

void require_same_files(const std::string& folder, const SetOrder& order) {
  for (const auto& [name, content] : make_set(order, false).files) {
    if (read_whole((fs::path(folder) / name).string()) == content) continue;
    throw InputError({fmt::format("'{}/{}' is not what this program makes of its truth", folder, name), "bank", folder,
                      "a bank made by this version of rollrig_blind", ""});
  }
}

}  // namespace blind
