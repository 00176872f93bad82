// Samples of stuck sensors and samples that stand alone are left out of a set, those beside them stay.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/checks/sample_checks.h"
#include "tests/diagnosis/checked_sets.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::check_set;
using diagnosis::SetChecks;
using measurements::MeasuredRun;
using measurements::MeasurementSet;
using tests::join;
using tests::kChannels;
using tests::short_set;

TEST_CASE("a stuck sensor is left out, where it stands still", "[fast]") {
  for (const char* channel : kChannels) {
    for (const std::size_t from : {std::size_t{0}, std::size_t{300}}) {
      MeasurementSet set = short_set();
      std::vector<double>& values = set.runs[1].columns.at(channel);
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(from), values.end(), values[200]);
      const SetChecks checks = check_set(set);
      INFO(channel << " from " << from << ": " << join(checks.warnings));
      CHECK_FALSE(checks.is_implausible());
      REQUIRE(checks.left_out.size() == 1);
      CHECK(checks.left_out[0].run == 1);
      CHECK(checks.left_out[0].channel.header() == channel);
      CHECK_THAT(join(checks.warnings), Contains("stands at") && Contains(set.runs[1].id));
      // what is left is the set without those samples, and it is let through
      const MeasurementSet kept = diagnosis::leave_out(set, checks.left_out);
      CHECK(std::isnan(kept.runs[1].columns.at(channel)[checks.left_out[0].first_row]));
      CHECK(std::isnan(kept.runs[1].columns.at(channel)[checks.left_out[0].last_row]));
      CHECK(kept.runs[0].columns.at("load_N") == set.runs[0].columns.at("load_N"));
      CHECK(check_set(kept).left_out.empty());
    }
  }
}

TEST_CASE("samples that stand alone are left out, those beside them stay", "[fast]") {
  const MeasurementSet clean = short_set();
  REQUIRE(check_set(clean).left_out.empty());
  for (const char* channel : kChannels) {
    MeasurementSet set = clean;
    std::vector<double>& values = set.runs[1].columns.at(channel);
    std::vector<std::size_t> rows;
    for (std::size_t row = 250; row + 20 < values.size() && rows.size() < 5; row += 37) {
      if (std::isnan(values[row])) continue;
      rows.push_back(row);
      values[row] = -9999.0;
    }
    const SetChecks checks = check_set(set);
    INFO(channel << ": " << join(checks.warnings));
    CHECK_FALSE(checks.is_implausible());
    CHECK_THAT(join(checks.warnings), Contains("5 samples stand alone") && Contains(set.runs[1].id));
    REQUIRE(checks.left_out.size() == rows.size());
    const MeasurementSet kept = diagnosis::leave_out(set, checks.left_out);
    for (const std::size_t row : rows) {
      CHECK(std::isnan(kept.runs[1].columns.at(channel)[row]));
      CHECK(kept.runs[1].columns.at(channel)[row + 1] == clean.runs[1].columns.at(channel)[row + 1]);
    }
  }
}

TEST_CASE("the number of a spike is a placeholder wherever it stands, if nothing comes near to it", "[fast]") {
  MeasurementSet set = short_set();
  std::vector<double>& torque = set.runs[1].columns.at("drum_torque_Nm");
  for (std::size_t row = 5; row < torque.size(); row += 31) torque[row] = -9999.0;  // on ramps and load changes as well
  const SetChecks checks = check_set(set);
  const MeasurementSet kept = diagnosis::leave_out(set, checks.left_out);
  const std::vector<double>& left = kept.runs[1].columns.at("drum_torque_Nm");
  CHECK(std::count(left.begin(), left.end(), -9999.0) == 0);
  CHECK(checks.left_out.size() == static_cast<std::size_t>(std::count(torque.begin(), torque.end(), -9999.0)));
}

TEST_CASE("where every sensor is stuck nothing is left", "[fast]") {
  MeasurementSet set = short_set();
  for (MeasuredRun& run : set.runs) {
    for (const char* channel : kChannels) {
      std::vector<double>& values = run.columns.at(channel);
      std::fill(values.begin(), values.end(), values[200]);
    }
  }
  CHECK_THROWS_WITH(check_set(set), Contains("stands still"));
}

TEST_CASE("a channel that holds still because nothing moves is not doubtful", "[fast]") {
  // coarse steps on a warm tire: minutes on one number
  MeasurementSet set = short_set();
  set.sensors.at("liner_temperature_degC").resolution = 2.0;
  for (MeasuredRun& run : set.runs) {
    for (double& value : run.columns.at("liner_temperature_degC"))
      value = 273.15 + 2.0 * std::round((value - 273.15) / 2.0);
  }
  const SetChecks checks = check_set(set);
  INFO(join(checks.warnings));
  CHECK(checks.left_out.empty());
}
