// What a person is told of drum coastdowns that are not what they seem.
#include "estimation/drum_deceleration/coast_doubts.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/coast_study.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

CoastSet make_set() {
  CoastSet set = tests::make_coasts({}, 3);
  for (std::size_t i = 0; i < set.runs.size(); ++i) set.runs[i].id = std::to_string(i) + ".csv";
  return set;
}

const PressureLevel& level_at(const DrumCoastdownFit& fit, std::size_t speed, double pressure_Pa, double load_N) {
  for (const PressureLevel& level : fit.points[speed].levels) {
    if (is_same_pressure(level.pressure_Pa, pressure_Pa) && is_same_load(level.load_N, load_N)) return level;
  }
  throw std::logic_error("no such level");
}

}  // namespace

TEST_CASE("a recording that is there twice does not make an interval narrower", "[fast]") {
  CoastSet set = make_set();
  const DrumCoastdownFit once = fit_drum_coastdown(set);
  CHECK(once.doubts.empty());
  CHECK(once.others == nullptr);
  set.runs.push_back(set.runs[12]);
  set.runs.back().id = "copy.csv";
  const DrumCoastdownFit twice = fit_drum_coastdown(set);
  REQUIRE(twice.doubts.size() == 1);
  CHECK(twice.doubts[0].runs == std::vector<std::string>{"12.csv", "copy.csv"});
  CHECK_THAT(twice.warnings.front(), Contains("12.csv and copy.csv are the same recording"));
  for (std::size_t i = 0; i < once.points.size(); ++i) {
    CHECK(twice.points[i].drum_alone_m_s2->lower == once.points[i].drum_alone_m_s2->lower);
    CHECK(twice.points[i].drum_alone_m_s2->upper == once.points[i].drum_alone_m_s2->upper);
  }
}

TEST_CASE("one recording under two labels is doubted aloud", "[fast]") {
  CoastSet set = make_set();
  set.runs.push_back(set.runs[0]);
  set.runs.back().id = "copy.csv";
  set.runs.back().pressure_Pa = 350e3;
  CHECK_THAT(fit_drum_coastdown(set).warnings.front(), Contains("The two differ in pressure"));
}

TEST_CASE("a file that is given twice is named as such, and not as two recordings", "[fast]") {
  CoastSet set = make_set();
  for (estimation::CoastRun& run : set.runs) run.file = "folder/" + run.id;
  set.runs.push_back(set.runs[12]);
  CHECK_THAT(fit_drum_coastdown(set).warnings.front(), Equals("the file 12.csv is given twice: it is counted once"));
  set.runs.back().id = "./12.csv";
  set.runs.back().file = "folder/./12.csv";
  CHECK_THAT(fit_drum_coastdown(set).warnings.front(), StartsWith("the file 12.csv is given twice:"));
  set.runs.back().direction = "right";
  set.runs[12].direction = "left";
  CHECK_THAT(fit_drum_coastdown(set).warnings.front(),
             Contains("it is counted once, as it is given first. The two differ in direction"));
}

TEST_CASE("a lifted run that is said to be loaded is named, and the others say what they said", "[fast]") {
  CoastSet set = make_set();
  const DrumCoastdownFit right = fit_drum_coastdown(set);
  set.runs[13].state = CoastState::kLoaded;
  set.runs[13].pressure_Pa = 420e3;
  const DrumCoastdownFit wrong = fit_drum_coastdown(set);
  REQUIRE(wrong.doubts.size() == 1);
  CHECK(wrong.doubts[0].kind == DoubtKind::kState);
  CHECK(wrong.doubts[0].runs == std::vector<std::string>{"13.csv"});
  CHECK_THAT(wrong.warnings.front(), Contains("13.csv is said to be loaded") && Contains("'lifted'"));
  REQUIRE(wrong.others != nullptr);
  const Interval& net = level_at(*wrong.others, 2, 420e3, 0.0).net_m_s2;
  const Interval& truth = level_at(right, 2, 420e3, 0.0).net_m_s2;
  const Interval& pooled = level_at(wrong, 2, 420e3, 0.0).net_m_s2;
  CHECK(net.value == Approx(truth.value).epsilon(0.02));
  CHECK(pooled.upper - pooled.lower > 5.0 * (net.upper - net.lower));
}

TEST_CASE("runs at another load are a level of their own, and are named", "[fast]") {
  CoastSet set = make_set();
  for (CoastRun& run : set.runs) run.load_N = run.state == CoastState::kLoaded ? 1115.0 : 0.0;
  set.runs[4].load_N = 156.0;
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].kind == DoubtKind::kLoad);
  CHECK_THAT(fit.warnings.front(), Contains("156 N in 4.csv") && Contains("1115 N in 5.csv"));
  CHECK(level_at(fit, 2, 420e3, 156.0).runs == 1);
  CHECK(level_at(fit, 2, 420e3, 1115.0).runs == 1);
  CHECK(level_at(fit, 2, 350e3, 1115.0).runs == 2);
}

