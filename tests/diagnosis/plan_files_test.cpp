#include "diagnosis/next_test/plan_files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "diagnosis/kinds/kinds.h"
#include "measurements/sensor_file.h"
#include "scenarios/run/run_spec.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/diagnosis/hand_made.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/machines.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

/// A set of one short run at 2 Hz; what it measured is of no matter here.
measurements::MeasurementSet make_set() {
  measurements::MeasurementSet set;
  set.path = "set.toml";
  set.name = "campaign";
  set.tire = tests::read_combined_tire();
  set.rig = tests::read_asset_rig();
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset("source");
  measurements::MeasuredRun run;
  run.id = "one";
  run.session = "day";
  run.initial_tire_temperature_K = 298.15;
  run.cold_pressure_Pa = 260e3;
  for (int i = 0; i < 600; ++i) {
    run.time_s.push_back(0.5 * i);
    run.columns["speed_km_h"].push_back(80.0 / 3.6);
    run.columns["load_N"].push_back(5000.0);
    run.columns["ambient_degC"].push_back(298.15);
    for (const auto& [channel, sensor] : set.sensors) run.columns[channel].push_back(300.0);
  }
  set.runs = {run};
  return set;
}

Diagnosis propose(const PlannedTest& test) {
  Diagnosis made = tests::make_explained();
  made.plan = {{test.description, {"bearing_warmup"}, 0.4, test.hours, test.by_hand},
               test.soaked,
               test.extra.force_at_standstill,
               test.runs};
  return made;
}

/// Value of a column at a time: a load holds, all else goes straight.
double value_at(const measurements::MeasuredRun& run, const std::string& column, double time_s) {
  const auto next = std::upper_bound(run.time_s.begin(), run.time_s.end(), time_s);
  const auto after = static_cast<std::size_t>(next - run.time_s.begin());
  const std::vector<double>& values = run.columns.at(column);
  if (after == run.time_s.size() || column == "load_N") return values[after - 1];
  const double share = (time_s - run.time_s[after - 1]) / (run.time_s[after] - run.time_s[after - 1]);
  return values[after - 1] + share * (values[after] - values[after - 1]);
}

}  // namespace

TEST_CASE("every test of the menu becomes run files whose inputs are the test's", "[fast]") {
  const measurements::MeasurementSet set = make_set();
  for (const PlannedTest& test : make_drum_tests(PreparedSet(set))) {
    INFO(test.id);
    const tests::TemporaryFolder folder;
    const auto files = write_plan(set, propose(test));
    for (const auto& [name, content] : files) tests::write_file(folder.file(name), content);
    CHECK(files.size() == 3 + 2 * test.runs.size());
    for (std::size_t i = 0; i < test.runs.size(); ++i) {
      const measurements::MeasuredRun& wanted = test.runs[i];
      const std::string file = folder.file("run-" + std::to_string(i + 1) + ".toml");
      const scenarios::RunSpec spec = scenarios::read_run_spec(read_config(file), folder.path());
      CHECK_NOTHROW(scenarios::prepare_run(spec));
      CHECK(spec.scenario->text.name == "follow_drum");
      CHECK(spec.sample_interval_s == Approx(0.5));  // the set's own
      CHECK(spec.sensors->size() == set.sensors.size());
      CHECK(spec.tire.name == set.tire.name);
      const measurements::MeasuredRun written =
          measurements::read_run_inputs(folder.file(wanted.id + ".csv"), *set.kind);
      CHECK(written.time_s.size() < 60);  // for a person
      CHECK(written.has(models::quantities::kSurfaceTemperature) ==
            wanted.has(models::quantities::kSurfaceTemperature));
      double worst = 0.0;
      for (const std::string column : {"speed_km_h", "load_N", "ambient_degC"}) {
        for (std::size_t row = 0; row < wanted.time_s.size(); ++row) {
          worst =
              std::max(worst, std::abs(value_at(written, column, wanted.time_s[row]) - wanted.columns.at(column)[row]));
        }
      }
      CHECK(worst < 1e-5);
      CHECK_THAT(files.at("plan.txt"), Catch::Contains("run-" + std::to_string(i + 1) + ".toml"));
    }
    for (const std::string& step : test.by_hand) {
      const std::string first_words = step.substr(0, step.find(' ', 12));
      CHECK_THAT(files.at("plan.txt"), Catch::Contains(first_words));
    }
  }
}

