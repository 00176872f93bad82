// What an effect owes to the diagnosis from its one file: a set simulated with it is named.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/diagnosis.h"
#include "measurements/resimulation.h"
#include "tests/diagnosis/answers.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/support/drum_sets.h"
#include "tests/support/fit_study.h"
#include "tests/support/machines.h"

using namespace rollrig;
using tests::contains;

namespace {

bool is_seen_on_drum(const models::EffectInfo& info) {
  return models::acts_in(info, tests::kDrum->traits, models::default_tire_model()) &&
         models::is_seen_on(info, tests::kDrum->traits);
}

/// The campaign measured again with an effect on: what its runs would have shown, and the sensors' noise.
measurements::MeasurementSet measure_with(const measurements::MeasurementSet& campaign,
                                          const models::ActiveEffect& effect) {
  measurements::MeasurementSet set = campaign;
  const models::Context<double> context = rigs::make_context(set.tire, *set.rig, set.baseline);
  for (measurements::MeasuredRun& run : set.runs) {
    models::Corner<double> corner(context, {effect});
    const auto recording = measurements::Resimulation(run, *set.kind).simulate(set, run, corner);
    for (const auto& [channel, sensor] : set.sensors) run.columns.at(channel) = recording.channel(channel);
  }
  return tests::add_noise(set, 7);
}

/// Of the sets that were diagnosed, those whose effect was named.
struct Named {
  int tried = 0;
  int named = 0;
};

/// Diagnoses a set simulated with each effect that a drum shows, or with every so many of them.
Named diagnose_each(std::size_t every) {
  constexpr double kLargeSize = 0.9;  // near the upper end of the prior
  measurements::MeasurementSet campaign = tests::simulate_campaign(tests::make_wide_campaign());
  for (measurements::MeasuredRun& run : campaign.runs) run = tests::thin_out(run, 4);
  std::vector<const models::Effect*> seen;
  for (const models::Effect* effect : models::all_effects()) {
    if (is_seen_on_drum(effect->info)) seen.push_back(effect);
  }
  Named count;
  for (std::size_t i = 0; i < seen.size(); i += every) {
    const std::string id = seen[i]->info.id;
    INFO(id);
    const auto set = measure_with(campaign, tests::make_effect_at(id, kLargeSize));
    const diagnosis::Diagnosis answer = diagnosis::diagnose(set, {});
    ++count.tried;
    if (answer.verdict == diagnosis::Verdict::kNoGap) {
      const bool is_trace = answer.trace.has_value() && contains(answer.trace->effects, id);
      CHECK((is_trace || contains(answer.not_excluded, id)));
      continue;
    }
    REQUIRE_FALSE(answer.causes.empty());
    const diagnosis::Cause& cause = answer.causes.front();
    CHECK((contains(cause.effects, id) || contains(cause.indistinguishable_from, id)));
    ++count.named;
  }
  return count;
}

}  // namespace

TEST_CASE("a set simulated with every fifth effect is named, a trace, or listed as one it would not show", "[slow]") {
  const Named count = diagnose_each(5);
  CHECK(count.tried >= 4);
  CHECK(2 * count.named >= count.tried);
}

TEST_CASE("a set simulated with an effect is named, a trace, or listed as one it would not show", "[weekly]") {
  CHECK(diagnose_each(1).named >= 12);
}
