#include "validation/generator/validation_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "validation/files.h"

namespace fs = std::filesystem;

namespace rollrig::generator {
namespace {

/// One case to be.
struct Plan {
  std::vector<std::string> effects;
  std::vector<SizeClass> size_classes = {};
};

SizeClass class_in_turn(int turn) { return static_cast<SizeClass>(turn % static_cast<int>(kSizeClassNames.size())); }

/// Those of `campaigns` in which sets have all of `effects` together.
std::vector<CampaignChoice> find_campaigns(const std::vector<CampaignChoice>& campaigns,
                                           const std::vector<std::string>& effects) {
  std::vector<CampaignChoice> found;
  for (const CampaignChoice& campaign : campaigns) {
    if (find_common_laws(effects, *campaign.machine, true).any()) found.push_back(campaign);
  }
  return found;
}

/// Effects that sets of `campaigns` have, of those that belong.
template <class Belongs>
std::vector<std::string> find_drawn(const std::vector<CampaignChoice>& campaigns, const Belongs& belongs) {
  std::vector<std::string> ids;
  for (const EffectKind* effect : effect_kinds()) {
    if (belongs(*effect) && !find_campaigns(campaigns, {effect->id}).empty()) ids.emplace_back(effect->id);
  }
  return ids;
}

void add_pairs(const ValidationSetOrder& order, Draws& draws, std::vector<Plan>& plans) {
  const int last = static_cast<int>(order.effects.size()) - 1;
  for (int i = 0; i < order.pairs; ++i) {
    const int first = draws.whole(0, last);
    int second = draws.whole(0, last - 1);
    if (second >= first) ++second;
    std::vector<std::string> pair{order.effects[static_cast<std::size_t>(first)],
                                  order.effects[static_cast<std::size_t>(second)]};
    if (find_campaigns(order.campaigns, pair).empty()) {
      --i;  // not on one rig, or not on one road against one law
    } else {
      Plan plan{std::move(pair)};
      if (order.singles > 0) plan.size_classes = {class_in_turn(i), class_in_turn(i / 3)};
      plans.push_back(std::move(plan));
    }
  }
}

/// From a stream of its own, so that validation sets without triples stay as they were.
void add_triples(const ValidationSetOrder& order, std::vector<Plan>& plans) {
  constexpr std::size_t kEffects = 3;
  Draws draws(order.seed, "bank/triples");
  std::vector<std::string> effects = order.effects;
  for (int added = 0; added < order.triples;) {
    draws.shuffle(effects);
    const std::vector<std::string> triple(effects.begin(), effects.begin() + kEffects);
    if (find_campaigns(order.campaigns, triple).empty()) continue;
    plans.push_back({triple});
    ++added;
  }
}

/// Effects in an order of the seed, so that where there are fewer cases than effects it is not the last that lack.
void add_singles(const ValidationSetOrder& order, std::vector<Plan>& plans) {
  Draws draws(order.seed, "bank/singles");
  std::vector<std::string> effects = order.effects;
  draws.shuffle(effects);
  const int count = static_cast<int>(effects.size());
  for (int i = 0; i < order.singles; ++i) {
    plans.push_back({{effects[static_cast<std::size_t>(i % count)]}, {class_in_turn(i % count + i / count)}});
  }
}

void add_outside(const ValidationSetOrder& order, std::vector<Plan>& plans) {
  const std::vector<std::string> effects = drawn_outside_effects(order.campaigns, order.outside_list);
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.outside); ++i) {
    plans.push_back({{effects[i % effects.size()]}});
  }
}

std::vector<Plan> draw_plans(const ValidationSetOrder& order) {
  Draws draws(order.seed, "bank");
  std::vector<Plan> plans(static_cast<std::size_t>(order.none));
  for (const std::string& effect : order.effects) {
    plans.insert(plans.end(), static_cast<std::size_t>(order.each), Plan{{effect}});
  }
  add_singles(order, plans);
  add_pairs(order, draws, plans);
  add_triples(order, plans);
  add_outside(order, plans);
  draws.shuffle(plans);
  return plans;
}

SetOrder order_case(const ValidationSetOrder& order, const Plan& plan, const std::string& name) {
  Draws draws(order.seed, "campaign/" + name);
  const CampaignChoice campaign = draws.pick(find_campaigns(order.campaigns, plan.effects));
  SetOrder set;
  set.name = name;
  set.effects = plan.effects;
  set.size_classes = plan.size_classes;
  set.sizes.resize(set.effects.size());
  set.seed = mix_seed(order.seed, "set/" + name);
  set.machine = campaign.machine;
  set.run_kind = campaign.run_kind;
  set.runs = std::min(order.runs, campaign.runs);
  set.campaign = campaign.name;
  return set;
}

