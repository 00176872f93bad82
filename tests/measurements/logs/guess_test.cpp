// Guesses about logs of other laboratories: right, or asked for, and never wrong without a word.
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "measurements/logs/guess.h"
#include "measurements/logs/mapping.h"
#include "sim/core/error.h"
#include "tests/support/foreign_logs.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using measurements::GuessedColumn;
using measurements::GuessedUnit;
using tests::LoggerStyle;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

const std::string kExample = ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect";

GuessOptions make_options(const std::string& folder) {
  GuessOptions options;
  options.folder = folder;
  options.tire = kExample + "/tire.toml";
  options.rig = kExample + "/rig.toml";
  return options;
}

/// Whether the columns of the first log have the values of the first run, as far as they are written.
bool has_values_of(const measurements::Guess& guess, const measurements::MeasuredRun& run, int every) {
  for (const GuessedColumn& column : guess.columns) {
    const std::vector<double>& truth = run.columns.at(column.target);
    const std::vector<double> numbers = guess.source.numbers_of(column.heading);
    for (std::size_t row = 0; row * static_cast<std::size_t>(every) < truth.size(); ++row) {
      const double value_SI = truth[row * static_cast<std::size_t>(every)];
      const double value = column.target.file_unit().from_si(value_SI);
      if (std::isnan(value_SI) != std::isnan(numbers[row])) return false;
      if (std::isnan(value_SI)) continue;
      // four decimals of the log, in any unit
      if (std::abs(column.unit.convert(column.sign * numbers[row], column.target) - value) >
          1e-3 * std::abs(value) + 1e-2)
        return false;
    }
  }
  return guess.columns.size() == run.columns.size();
}

bool has_times_of(const measurements::Guess& guess, const measurements::MeasuredRun& run, int every) {
  const std::vector<double> times_s = read_guessed_times(guess.source, guess.time, guess.source.logs.front());
  for (std::size_t row = 1; row < times_s.size(); ++row) {
    const double truth_s = run.time_s[row * static_cast<std::size_t>(every)] - run.time_s.front();
    if (std::abs(times_s[row] - times_s.front() - truth_s) > 0.02) return false;
  }
  return true;
}

/// Sessions and rests as the times of the logs tell them, and a soaked tire where they tell nothing.
bool has_runs_of(const measurements::Guess& guess, const measurements::MeasurementSet& set, const LoggerStyle& style) {
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    const measurements::GuessedRun& run = guess.runs[i];
    const measurements::MeasuredRun& truth = set.runs[i];
    if (run.id != truth.id) return false;
    if (std::abs(run.initial_tire_temperature_K - truth.initial_tire_temperature_K) > 1.0) return false;
    if (std::abs(run.cold_pressure_Pa - truth.cold_pressure_Pa) > 1500.0) return false;
    if (!tests::is_dated(style)) continue;
    if (run.rest_before_s.has_value() != truth.rest_before_s.has_value()) return false;
    // the log ends up to `every` rows early
    if (run.rest_before_s.has_value() && std::abs(*run.rest_before_s - *truth.rest_before_s) > 15.0) return false;
    if (i > 0 && (run.session == guess.runs[i - 1].session) != (truth.session == set.runs[i - 1].session)) return false;
  }
  return guess.runs.size() == set.runs.size();
}

enum class Answer { kRight, kAsked, kWrong };

Answer judge_guess(const measurements::MeasurementSet& set, const LoggerStyle& style) {
  const TemporaryFolder folder;
  tests::write_foreign_logs(set, style, folder.path());
  try {
    const measurements::Guess guess = measurements::guess_logs(make_options(folder.path()));
    const measurements::MeasuredRun& run = set.runs.front();
    const bool values = has_values_of(guess, run, style.every), times = has_times_of(guess, run, style.every),
               runs = has_runs_of(guess, set, style);
    if (!(values && times && runs)) UNSCOPED_INFO("values " << values << ", times " << times << ", runs " << runs);
    return values && times && runs ? Answer::kRight : Answer::kWrong;
  } catch (const InputError& error) {
    WARN("asked for: " << error.problem().what << " (" << error.problem().key << "): " << tests::describe(style));
    CHECK_FALSE(error.problem().key.empty());  // names an option
    return Answer::kAsked;
  }
}

}  // namespace

TEST_CASE("logs of sixty laboratories: what is guessed is right, and the rest is asked for", "[slow]") {
  const measurements::MeasurementSet set = measurements::read_measurement_set(kExample);
  constexpr int kFolders = 60;
  int right = 0, asked = 0, stated = 0, stated_right = 0;
  for (std::uint64_t seed = 1; seed <= kFolders; ++seed) {
    const LoggerStyle style = tests::make_logger_style(seed);
    INFO("seed " << seed << ": " << tests::describe(style));
    const Answer answer = judge_guess(set, style);
    CHECK(answer != Answer::kWrong);
    right += answer == Answer::kRight ? 1 : 0;
    asked += answer == Answer::kAsked ? 1 : 0;
    if (style.units == LoggerStyle::Units::kNone) continue;
    ++stated;
    stated_right += answer == Answer::kRight ? 1 : 0;
  }
  WARN(right << " of " << kFolders << " guessed fully right, " << asked << " asked for; of those that state units "
             << stated_right << " of " << stated);
  CHECK(stated_right == stated);   // a log that states its units needs no question
  CHECK(right >= 0.9 * kFolders);  // docs/own_tire_and_set.md
}

