// Phases of a run in which a vehicle is driven.
#include <catch2/catch.hpp>

#include "diagnosis/kinds/kinds.h"

using namespace rollrig;
using diagnosis::find_driving_phases;
using diagnosis::RunPhase;

namespace {

struct Stage {
  double minutes;
  double km_h;
  double load_N = 5000.0;
};

measurements::MeasuredRun make_run(const std::vector<Stage>& stages) {
  measurements::MeasuredRun run;
  for (const Stage& stage : stages) {
    for (int i = 0; i < static_cast<int>(60.0 * stage.minutes); ++i) {
      run.time_s.push_back(static_cast<double>(run.time_s.size()));
      run.columns["speed_km_h"].push_back(stage.km_h / 3.6);
      run.columns["load_N"].push_back(stage.load_N);
    }
  }
  return run;
}

std::vector<std::string> names_of(const std::vector<RunPhase>& phases) {
  std::vector<std::string> names;
  for (const RunPhase& phase : phases) names.push_back(phase.name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("phases of a drive follow its speed and cover every row once", "[fast]") {
  const auto run = make_run({{10.0, 30.0}, {20.0, 120.0}, {10.0, 70.0}, {10.0, 30.0}});
  const auto phases = find_driving_phases(run);
  CHECK(names_of(phases) == Names{"city 1", "motorway 1", "country 1", "city 2"});
  std::size_t next = 0;
  for (const RunPhase& phase : phases) {
    CHECK(phase.first == next);
    CHECK(phase.last > phase.first);
    next = phase.last;
  }
  CHECK(next == run.time_s.size());
}

TEST_CASE("a stop at a light is no phase, a rest is", "[fast]") {
  CHECK(names_of(find_driving_phases(make_run({{10.0, 40.0}, {1.0, 0.0}, {10.0, 40.0}}))) == Names{"city 1"});
  CHECK(names_of(find_driving_phases(make_run({{10.0, 40.0}, {10.0, 0.0}, {10.0, 40.0}}))) ==
        Names{"city 1", "standstill 1", "city 2"});
}

TEST_CASE("a run shorter than a phase is one, and a change of load begins one", "[fast]") {
  CHECK(find_driving_phases(make_run({{1.0, 100.0}})).size() == 1);
  const auto phases = find_driving_phases(make_run({{10.0, 80.0, 5000.0}, {10.0, 80.0, 3000.0}}));
  CHECK(names_of(phases) == Names{"country 1", "country 2"});
  CHECK(phases[1].first == 600);
}