TEST_CASE("a braked loaded run is told from its repeat by the other pressures", "[fast]") {
  CoastSet set = make_set();
  CoastSeries& drum = *set.runs[6].drum;
  for (double& time_s : drum.time_s) time_s *= 0.7;
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].kind == DoubtKind::kOdd);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{"6.csv"});
  CHECK_THAT(fit.warnings.front(), Contains("was it braked"));
  REQUIRE(fit.others != nullptr);
  CHECK(level_at(*fit.others, 2, 490e3, 0.0).runs == 1);
}

TEST_CASE("where loads differ, every loaded run needs its own", "[fast]") {
  const TemporaryFolder folder;
  const std::string head = "format = \"rollrig-drum-coastdown/1\"\n[drum]\ndiameter_m = 1.7\n";
  const auto run = [](const std::string& state) { return "[[run]]\nfile = \"1.csv\"\nstate = \"" + state + "\"\n"; };
  write_file(folder.file("1.csv"), "time_s,speed_km_h\n0,80\n1,79\n2,78\n");
  const std::string loaded = run("loaded") + "pressure_kPa = 250\n";
  write_file(folder.file("set.toml"),
             head + loaded + "load_N = 500\n" + loaded + "load_N = 900\n" + loaded + run("lifted"));
  CHECK_THROWS_WITH(read_coast_set(folder.file("set.toml")), Contains("the loads of the runs differ"));
  write_file(folder.file("set.toml"), head + loaded + "load_N = 500\n" + loaded + run("lifted"));
  CHECK(read_coast_set(folder.file("set.toml")).runs[1].load_N == 500.0);
}

TEST_CASE("two runs whose pressures are exchanged are named", "[fast]") {
  CoastSet set = make_set();
  std::swap(set.runs[0].pressure_Pa, set.runs[8].pressure_Pa);  // 280 and 560 kPa
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{"0.csv", "8.csv"});
  CHECK_THAT(fit.warnings.front(), Contains("look as if their pressures were exchanged"));
  REQUIRE(fit.others != nullptr);
}

TEST_CASE("pressures that are all the other way round are doubted by their exponent", "[fast]") {
  CoastSet set = make_set();
  for (CoastRun& run : set.runs) {
    if (run.state == CoastState::kLoaded) run.pressure_Pa = 280e3 * 560e3 / run.pressure_Pa;
  }
  const auto warnings = fit_drum_coastdown(set).warnings;
  CHECK(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("would rise with pressure") != std::string::npos;
  }));
}

TEST_CASE("without a load the force is bounded, and its judgment said to be missing", "[fast]") {
  CoastSet set = make_set();
  const auto says = [&set](double inertia_kg_m2) {
    set.drum_inertia_kg_m2 = inertia_kg_m2;
    std::string all;
    for (const std::string& warning : fit_drum_coastdown(set).warnings) all += warning + "; ";
    return all;
  };
  CHECK_THAT(says(400.0), Contains("no load_N in the runs") && !Contains("car tires have"));
  CHECK_THAT(says(30.0), Contains("car tires have about 20 to 100 N"));
  CHECK_THROWS_WITH(says(4.0), Contains("that of no tire"));
  set.drum_inertia_kg_m2.reset();
  for (CoastRun& run : set.runs) {
    for (double& time_s : run.drum->time_s) time_s /= 60.0;
  }
  CHECK_THROWS_WITH(fit_drum_coastdown(set), Contains("It would be usual with times in min"));
}

TEST_CASE("a run that is said to be the lifted wheel and slows down otherwise is named", "[fast]") {
  CoastSet set = make_set();
  std::vector<std::size_t> wheels;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    if (set.runs[i].state == CoastState::kLifted && set.runs[i].wheel.has_value()) wheels.push_back(i);
  }
  REQUIRE(wheels.size() > 2);
  CHECK(fit_drum_coastdown(set).doubts.empty());
  for (double& time_s : set.runs[wheels[1]].wheel->time_s) time_s *= 10.0;
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{set.runs[wheels[1]].id});
  CHECK_THAT(fit.warnings.front(), Contains("the other runs of the lifted wheel"));
}

TEST_CASE("a rolling radius that looks like a diameter is doubted", "[fast]") {
  const auto is_doubted = [](double radius_m, double inertia_kg_m2) {
    CoastSet set = make_set();
    set.wheel_mass_ratio.reset();
    set.drum_inertia_kg_m2 = 850.0;
    set.wheel_inertia_kg_m2 = inertia_kg_m2;
    set.wheel_rolling_radius_m = radius_m;
    for (CoastRun& run : set.runs) run.load_N = run.state == CoastState::kLoaded ? 4000.0 : 0.0;
    const auto warnings = fit_drum_coastdown(set).warnings;
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("Is it the diameter?") != std::string::npos;
    });
  };
  CHECK_FALSE(is_doubted(0.344, 1.1));
  CHECK_FALSE(is_doubted(0.52, 12.0));  // of a truck
  CHECK(is_doubted(0.688, 1.1));
  CHECK(is_doubted(0.5, 0.8));
}

