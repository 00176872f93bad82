#include "validation/generator/machine_pairs.h"

#include <fmt/format.h>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
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

Json describe_pair(const PairPlan& pair, const std::array<MadeSet, 2>& made, std::optional<double> d_prime) {
  const auto or_null = [](const std::string& id) { return id.empty() ? Json(nullptr) : Json(id); };
  return {{"effect", or_null(pair.effect)},
          {"on", pair.effect.empty() ? Json(nullptr) : Json(pair.on == 0 ? "A" : "B")},
          {"tire_effect", or_null(pair.tire_effect)},
          {"d_prime", d_prime.has_value() ? Json(*d_prime) : Json(nullptr)},
          {"a", made[0].truth},
          {"b", made[1].truth}};
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

void write_pairs(const PairsOrder& order, const std::function<void(const std::string&)>& hashed,
                 const Progress& progress) {
  validation::require_new_folder(order.out, "--out");
  OutputFolder folder(order.out, false);
  const std::vector<PairPlan> pairs = draw_pairs(order);
  std::vector<std::array<MadeSet, 2>> made(pairs.size());
  std::vector<std::optional<double>> d_prime(pairs.size());
  const auto make_pair = [&](std::size_t i) {
    for (std::size_t k = 0; k < kFolders.size(); ++k) made[i][k] = make_set(pairs[i].sets[k], false);
    if (!pairs[i].effect.empty()) d_prime[i] = find_pair_detectability(pairs[i]);
    throw_if_interrupted();
  };
  parallel_for(pairs.size(), order.threads, make_pair, progress);
  Json truth = {{"format", validation::kPairsTruthFormat},
                {"seed", order.seed},
                {"differing", order.differing},
                {"none", order.none},
                {"runs", order.runs},
                {"sets", Json::object()}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::map<std::string, std::string> files;
    for (std::size_t k = 0; k < kFolders.size(); ++k) {
      for (auto& [file, content] : made[i][k].files)
        files[fmt::format("{}/{}", kFolders[k], file)] = std::move(content);
    }
    Json described = describe_pair(pairs[i], made[i], d_prime[i]);
    described["set_sha256"] = validation::hash_files(files);
    truth["sets"][pairs[i].name] = std::move(described);
    for (const auto& [file, content] : files) folder.add(fmt::format("sets/{}/{}", pairs[i].name, file), content);
  }
  const std::string text = to_text(truth, 1);
  const std::string sha256 = calc_sha256(text);
  folder.add("truth.json", text);
  folder.add("truth.sha256", sha256 + "  truth.json\n");
  folder.flush();
  hashed(sha256);
  throw_if_interrupted();
  folder.commit();
}

}  // namespace rollrig::generator
