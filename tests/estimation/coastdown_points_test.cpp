#include "estimation/road_load/coastdown_points.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig::estimation;

namespace {

/// v(t) of dv/dt = -c v^2, exactly: v0/(1 + c v0 t).
CoastdownRun make_drag_run(double v0, double c, double interval_s, double end_s) {
  CoastdownRun run;
  for (double t = 0.0; t <= end_s; t += interval_s) {
    run.time_s.push_back(t);
    run.speed_m_s.push_back(v0 / (1.0 + c * v0 * t));
  }
  return run;
}

DecelerationCurve drag_curve(double c, double v) { return {c * v * v, 2.0 * c * v, 2.0 * c}; }

}  // namespace

TEST_CASE("passing times of a vehicle with drag alone", "[fast]") {
  // t(v) = (1/v - 1/v0)/c
  constexpr double c = 3e-4, v0 = 36.0;
  const CoastdownRun run = make_drag_run(v0, c, 0.1, 200.0);
  const auto cells = cut_into_cells(run, {});
  REQUIRE(cells.size() > 10);
  for (const SpeedCell& cell : cells) {
    const double v = cell.nominal_speed_m_s;
    CHECK(calc_passing_time_s(cell, drag_curve(c, v)) == Approx((1.0 / v - 1.0 / v0) / c).margin(2e-4));
  }
}

TEST_CASE("the error of a passing time falls with the fourth power of the cell", "[fast]") {
  constexpr double c = 3e-4, v0 = 36.0;
  const CoastdownRun run = make_drag_run(v0, c, 0.01, 400.0);
  const auto error = [&](double width) {
    CellOptions options;
    options.width_m_s = width;
    double worst = 0.0;
    for (const SpeedCell& cell : cut_into_cells(run, options)) {
      const double v = cell.nominal_speed_m_s;
      if (std::abs(v - 16.0) > 1e-9) continue;
      worst = std::abs(calc_passing_time_s(cell, drag_curve(c, v)) - (1.0 / v - 1.0 / v0) / c);
    }
    return worst;
  };
  const double order = std::log2(error(8.0) / error(4.0));
  INFO("order " << order);
  CHECK(order > 3.5);
}

TEST_CASE("only the coasting part of a trace is cut, each sample once", "[fast]") {
  CoastdownRun run;
  const auto add = [&run](double speed) {
    run.time_s.push_back(0.5 * static_cast<double>(run.time_s.size()));
    run.speed_m_s.push_back(speed);
  };
  for (int i = 0; i < 60; ++i) add(0.5 * i);          // run-up
  for (int i = 0; i < 200; ++i) add(30.0 - 0.1 * i);  // coast to 10 m/s
  for (int i = 0; i < 60; ++i) add(10.0 + 0.3 * i);   // drive home
  const auto cells = cut_into_cells(run, {});
  REQUIRE(cells.size() > 5);
  std::size_t last_end = 0;
  for (const SpeedCell& cell : cells) {
    CHECK(cell.first_sample >= last_end);
    CHECK(cell.first_sample >= 59);
    CHECK(cell.end_sample <= 263);
    CHECK(cell.end_sample - cell.first_sample == static_cast<std::size_t>(cell.samples));
    last_end = cell.end_sample;
  }
}

TEST_CASE("a trace that only rises, or is too short, gives no two cells", "[fast]") {
  CoastdownRun rising;
  for (int i = 0; i < 100; ++i) {
    rising.time_s.push_back(i);
    rising.speed_m_s.push_back(0.3 * i);
  }
  CHECK(cut_into_cells(rising, {}).size() < 2);
  CoastdownRun two;
  two.time_s = {0.0, 1.0};
  two.speed_m_s = {30.0, 20.0};
  CHECK(cut_into_cells(two, {}).empty());
}
