// Control tires: a drift that is there is found, one that is not is not, and a step stands out.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/alignment/control_tires.h"
#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

constexpr double kDay = 86400.0;

/// Two control tires, a measurement a month, with a drift in N/kN a year.
std::vector<ControlTire> make_controls(RandomStream& random, double drift_per_year, int months = 24, double sd = 0.04) {
  std::vector<ControlTire> tires{{"K1", {}}, {"K2", {}}};
  for (int month = 0; month < months; ++month) {
    const double time_s = 28.0 * kDay * month;
    for (std::size_t i = 0; i < 2; ++i) {
      const double level = i == 0 ? 7.9 : 10.2;
      tires[i].measurements.push_back(
          {time_s, level + drift_per_year * time_s / (365.25 * kDay) + sd * random.normal(), true});
    }
  }
  return tires;
}

}  // namespace

TEST_CASE("a drift of the machine is found with an interval that holds it", "[fast]") {
  RandomStream random(1, "drift");
  int covered = 0, found = 0;
  constexpr int kTimes = 400;
  for (int i = 0; i < kTimes; ++i) {
    const ControlMonitoring seen = watch_control_tires(make_controls(random, 0.06));
    REQUIRE(seen.drift.has_value());
    covered += seen.drift->low_95 <= 0.06 && 0.06 <= seen.drift->high_95 ? 1 : 0;
    found += has_drift(seen) ? 1 : 0;
  }
  CHECK(covered / double(kTimes) == Approx(0.95).margin(0.033));  // three standard deviations of 400 draws
  CHECK(found / double(kTimes) > 0.9);
}

TEST_CASE("a machine that does not drift is seldom said to", "[fast]") {
  RandomStream random(2, "no drift");
  int found = 0, in_control = 0;
  constexpr int kTimes = 1000;
  for (int i = 0; i < kTimes; ++i) {
    const ControlMonitoring seen = watch_control_tires(make_controls(random, 0.0));
    found += has_drift(seen) ? 1 : 0;
    in_control += is_out_of_control(seen.charts[0]) ? 0 : 1;
  }
  CHECK(found / double(kTimes) < 0.02);       // level 0.01
  CHECK(in_control / double(kTimes) > 0.75);  // 24 points, limits that are estimated from them
}

TEST_CASE("the standard deviation of a chart does not take in its drift", "[fast]") {
  RandomStream random(3, "range");
  double sd = 0.0;
  constexpr int kTimes = 300;
  for (int i = 0; i < kTimes; ++i) {
    sd += watch_control_tires(make_controls(random, 0.5, 36)).charts[0].sd_N_per_kN / kTimes;
  }
  CHECK(sd == Approx(0.04).epsilon(0.25));  // a month's drift of 0.04 N/kN adds to neighbors; all of it would be 0.4
}

TEST_CASE("one measurement that falls out is named by its place, a gap by its days", "[fast]") {
  RandomStream random(4, "step");
  std::vector<ControlTire> tires = make_controls(random, 0.0);
  tires[1].measurements[9].rrc_N_per_kN += 0.4;
  tires[1].measurements.erase(tires[1].measurements.begin() + 15);
  const ControlMonitoring seen = watch_control_tires(tires);
  REQUIRE(seen.charts[1].outside.size() == 1);
  CHECK(seen.charts[1].outside[0] == 9);
  CHECK(is_out_of_control(seen.charts[1]));
  CHECK(seen.charts[1].largest_gap_days == Approx(56.0));
  CHECK(seen.charts[0].largest_gap_days == Approx(28.0));
}

TEST_CASE("equal control values are not outside their limits", "[fast]") {
  std::vector<ControlTire> tires{{"K1", {}}};
  for (int month = 0; month < 15; ++month) tires[0].measurements.push_back({28.0 * kDay * month, 8.27, true});
  const ControlMonitoring seen = watch_control_tires(tires);
  CHECK(seen.charts[0].outside.empty());
  CHECK(seen.charts[0].longest_run == 0);
}

TEST_CASE("too few control measurements say nothing of a drift", "[fast]") {
  RandomStream random(5, "few");
  CHECK_FALSE(watch_control_tires({}).drift.has_value());
  CHECK_FALSE(watch_control_tires(make_controls(random, 0.1, 2)).drift.has_value());
  CHECK_FALSE(is_out_of_control(watch_control_tires(make_controls(random, 0.1, 1)).charts[0]));
}

TEST_CASE("coarse control values that do not drift are as seldom doubted as fine ones", "[fast]") {
  constexpr int kTimes = 400;
  for (const int months : {6, 10, 16}) {
    double drifts[2] = {0.0, 0.0}, alarms[2] = {0.0, 0.0};
    for (const std::size_t is_coarse : {0u, 1u}) {
      RandomStream random(6, "coarse");
      for (int i = 0; i < kTimes; ++i) {
        std::vector<ControlTire> tires = make_controls(random, 0.0, months, 0.045);
        for (ControlTire& tire : tires) {
          for (AlignmentMeasurement& one : tire.measurements) {
            if (is_coarse == 1) one.rrc_N_per_kN = std::round(10.0 * one.rrc_N_per_kN) / 10.0;
          }
        }
        const ControlMonitoring seen = watch_control_tires(tires);
        drifts[is_coarse] += has_drift(seen) ? 1.0 / kTimes : 0.0;
        alarms[is_coarse] += is_out_of_control(seen.charts[0]) ? 1.0 / kTimes : 0.0;
      }
    }
    INFO(months << ": drifts " << drifts[0] << " " << drifts[1] << ", alarms " << alarms[0] << " " << alarms[1]);
    CHECK(drifts[1] < 0.025);  // level 0.01, three standard deviations of 400 draws
    CHECK(alarms[1] < alarms[0] + 0.04);
  }
}

