#include "diagnosis/next_test.h"

#include <catch2/catch.hpp>

#include <ctime>

#include "diagnosis/base_parameters.h"
#include "diagnosis/verdict.h"
#include "identification/replay.h"
#include "scenarios/sensor_file.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// Stages of a run: minutes, load, speed.
struct Stage {
  double minutes;
  double load_N;
  double speed_km_h;
};

scenarios::MeasuredRun make_run(const std::string& id, const std::vector<Stage>& stages) {
  scenarios::MeasuredRun run;
  run.id = id;
  run.session = "day";
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 280e3;
  double time_s = 0.0;
  for (const Stage& stage : stages) {
    for (int i = 0; i < static_cast<int>(60.0 * stage.minutes); ++i) {
      run.time_s.push_back(time_s++);
      run.columns["speed_km_h"].push_back(stage.speed_km_h / 3.6);
      run.columns["load_N"].push_back(stage.load_N);
      run.columns["ambient_degC"].push_back(298.15);
    }
  }
  return run;
}

/// Runs of the asset tire on the asset rig with an effect on, measured with noise.
scenarios::MeasurementSet measure(const std::vector<models::ActiveEffect>& effects,
                                  std::vector<scenarios::MeasuredRun> runs, std::uint64_t seed) {
  scenarios::MeasurementSet set;
  set.path = "simulated";
  set.name = "simulated";
  set.tire = tests::read_asset_tire();
  set.rig = tests::read_asset_rig();
  set.sensors = scenarios::read_sensor_asset("source");
  for (scenarios::MeasuredRun& run : runs) {
    models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), effects);
    const auto recording =
        identification::replay_drum_run<double>(set, run, identification::make_drum_replay(run), corner);
    for (const auto& [channel, sensor] : set.sensors) run.columns[channel] = recording.channel(channel);
    set.runs.push_back(std::move(run));
  }
  return tests::add_noise(set, seed);
}

struct Raced {
  Raced(const scenarios::MeasurementSet& measured, const std::vector<std::string>& effects)
      : set(measured), base(find_base_parameters(set.source(), set.context())), remainder(set) {
    RaceSettings settings;
    for (const std::string& id : effects) settings.effects.push_back(&models::find_effect(id));
    race = run_race(set, base, remainder, settings);
  }
  PreparedSet set;
  std::vector<identification::FreeParameter> base;
  Remainder remainder;
  Race race;
};

}  // namespace

TEST_CASE("look", "[.look]") {
  const std::string truth = std::getenv("TRUTH") ? std::getenv("TRUTH") : "bearing_warmup";
  std::vector<models::ActiveEffect> on;
  if (truth != "none") {
    std::vector<double> values;
    for (const auto& p : models::find_effect(truth).info.parameters) values.push_back(p.prior.centre());
    on.push_back(tests::make_active(models::find_effect(truth), values));
  }
  std::vector<std::string> ids;
  for (const auto* e : models::all_effects()) {
    const auto& i = e->info;
    if (models::acts_on(i, models::RigKind::kDrum) && std::count(i.faint_on.begin(), i.faint_on.end(), models::RigKind::kDrum) == 0) ids.push_back(i.id);
  }
  if (std::getenv("IDS")) { ids.clear(); std::string a = std::getenv("IDS"); for (std::size_t k = 0; k < a.size();) { auto e = std::min(a.find(',', k), a.size()); ids.push_back(a.substr(k, e - k)); k = e + 1; } }
  if (std::getenv("SIZE")) on[0].parameters[0] *= std::stod(std::getenv("SIZE"));
  const Raced raced(std::getenv("SHORT") ? measure(on, {make_run("a", {{3, 200, 80}, {25, 5400, 80}, {3, 200, 80}})}, 1) : measure(on, {make_run("a", {{3, 200, 80}, {8, 5400, 80}, {3, 200, 80}, {8, 5400, 80}, {3, 200, 80}})}, 1), ids);
  for (const auto& c : raced.race.contenders) {
    WARN(c.fit.hypothesis.name() << " p " << c.probability << " rem " << c.remainder_probability << " lbf " << expected_log_bayes_factor(raced.remainder, raced.race.contenders.front(), c));
  }
  WARN("null " << raced.race.null.probability << " unknown " << raced.race.unknown_probability);
  for (const auto& s : raced.race.screened) WARN(s.effect.effect->info.id << " d' " << s.detectability);
  const std::clock_t t0 = std::clock();
  const auto open = find_open_hypotheses(raced.set, raced.base, raced.remainder, raced.race);
  const std::clock_t t1 = std::clock();
  const auto judged = judge_tests(raced.set, raced.base, open, 1);
  const std::clock_t t2 = std::clock();
  WARN("open " << double(t1 - t0) / CLOCKS_PER_SEC << " judge " << double(t2 - t1) / CLOCKS_PER_SEC);
  std::string text;
  for (const auto& o : open) text += o.hypothesis.name() + " " + std::to_string(o.probability) + "\n";
  for (const auto& j : judged) {
    text += j.test.id + " h " + std::to_string(j.test.hours) + " bits " + std::to_string(j.bits) + " /h " + std::to_string(j.bits / j.test.hours) + " splits";
    for (const auto& s : j.splits) text += " " + s;
    text += "\n";
  }
  WARN(text);
  const std::clock_t t3 = std::clock();
  for (const auto& t : make_test_menu(raced.set)) { std::clock_t a = std::clock(); predict_outcomes(raced.set, raced.base, open, t); WARN(t.id << " " << double(std::clock() - a) / CLOCKS_PER_SEC); }
  (void)t3;
}
