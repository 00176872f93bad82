// Sets that cannot be what they are said to be are met before the comparison, and sets that can are let through.
#include "diagnosis/checks/sample_checks.h"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "sim/core/error.h"
#include "sim/core/units.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/drum_sets.h"
#include "tests/support/machines.h"

using Catch::Contains;
using namespace rollrig;
using diagnosis::check_set;
using diagnosis::SetChecks;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

namespace {

const char* const kChannels[] = {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"};

const MeasurementSet& short_set() {
  static const MeasurementSet set = tests::simulate_campaign(tests::make_short_campaign());
  return set;
}

/// The numbers of a column, as a file has them, replaced by factor x + offset.
MeasurementSet rescale(MeasurementSet set, const std::string& column, double factor, double offset = 0.0) {
  const Unit unit = unit_of_key(column);
  for (MeasuredRun& run : set.runs) {
    for (double& value : run.columns.at(column)) value = unit.to_si(factor * unit.from_si(value) + offset);
  }
  return set;
}

/// The headings of two columns exchanged. A file has no empty field in a given column, so those take 20.
void exchange(MeasuredRun& run, const std::string& a, const std::string& b) {
  const std::vector<double> was_a = run.columns.at(a);
  const std::vector<double> was_b = run.columns.at(b);
  const auto read_as = [](const std::string& from, const std::string& to, double value) {
    const bool given = to == "speed_km_h" || to == "load_N" || to == "ambient_degC";
    const double number = unit_of_key(from).from_si(value);
    return unit_of_key(to).to_si(given && std::isnan(number) ? 20.0 : number);
  };
  for (std::size_t row = 0; row < was_a.size(); ++row) {
    run.columns.at(a)[row] = read_as(b, a, was_b[row]);
    run.columns.at(b)[row] = read_as(a, b, was_a[row]);
  }
}

MeasurementSet exchange_everywhere(MeasurementSet set, const std::string& a, const std::string& b) {
  for (MeasuredRun& run : set.runs) exchange(run, a, b);
  return set;
}

std::string join(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

/// All that is said of a set, whether it is refused or warned of.
struct Answer {
  bool stopped = false;  // refused or implausible: no cause is named
  std::string text;
};
Answer answer_to(const MeasurementSet& set) {
  try {
    const SetChecks checks = check_set(set);
    return {checks.is_implausible(), join(checks.warnings)};
  } catch (const InputError& error) {
    return {true, error.what()};
  }
}

/// A draw from the priors: log-normal or normal, two thirds between low and high.
models::ActiveEffect draw_effect(const models::Effect& effect, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) {
    const models::Prior& prior = parameter.prior;
    const double z = normal(random);
    double value = prior.scale == models::Prior::Scale::kLog
                       ? prior.center() * std::pow(prior.high / prior.low, 0.5 * z)
                       : prior.center() + 0.5 * z * (prior.high - prior.low);
    if (prior.either_sign && random() % 2 == 0) value = -value;
    values.push_back(std::clamp(value, parameter.range.lower, parameter.range.upper));
  }
  return tests::make_active(effect, values);
}

}  // namespace

TEST_CASE("a set as the simulator makes it is let through without a word", "[fast]") {
  const SetChecks checks = check_set(short_set());
  INFO(join(checks.warnings));
  CHECK(checks.warnings.empty());
  CHECK(checks.left_out.empty());
  CHECK_FALSE(checks.is_implausible());
}

TEST_CASE("runs of next to no samples are warned of", "[fast]") {
  const auto cut = [](std::size_t rows) {
    MeasurementSet set = short_set();
    for (MeasuredRun& run : set.runs) {
      run.time_s.resize(rows);
      for (auto& [name, values] : run.columns) values.resize(rows);
    }
    return join(check_set(set).warnings);
  };
  CHECK_THAT(cut(19), Contains("hardly any data in all runs"));
  CHECK_THAT(cut(diagnosis::kFewSamples - 1), Contains("hardly any data"));
  CHECK_THAT(cut(diagnosis::kFewSamples + 5), !Contains("hardly any data"));  // where the load jumps a row has none
}

TEST_CASE("no effect of the catalog makes a set look like a mistake", "[slow]") {
  constexpr int kDraws = 20;
  int sets = 0;
  int stopped = 0;
  for (const models::Effect* effect : models::all_effects()) {
    if (!models::acts_in(effect->info, tests::kDrum->traits, models::default_tire_model())) continue;
    std::seed_seq seed(effect->info.id.begin(), effect->info.id.end());  // whatever effects there are beside it
    std::mt19937_64 random(seed);
    for (int i = 0; i < kDraws; ++i) {
      tests::Campaign campaign = tests::make_wide_campaign();
      campaign.effects = {draw_effect(*effect, random)};
      INFO(effect->info.id << " at " << fmt::format("{}", fmt::join(campaign.effects.front().parameters, ", ")));
      const SetChecks checks = check_set(tests::simulate_campaign(campaign, static_cast<std::uint64_t>(i)));
      INFO(join(checks.warnings));
      CHECK_THAT(join(checks.warnings), !Contains("looks as if"));
      CHECK(checks.left_out.empty());
      ++sets;
      stopped += checks.is_implausible() ? 1 : 0;
    }
  }
  // the far tail of a prior may be outside: parasitic losses many times those of the file
  CHECK(stopped <= sets / 100);
}

TEST_CASE("each pair of exchanged columns is found", "[fast]") {
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

TEST_CASE("a wrong unit is named", "[fast]") {
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

TEST_CASE("rows far apart are warned of, with the shift that they may make", "[fast]") {
  MeasurementSet set = short_set();
  CHECK_THAT(join(check_set(set).warnings), !Contains("apart"));
  for (MeasuredRun& run : set.runs) {
    const auto thin = [](std::vector<double>& values) {
      std::vector<double> kept;
      for (std::size_t row = 0; row < values.size(); row += 4) kept.push_back(values[row]);
      values = kept;
    };
    thin(run.time_s);
    for (auto& [name, values] : run.columns) thin(values);
  }
  CHECK_THAT(join(check_set(set).warnings), Contains("s apart") && Contains("clock_shift"));
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

TEST_CASE("nothing measured is an error; a channel without samples a warning", "[fast]") {
  MeasurementSet set = short_set();
  const auto clear = [](MeasuredRun& run, const char* channel) {
    std::vector<double>& values = run.columns.at(channel);
    std::fill(values.begin(), values.end(), std::nan(""));
  };
  clear(set.runs[0], "cavity_pressure_kPa");
  CHECK_THAT(join(check_set(set).warnings), Contains("cavity_pressure_kPa has no sample in run " + set.runs[0].id));
  for (MeasuredRun& run : set.runs) run.columns.erase(models::quantities::kCavityPressure);
  CHECK_THAT(join(check_set(set).warnings), Contains("cavity_pressure_kPa was not measured"));
  for (MeasuredRun& run : set.runs) {
    clear(run, "drum_torque_Nm");
    clear(run, "liner_temperature_degC");
  }
  CHECK_THROWS_WITH(check_set(set), Contains("nothing was measured") && Contains(set.path));
}

TEST_CASE("a run that measured nothing is warned of, once", "[fast]") {
  MeasurementSet set = short_set();
  MeasuredRun& empty = set.runs[1];
  for (const char* channel : kChannels) empty.columns.erase(intern_quantity(channel));
  const std::vector<std::string> missing = diagnosis::find_missing_samples(set);
  REQUIRE(missing.size() == 1);
  CHECK_THAT(missing[0], Contains("run " + empty.id) && Contains("measured nothing"));
  CHECK(join(check_set(set).warnings) == join(missing));
}

TEST_CASE("torque that never settles is said not to count", "[fast]") {
  MeasurementSet set = short_set();
  for (double& speed_m_s : set.runs[0].columns.at("speed_km_h")) speed_m_s = 10.0 / 3.6;
  CHECK_THAT(answer_to(set).text, Contains("no torque of run " + set.runs[0].id) && Contains("20 km/h"));
}

TEST_CASE("one run works, and says what it cannot show", "[fast]") {
  MeasurementSet set = short_set();
  set.runs.resize(1);
  const SetChecks checks = check_set(set);
  CHECK_FALSE(checks.is_implausible());
  REQUIRE(checks.warnings.size() == 1);
  CHECK_THAT(checks.warnings[0], Contains("one run only"));
}

TEST_CASE("the same samples under two names are no second run", "[fast]") {
  MeasurementSet set = short_set();
  set.runs.push_back(set.runs[0]);
  set.runs.back().id = "again";
  CHECK_THAT(join(check_set(set).warnings), Contains("hold the same samples") && Contains("again"));
}

TEST_CASE("a wrong tire is warned of", "[fast]") {
  for (const char* file : {"a40", "a60"}) {
    MeasurementSet set = short_set();
    set.tire = tests::read_asset_tire(file);
    const SetChecks checks = check_set(set);
    INFO(file);
    CHECK_THAT(join(checks.warnings), Contains("tire a50 (235/50 R19) fits these runs far better"));
  }
  MeasurementSet truck = short_set();
  truck.tire.values.rolling_resistance.reference_load_N *= 6.0;
  truck.tire.values.rolling_resistance.reference_pressure_Pa *= 3.0;
  const Answer answer = answer_to(truck);
  CHECK_THAT(answer.text, Contains("cold pressure") && Contains("load"));
}

TEST_CASE("a drum set with noise is asked for", "[fast]") {
  MeasurementSet set = short_set();
  set.sensors.at("drum_torque_Nm") = {};
  CHECK_THROWS_WITH(check_set(set), Contains("no noise at all") && Contains("[sensors.drum_torque_Nm]"));
  set = short_set();
  set.kind = tests::kRoad;
  CHECK_THROWS_AS(check_set(set), InputError);
}

TEST_CASE("a run that cannot be simulated is an error that names it", "[fast]") {
  MeasurementSet set = short_set();
  for (double& ambient_K : set.runs[2].columns.at("ambient_degC")) ambient_K = std::nan("");
  CHECK_THROWS_WITH(check_set(set), Contains("cannot be simulated") && Contains(set.runs[2].id));
}

TEST_CASE("ten hours of data are checked", "[fast]") {
  tests::Campaign campaign;
  campaign.parts = {{"transient_skim", {"repeats=75"}}, {"warm_up", {"speed_km_h=80"}}};
  const MeasurementSet set = tests::simulate_campaign(campaign);
  REQUIRE(set.runs[0].time_s.back() > 36000.0 - 3600.0);
  const SetChecks checks = check_set(set);
  INFO(join(checks.warnings));
  CHECK(checks.warnings.empty());
}

TEST_CASE("the checks do not depend on threads or on the order of runs", "[fast]") {
  MeasurementSet set = exchange_everywhere(short_set(), "drum_torque_Nm", "liner_temperature_degC");
  const SetChecks one = check_set(set, 1);
  CHECK(check_set(set, 2).warnings == one.warnings);
  std::reverse(set.runs.begin(), set.runs.end());
  CHECK(check_set(set, 2).warnings == one.warnings);
}
