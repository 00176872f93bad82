#include "diagnosis/comparison/run_phases.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace rollrig;
using diagnosis::find_phases;
using diagnosis::RunPhase;

namespace {

constexpr double kSkim_N = 200.0;
constexpr double kSkimLimit_N = 300.0;

/// A run at 1 Hz, written down piece by piece.
struct Recorded {
  measurements::MeasuredRun run;

  /// Straight to that speed in that time, under that load.
  Recorded& then(int duration_s, double speed_km_h, double load_N) {
    std::vector<double>& speed_m_s = run.columns["speed_km_h"];
    const double from_m_s = speed_m_s.empty() ? speed_km_h / 3.6 : speed_m_s.back();
    for (int i = 1; i <= duration_s; ++i) {
      run.time_s.push_back(static_cast<double>(run.time_s.size()));
      speed_m_s.push_back(from_m_s + (speed_km_h / 3.6 - from_m_s) * i / duration_s);
      run.columns["load_N"].push_back(load_N);
    }
    return *this;
  }

  std::vector<RunPhase> phases() const {
    const std::vector<RunPhase> found = find_phases(run, kSkimLimit_N);
    // In order, without a gap, over the whole run.
    REQUIRE(!found.empty());
    CHECK(found.front().first == 0);
    CHECK(found.back().last == run.time_s.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].first < found[i].last);
      if (i > 0) CHECK(found[i].first == found[i - 1].last);
    }
    return found;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const RunPhase& phase : phases()) all.push_back(phase.name);
    return all;
  }
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a run is cut where the load changes, and its phases are named", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, kSkim_N).then(600, 80.0, 5400.0).then(300, 80.0, kSkim_N);
  CHECK(recorded.names() == Names{"skim 1", "80 km/h 5.4 kN", "skim 2"});
  const auto phases = recorded.phases();
  CHECK(phases[1].first == 300);
  CHECK(phases[1].last == 900);
}

TEST_CASE("a change of load of 1 % is none", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, 5400.0).then(300, 80.0, 5440.0).then(300, 80.0, 5560.0);
  CHECK(recorded.phases().size() == 2);
}

TEST_CASE("a short change of speed belongs to what it leads to", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, 5400.0).then(20, 120.0, 5400.0).then(300, 120.0, 5400.0);
  CHECK(recorded.names() == Names{"80 km/h 5.4 kN", "120 km/h 5.4 kN"});
  const auto phases = recorded.phases();
  CHECK(phases[1].first <= 301);  // with the ramp
  CHECK(phases[1].first >= 298);
}

TEST_CASE("a change of speed of more than half a minute is a phase", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, 5400.0).then(60, 120.0, 5400.0).then(300, 120.0, 5400.0).then(60, 80.0, 5400.0);
  recorded.then(300, 80.0, 5400.0);
  CHECK(recorded.names() ==
        Names{"80 km/h 5.4 kN", "speed change 1", "120 km/h 5.4 kN", "speed change 2", "80 km/h 5.4 kN (2)"});
}

TEST_CASE("at the end of a run, a short change of speed belongs to what it came from", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, 5400.0).then(15, 100.0, 5400.0);
  CHECK(recorded.phases().size() == 1);
}

TEST_CASE("a short change of speed does not reach over a change of load", "[fast]") {
  Recorded recorded;
  recorded.then(300, 80.0, 5400.0).then(20, 120.0, 5400.0).then(300, 120.0, kSkim_N);
  const auto phases = recorded.phases();
  REQUIRE(phases.size() == 2);
  CHECK(phases[1].first == 320);
  CHECK(phases[1].name == "skim 1");
}

TEST_CASE("up to the limit a tire is in skim", "[fast]") {
  Recorded at;
  at.then(300, 80.0, kSkimLimit_N);
  CHECK(at.names() == Names{"skim 1"});
  Recorded above;
  above.then(300, 80.0, 1.02 * kSkimLimit_N);
  CHECK(above.names() == Names{"80 km/h 0.3 kN"});
}

TEST_CASE("a drum that stands has a phase of its own", "[fast]") {
  Recorded recorded;
  recorded.then(120, 0.0, kSkim_N).then(60, 80.0, kSkim_N).then(300, 80.0, kSkim_N);
  CHECK(recorded.names() == Names{"standstill 1", "speed change 1", "skim 1"});
}

TEST_CASE("no two phases of a run have the same name", "[fast]") {
  Recorded recorded;
  for (int i = 0; i < 3; ++i) {
    recorded.then(100, 80.0, 5400.0).then(100, 80.0, kSkim_N).then(60, 120.0, kSkim_N).then(60, 80.0, kSkim_N);
  }
  Names names = recorded.names();
  const std::size_t count = names.size();
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  CHECK(names.size() == count);
}

TEST_CASE("a run of the shortest kind has a phase", "[fast]") {
  Recorded recorded;
  recorded.then(2, 80.0, 5400.0);
  CHECK(recorded.phases().size() == 1);
}
