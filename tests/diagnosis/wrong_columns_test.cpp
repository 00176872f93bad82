// Columns exchanged or in another unit, and levels that no mistake of the list explains, are found in a set.
#include <catch2/catch.hpp>

#include "tests/diagnosis/checked_sets.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::check_set;
using diagnosis::SetChecks;
using measurements::MeasurementSet;
using tests::Answer;
using tests::answer_to;
using tests::exchange;
using tests::exchange_everywhere;
using tests::join;
using tests::kChannels;
using tests::rescale;
using tests::short_set;

TEST_CASE("each pair of exchanged columns is found", "[slow]") {
  const std::vector<std::string> columns{"speed_km_h",     "load_N",     "ambient_degC",
                                         "drum_torque_Nm", kChannels[1], kChannels[2]};
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = a + 1; b < columns.size(); ++b) {
      const Answer answer = answer_to(exchange_everywhere(short_set(), columns[a], columns[b]));
      INFO(columns[a] << " " << columns[b] << ": " << answer.text);
      CHECK(answer.stopped);
      CHECK_THAT(answer.text, Contains("the columns " + columns[a] + " and " + columns[b] + " are exchanged"));
    }
  }
}

TEST_CASE("columns exchanged in one run alone are found in that run", "[fast]") {
  MeasurementSet set = short_set();
  exchange(set.runs[1], "drum_torque_Nm", "liner_temperature_degC");
  const Answer answer = answer_to(set);
  CHECK(answer.stopped);
  CHECK_THAT(answer.text, Contains("in run " + set.runs[1].id) && Contains("are exchanged"));
}

TEST_CASE("a wrong unit is named", "[slow]") {
  struct Case {
    const char* column;
    double factor;
    double offset;
    const char* text;
  };
  const std::vector<Case> cases{{"speed_km_h", 1.0 / 3.6, 0.0, "speed_km_h holds m/s"},
                                {"speed_km_h", 3.6, 0.0, "speed_km_h was multiplied by 3.6"},
                                {"drum_torque_Nm", 3.6, 0.0, "drum_torque_Nm of all runs (3.6 of the simulated"},
                                {"drum_torque_Nm", 1.0 / 3.6, 0.0, "drum_torque_Nm is too small by a factor of 3.6"},
                                {"drum_torque_Nm", -1.0, 0.0, "the other sign"},
                                {"speed_km_h", 1.0 / 1.609344, 0.0, "speed_km_h holds mph"},
                                {"drum_torque_Nm", 1e-3, 0.0, "drum_torque_Nm holds kN m"},
                                {"load_N", 1.0 / 9.80665, 0.0, "load_N holds kgf"},
                                {"load_N", 1e-3, 0.0, "load_N holds kN"},
                                {"cavity_pressure_kPa", 1.0, 101.325, "absolute"},
                                {"cavity_pressure_kPa", 0.01, 0.0, "holds bar"},
                                {"cavity_pressure_kPa", 1.0 / 6.894757, 0.0, "holds psi"},
                                {"liner_temperature_degC", 1.8, 32.0, "liner_temperature_degC holds degF"},
                                {"ambient_degC", 1.8, 32.0, "ambient_degC holds degF"}};
  for (const Case& at : cases) {
    const Answer answer = answer_to(rescale(short_set(), at.column, at.factor, at.offset));
    INFO(at.column << " x " << at.factor << " + " << at.offset << ": " << answer.text);
    CHECK(answer.stopped);
    CHECK_THAT(answer.text, Contains("all runs") && Contains(at.text));
  }
}

TEST_CASE("a wrong unit is found beside the uncertainty of the tire file and an effect", "[fast]") {
  for (const char* id : {"bearing_warmup", "tire_loss_in_skim", "tread_liner_lag"}) {
    for (const double factor : {1.0 / 3.6, 3.6}) {
      tests::Campaign campaign = tests::make_short_campaign();
      campaign.effects = {tests::make_effect_at(id, 0.5)};
      MeasurementSet set = rescale(tests::simulate_campaign(campaign, 3), "speed_km_h", factor);
      set.tire.values.rolling_resistance.A0_N *= 1.05;
      set.tire.values.thermal.heat_capacity_J_per_K *= 0.95;
      const Answer answer = answer_to(set);
      INFO(id << " " << factor << ": " << answer.text);
      CHECK(answer.stopped);
      CHECK_THAT(answer.text, Contains("speed_km_h"));
    }
  }
}

TEST_CASE("a level that no mistake of the list explains is outside, and said with its ratio", "[fast]") {
  const SetChecks checks = check_set(rescale(short_set(), "drum_torque_Nm", 10.0));
  CHECK(checks.is_implausible());
  CHECK_THAT(join(checks.warnings), Contains("drum_torque_Nm of all runs (10 of the simulated"));
}
