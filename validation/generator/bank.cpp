#include "validation/generator/bank.h"

#include <fmt/format.h>

#include <algorithm>

#include "validation/generator/draws.h"
#include "validation/generator/effect.h"
#include "validation/generator/interrupt.h"
#include "validation/generator/output.h"

namespace blind {
namespace {

/// One set to be.
struct Plan {
  std::vector<std::string> effects;
  std::vector<SizeClass> size_classes = {};
};

SizeClass class_in_turn(int turn) { return static_cast<SizeClass>(turn % static_cast<int>(kSizeClassNames.size())); }

void add_pairs(const BankOrder& order, Draws& draws, std::vector<Plan>& plans) {
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

/// Effects in an order of the seed, so that where there are fewer sets than effects it is not the last that lack.
void add_singles(const BankOrder& order, std::vector<Plan>& plans) {
  Draws draws(order.seed, "bank/singles");
  std::vector<std::string> effects = order.effects;
  for (std::size_t i = effects.size(); i > 1; --i) {
    std::swap(effects[i - 1], effects[static_cast<std::size_t>(draws.whole(0, static_cast<int>(i) - 1))]);
  }
  const int count = static_cast<int>(effects.size());
  for (int i = 0; i < order.singles; ++i) {
    plans.push_back({{effects[static_cast<std::size_t>(i % count)]}, {class_in_turn(i % count + i / count)}});
  }
}

void add_outside(const BankOrder& order, std::vector<Plan>& plans) {
  const std::vector<std::string> effects = drawn_effects(order.campaigns, true);
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.outside); ++i) {
    plans.push_back({{effects[i % effects.size()]}});
  }
}

std::vector<Plan> draw_plans(const BankOrder& order) {
  Draws draws(order.seed, "bank");
  std::vector<Plan> plans(static_cast<std::size_t>(order.none));
  for (const std::string& effect : order.effects) {
    plans.insert(plans.end(), static_cast<std::size_t>(order.each), Plan{{effect}});
  }
  add_singles(order, plans);
  add_pairs(order, draws, plans);
  add_outside(order, plans);
  for (std::size_t i = plans.size(); i > 1; --i) {
    std::swap(plans[i - 1], plans[static_cast<std::size_t>(draws.whole(0, static_cast<int>(i) - 1))]);
  }
  return plans;
}

CampaignChoice draw_campaign_choice(const BankOrder& order, const Plan& plan, const std::string& set) {
  const std::vector<CampaignChoice> choices = find_campaigns(order.campaigns, plan.effects);
  Draws draws(order.seed, "campaign/" + set);
  return choices[static_cast<std::size_t>(draws.whole(0, static_cast<int>(choices.size()) - 1))];
}

MadeSet make_planned(const BankOrder& order, const Plan& plan, const std::string& name) {
  const CampaignChoice campaign = draw_campaign_choice(order, plan, name);
  SetOrder set;
  set.name = name;
  set.effects = plan.effects;
  set.size_classes = plan.size_classes;
  set.sizes.resize(set.effects.size());
  set.seed = mix_seed(order.seed, "set/" + name);
  set.kind = campaign.kind;
  set.dyno_runs = campaign.dyno_runs;
  set.runs = std::min(order.runs, campaign.runs);
  MadeSet made = make_set(set, order.counterfactual);
  const std::string campaign_kind = campaign.name;
  if (!campaign_kind.empty()) made.truth["campaign_kind"] = campaign_kind;
  return made;
}

nlohmann::ordered_json describe(const BankOrder& order) {
  nlohmann::ordered_json truth = {{"format", "rollrig-blind-bank/1"},
                                  {"seed", order.seed},
                                  {"each", order.each},
                                  {"none", order.none},
                                  {"pairs", order.pairs}};
  if (order.singles > 0) truth["singles"] = order.singles;
  if (order.outside > 0) truth["outside"] = order.outside;
  if (order.kind != name_of(Kind::kDrum)) truth["kind"] = order.kind;
  truth["sets"] = nlohmann::ordered_json::object();
  return truth;
}

}  // namespace

std::vector<CampaignChoice> find_campaigns(const std::vector<CampaignChoice>& campaigns,
                                           const std::vector<std::string>& effects) {
  std::vector<CampaignChoice> found;
  for (const CampaignChoice& campaign : campaigns) {
    if (find_common_grounds(effects, campaign.kind, true) != kNowhere) found.push_back(campaign);
  }
  return found;
}

std::vector<std::string> drawn_effects(const std::vector<CampaignChoice>& campaigns, bool outside) {
  std::vector<std::string> ids;
  for (const EffectKind* effect : effect_kinds()) {
    if (effect->outside == outside && !find_campaigns(campaigns, {effect->id}).empty()) ids.emplace_back(effect->id);
  }
  return ids;
}

void write_bank(const BankOrder& order, const std::function<void(const std::string&)>& sealed,
                const std::function<void(std::size_t, std::size_t)>& progress) {
  StagedFolder folder(order.out, "--out");
  const std::vector<Plan> plans = draw_plans(order);
  nlohmann::ordered_json truth = describe(order);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const std::string name = fmt::format("{:04}", i + 1);
    MadeSet made = make_planned(order, plans[i], name);
    folder.write("sets/" + name, made.files);
    if (order.counterfactual) folder.write("counterfactual/" + name, made.counterfactual);
    made.truth["set_sha256"] = hash_files(made.files);
    truth["sets"][name] = std::move(made.truth);
    progress(i + 1, plans.size());
    throw_if_interrupted();
  }
  const std::string text = truth.dump(1) + "\n";
  const std::string sha256 = calc_sha256(text);
  folder.write("truth.json", text);
  folder.write("seal.sha256", sha256 + "  truth.json\n");
  sealed(sha256);
  folder.commit();
}

}  // namespace blind
