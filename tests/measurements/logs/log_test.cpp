#include "measurements/logs/log.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/temporary_folder.h"

using namespace rollrig;
using measurements::Log;
using measurements::LogForm;
using measurements::TimeForm;

namespace {

LogForm make_form(TimeForm time_form) {
  LogForm form;
  form.name = "torque_log";
  form.time.column = "t";
  form.time.form = time_form;
  form.missing = {"---"};
  measurements::LogColumn column;
  column.target = models::quantities::kCavityPressure;
  column.column = "p";
  column.unit = unit_of_key("value_bar");
  column.allowed = between(-100.0, 3000.0);
  form.columns = {column};
  return form;
}

Log read(const LogForm& form, const std::string& content) {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("log.csv"), content);
  return measurements::read_log(form, folder.file("log.csv"));
}

}  // namespace

TEST_CASE("one moment in four forms of time stamps", "[fast]") {
  const std::string rest = ",2.5\n";
  LogForm iso = make_form(TimeForm::kIso8601);
  const double in_iso = read(iso, "t,p\n2024-03-05T13:29:42.5+01:00" + rest + "2024-03-05T12:29:43Z" + rest +
                                      "2024-03-05 12:29:44Z" + rest)
                            .time_s[0];
  CHECK(in_iso == Approx(1709641782.5).margin(1e-6));
  LogForm clock = make_form(TimeForm::kClock);
  clock.time.date = "05.03.2024";
  clock.time.date_order = "dmy";
  clock.time.utc_offset_s = 3600.0;
  clock.csv.separator = ';';
  clock.csv.decimal = ',';
  const Log by_clock = read(clock, "t;p\n13:29:42,5;2,5\n13:29:43,5;2,5\n13:29:44,5;2,5\n");
  CHECK(by_clock.time_s[0] == Approx(in_iso).margin(1e-6));
  CHECK(by_clock.is_utc);
  LogForm days = make_form(TimeForm::kSpreadsheetDays);
  days.time.utc_offset_s = 3600.0;
  const Log by_days = read(days, "t,p\n45356.562297454,2.5\n45356.562309028,2.5\n45356.562320602,2.5\n");
  CHECK(by_days.time_s[0] == Approx(in_iso).margin(1e-3));
  LogForm seconds = make_form(TimeForm::kSeconds);
  seconds.time.unit_s = 1e-3;
  CHECK(read(seconds, "t,p\n500,2.5\n1500,2.5\n2500,2.5\n").interval_s == Approx(1.0));
}

TEST_CASE("date and time in one column are read in the usual forms, and seconds since 1970", "[fast]") {
  const double in_utc = 1709645382.0;  // 2024-03-05T13:29:42Z
  const auto read_as = [](const std::string& stamp, const std::string& order) {
    LogForm form = make_form(TimeForm::kDateTime);
    form.time.date_order = order;
    form.csv.separator = ';';
    return read(form, "t;p\n" + stamp + ";2\n2024-03-06 01:00;2\n2024-03-07 01:00;2\n");
  };
  for (const auto& [stamp, order] :
       {std::pair{"2024-03-05 13:29:42", "ymd"}, std::pair{"2024/3/5 13:29:42", "ymd"},
        std::pair{"2024-03-05T13:29:42", "ymd"}, std::pair{"2024-03-05 1:29:42 PM", "ymd"},
        std::pair{"05-Mar-2024 13:29:42", "ymd"}, std::pair{"5 March 2024 13:29:42", "ymd"}}) {
    INFO(stamp);
    CHECK(read_as(stamp, order).time_s[0] == Approx(in_utc).margin(1e-6));
  }
  using measurements::parse_date_time_s;
  CHECK(parse_date_time_s("05.03.2024 13:29:42,5", "dmy") == Approx(in_utc + 0.5).margin(1e-6));
  CHECK(parse_date_time_s("5/3/24 13:29:42", "dmy") == Approx(in_utc));
  CHECK(parse_date_time_s("3/5/2024 1:29:42 PM", "mdy") == Approx(in_utc));
  CHECK(parse_date_time_s("3/5/2024, 1:29:42 pm", "mdy") == Approx(in_utc));
  CHECK(parse_date_time_s("3/5/2024 12:00:00 AM", "mdy") == Approx(in_utc - 13 * 3600 - 29 * 60 - 42));
  CHECK(parse_date_time_s("3/5/2024 12:30 PM", "mdy") == Approx(in_utc - 59 * 60 - 42));
  for (const char* wrong : {"13/5/2024 1:29:42 PM", "3/5/2024 13:29:42 PM", "3/5/2024 0:29:42 AM", "3/5/2024",
                            "1:29:42 PM", "3/5 1:29:42", "05-Mrz-2024 13:29:42", "3/5/124 1:29:42"}) {
    INFO(wrong);
    CHECK_THROWS_AS(parse_date_time_s(wrong, "mdy"), std::invalid_argument);
  }
  LogForm epoch = make_form(TimeForm::kEpochSeconds);
  const Log in_seconds = read(epoch, "t,p\n1709645382,2\n1709645383,2\n1709645384,2\n");
  CHECK(in_seconds.time_s[0] == Approx(in_utc).margin(1e-6));
  CHECK((in_seconds.is_utc && in_seconds.is_absolute));
  epoch.time.unit_s = 1e-3;
  const Log in_ms = read(epoch, "t,p\n1709645382000,2\n1709645383000,2\n1709645384500,2\n");
  CHECK(in_ms.time_s[2] == Approx(in_utc + 2.5).margin(1e-6));
}

