#include "measurements/logs/resample.h"
#include "measurements/whitener.h"
#include "tests/support/machines.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <ctime>

using namespace rollrig;
using measurements::Log;

namespace {

Log make_log(const std::string& form, double start_s, double interval_s, std::size_t rows) {
  Log log;
  log.file = form + ".csv";
  log.form = form;
  log.interval_s = interval_s;
  for (std::size_t i = 0; i < rows; ++i) {
    log.time_s.push_back(start_s + interval_s * static_cast<double>(i));
    log.line.push_back(static_cast<int>(i) + 2);
  }
  return log;
}

struct Pair {
  Log torque = make_log("torque_log", 0.0, 1.0, 101);
  Log tire;
  measurements::Mapping mapping;

  Pair(double start_s, double interval_s, std::size_t rows) : tire(make_log("tire_log", start_s, interval_s, rows)) {
    mapping.set.kind = tests::kDrum;
    for (const double t : torque.time_s) {
      torque.columns["speed_km_h"].push_back(20.0 + 0.01 * t);
      torque.columns["load_N"].push_back(t < 50.0 ? 5000.0 : 200.0);
      torque.columns["ambient_degC"].push_back(298.0);
    }
  }
  measurements::ResampledRun resample(double interval_s, double from_s = 0.0, double to_s = 100.0) const {
    return measurements::resample_run(mapping, {&torque, &tire}, interval_s, from_s, to_s);
  }
};

}  // namespace

TEST_CASE("a mean over a row keeps a straight line, whatever the clocks' shift and the log's pace", "[fast]") {
  for (const double interval_s : {0.1, 0.25, 1.0}) {
    for (const double start_s : {-10.0, -10.37}) {
      Pair pair(start_s, interval_s, static_cast<std::size_t>(125.0 / interval_s));
      for (const double t : pair.tire.time_s) pair.tire.columns["liner_temperature_degC"].push_back(300.0 + 0.1 * t);
      const measurements::ResampledRun run = pair.resample(1.0);
      const std::vector<double>& values = run.columns.at("liner_temperature_degC");
      for (std::size_t row = 1; row + 1 < run.time_s.size(); ++row) {
        // A sample stands for its whole cell: a mean over parts of cells is right to an eighth of a sample's change.
        CHECK(values[row] == Approx(300.0 + 0.1 * run.time_s[row]).margin(0.1 * interval_s / 8.0 + 1e-9));
      }
    }
  }
}

TEST_CASE("what the rows of a measured column hold sums up to what the log holds", "[fast]") {
  Pair pair(-5.3, 1.0, 120);
  for (std::size_t i = 0; i < 120; ++i) {
    pair.tire.columns["cavity_pressure_kPa"].push_back(i == 60 ? 1000.0 : 0.0);  // the sample at 54.7 s
  }
  const measurements::ResampledRun run = pair.resample(1.0);
  const std::vector<double>& values = run.columns.at("cavity_pressure_kPa");
  double sum = 0.0, moment = 0.0;
  for (std::size_t row = 1; row + 1 < values.size(); ++row) {
    sum += values[row];
    moment += values[row] * static_cast<double>(row);
  }
  CHECK(sum == Approx(1000.0));
  CHECK(moment / sum == Approx(54.7));
}

TEST_CASE("given columns run linearly between samples, the load holds", "[fast]") {
  const Pair pair(0.0, 1.0, 101);
  const measurements::ResampledRun run = pair.resample(0.25, 49.0, 51.0);
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double t = 49.0 + run.time_s[row];
    CHECK(run.columns.at("speed_km_h")[row] == Approx(20.0 + 0.01 * t));
    CHECK(run.columns.at("load_N")[row] == (t < 50.0 ? 5000.0 : 200.0));
  }
}

TEST_CASE("gaps and marked values leave empty fields, never made-up ones", "[fast]") {
  Pair pair(-5.5, 0.5, 240);
  for (const double t : pair.tire.time_s) pair.tire.columns["liner_temperature_degC"].push_back(300.0 + t);
  std::vector<double>& values = pair.tire.columns["liner_temperature_degC"];
  for (std::size_t i = 71; i < 81; ++i) values[i] = std::nan("");  // 30.0 to 34.5 s
  pair.tire.marks.push_back(
      {"tire_log.csv", 73, models::quantities::kLinerTemperature, 30.0, 34.5, std::nullopt, "spike"});
  const measurements::ResampledRun run = pair.resample(1.0);
  for (std::size_t row = 1; row + 1 < run.time_s.size(); ++row) {
    const bool touched = run.time_s[row] + 0.5 > 29.75 && run.time_s[row] - 0.5 < 34.75;
    INFO(run.time_s[row]);
    CHECK(std::isnan(run.columns.at("liner_temperature_degC")[row]) == touched);
  }
  bool listed = false;
  for (const measurements::EmptyRange& range : run.empty) {
    listed = listed || (range.reason == "spike" && range.from_s == 30.0 && range.to_s == 35.0 && range.rows == 6);
  }
  CHECK(listed);
}