TEST_CASE("values that tie with their mean within half a step are on no side of it", "[fast]") {
  std::vector<ControlTire> tires{{"K1", {}}};
  for (int month = 0; month < 12; ++month) {
    tires[0].measurements.push_back({28.0 * kDay * month, month == 11 ? 8.4 : month == 10 ? 8.5 : 8.3, true});
  }
  const ControlMonitoring seen = watch_control_tires(tires);
  CHECK(seen.charts[0].longest_run < kMostOnOneSide);
  CHECK(seen.charts[0].sd_N_per_kN >= Approx(0.1 / std::sqrt(12.0)));
}

TEST_CASE("a step of the mean is named by the day from which on it is there", "[fast]") {
  RandomStream random(7, "shift");
  std::vector<ControlTire> tires = make_controls(random, 0.0, 14, 0.03);
  CHECK_FALSE(watch_control_tires(tires).charts[1].shift.has_value());
  for (std::size_t i = 8; i < 14; ++i) tires[1].measurements[i].rrc_N_per_kN += 0.3;
  const ControlChart chart = watch_control_tires(tires).charts[1];
  REQUIRE(chart.shift.has_value());
  CHECK(chart.shift->from_s == Approx(8.0 * 28.0 * kDay));
  CHECK(chart.shift->by_N_per_kN == Approx(0.3).margin(0.06));
}

TEST_CASE("one jump of one control tire with few values is a shift of the machine", "[fast]") {
  const auto watch = [](const std::vector<double>& values) {
    std::vector<ControlTire> tires{{"K1", {}}};
    for (const double value : values) {
      tires[0].measurements.push_back({28.0 * kDay * static_cast<double>(tires[0].measurements.size()), value, true});
    }
    return watch_control_tires(tires);
  };
  const ControlMonitoring seen = watch({8.24, 8.24, 8.20, 8.67, 8.58, 8.61});
  REQUIRE(seen.shift.has_value());
  CHECK(seen.shift->from_s == Approx(3.0 * 28.0 * kDay));
  CHECK(seen.shift->by_N_per_kN == Approx(0.3933).margin(1e-4));
  CHECK(seen.shift->p_value == Approx(0.000558).margin(1e-6));  // t = 13.27 of 4 degrees of freedom, of three days
  CHECK(has_drift(seen));
  CHECK(is_out_of_control(seen.charts[0]));
  CHECK(has_drift(watch({8.24, 8.22, 9.24, 9.21})));
  CHECK(has_drift(watch({8.24, 8.22, 8.25, 9.24, 9.21, 9.26})));
  CHECK_FALSE(has_drift(watch({8.24, 8.22, 9.24})));
  CHECK_FALSE(has_drift(watch({8.2, 8.2, 8.3, 8.3})));  // a step of the values
}

TEST_CASE("a jump of one of two control tires is its own, one of both is that of the machine", "[fast]") {
  RandomStream random(8, "whose shift");
  std::vector<ControlTire> tires = make_controls(random, 0.0, 6, 0.03);
  for (std::size_t i = 3; i < 6; ++i) tires[1].measurements[i].rrc_N_per_kN += 0.4;
  const ControlMonitoring one = watch_control_tires(tires);
  CHECK_FALSE(one.shift.has_value());
  CHECK_FALSE(is_out_of_control(one.charts[0]));
  CHECK(is_out_of_control(one.charts[1]));
  for (std::size_t i = 3; i < 6; ++i) tires[0].measurements[i].rrc_N_per_kN += 0.4;
  const ControlMonitoring both = watch_control_tires(tires);
  REQUIRE(both.shift.has_value());
  CHECK(both.shift->by_N_per_kN == Approx(0.4).margin(0.06));
}

TEST_CASE("control tires that hold are seldom said to drift or to shift, whatever their number and rounding",
          "[fast]") {
  RandomStream random(9, "no shift");
  constexpr int kTimes = 400;
  for (const double step : {0.001, 0.01, 0.1}) {
    int found = 0, sets = 0;
    for (const int months : {4, 5, 6, 8, 12}) {
      for (int i = 0; i < kTimes; ++i, ++sets) {
        std::vector<ControlTire> tires = make_controls(random, 0.0, months, 0.04);
        tires.pop_back();
        const double level = random.uniform();
        for (AlignmentMeasurement& one : tires[0].measurements) {
          one.rrc_N_per_kN = step * std::round((one.rrc_N_per_kN + level) / step);
        }
        const ControlMonitoring seen = watch_control_tires(tires);
        found += has_drift(seen) || seen.charts[0].shift.has_value() ? 1 : 0;
      }
    }
    INFO(step << ": " << found << " of " << sets);
    CHECK(found / double(sets) < 0.0165);  // level 0.01, three standard deviations of 2000 draws
  }
}