TEST_CASE("a rolling radius that looks like half of it is doubted, by the load and by the wheel", "[fast]") {
  const auto says = [](double radius_m, double inertia_kg_m2, double load_N) {
    CoastSet set = make_set();
    set.wheel_mass_ratio.reset();
    set.drum_inertia_kg_m2 = 850.0 * load_N / 4000.0;
    set.wheel_inertia_kg_m2 = inertia_kg_m2;
    set.wheel_rolling_radius_m = radius_m;
    for (CoastRun& run : set.runs) run.load_N = run.state == CoastState::kLoaded ? load_N : 0.0;
    std::string all;
    for (const std::string& warning : fit_drum_coastdown(set).warnings) all += warning + "; ";
    return all;
  };
  CHECK_THAT(says(0.172, 1.1, 4000.0), Contains("half of the radius? Twice it is 0.344 m"));
  CHECK_THAT(says(0.21, 1.8, 6000.0), Contains("half of the radius?"));   // a wheel of 41 kg is no small one
  CHECK_THAT(says(0.26, 9.0, 25000.0), Contains("half of the radius?"));  // a load of trucks
  CHECK_THAT(says(0.25, 0.4, 2500.0), !Contains("rolling_radius_m of [wheel] is"));
  CHECK_THAT(says(0.37, 4.0, 20000.0), !Contains("rolling_radius_m of [wheel] is"));
  CHECK_THAT(says(0.52, 12.0, 30000.0), !Contains("rolling_radius_m of [wheel] is"));
  CHECK_THAT(says(0.42, 1.9, 9000.0), !Contains("rolling_radius_m of [wheel] is"));
}

namespace {

/// The lifted wheel in runs of its own.
CoastSet make_wheel_runs(std::size_t count, std::uint64_t seed = 3) {
  CoastSet set = tests::make_coasts({}, seed);
  for (std::size_t i = 0, with_wheel = 0, runs = set.runs.size(); i < runs; ++i) {
    set.runs[i].id = std::to_string(i) + ".csv";
    if (!set.runs[i].wheel.has_value() || set.runs[i].state != CoastState::kLifted) continue;
    CoastRun wheel = set.runs[i];
    set.runs[i].wheel.reset();
    wheel.drum.reset();
    wheel.id = "wheel_" + std::to_string(++with_wheel) + ".csv";
    if (with_wheel <= count) set.runs.push_back(wheel);
  }
  return set;
}

void slow_down_wheel(CoastRun& run, double factor) {
  for (double& time_s : run.wheel->time_s) time_s /= factor;
}

}  // namespace

TEST_CASE("of two runs of the lifted wheel that differ, both are named with their ratio", "[fast]") {
  for (const double factor : {1.25, 1.6, 1.0 / 1.6}) {
    CoastSet set = make_wheel_runs(2);
    CHECK(fit_drum_coastdown(set).doubts.empty());
    slow_down_wheel(set.runs.back(), factor);
    const DrumCoastdownFit fit = fit_drum_coastdown(set);
    REQUIRE(fit.doubts.size() == 1);
    CHECK(fit.doubts[0].runs == std::vector<std::string>{"wheel_1.csv", "wheel_2.csv"});
    CHECK(fit.doubts[0].relative == Approx(factor - 1.0).margin(0.08));
    CHECK_THAT(fit.warnings.front(), Contains("times as fast in the second"));
    CHECK(fit.others == nullptr);
  }
}

TEST_CASE("of several runs of the lifted wheel the odd one is named and set aside", "[fast]") {
  CoastSet set = make_wheel_runs(4);
  slow_down_wheel(set.runs.back(), 1.3);
  const DrumCoastdownFit fit = fit_drum_coastdown(set);
  REQUIRE(fit.doubts.size() == 1);
  CHECK(fit.doubts[0].runs == std::vector<std::string>{"wheel_4.csv"});
  CHECK_THAT(fit.warnings.front(), Contains("were its bearings as warm?"));
  CHECK(fit.others != nullptr);
}

TEST_CASE("runs of the lifted wheel that scatter as usual are not doubted", "[slow]") {
  int doubted = 0, sets = 0;
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    for (const std::size_t count : {2u, 4u}) {
      ++sets;
      for (const RunDoubt& doubt : fit_drum_coastdown(make_wheel_runs(count, seed)).doubts) {
        doubted += doubt.text.find("the lifted wheel") != std::string::npos ? 1 : 0;
      }
    }
  }
  INFO(doubted << " of " << sets);
  CHECK(doubted <= 1);
}

TEST_CASE("runs of the lifted wheel in m/s are named where they reach no speed that is asked for", "[fast]") {
  CoastSet set = make_wheel_runs(2);
  for (CoastRun& run : set.runs) {
    if (!run.wheel.has_value()) continue;
    for (double& speed_m_s : run.wheel->speed_m_s) speed_m_s /= 3.6;
  }
  set.speeds_m_s = {12.0, 20.0};
  CHECK_NOTHROW(fit_drum_coastdown(set));  // without a share of the mass no run of the wheel is needed
  set.wheel_mass_ratio = 0.05;
  CHECK_THROWS_WITH(fit_drum_coastdown(set), Contains("The speeds of the lifted wheel runs are") &&
                                                 Contains("is their speed_km_h in m/s?") &&
                                                 !Contains("the loaded runs are"));
}
