// Sets that cannot be what they are said to be are met before the comparison, and sets that can are let through.
#include "diagnosis/checks/set_checks.h"

#include <fmt/format.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/checks/sample_checks.h"
#include "diagnosis/comparison/prepared_set.h"
#include "sim/core/assets.h"
#include "tests/diagnosis/checked_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::check_set;
using diagnosis::SetChecks;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using tests::Answer;
using tests::answer_to;
using tests::exchange_everywhere;
using tests::join;
using tests::kChannels;
using tests::short_set;

namespace {

/// A draw from the priors: log-normal or normal, two thirds between low and high.
models::ActiveEffect draw_effect(const models::Effect& effect, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) {
    const models::Prior& prior = parameter.prior;
    const double z = normal(random);
    double value = prior.scale == models::Prior::Scale::kLog
                       ? prior.center() * std::pow(prior.high / prior.low, 0.5 * z)
                       : prior.center() + 0.5 * z * (prior.high - prior.low);
    if (prior.either_sign && random() % 2 == 0) value = -value;
    values.push_back(std::clamp(value, parameter.range.lower, parameter.range.upper));
  }
  return tests::make_active(effect, values);
}

}  // namespace

TEST_CASE("a set as the simulator makes it is let through without a word", "[fast]") {
  const SetChecks checks = check_set(short_set());
  INFO(join(checks.warnings));
  CHECK(checks.warnings.empty());
  CHECK(checks.left_out.empty());
  CHECK_FALSE(checks.is_implausible());
}

TEST_CASE("runs of next to no samples are warned of", "[fast]") {
  const auto cut = [](std::size_t rows) {
    MeasurementSet set = short_set();
    for (MeasuredRun& run : set.runs) {
      run.time_s.resize(rows);
      for (auto& [name, values] : run.columns) values.resize(rows);
    }
    return join(check_set(set).warnings);
  };
  CHECK_THAT(cut(19), Contains("hardly any data in all runs"));
  CHECK_THAT(cut(diagnosis::kFewSamples - 1), Contains("hardly any data"));
  CHECK_THAT(cut(diagnosis::kFewSamples + 5), !Contains("hardly any data"));  // where the load jumps a row has none
}

namespace {

/// Checks sets with so many sizes of each effect of the catalog.
void check_effects(int draws) {
  int sets = 0;
  int stopped = 0;
  for (const models::Effect* effect : models::all_effects()) {
    if (!models::acts_in(effect->info, tests::kDrum->traits, models::default_tire_model())) continue;
    std::seed_seq seed(effect->info.id.begin(), effect->info.id.end());  // whatever effects there are beside it
    std::mt19937_64 random(seed);
    for (int i = 0; i < draws; ++i) {
      tests::Campaign campaign = tests::make_wide_campaign();
      campaign.effects = {draw_effect(*effect, random)};
      INFO(effect->info.id << " at " << fmt::format("{}", fmt::join(campaign.effects.front().parameters, ", ")));
      const SetChecks checks = check_set(tests::simulate_campaign(campaign, static_cast<std::uint64_t>(i)));
      INFO(join(checks.warnings));
      CHECK_THAT(join(checks.warnings), !Contains("looks as if"));
      CHECK(checks.left_out.empty());
      ++sets;
      stopped += checks.is_implausible() ? 1 : 0;
    }
  }
  // the far tail of a prior may be outside: parasitic losses many times those of the file
  CHECK(stopped <= sets / 100);
}

}  // namespace

TEST_CASE("no effect of the catalog makes a set look like a mistake", "[slow]") { check_effects(2); }

TEST_CASE("no effect of the catalog makes a set look like a mistake, whatever its size", "[weekly]") {
  check_effects(12);
}

TEST_CASE("rows far apart are warned of, with the shift that they may make", "[fast]") {
  MeasurementSet set = short_set();
  CHECK_THAT(join(check_set(set).warnings), !Contains("apart"));
  for (MeasuredRun& run : set.runs) {
    const auto thin = [](std::vector<double>& values) {
      std::vector<double> kept;
      for (std::size_t row = 0; row < values.size(); row += 4) kept.push_back(values[row]);
      values = kept;
    };
    thin(run.time_s);
    for (auto& [name, values] : run.columns) thin(values);
  }
  CHECK_THAT(join(check_set(set).warnings), Contains("s apart") && Contains("clock_shift"));
}

TEST_CASE("nothing measured is an error, and a channel without samples a warning", "[fast]") {
  MeasurementSet set = short_set();
  const auto clear = [](MeasuredRun& run, const char* channel) {
    std::vector<double>& values = run.columns.at(channel);
    std::fill(values.begin(), values.end(), std::nan(""));
  };
  clear(set.runs[0], "cavity_pressure_kPa");
  CHECK_THAT(join(check_set(set).warnings), Contains("cavity_pressure_kPa has no sample in run " + set.runs[0].id));
  for (MeasuredRun& run : set.runs) run.columns.erase(models::quantities::kCavityPressure);
  CHECK_THAT(join(check_set(set).warnings), Contains("cavity_pressure_kPa was not measured"));
  for (MeasuredRun& run : set.runs) {
    clear(run, "drum_torque_Nm");
    clear(run, "liner_temperature_degC");
  }
  CHECK_THROWS_WITH(check_set(set), Contains("nothing was measured") && Contains(set.path));
}

