// Sets of a flat belt: what the generator makes, rollrig reads and diagnoses.
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "tests/support/machines.h"
#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using namespace rollrig::tests;

TEST_CASE("a generated set of a flat belt is read as one", "[fast]") {
  const GeneratedSet made = make_generated_set("--kind flat_belt --effect none --seed 3 --runs 1");
  CHECK(made.set.kind == kFlatBelt);
  CHECK(made.truth.at("kind") == "flat_belt");
  CHECK_FALSE(made.set.rig->is_curved());
  CHECK(made.set.runs.front().has_samples(kFlatBelt->traits.force));
  CHECK(made.set.assumed_sensors.empty());
}

TEST_CASE("a diagnosis names what is hidden in a set of a flat belt, and finds no gap where nothing is", "[slow]") {
  const auto diagnose = [](const std::string& hidden) {
    return diagnosis::diagnose(make_generated_set("--kind flat_belt --seed 8 --effect " + hidden).set, {});
  };
  CHECK(diagnose("none").verdict == diagnosis::Verdict::kNoGap);
  for (const std::string effect : {"tire_loss_in_skim --size 3", "slow_leak --size 2"}) {
    const diagnosis::Diagnosis found = diagnose(effect);
    INFO(effect);
    CHECK(found.verdict == diagnosis::Verdict::kExplained);
    REQUIRE_FALSE(found.causes.empty());
    CHECK(found.causes.front().effects == std::vector<std::string>{effect.substr(0, effect.find(' '))});
  }
}
