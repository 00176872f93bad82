// A measured run simulated again.
#include <catch2/catch.hpp>

#include "measurements/replay.h"
#include "tests/support/drum_sets.h"

using namespace rollrig;

TEST_CASE("a replay shows trace effects the recorded load and ambient", "[fast]") {
  tests::Campaign campaign = tests::make_short_campaign();
  measurements::MeasurementSet set = tests::simulate_campaign(campaign);
  measurements::MeasuredRun run = set.runs.front();
  std::vector<double>& ambient_K = run.columns.at("ambient_degC");
  for (std::size_t row = 0; row < ambient_K.size(); ++row) ambient_K[row] += 0.002 * run.time_s[row];
  const models::Effect& effect = models::find_effect("torque_zero_drift");
  const auto torque_with = [&](double ambient_min_per_K) {
    models::ActiveEffect drift = tests::make_effect_at("torque_zero_drift", 0.5);
    drift.parameters[2] = ambient_min_per_K * 60.0;
    models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), {drift});
    return measurements::replay_drum_run<double>(set, run, measurements::make_drum_replay(run), corner)
        .channel("drum_torque_Nm");
  };
  REQUIRE(std::string(effect.info.parameters[2].key) == "ambient_min_per_K");
  const std::vector<double> without = torque_with(0.0);
  const std::vector<double> with = torque_with(5.0);
  CHECK(with.front() == Approx(without.front()).margin(1e-3));
  CHECK(with.back() - without.back() > 0.01);  // the air is warmer than at the start, and the drift positive
}