TEST_CASE("a run that measured nothing is warned of, once", "[fast]") {
  MeasurementSet set = short_set();
  MeasuredRun& empty = set.runs[1];
  for (const char* channel : kChannels) empty.columns.erase(intern_quantity(channel));
  const std::vector<std::string> missing = diagnosis::find_missing_samples(set);
  REQUIRE(missing.size() == 1);
  CHECK_THAT(missing[0], Contains("run " + empty.id) && Contains("measured nothing"));
  CHECK(join(check_set(set).warnings) == join(missing));
}

TEST_CASE("torque that never settles is said not to count", "[fast]") {
  MeasurementSet set = short_set();
  for (double& speed_m_s : set.runs[0].columns.at("speed_km_h")) speed_m_s = 10.0 / 3.6;
  CHECK_THAT(answer_to(set).text, Contains("no torque of run " + set.runs[0].id) && Contains("20 km/h"));
}

TEST_CASE("one run works, and says what it cannot show", "[fast]") {
  MeasurementSet set = short_set();
  set.runs.resize(1);
  const SetChecks checks = check_set(set);
  CHECK_FALSE(checks.is_implausible());
  REQUIRE(checks.warnings.size() == 1);
  CHECK_THAT(checks.warnings[0], Contains("one run only"));
}

TEST_CASE("the same samples under two names are no second run", "[fast]") {
  MeasurementSet set = short_set();
  set.runs.push_back(set.runs[0]);
  set.runs.back().id = "again";
  CHECK_THAT(join(check_set(set).warnings), Contains("hold the same samples") && Contains("again"));
}

TEST_CASE("a wrong tire is warned of", "[fast]") {
  tests::Campaign campaign = tests::make_short_campaign();
  campaign.tire = find_asset("tires", "a50");
  const MeasurementSet of_a50 = tests::simulate_campaign(campaign);
  for (const char* file : {"a40", "a60"}) {
    MeasurementSet set = of_a50;
    set.tire = tests::read_asset_tire(file);
    const SetChecks checks = check_set(set);
    INFO(file);
    CHECK_THAT(join(checks.warnings), Contains("tire a50 (235/50 R19) fits these runs far better"));
    // a tire of the same size is the same one, with other numbers
    set.tire.designation = of_a50.tire.designation;
    CHECK_THAT(join(check_set(set).warnings), !Contains("tire a50"));
  }
  MeasurementSet truck = short_set();
  truck.tire.values.rolling_resistance.reference_load_N *= 6.0;
  truck.tire.values.rolling_resistance.reference_pressure_Pa *= 3.0;
  const Answer answer = answer_to(truck);
  CHECK_THAT(answer.text, Contains("cold pressure") && Contains("load"));
}

TEST_CASE("a drum set with noise is asked for", "[fast]") {
  MeasurementSet set = short_set();
  set.sensors.at("drum_torque_Nm") = {};
  CHECK_THROWS_WITH(check_set(set), Contains("no noise at all") && Contains("[sensors.drum_torque_Nm]"));
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
    INFO(channel);
    set = short_set();
    set.sensors.at(channel) = {1.0, 0.0, 60.0, 1e-300, 0.0};
    CHECK_THROWS_WITH(check_set(set), Contains("less noise than any") && Contains(channel));
    set.sensors.at(channel).drift_sd = 1.0;  // a sample then scatters by that
    CHECK_NOTHROW(check_set(set));
  }
  // What is just believed gives finite numbers; a finer one is refused.
  const Quantity torque = intern_quantity("drum_torque_Nm");
  set = short_set();
  set.sensors.at(torque) = {0.5, 0.0, 60.0, diagnosis::find_least_noise(torque), 0.0};
  CHECK_NOTHROW(check_set(set));
  set.sensors.at(torque).noise_sd *= 0.99;
  CHECK_THROWS_AS(check_set(set), InputError);
  set = short_set();
  set.kind = tests::kRoad;
  CHECK_THROWS_AS(check_set(set), InputError);
}

TEST_CASE("a run that cannot be simulated is an error that names it", "[fast]") {
  MeasurementSet set = short_set();
  for (double& ambient_K : set.runs[2].columns.at("ambient_degC")) ambient_K = std::nan("");
  CHECK_THROWS_WITH(check_set(set), Contains("cannot be simulated") && Contains(set.runs[2].id));
}

TEST_CASE("ten hours of data are checked", "[fast]") {
  tests::Campaign campaign;
  campaign.parts = {{"transient_skim", {"repeats=75"}}, {"warm_up", {"speed_km_h=80"}}};
  const MeasurementSet set = tests::simulate_campaign(campaign);
  REQUIRE(set.runs[0].time_s.back() > 36000.0 - 3600.0);
  const SetChecks checks = check_set(set);
  INFO(join(checks.warnings));
  CHECK(checks.warnings.empty());
}

TEST_CASE("the checks do not depend on threads or on the order of runs", "[fast]") {
  MeasurementSet set = exchange_everywhere(short_set(), "drum_torque_Nm", "liner_temperature_degC");
  const SetChecks one = check_set(set, 1);
  CHECK(check_set(set, 2).warnings == one.warnings);
  std::reverse(set.runs.begin(), set.runs.end());
  CHECK(check_set(set, 2).warnings == one.warnings);
}
