// Runs over one time: phases begin together, and the shorter one ends in a gap.
#include "comparison/overlay.h"

#include <catch2/catch.hpp>
#include <cmath>

using rollrig::comparison::OverlaidRun;
using rollrig::comparison::Overlay;
using rollrig::comparison::overlay_runs;

namespace {

/// A run of phases of these lengths, a row a second, whose speed is the number of the phase.
OverlaidRun make_run(const std::vector<std::pair<std::string, int>>& phases, double start_s = 0.0) {
  OverlaidRun run;
  std::vector<double> speed_km_h;
  double at_s = start_s;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    run.phases.push_back({phases[p].first, at_s, at_s + phases[p].second});
    for (int row = 0; row < phases[p].second; ++row) {
      run.time_s.push_back(at_s + row);
      run.phase.push_back(p);
      speed_km_h.push_back(static_cast<double>(p));
    }
    at_s += phases[p].second;
  }
  run.channels.emplace_back("speed_km_h", speed_km_h);
  return run;
}

}  // namespace

TEST_CASE("a phase begins at one time for all, whatever its length", "[fast]") {
  std::vector<std::string> warnings;
  const Overlay overlay = overlay_runs({make_run({{"soak", 10}, {"warm-up", 100}, {"skim", 20}}, -10.0),
                                        make_run({{"soak", 10}, {"warm-up", 130}, {"skim", 15}}, 500.0)},
                                       {"a", "b"}, "", warnings);
  CHECK(warnings.empty());
  REQUIRE(overlay.phases.size() == 3);
  CHECK(overlay.phases[1].start_s == 0.0);
  CHECK(overlay.phases[2].start_s == 130.0);  // after the longer warm-up
  CHECK(overlay.phases[2].end_s == 150.0);
  REQUIRE(overlay.panels.size() == 1);
  for (const auto& line : overlay.panels.front().lines) {
    bool has_gap = false;
    for (std::size_t i = 0; i < line.time_s.size(); ++i) {
      if (i > 0) CHECK(line.time_s[i] > line.time_s[i - 1]);
      if (line.values[i] == 1.0) CHECK((line.time_s[i] >= 0.0 && line.time_s[i] < 130.0));
      if (line.values[i] == 2.0) CHECK(line.time_s[i] >= 130.0);
      has_gap = has_gap || std::isnan(line.values[i]);
    }
    CHECK(has_gap == (&line == &overlay.panels.front().lines.front()));  // the warm-up of 100 s
  }
}

TEST_CASE("runs with other phases begin with the first that they share, and a warning says so", "[fast]") {
  std::vector<std::string> warnings;
  const Overlay overlay =
      overlay_runs({make_run({{"soak", 10}, {"80 km/h", 100}}), make_run({{"80 km/h", 60}, {"skim", 20}})}, {"a", "b"},
                   "", warnings);
  REQUIRE(warnings.size() == 1);
  REQUIRE(overlay.panels.size() == 1);
  CHECK(overlay.panels.front().lines[1].time_s.front() == 10.0);
}

TEST_CASE("a channel that one run lacks has no panel", "[fast]") {
  std::vector<std::string> warnings;
  OverlaidRun more = make_run({{"warm-up", 10}});
  more.channels.emplace_back("drum_torque_Nm", std::vector<double>(10, 1.0));
  CHECK(overlay_runs({more, make_run({{"warm-up", 10}})}, {"a", "b"}, "", warnings).panels.size() == 1);
}