TEST_CASE("bad rows of a log are in one error, or are marked and left out", "[fast]") {
  std::string content = "t,p\n";
  for (int i = 0; i < 200; ++i) {
    content += i == 20   ? "20,2.5,7\n"
               : i == 60 ? "60,two\n"
               : i == 90 ? "9,2.5\n"
               : i == 95 ? "soon,2.5\n"
                         : std::to_string(i) + ",2.5\n";
  }
  const LogForm form = make_form(TimeForm::kSeconds);
  CHECK_THROWS_WITH(read(form, content), Catch::Contains("4 bad rows") && Catch::Contains("22  (row)") &&
                                             Catch::Contains("62  p") && Catch::Contains("92  t") &&
                                             Catch::Contains("97  t"));
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("log.csv"), content);
  RowProblems problems;
  const Log log = measurements::read_log(form, folder.file("log.csv"), &problems);
  CHECK(count_rows(problems) == 4);
  CHECK(log.time_s.size() == 197);  // the row with a wrong pressure stays
  int bad_rows = 0, bad_fields = 0;
  for (const measurements::Mark& mark : log.marks) {
    bad_rows += mark.reason == "bad row" ? 1 : 0;
    bad_fields += mark.reason == "bad field" ? 1 : 0;
  }
  CHECK(bad_rows == 3);
  CHECK(bad_fields == 1);
  CHECK(std::isnan(log.columns.at("cavity_pressure_kPa")[59]));
}

TEST_CASE("a log over midnight goes on into the next day", "[fast]") {
  LogForm clock = make_form(TimeForm::kClock);
  clock.time.date = "2024-12-31";
  const Log log = read(clock, "t,p\n23:59:59,2\n00:00:00,2\n00:00:01,2\n");
  CHECK(log.time_s[2] - log.time_s[0] == Approx(2.0));
  LogForm dated = make_form(TimeForm::kClock);
  dated.time.date_column = "d";
  dated.time.date_order = "mdy";
  const Log with_dates = read(dated, "d,t,p\n12/31/2024,23:59:59,2\n01/01/2025,00:00:00,2\n01/01/2025,00:00:01,2\n");
  CHECK(with_dates.time_s[1] == Approx(log.time_s[1]));
}

TEST_CASE("units, factor and offset are applied once, what is small is zero where told so", "[fast]") {
  LogForm form = make_form(TimeForm::kSeconds);
  CHECK(read(form, "t,p\n0,2.5\n1,2.6\n2,2.7\n").columns.at("cavity_pressure_kPa")[0] == Approx(250e3));
  form.columns[0].unit = unit_of_key("value_kPa");
  form.columns[0].factor = 6.894757;  // psi
  form.columns[0].offset = -101.325;  // absolute
  form.columns[0].dead_band = 0.5;
  const Log log = read(form, "t,p\n0,50\n1,14.7\n2,51\n");
  CHECK(log.columns.at("cavity_pressure_kPa")[0] == Approx(1e3 * (50.0 * 6.894757 - 101.325)));
  CHECK(log.columns.at("cavity_pressure_kPa")[1] == 0.0);
  CHECK(log.dead_banded.at("cavity_pressure_kPa") == 1);
}

TEST_CASE("gaps, empty cells and values out of range are marked with line and reason", "[fast]") {
  std::string content = "t,p\n";
  for (int i = 0; i < 300; ++i) {
    if (i >= 100 && i < 110) continue;
    content += std::to_string(i) + (i == 50 ? ",---\n" : i == 60 ? ",\n" : i == 70 ? ",99\n" : ",2.5\n");
  }
  const Log log = read(make_form(TimeForm::kSeconds), content);
  REQUIRE(log.marks.size() == 4);
  CHECK((log.marks[0].line == 52 && log.marks[0].reason == "no value"));
  CHECK((log.marks[1].line == 62 && log.marks[1].reason == "no value"));
  CHECK((log.marks[2].line == 72 && log.marks[2].reason == "out of range" && *log.marks[2].value == Approx(9900.0)));
  CHECK((log.marks[3].reason == "no rows" && log.marks[3].from_s == 99.0 && log.marks[3].to_s == 110.0));
  for (const std::size_t row : {50U, 60U, 70U}) CHECK(std::isnan(log.columns.at("cavity_pressure_kPa")[row]));
}

