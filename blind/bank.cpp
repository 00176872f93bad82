#include "blind/bank.h"

#include <fmt/format.h>

#include "blind/draws.h"
#include "blind/effect.h"
#include "blind/output.h"

namespace blind {
namespace {

using Causes = std::vector<std::vector<std::string>>;  // effects of each set

void add_pairs(const BankOrder& order, Draws& draws, Causes& causes) {
  const int last = static_cast<int>(order.effects.size()) - 1;
  for (int i = 0; i < order.pairs; ++i) {
    const int first = draws.whole(0, last);
    int second = draws.whole(0, last - 1);
    if (second >= first) ++second;
    std::vector<std::string> pair{order.effects[static_cast<std::size_t>(first)],
                                  order.effects[static_cast<std::size_t>(second)]};
    if (find_common_grounds(pair, order.kind, true) == kNowhere) {
      --i;  // not on one road against one law
    } else {
      causes.push_back(std::move(pair));
    }
  }
}

void add_outside(const BankOrder& order, Causes& causes) {
  const std::vector<std::string> effects = drawn_effects(order.kind, true);
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.outside); ++i) {
    causes.push_back({effects[i % effects.size()]});
  }
}

Causes draw_causes(const BankOrder& order) {
  Draws draws(order.seed, "bank");
  Causes causes(static_cast<std::size_t>(order.none));
  for (const std::string& effect : order.effects) {
    causes.insert(causes.end(), static_cast<std::size_t>(order.each), {effect});
  }
  add_pairs(order, draws, causes);
  add_outside(order, causes);
  for (std::size_t i = causes.size(); i > 1; --i) {
    std::swap(causes[i - 1], causes[static_cast<std::size_t>(draws.whole(0, static_cast<int>(i) - 1))]);
  }
  return causes;
}

}  // namespace

std::vector<std::string> drawn_effects(Kind kind, bool outside) {
  std::vector<std::string> ids;
  for (const EffectKind* effect : effect_kinds()) {
    if (effect->outside == outside && (effect->drawn & grounds_of(kind)) != 0) ids.push_back(effect->id);
  }
  return ids;
}

void write_bank(const BankOrder& order, const std::function<void(const std::string&)>& sealed,
                const std::function<void(std::size_t, std::size_t)>& progress) {
  StagedFolder folder(order.out, "--out");
  const Causes causes = draw_causes(order);
  nlohmann::ordered_json truth = {{"format", "rollrig-blind-bank/1"},
                                  {"seed", order.seed},
                                  {"each", order.each},
                                  {"none", order.none},
                                  {"pairs", order.pairs}};
  if (order.outside > 0) truth["outside"] = order.outside;
  if (order.kind != Kind::kDrum) truth["kind"] = name_of(order.kind);
  truth["sets"] = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < causes.size(); ++i) {
    SetOrder set;
    set.name = fmt::format("{:04}", i + 1);
    set.effects = causes[i];
    set.sizes.resize(set.effects.size());
    set.seed = mix_seed(order.seed, "set/" + set.name);
    set.kind = order.kind;
    set.runs = order.runs;
    MadeSet made = make_set(set, order.counterfactual);
    folder.write("sets/" + set.name, made.files);
    if (order.counterfactual) folder.write("counterfactual/" + set.name, made.counterfactual);
    truth["sets"][set.name] = std::move(made.truth);
    progress(i + 1, causes.size());
  }
  const std::string text = truth.dump(1) + "\n";
  folder.write("truth.json", text);
  sealed(calc_sha256(text));
  folder.commit();
}

}  // namespace blind
