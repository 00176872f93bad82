// What a page says in numbers of a recording is what the recording has.
#include "report/readings.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/random.h"

using namespace rollrig;

namespace {

/// Rows of a minute, then of a second; the value jumps with the phase.
sim::Recording<double> make_jump() {
  sim::Recording<double> recording;
  recording.phases = {{"soak", -600.0, 0.0}, {"drive", 0.0, 100.0}};
  std::vector<double> torque_Nm;
  for (double time_s = -600.0; time_s <= 100.0; time_s += time_s < 0.0 ? 60.0 : 1.0) {
    recording.time_s.push_back(time_s);
    recording.phase.push_back(time_s < 0.0 ? 0 : 1);
    torque_Nm.push_back(time_s < 0.0 ? 0.0 : 88.0);
  }
  recording.values = {torque_Nm};
  return recording;
}

double at_row(const Json& recorded, std::size_t row, const std::vector<double>& time_s) {
  std::size_t k = 0;
  while (recorded["row"][k] < row) ++k;
  if (recorded["row"][k] == row) return recorded["y"][k];
  const std::size_t before = recorded["row"][k - 1];
  const std::size_t after = recorded["row"][k];
  const double share = (time_s[row] - time_s[before]) / (time_s[after] - time_s[before]);
  const double from = recorded["y"][k - 1];
  const double to = recorded["y"][k];
  return from + share * (to - from);
}

}  // namespace

TEST_CASE("a phase's numbers are those of its own rows", "[fast]") {
  const sim::Recording<double> recording = make_jump();
  const Json phases = report::summarize_phases(recording, recording.values.front());
  CHECK(phases == Json::parse("[[0.0, 0.0, 0.0, 0.0], [88.0, 88.0, 88.0, 88.0]]"));
  const Json none = report::summarize_phases(recording, std::vector<double>(recording.row_count(), std::nan("")));
  CHECK(none == Json::parse("[null, null]"));
}

TEST_CASE("a row that lies in two phases counts in neither", "[fast]") {
  sim::Recording<double> recording;
  recording.phases = {{"run-up", 0.0, 3.0}, {"warm-up", 3.0, 6.0}};
  recording.time_s = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  recording.phase = {0, 0, 0, 1, 1, 1};
  const std::vector<double> torque_Nm{180.0, 180.0, 180.0, 122.0, 64.0, 62.0};  // 122: half run-up, half load
  recording.values = {torque_Nm};
  const Json expected = Json::parse("[[180.0, 180.0, 180.0, 180.0], [63.0, 62.0, 64.0, 62.0]]");
  CHECK(report::summarize_phases(recording, torque_Nm) == expected);
  CHECK(report::summarize_spans(recording.time_s, torque_Nm, {{0.0, 3.0}, {3.0, 6.0}}) == expected);
}

TEST_CASE("the page can tell the time of every row", "[fast]") {
  const sim::Recording<double> recording = make_jump();
  std::vector<double> times_s;
  for (const Json& stretch : report::make_row_times(recording.time_s)) {
    for (int i = 0; i < stretch[2].get<int>(); ++i) {
      times_s.push_back(stretch[0].get<double>() + i * stretch[1].get<double>());
    }
  }
  REQUIRE(times_s.size() == recording.row_count());
  for (std::size_t row = 0; row < times_s.size(); ++row) CHECK(std::abs(times_s[row] - recording.time_s[row]) <= 1e-3);
}

TEST_CASE("the page has the value of every row to five digits", "[slow]") {
  RandomStream random(3, "readings");
  std::vector<double> time_s;
  std::vector<double> values;
  for (int i = 0; i < 14000; ++i) {
    time_s.push_back(0.5 * i);
    values.push_back(i < 5000 ? 0.01 * i : i < 10000 ? 100.0 * random.uniform() : 3.0);
  }
  const Json recorded = report::make_recorded(time_s, values);
  CHECK(recorded["row"].size() < 6000);
  double worst = 0.0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    worst = std::max(worst, std::abs(at_row(recorded, row, time_s) - values[row]));
  }
  CHECK(worst <= 1e-3);  // of values up to 100, half of the last digit for the line and for rounding
}
