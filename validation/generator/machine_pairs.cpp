#include "validation/generator/machine_pairs.h"

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "validation/files.h"
#include "validation/generator/known_set.h"
#include "validation/generator/observer.h"

namespace rollrig::generator {
namespace {

constexpr std::array<const char*, 2> kFolders{"a", "b"};
constexpr Eigen::Index kTireNumbers = static_cast<Eigen::Index>(Base::kF) + 1;

struct PairKind {
  std::string effect;
  SizeClass size_class = SizeClass::kMiddle;
  std::string tire_effect;
};

std::vector<PairKind> list_pair_kinds(const PairsOrder& order) {
  std::vector<PairKind> kinds;
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.differing); ++i) {
    const std::size_t round = i / kPairEffects.size();
    kinds.push_back({kPairEffects[i % kPairEffects.size()], static_cast<SizeClass>(round % kSizeClassNames.size()),
                     round % 2 == 0 ? "" : kPairTireEffects[(round / 2) % kPairTireEffects.size()]});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(order.none); ++i) {
    kinds.push_back({"", SizeClass::kMiddle, i % 2 == 0 ? "" : kPairTireEffects[(i / 2) % kPairTireEffects.size()]});
  }
  return kinds;
}

void add_pair_effect(const std::string& id, std::optional<SizeClass> size_class, Draws& draws,
                     const std::vector<SetOrder*>& sets) {
  const EffectKind& kind = *find_effect_kind(id);
  const double size = size_class.has_value() ? draw_size(kind, *size_class, draws) : draw_size(kind, draws);
  const char* form = draws.pick(kind.forms).name;
  for (SetOrder* set : sets) {
    set->effects.push_back(id);
    set->sizes.emplace_back(size);
    set->forms.emplace_back(form);
  }
}

PairPlan plan_pair(const PairsOrder& order, const PairKind& kind, const std::string& name) {
  Draws draws(order.seed, "pair/" + name);
  PairPlan pair;
  pair.name = name;
  pair.effect = kind.effect;
  pair.tire_effect = kind.tire_effect;
  pair.on = draws.happens(0.5) ? 1 : 0;
  for (std::size_t i = 0; i < kFolders.size(); ++i) {
    SetOrder& set = pair.sets[i];
    set.name = fmt::format("{}-{}", name, kFolders[i]);
    set.seed = mix_seed(order.seed, fmt::format("pair/{}/{}", name, kFolders[i]));
    set.tire_seed = mix_seed(order.seed, fmt::format("pair/{}/tire", name));
    set.runs = order.runs;
  }
  if (!kind.tire_effect.empty()) {
    add_pair_effect(kind.tire_effect, std::nullopt, draws, {&pair.sets[0], &pair.sets[1]});
    for (SetOrder& set : pair.sets) set.common_effects = 1;
  }
  if (!kind.effect.empty()) add_pair_effect(kind.effect, kind.size_class, draws, {&pair.sets[pair.on]});
  return pair;
}

/// The offsets of one set's sensors and its numbers: those of the tire, and those that are its own.
struct SetUnknowns {
  Eigen::MatrixXd tire;
  Eigen::MatrixXd own;
};

SetUnknowns find_set_unknowns(const KnownSet& set) {
  const Eigen::MatrixXd all = set.unknowns();  // offsets, then the numbers of tire and rig in the order of Base
  const Eigen::Index rig = static_cast<Eigen::Index>(Base::kC2) - static_cast<Eigen::Index>(Base::kF);
  const Eigen::Index offsets = all.cols() - kTireNumbers - rig;
  SetUnknowns found{all.middleCols(offsets, kTireNumbers), Eigen::MatrixXd(all.rows(), offsets + rig)};
  found.own << all.leftCols(offsets), all.rightCols(rig);
  return found;
}