TEST_CASE("dates and times that do not exist are refused with their line", "[fast]") {
  LogForm iso = make_form(TimeForm::kIso8601);
  for (const char* stamp :
       {"2024-02-30T10:00:00", "2024-03-05T25:00:00", "2024-03-05", "05.03.2024 10:00:00", "soon"}) {
    INFO(stamp);
    CHECK_THROWS_WITH(read(iso, std::string("t,p\n2024-02-29T10:00:00,2\n") + stamp + ",2\n"),
                      Catch::Contains("line 3") && Catch::Contains(stamp));
  }
}

TEST_CASE("lines above the header and units below it are passed over", "[fast]") {
  LogForm form = make_form(TimeForm::kSeconds);
  form.csv.header_line = 3;
  form.csv.first_row_line = 5;
  const Log log = read(form, "Logger 4711\n\"serial;17\nt,p\ns,bar\n0,2.5\n1,2.5\n2,2.5\n");
  CHECK(log.time_s.size() == 3);
  CHECK(log.line[0] == 5);
}

TEST_CASE("a log in Windows-1252 with decimal commas, mph, kgf and degF is read as its mapping says", "[fast]") {
  const tests::TemporaryFolder folder;
  std::string log =
      "Zeit;v [mph];F [kgf];T [\xB0"
      "F];M [lb-ft]\r\n";
  for (const char* second : {"42,5", "43,5", "44,5"}) {
    log += std::string("05.03.2024 13:29:") + second + ";50,0;550,0;77,0;30,0\r\n";
  }
  tests::write_file(folder.file("log.csv"), log);
  tests::write_file(folder.file("import.toml"), R"(format = "rollrig-import/1"
name = "abroad"
tire = "a50"
rig = "drum_2m"
sensors = "source"
[torque_log]
encoding = "windows-1252"
separator = "semicolon"
decimal = "comma"
time = { column = "Zeit", form = "date_time", date_order = "dmy", utc_offset_h = 1.0 }
[torque_log.columns]
speed_km_h = { column = "v [mph]", unit = "mph" }
load_N = { column = "F [kgf]", unit = "kgf" }
ambient_degC = { column = "T [°F]", unit = "°F" }
drum_torque_Nm = { column = "M [lb-ft]", unit = "lb-ft" }
[[run]]
id = "one"
session = "day"
torque_log = "log.csv"
initial_tire_temperature_degC = 25.0
cold_pressure_kPa = 280.0
from = "05.03.2024 13:29:43,5"
)");
  const measurements::Mapping mapping = measurements::read_mapping(folder.file("import.toml"));
  const Log read = measurements::read_log(mapping.torque_log, folder.file("log.csv"));
  CHECK(read.time_s.front() == Approx(1709641782.5).margin(1e-6));
  CHECK(read.is_utc);
  CHECK(read.columns.at("speed_km_h").front() == Approx(22.352));  // 50 mph in m/s, exact
  CHECK(read.columns.at("load_N").front() == Approx(550.0 * 9.80665));
  CHECK(read.columns.at("ambient_degC").front() == Approx(298.15));
  CHECK(read.columns.at("drum_torque_Nm").front() == Approx(40.6745).epsilon(1e-5));  // 1 lbf ft = 1.355818 N m
  CHECK(measurements::parse_log_time(mapping.torque_log, read, mapping.runs[0].from, "from", {}) ==
        Approx(1709641783.5).margin(1e-6));
}

TEST_CASE("a time stamp may be as long as it likes: it is refused", "[fast]") {
  using namespace rollrig::measurements;
  const std::string blanks(50000, ' '), digits(50000, '1'), colons(50000, ':');
  for (const std::string& text : {blanks, digits, colons, "1 " + blanks, "2024-03-05T" + digits, "2024-03-05T" + colons,
                                  "2024-03-05T12:00:00." + digits, digits + "T12:00:00"}) {
    CHECK_THROWS_AS(parse_iso_8601(text), std::invalid_argument);
    CHECK_THROWS_AS(parse_clock_s(text), std::invalid_argument);
    CHECK_THROWS_AS(parse_date_days(text, "dmy"), std::invalid_argument);
    CHECK_THROWS_AS(parse_date_time_s(text, "dmy"), std::invalid_argument);
  }
}
