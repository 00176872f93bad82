// Pairs of machines: one tire, and an effect that changes nothing but what its own machine measures.
#include "validation/generator/machine_pairs.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>

#include "validation/generator/known_set.h"
#include "validation/generator/observer.h"
#include "validation/generator/upper_bound.h"

using namespace rollrig;
using namespace rollrig::generator;

namespace {

PairsOrder make_order() {
  PairsOrder order;
  order.seed = 77;
  order.differing = 12;
  order.none = 4;
  order.runs = 1;
  return order;
}

PairPlan find_pair(const PairsOrder& order, const std::string& effect) {
  for (const PairPlan& pair : draw_pairs(order)) {
    if (pair.effect == effect && pair.tire_effect.empty()) return pair;
  }
  throw std::logic_error("no such pair");
}

}  // namespace

TEST_CASE("pairs have each effect in turn, on either machine, with and without one of the tire", "[fast]") {
  std::map<std::string, int> effects;
  std::set<std::size_t> machines;
  int with_tire_effect = 0;
  for (const PairPlan& pair : draw_pairs(make_order())) {
    ++effects[pair.effect];
    if (!pair.effect.empty()) {
      machines.insert(pair.on);
      CHECK(pair.sets[pair.on].effects.back() == pair.effect);
    }
    const std::size_t common = pair.tire_effect.empty() ? 0 : 1;
    with_tire_effect += static_cast<int>(common);
    for (std::size_t i = 0; i < 2; ++i) {
      const bool has_own = !pair.effect.empty() && i == pair.on;
      CHECK(pair.sets[i].effects.size() == common + (has_own ? 1 : 0));
      if (common == 1) CHECK(pair.sets[i].effects.front() == pair.tire_effect);
    }
  }
  CHECK(effects.size() == kPairEffects.size() + 1);
  for (const char* effect : kPairEffects) CHECK(effects[effect] == 2);
  CHECK(effects[""] == 4);
  CHECK(machines.size() == 2);
  CHECK(with_tire_effect == 8);
}

TEST_CASE("both machines of a pair test one tire, each on a rig of its own", "[fast]") {
  const PairPlan pair = draw_pairs(make_order()).front();
  const Files a = make_set(pair.sets[0], false).files;
  const Files b = make_set(pair.sets[1], false).files;
  CHECK(a.at("tire.toml") == b.at("tire.toml"));
  CHECK(a.at("rig.toml") != b.at("rig.toml"));
  const Laboratory first = draw_laboratory(pair.sets[0]);
  const Laboratory second = draw_laboratory(pair.sets[1]);
  for (std::size_t i = 0; i < kBaseCount; ++i) {
    const bool is_of_tire = static_cast<Base>(i) <= Base::kF;
    INFO(first.specimen.base[i].key);
    if (static_cast<Base>(i) > Base::kC2) continue;
    CHECK((first.specimen.base[i].truth == second.specimen.base[i].truth) == is_of_tire);
  }
  CHECK(first.campaign.name == second.campaign.name);
}

TEST_CASE("the effect of a pair changes what its own machine measures, and no other file", "[fast]") {
  for (const char* effect : {"drum_diameter", "ambient_record", "surface_roughness"}) {
    INFO(effect);
    const PairPlan pair = find_pair(make_order(), effect);
    SetOrder without = pair.sets[pair.on];
    without.effects.clear();
    without.sizes.clear();
    without.forms.clear();
    const Files with_files = make_set(pair.sets[pair.on], false).files;
    for (const auto& [name, content] : make_set(without, false).files) {
      INFO(name);
      const bool is_run = name.find(".csv") != std::string::npos;
      CHECK((with_files.at(name) == content) == !is_run);
    }
  }
}

TEST_CASE("a rougher surface hides in the tire's numbers on one machine, and is seen beside a second one", "[fast]") {
  const PairPlan pair = find_pair(make_order(), "surface_roughness");
  const double alone = find_detectability(KnownSet(pair.sets[pair.on])).d_prime;
  const double in_pair = find_pair_detectability(pair);
  CHECK(in_pair > 1.5 * alone);
}

TEST_CASE("a second machine never makes an effect harder to see", "[slow]") {
  for (const char* effect : {"bearing_warmup", "speed_record"}) {
    INFO(effect);
    const PairPlan pair = find_pair(make_order(), effect);
    // Both are roots of squares of the same signal, of which the pair leaves less to the unknowns.
    CHECK(find_pair_detectability(pair) >= 0.999 * find_detectability(KnownSet(pair.sets[pair.on])).d_prime);
  }
}