Json describe_order(const ValidationSetOrder& order) {
  Json truth = {{"format", validation::kTruthFormat},
                {"seed", order.seed},
                {"each", order.each},
                {"none", order.none},
                {"pairs", order.pairs}};
  if (order.singles > 0) truth["singles"] = order.singles;
  if (order.triples > 0) truth["triples"] = order.triples;
  if (order.outside > 0) truth["outside"] = order.outside;
  if (order.outside_list != OutsideList::kFirst) {
    truth["outside_list"] = kOutsideListNames[static_cast<std::size_t>(order.outside_list)];
  }
  if (order.kind != all_machines().front()->word) truth["kind"] = order.kind;
  truth["sets"] = Json::object();
  return truth;
}

/// Where the files of a case go, and in its JSON their contents.
constexpr std::array<const char*, 2> kCaseFolders{"sets", "counterfactual"};

/// A case: its truth, and its files by name.
Json make_case(const SetOrder& order, bool with_counterfactual) {
  MadeSet made = make_set(order, with_counterfactual);
  made.truth["set_sha256"] = validation::hash_files(made.files);
  return {{"truth", std::move(made.truth)},
          {kCaseFolders[0], std::move(made.files)},
          {kCaseFolders[1], std::move(made.counterfactual)}};
}

constexpr const char* kAllowed = "a validation set made by this version of rollrig_validation";

InputError no_truth(const std::string& what) {
  return InputError({"not the truth of a case: " + what, "", 0, "", "", kAllowed, ""});
}

std::string read_run_kind(const Json& truth) {
  const std::string name = truth.value("campaign_kind", "");
  for (const CampaignChoice& campaign : mixed_campaigns()) {
    if (name == campaign.name) return campaign.run_kind;
  }
  return "";
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

std::vector<CampaignChoice> mixed_campaigns() {
  std::vector<CampaignChoice> choices;
  for (const Machine* machine : all_machines()) {
    for (const auto& [name, runs, run_kind] : machine->mixed) choices.push_back({name, machine, runs, run_kind});
  }
  return choices;
}

std::vector<std::string> drawn_effects(const std::vector<CampaignChoice>& campaigns) {
  return find_drawn(campaigns, [](const EffectKind& effect) { return !effect.outside; });
}

std::vector<std::string> drawn_outside_effects(const std::vector<CampaignChoice>& campaigns, OutsideList list) {
  return find_drawn(campaigns,
                    [list](const EffectKind& effect) { return effect.outside && effect.outside_list == list; });
}

std::vector<SetOrder> draw_cases(const ValidationSetOrder& order) {
  std::vector<SetOrder> cases;
  for (const Plan& plan : draw_plans(order)) {
    cases.push_back(order_case(order, plan, fmt::format("{:04}", cases.size() + 1)));
  }
  return cases;
}

void write_validation_set(const ValidationSetOrder& order, const MakeItems& make_items,
                          const std::function<void(const std::string&)>& hashed) {
  validation::require_new_folder(order.out, "--out");
  OutputFolder folder(order.out, false);
  const std::vector<SetOrder> cases = draw_cases(order);
  Json truth = describe_order(order);
  for (const SetOrder& one : cases)
    truth["sets"][one.name] = nullptr;  // the order does not depend on which is made first
  const auto take = [&](const Json& made) {
    const auto name = made.at("truth").at("name").get<std::string>();
    for (const char* kind : kCaseFolders) {
      for (const auto& [file, content] : made.at(kind).items()) {
        folder.add(fmt::format("{}/{}/{}", kind, name, file), content.get<std::string>());
      }
    }
    folder.flush();
    truth["sets"][name] = made.at("truth");
  };
  make_items(
      cases.size(), [&](std::size_t i) { return make_case(cases[i], order.counterfactual); }, take);
  commit_with_truth(folder, truth, hashed);
}

void commit_with_truth(OutputFolder& folder, const Json& truth, const std::function<void(const std::string&)>& hashed) {
  const std::string text = to_text(truth, 1);
  const std::string sha256 = calc_sha256(text);
  folder.add("truth.json", text);
  folder.add("truth.sha256", sha256 + "  truth.json\n");
  folder.flush();
  hashed(sha256);
  throw_if_interrupted();
  folder.commit();
}

SetOrder read_order(const Json& truth) {
  SetOrder order;
  try {
    order.name = truth.at("name").get<std::string>();
    order.seed = truth.at("seed").get<std::uint64_t>();
    order.runs = truth.at("runs").get<int>();
    order.noise_free = truth.at("noise_free").get<bool>();
    order.machine = &find_machine(truth.value("kind", all_machines().front()->word), "kind");
    order.run_kind = read_run_kind(truth);
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
    if (read_table_file(file) == content) continue;
    throw InputError(
        {fmt::format("'{}' is not what this program makes of its truth", file), file, 0, "", "", kAllowed, ""});
  }
}

}  // namespace rollrig::generator