TEST_CASE("the stages of a plan last as long as its run, changes of speed with what they lead to", "[fast]") {
  const measurements::MeasurementSet set = make_set();
  for (const PlannedTest& test : make_drum_tests(PreparedSet(set))) {
    if (test.id != "speed_steps") continue;
    const std::string plan = write_plan(set, propose(test)).at("plan.txt");
    for (const char* stage : {" 20.0 min   80 km/h", "120 km/h     ", "40 km/h      ", "soak for 3 h"}) {
      CHECK_THAT(plan, Catch::Contains(stage));
    }
    // "       20.0 min   80 km/h      5000 N"
    double stages_min = 0.0;
    std::istringstream lines(plan);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      double minutes = 0.0;
      std::string unit;
      if (words >> minutes >> unit && unit == "min") stages_min += minutes;
    }
    const measurements::MeasuredRun& run = test.runs.front();
    CHECK(stages_min == Approx((run.time_s.back() - run.time_s.front()) / 60.0).margin(0.2));
  }
}

TEST_CASE("where no test is proposed there is no plan", "[fast]") {
  CHECK(write_plan(make_set(), tests::make_no_gap()).empty());
}

namespace {

using Visit = std::function<void(const measurements::MeasurementSet& rehearsed, const scenarios::RunSpec& spec)>;

/// Whether a tire rolls under load in a test.
bool rolls(const PlannedTest& test) {
  return std::any_of(test.runs.begin(), test.runs.end(), [](const measurements::MeasuredRun& run) {
    for (std::size_t row = 0; row < run.time_s.size(); ++row) {
      if (run.columns.at("load_N")[row] > 0.0 && run.columns.at("speed_km_h")[row] > 0.0) return true;
    }
    return false;
  });
}

/// How many of these channels the set has a sensor for.
std::size_t count_in(const measurements::MeasurementSet& set, const std::vector<Quantity>& channels) {
  return static_cast<std::size_t>(std::count_if(channels.begin(), channels.end(), [&](const Quantity& channel) {
    return set.sensors.count(channel) > 0 || channel == models::quantities::kRimTemperature;
  }));
}

/// Every run of the plan of a test, run without errors of sensors and read back as a set; `effect` as of --set.
void visit_rehearsals(const measurements::MeasurementSet& set, const PlannedTest& test, const std::string& effect,
                      const Visit& visit) {
  const tests::TemporaryFolder folder;
  for (const auto& [name, content] : write_plan(set, propose(test))) tests::write_file(folder.file(name), content);
  for (std::size_t i = 0; i < test.runs.size(); ++i) {
    ConfigTable document = read_config(folder.file("run-" + std::to_string(i + 1) + ".toml"));
    if (!effect.empty()) scenarios::set_run_value(document, effect);
    scenarios::RunSpec spec = scenarios::read_run_spec(document, folder.path());
    CHECK(spec.sensors->size() == set.sensors.size() + test.extra.sensors.size() - count_in(set, test.extra.sensors));
    for (auto& [channel, sensor] : *spec.sensors) sensor = {};  // without error
    const tests::TemporaryFolder written;
    for (const auto& [name, content] :
         scenarios::write_measurement_set(spec, scenarios::run_scenario(spec, {}), "paper")) {
      tests::write_file(written.file(name), content);
    }
    visit(measurements::read_measurement_set(written.path()), spec);
  }
}

/// Largest difference of a set's channels from their resimulation, as a share; `resimulated` is the set measured again.
double find_worst_share(const measurements::MeasurementSet& set, const measurements::MeasurementSet& resimulated) {
  double worst = 0.0;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    for (const auto& [channel, sensor] : set.sensors) {
      const std::vector<double>& written = set.runs[r].columns.at(channel);
      const std::vector<double>& simulated = resimulated.runs[r].columns.at(channel);
      for (std::size_t row = 0; row < written.size(); ++row) {
        if (std::isnan(written[row])) continue;
        // A traction force near zero is the difference of forces a hundred times as large.
        const double scale =
            std::max(std::abs(simulated[row]), channel == models::quantities::kTractionForce ? 100.0 : 1.0);
        worst = std::max(worst, std::abs(written[row] - simulated[row]) / scale);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("plans of wheel and vehicle are run as a set whose resimulation is what was written", "[slow]") {
  const measurements::MeasurementSet sets[] = {tests::make_dyno_set({}, 1), tests::make_road_set({}, 1),
                                               tests::make_road_set({}, 1, models::Baseline::kCombined)};
  for (const measurements::MeasurementSet& set : sets) {
    const bool is_road = set.kind == tests::kRoad;
    for (const PlannedTest& test : (is_road ? make_road_tests : make_dyno_tests)(PreparedSet(set))) {
      for (const char* effect : {"", "effects.toe_camber_drag.force_N=20"}) {
        INFO(test.id << " " << effect);
        std::size_t runs = 0;
        visit_rehearsals(set, test, effect,
                         [&](const measurements::MeasurementSet& rehearsed, const scenarios::RunSpec& spec) {
                           ++runs;
                           REQUIRE(rehearsed.runs.size() == 1);
                           CHECK(rehearsed.kind == set.kind);
                           CHECK(rehearsed.baseline == set.baseline);
                           CHECK(rehearsed.tire.name == set.tire.name);
                           measurements::MeasurementSet resimulated = rehearsed;
                           tests::measure_again(resimulated, spec.effects);
                           CHECK(find_worst_share(rehearsed, resimulated) < 1e-6);
                           if (spec.effects.empty() || !rolls(test)) return;
                           tests::measure_again(resimulated, {});
                           CHECK(find_worst_share(rehearsed, resimulated) > 1e-2);  // the effect was there
                         });
        CHECK(runs == test.runs.size());
      }
    }
  }
}

TEST_CASE("a set and its next test, run with the true effect, are diagnosed together", "[slow]") {
  const std::string effect = "effects.toe_camber_drag.force_N=20";
  measurements::MeasurementSet set = tests::make_dyno_set({}, 2, models::Baseline::kCombined, 45.0);
  const PlannedTest test = make_dyno_tests(PreparedSet(set)).front();
  visit_rehearsals(set, test, effect,
                   [&](const measurements::MeasurementSet& rehearsed, const scenarios::RunSpec& spec) {
                     tests::measure_again(set, spec.effects);
                     set.runs.push_back(rehearsed.runs.front());
                   });
  REQUIRE(set.runs.size() == 3);
  const Diagnosis diagnosed = diagnose(set, {{}, {"toe_camber_drag", "torque_zero_drift"}, 2});
  REQUIRE_FALSE(diagnosed.causes.empty());
  CHECK(diagnosed.causes.front().effects.front() == "toe_camber_drag");
}

TEST_CASE("a plan tells a person of force on the wheel, and of a road without loads", "[fast]") {
  const measurements::MeasurementSet dyno = tests::make_dyno_set({}, 1);
  for (const PlannedTest& test : make_dyno_tests(PreparedSet(dyno))) {
    if (test.id != "drive_and_brake") continue;
    const std::string plan = write_plan(dyno, propose(test)).at("plan.txt");
    CHECK_THAT(plan, Catch::Contains("5400 N, driving with 1000 N"));
    CHECK_THAT(plan, Catch::Contains("5400 N, braking with 1000 N"));
  }
  const measurements::MeasurementSet road = tests::make_road_set({}, 1);
  const auto files = write_plan(road, propose(make_road_tests(PreparedSet(road)).front()));
  CHECK_THAT(files.at("plan.txt"), Catch::Contains("On the road, in this order"));
  CHECK_THAT(files.at("plan.txt"), !Catch::Contains(" N\n"));
  CHECK(files.count("vehicle.toml") == 1);
  CHECK(files.count("rig.toml") == 0);
}