TEST_CASE("a log slower than the rows gives each sample to one row, and no row another", "[fast]") {
  Pair pair(0.3, 10.0, 10);
  for (const double t : pair.tire.time_s) pair.tire.columns["liner_temperature_degC"].push_back(300.0 + t);
  const measurements::ResampledRun run = pair.resample(1.0);
  int there = 0;
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double value = run.columns.at("liner_temperature_degC")[row];
    if (std::isnan(value)) continue;
    ++there;
    CHECK(std::abs(value - 300.0 - run.time_s[row]) <= 0.5);
  }
  CHECK(there == 10);
  CHECK(run.rows_between.at("liner_temperature_degC") > 80);
}

TEST_CASE("rows without an input are left out, and too many of them are refused", "[fast]") {
  Pair pair(0.0, 1.0, 101);
  for (const double t : pair.tire.time_s) pair.tire.columns["liner_temperature_degC"].push_back(300.0 + t);
  pair.torque.columns["speed_km_h"][40] = std::nan("");
  pair.torque.marks.push_back({"torque_log.csv", 42, models::quantities::kSpeed, 40.0, 40.0, std::nullopt, "no value"});
  const measurements::ResampledRun run = pair.resample(1.0);
  CHECK(run.time_s.size() == 100);
  CHECK(run.time_s[40] == 41.0);
  // The rows beside it now stand for a second and a half each.
  CHECK(run.columns.at("liner_temperature_degC")[39] == Approx(300.0 + 39.25).margin(0.1));
  REQUIRE(!run.empty.empty());
  CHECK(run.empty.front().rows_left_out);
  for (std::size_t row = 40; row < 60; ++row) pair.torque.columns["speed_km_h"][row] = std::nan("");
  CHECK_THROWS_WITH(pair.resample(1.0), Catch::Contains("speed_km_h") && Catch::Contains("line 42"));
}

TEST_CASE("the noise of a mean over samples is the smaller, but for what rounding leaves", "[fast]") {
  const models::SensorParameters noisy{0.1, 0.2, 60.0, 0.5, 0.0};
  CHECK(measurements::average_sensor(noisy, 1.0).noise_sd == noisy.noise_sd);
  CHECK(measurements::average_sensor(noisy, 25.0).noise_sd == Approx(0.1));
  CHECK(measurements::average_sensor(noisy, 25.0).drift_sd == noisy.drift_sd);
  const models::SensorParameters coarse{0.0, 0.0, 60.0, 0.0, 1.0};
  CHECK(measurements::average_sensor(coarse, 1000.0).noise_sd == Approx(1.0 / std::sqrt(12.0)));
}

TEST_CASE("a log in which every second value is missing takes no longer for each row when it is long", "[slow]") {
  constexpr std::size_t kRows = 300000;
  Log log = make_log("torque_log", 0.0, 1.0, kRows);
  for (std::size_t i = 0; i < kRows; ++i) {
    log.columns["speed_km_h"].push_back(20.0);
    log.columns["load_N"].push_back(5000.0);
    log.columns["ambient_degC"].push_back(298.0);
    log.columns["drum_torque_Nm"].push_back(i % 2 == 0 ? 10.0 : std::nan(""));
    if (i % 2 == 1) {
      log.marks.push_back({log.file, log.line[i], models::quantities::kDrumTorque, log.time_s[i], log.time_s[i],
                           std::nullopt, i % 4 == 1 ? "no value" : "bad field"});
    }
  }
  measurements::Mapping mapping;
  mapping.set.kind = tests::kDrum;
  const std::clock_t start = std::clock();
  const auto run = measurements::resample_run(mapping, {&log, nullptr}, 1.0, 0.0, static_cast<double>(kRows - 1));
  // A second or so with sanitizers; two minutes, were all marks looked at for each row.
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 15.0);
  const auto rows_of = [&run](const char* reason) {
    return std::count_if(run.empty.begin(), run.empty.end(), [reason](const measurements::EmptyRange& range) {
      return range.column == models::quantities::kDrumTorque && range.reason == reason;
    });
  };
  CHECK(rows_of("no value") > 70000);
  CHECK(rows_of("bad field") > 70000);
}