/// A pair: its truth, and its files by name.
Json make_pair_of_sets(const PairPlan& pair) {
  const auto or_null = [](const std::string& id) { return id.empty() ? Json(nullptr) : Json(id); };
  Files files;
  std::array<Json, 2> truths;
  for (std::size_t k = 0; k < kFolders.size(); ++k) {
    MadeSet made = make_set(pair.sets[k], false);
    for (auto& [file, content] : made.files) files[fmt::format("{}/{}", kFolders[k], file)] = std::move(content);
    truths[k] = std::move(made.truth);
  }
  const bool differs = !pair.effect.empty();
  Json truth = {{"effect", or_null(pair.effect)},
                {"on", differs ? Json(pair.on == 0 ? "A" : "B") : Json(nullptr)},
                {"tire_effect", or_null(pair.tire_effect)},
                {"d_prime", differs ? Json(find_pair_detectability(pair)) : Json(nullptr)},
                {"a", std::move(truths[0])},
                {"b", std::move(truths[1])},
                {"set_sha256", validation::hash_files(files)}};
  return {{"name", pair.name}, {"truth", std::move(truth)}, {"files", std::move(files)}};
}

}  // namespace

std::vector<PairPlan> draw_pairs(const PairsOrder& order) {
  std::vector<PairKind> kinds = list_pair_kinds(order);
  Draws draws(order.seed, "pairs");
  draws.shuffle(kinds);
  std::vector<PairPlan> pairs;
  for (const PairKind& kind : kinds) pairs.push_back(plan_pair(order, kind, fmt::format("{:04}", pairs.size() + 1)));
  return pairs;
}

double find_pair_detectability(const PairPlan& pair) {
  const KnownSet with(pair.sets[pair.on]);
  const KnownSet without(pair.sets[1 - pair.on]);
  const Eigen::VectorXd change = with.signal_of(pair.sets[pair.on].effects.size() - 1);
  const SetUnknowns first = find_set_unknowns(with);
  const SetUnknowns second = find_set_unknowns(without);
  Eigen::VectorXd signal = Eigen::VectorXd::Zero(first.tire.rows() + second.tire.rows());
  signal.head(change.size()) = change;
  Eigen::MatrixXd unknowns = Eigen::MatrixXd::Zero(signal.size(), kTireNumbers + first.own.cols() + second.own.cols());
  unknowns.topLeftCorner(first.tire.rows(), kTireNumbers) = first.tire;
  unknowns.bottomLeftCorner(second.tire.rows(), kTireNumbers) = second.tire;
  unknowns.block(0, kTireNumbers, first.own.rows(), first.own.cols()) = first.own;
  unknowns.bottomRightCorner(second.own.rows(), second.own.cols()) = second.own;
  return Observer(unknowns).reduce(signal).norm();
}

void write_pairs(const PairsOrder& order, const MakeItems& make_items,
                 const std::function<void(const std::string&)>& hashed) {
  validation::require_new_folder(order.out, "--out");
  OutputFolder folder(order.out, false);
  const std::vector<PairPlan> pairs = draw_pairs(order);
  Json truth = {{"format", validation::kPairsTruthFormat},
                {"seed", order.seed},
                {"differing", order.differing},
                {"none", order.none},
                {"runs", order.runs},
                {"sets", Json::object()}};
  for (const PairPlan& pair : pairs)
    truth["sets"][pair.name] = nullptr;  // the order does not depend on which is made first
  const auto take = [&](const Json& made) {
    const auto name = made.at("name").get<std::string>();
    for (const auto& [file, content] : made.at("files").items()) {
      folder.add(fmt::format("sets/{}/{}", name, file), content.get<std::string>());
    }
    folder.flush();
    truth["sets"][name] = made.at("truth");
  };
  make_items(
      pairs.size(), [&](std::size_t i) { return make_pair_of_sets(pairs[i]); }, take);
  commit_with_truth(folder, truth, hashed);
}

}  // namespace rollrig::generator