TEST_CASE("units are known by their usual spellings", "[fast]") {
  const auto convert = [](const char* text, double number, const char* column) {
    const std::optional<GuessedUnit> unit = measurements::find_unit(text);
    REQUIRE(unit.has_value());
    return unit->convert(number, intern_quantity(column));
  };
  CHECK(convert("m/s", 10.0, "speed_km_h") == Approx(36.0));
  CHECK(convert("mph", 60.0, "speed_km_h") == Approx(96.56064));
  CHECK(convert("kN", 5.4, "load_N") == Approx(5400.0));
  CHECK(convert("kg", 100.0, "load_N") == Approx(980.665));
  CHECK(convert("\u00B0C", 25.0, "ambient_degC") == Approx(25.0));
  CHECK(convert("\u00B0F", 77.0, "ambient_degC") == Approx(25.0));
  CHECK(convert("K", 298.15, "ambient_degC") == Approx(25.0));
  CHECK(convert("bar", 2.5, "cavity_pressure_kPa") == Approx(250.0));
  CHECK(convert("psi", 36.2594, "cavity_pressure_kPa") == Approx(250.0).epsilon(1e-5));
  CHECK(convert("bar(a)", 3.51325, "cavity_pressure_kPa") == Approx(250.0));
  CHECK(convert("N\u00B7m", 47.0, "drum_torque_Nm") == Approx(47.0));
  CHECK_FALSE(measurements::find_unit("furlong").has_value());
}

TEST_CASE("headings are taken apart into name and unit", "[fast]") {
  struct Known {
    const char* heading;
    const char* name;
    const char* unit;
  };
  for (const Known& known : {Known{"Geschwindigkeit [m/s]", "Geschwindigkeit", "m/s"},
                             {"Druck (bar)", "Druck", "bar"},
                             {"Load / kN", "Load", "kN"},
                             {"Radlast in N", "Radlast", "N"},
                             {"p_bar", "p", "bar"},
                             {"drum km/h", "drum", "km/h"},
                             {"v_km_h", "v", "km_h"}}) {
    INFO(known.heading);
    const measurements::HeadingParts parts = measurements::split_heading(known.heading, "");
    CHECK(parts.name == known.name);
    REQUIRE(parts.unit.has_value());
    CHECK(parts.unit->written == known.unit);
  }
  for (const char* heading : {"T_liner", "F_z", "Druck (vorne)", "Radlast"}) {
    INFO(heading);
    CHECK_FALSE(measurements::split_heading(heading, "").unit.has_value());
  }
  CHECK(measurements::split_heading("Druck [inHg]", "").unknown_unit == "inHg");
}

TEST_CASE("the written mapping says of each guess that it is one, and is read as it was guessed", "[fast]") {
  const measurements::MeasurementSet set = measurements::read_measurement_set(kExample);
  const TemporaryFolder folder;
  LoggerStyle style;
  style.is_german = true;
  style.separator = ';';
  style.decimal = ',';
  style.time = LoggerStyle::Time::kClockAndDate;
  style.speed_unit = "m/s";
  style.every = 5;
  tests::write_foreign_logs(set, style, folder.path());
  const measurements::Guess guess = measurements::guess_logs(make_options(folder.path()));
  const std::string text = measurements::write_guessed_mapping(guess, folder.path());
  for (const char* key : {"separator = ", "decimal = ", "header_line = ", "first_row_line = ", "column = \"Uhrzeit\"",
                          "date_order = ", "speed_km_h = ", "load_N = ", "ambient_degC = ", "drum_torque_Nm = ",
                          "liner_temperature_degC = ", "cavity_pressure_kPa = ", "session = ", "sensors = "}) {
    INFO(key << "\n" << text);
    const std::size_t at = text.find(std::string("\n") + key);
    REQUIRE(at != std::string::npos);
    const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    CHECK_THAT(line, Catch::Contains("# "));
  }
  write_file(folder.file("import.toml"), text);
  const measurements::Mapping mapping = measurements::read_mapping(folder.file("import.toml"));
  CHECK(mapping.runs.size() == set.runs.size());
  CHECK(mapping.torque_log.columns.size() == guess.columns.size());
}

TEST_CASE("a log that counts loads and torques downwards is turned", "[fast]") {
  const TemporaryFolder folder;
  std::string text = "Zeit [s];v [km/h];Fz [N];M [Nm];T Luft [\u00B0C];T innen [\u00B0C];p [bar]\n";
  for (int i = 0; i < 300; ++i) text += std::to_string(i) + ";80,0;-5400,0;-47,5;25,0;25,0;2,5\n";
  write_file(folder.file("run.csv"), text);
  const measurements::Guess guess = measurements::guess_logs(make_options(folder.path()));
  for (const GuessedColumn& column : guess.columns) {
    const std::string header = column.target.header();
    CHECK((column.sign < 0.0) == (header == "load_N" || header == "drum_torque_Nm"));
  }
}
