#include "validation/generator/known_order.h"

#include <fmt/format.h>

#include <filesystem>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "validation/generator/validation_set.h"

namespace fs = std::filesystem;

namespace rollrig::generator {
namespace {

constexpr const char* kAllowed = "a validation set made by this version of rollrig_validation";

InputError no_truth(const std::string& what) {
  return InputError({"not the truth of a case: " + what, "", 0, "", "", kAllowed, ""});
}

DynoRuns read_dyno_runs(const Json& truth) {
  const std::string name = truth.value("campaign_kind", "");
  for (const CampaignChoice& campaign : mixed_campaigns()) {
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

SetOrder read_order(const Json& truth) {
  SetOrder order;
  try {
    order.name = truth.at("name").get<std::string>();
    order.seed = truth.at("seed").get<std::uint64_t>();
    order.runs = truth.at("runs").get<int>();
    order.noise_free = truth.at("noise_free").get<bool>();
    order.machine = &find_machine(truth.value("kind", all_machines().front()->name()));
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
    const std::string file = (fs::path(folder) / name).string();
    if (read_text_file(file) == content) continue;
    throw InputError(
        {fmt::format("'{}' is not what this program makes of its truth", file), file, 0, "", "", kAllowed, ""});
  }
}

}  // namespace rollrig::generator
