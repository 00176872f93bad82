#include "validation/generator/validation_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "validation/files.h"

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
    if (find_common_grounds(effects, *campaign.machine, true) != kNowhere) found.push_back(campaign);
  }
  return found;
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
  const std::vector<std::string> effects = drawn_effects(order.campaigns, true);
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
  add_outside(order, plans);
  draws.shuffle(plans);
  return plans;
}

MadeSet make_planned(const ValidationSetOrder& order, const Plan& plan, const std::string& name) {
  Draws draws(order.seed, "campaign/" + name);
  const CampaignChoice campaign = draws.pick(find_campaigns(order.campaigns, plan.effects));
  SetOrder set;
  set.name = name;
  set.effects = plan.effects;
  set.size_classes = plan.size_classes;
  set.sizes.resize(set.effects.size());
  set.seed = mix_seed(order.seed, "set/" + name);
  set.machine = campaign.machine;
  set.dyno_runs = campaign.dyno_runs;
  set.runs = std::min(order.runs, campaign.runs);
  MadeSet made = make_set(set, order.counterfactual);
  if (order.kind == kMixed) made.truth["campaign_kind"] = campaign.name;
  return made;
}

Json describe(const ValidationSetOrder& order) {
  Json truth = {{"format", validation::kTruthFormat},
                {"seed", order.seed},
                {"each", order.each},
                {"none", order.none},
                {"pairs", order.pairs}};
  if (order.singles > 0) truth["singles"] = order.singles;
  if (order.outside > 0) truth["outside"] = order.outside;
  if (order.kind != all_machines().front()->name()) truth["kind"] = order.kind;
  truth["sets"] = Json::object();
  return truth;
}

}  // namespace

std::vector<CampaignChoice> mixed_campaigns() {
  const Machine* drum = &find_machine("drum");
  const Machine* dyno = &find_machine("dyno");
  return {{"full_drum", drum, 6},
          {"short_drum", drum, 3},
          {"dyno_multi_cycle", dyno, 6, DynoRuns::kMultiCycle},
          {"dyno_constant_speed", dyno, 6, DynoRuns::kConstantSpeeds},
          {"dyno_mixed", dyno, 6},
          {"road", &find_machine("road"), 6}};
}

std::vector<std::string> drawn_effects(const std::vector<CampaignChoice>& campaigns, bool outside) {
  std::vector<std::string> ids;
  for (const EffectKind* effect : effect_kinds()) {
    if (effect->outside == outside && !find_campaigns(campaigns, {effect->id}).empty()) ids.emplace_back(effect->id);
  }
  return ids;
}

void write_validation_set(const ValidationSetOrder& order, const std::function<void(const std::string&)>& hashed,
                          const Progress& progress) {
  validation::require_new_folder(order.out, "--out");
  OutputFolder folder(order.out, true);
  const auto add = [&folder](const std::string& name, const Files& files) {
    for (const auto& [file, content] : files) folder.add(name + "/" + file, content);
  };
  const std::vector<Plan> plans = draw_plans(order);
  Json truth = describe(order);
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const std::string name = fmt::format("{:04}", i + 1);
    MadeSet made = make_planned(order, plans[i], name);
    add("sets/" + name, made.files);
    if (order.counterfactual) add("counterfactual/" + name, made.counterfactual);
    folder.flush();
    made.truth["set_sha256"] = validation::hash_files(made.files);
    truth["sets"][name] = std::move(made.truth);
    progress(i + 1, plans.size());
    throw_if_interrupted();
  }
  const std::string text = truth.dump(1) + "\n";
  const std::string sha256 = calc_sha256(text);
  folder.add("truth.json", text);
  folder.add("truth.sha256", sha256 + "  truth.json\n");
  hashed(sha256);
  folder.commit();
}

}  // namespace rollrig::generator
