// Bad rows of measurement sets: all of them are found and named, and what is left out changes nothing else.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/split.hpp>

#include "build_paths.h"
#include "measurements/run_rows.h"
#include "sim/core/error.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;
using measurements::MeasuredRun;
using measurements::MeasurementSet;

namespace {

namespace quantities = models::quantities;
using Random = std::mt19937;

const std::string kDrumHeader = "time_s,speed_km_h,load_N,ambient_degC,drum_torque_Nm,liner_temperature_degC";

/// A drum set whose runs have these rows below the usual header.
std::string write_drum_set(const tests::TemporaryFolder& folder, const std::vector<std::vector<std::string>>& runs) {
  std::string toml = "format = \"rollrig-measurements/1\"\nname = \"drum\"\ntire = \"a50\"\nrig = \"drum_2m\"\n";
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC"}) {
    toml += fmt::format(
        "[sensors.{}]\noffset_sd = 0.4\ndrift_sd = 0.1\ndrift_time_s = 60\nnoise_sd = 0.2\n"
        "resolution = 0\n",
        channel);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    toml += fmt::format(
        "[[run]]\nid = \"run{0}\"\nfile = \"run{0}.csv\"\nsession = \"day\"\n"
        "initial_tire_temperature_degC = 25\ncold_pressure_kPa = 250\n",
        i);
    tests::write_file(folder.file(fmt::format("run{}.csv", i)),
                      kDrumHeader + "\n" + boost::algorithm::join(runs[i], "\n") + "\n");
  }
  tests::write_file(folder.file("set.toml"), toml);
  return folder.path();
}

/// Rows of a drum that stays at one speed.
std::vector<std::string> make_steady_rows(std::size_t count, double interval_s = 1.0) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.push_back(fmt::format("{:.6g},80,5400,25,{:.4f},{:.3f}", static_cast<double>(i) * interval_s,
                               40.0 - 0.01 * static_cast<double>(i), 25.0 + 0.02 * static_cast<double>(i)));
  }
  return rows;
}

MeasurementSet read_with(std::size_t row, const std::string& text, std::size_t count = 100, double interval_s = 1.0) {
  const tests::TemporaryFolder folder;
  std::vector<std::string> rows = make_steady_rows(count, interval_s);
  rows[row] = text;
  return measurements::read_measurement_set(write_drum_set(folder, {rows}), BadRows::kLeaveOut);
}

}  // namespace

TEST_CASE("bad rows of all files are in one error, with file, line, column, value and what is allowed", "[fast]") {
  const tests::TemporaryFolder folder;
  std::vector<std::string> first = make_steady_rows(60), second = make_steady_rows(60);
  first[8] = "8,2257.2,5400,25,40,25";  // 627 m/s
  first[20] = "20,80,54";
  second[30] = "30,80,OVER,25,40,25";
  second[40] = "40,80,5400,,40,25";
  const std::string path = write_drum_set(folder, {first, make_steady_rows(60), second});
  try {
    measurements::read_measurement_set(path);
    FAIL("read with bad rows");
  } catch (const InputError& error) {
    const std::string text = format_error("error: ", error.problem());
    INFO(text);
    CHECK_THAT(text, Catch::StartsWith("error: 4 bad rows in 2 of 3 files\n"));
    CHECK_THAT(text, Catch::Contains("run0.csv: 2 bad rows") && Catch::Contains("run2.csv: 2 bad rows"));
    CHECK_THAT(text, Catch::Contains("10  speed_km_h") && Catch::Contains("2257.2") && Catch::Contains("<= 400"));
    CHECK_THAT(text, Catch::Contains("22  (row)") && Catch::Contains("3 fields"));
    CHECK_THAT(text, Catch::Contains("32  load_N") && Catch::Contains("OVER"));
    CHECK_THAT(text, Catch::Contains("42  ambient_degC") && Catch::Contains("(empty)"));
    CHECK_THAT(text, Catch::Contains("--skip-bad-rows"));
  }
}

TEST_CASE("a row that is left out leaves the inputs as straight lines, and its neighbors without means", "[fast]") {
  const MeasurementSet set = read_with(50, "50,abc,5400,25,39,26");
  const MeasuredRun& run = set.runs.front();
  REQUIRE(run.time_s.size() == 99);
  CHECK(run.time_s[49] == 49.0);
  CHECK(run.time_s[50] == 51.0);
  // The logger averaged rows 49 and 51 over one second, which their times no longer tell.
  const std::vector<double>& torque_Nm = run.column(quantities::kDrumTorque);
  for (std::size_t row = 0; row < torque_Nm.size(); ++row) {
    INFO("row " << row);
    CHECK(std::isnan(torque_Nm[row]) == (row == 49 || row == 50));
    CHECK_FALSE(std::isnan(run.column(quantities::kSpeed)[row]));
  }
  CHECK(run.left_out.rows == 1);
  CHECK(run.left_out.fields == 0);
  CHECK(run.left_out.file_rows == 100);
  REQUIRE(run.left_out.problems.size() == 1);
  CHECK(run.left_out.problems.front().line == 52);
  const std::vector<std::string> told = measurements::describe_bad_rows(set);
  REQUIRE(told.size() == 1);
  CHECK_THAT(told.front(), Catch::Contains("run0.csv, line 52: speed_km_h abc"));
  CHECK(measurements::make_bad_rows_json(set)[0]["bad"][0]["line"] == 52);
}

TEST_CASE("a bad measured field is left empty, and its row stays", "[fast]") {
  const MeasurementSet set = read_with(50, "50,80,5400,25,OVER,26");
  const MeasuredRun& run = set.runs.front();
  CHECK(run.time_s.size() == 100);
  CHECK(std::isnan(run.column(quantities::kDrumTorque)[50]));
  CHECK_FALSE(std::isnan(run.column(quantities::kDrumTorque)[49]));
  CHECK(run.column(quantities::kLinerTemperature)[50] == Approx(299.15));
  CHECK(run.left_out.rows == 0);
  CHECK(run.left_out.fields == 1);
}

TEST_CASE("bad rows are refused where they are many, or where they leave a long gap", "[fast]") {
  const auto read = [](const std::vector<std::string>& rows) {
    const tests::TemporaryFolder folder;
    return measurements::read_measurement_set(write_drum_set(folder, {rows}), BadRows::kLeaveOut).runs.front();
  };
  const auto spoil = [](std::vector<std::string> rows, const std::vector<std::size_t>& at) {
    for (const std::size_t row : at) rows[row] = "x";
    return rows;
  };
  CHECK(read(spoil(make_steady_rows(100), {10, 30, 50, 70, 90})).time_s.size() == 95);
  CHECK_THROWS_WITH(read(spoil(make_steady_rows(100), {10, 20, 30, 50, 70, 90})), Catch::Contains("too many"));
  CHECK(read(spoil(make_steady_rows(10), {4})).time_s.size() == 9);  // one row always may be bad

  CHECK(read(spoil(make_steady_rows(200), {50, 51, 52, 53})).time_s.size() == 196);  // 5 s
  CHECK_THROWS_WITH(read(spoil(make_steady_rows(200), {50, 51, 52, 53, 54})),
                    Catch::Contains("has no row for 6 s") && Catch::Contains("at most 5 s"));
  CHECK(read(spoil(make_steady_rows(100, 60.0), {50})).time_s.size() == 99);  // of a slow file, one row
  CHECK_THROWS_WITH(read(spoil(make_steady_rows(100, 60.0), {50, 51})), Catch::Contains("has no row for 180 s"));
  CHECK(read(spoil(make_steady_rows(200), {0, 1})).time_s.front() == 2.0);  // the run begins later
  CHECK_THROWS_WITH(read(spoil(make_steady_rows(200), {0, 1, 2, 3, 4, 5})), Catch::Contains("has no row for 6 s"));
  CHECK(read(spoil(make_steady_rows(200), {195, 196, 197, 198, 199})).time_s.back() == 194.0);  // and ends earlier
}

TEST_CASE("what is wrong with a file as a whole stays an error", "[fast]") {
  const auto read = [](const std::string& header, const std::vector<std::string>& rows) {
    const tests::TemporaryFolder folder;
    write_drum_set(folder, {rows});
    tests::write_file(folder.file("run0.csv"), header + "\n" + boost::algorithm::join(rows, "\n") + "\n");
    return measurements::read_measurement_set(folder.path(), BadRows::kLeaveOut);
  };
  const std::vector<std::string> rows = make_steady_rows(20);
  CHECK_THROWS_WITH(read("time_s,speed_km_h,load_N,ambient_degC,torque,liner_temperature_degC", rows),
                    Catch::Contains("unknown column 'torque'"));
  CHECK_THROWS_WITH(read("time_s,speed_km_h,load_N,drum_torque_Nm,cavity_pressure_kPa,liner_temperature_degC", rows),
                    Catch::Contains("missing column 'ambient_degC'"));
  CHECK_THROWS(read(rows.front(), rows));
  std::vector<std::string> in_ms;
  for (int i = 0; i < 600; ++i) in_ms.push_back(fmt::format("{},80,5400,25,40,25", 1000 * i));
  CHECK_THROWS_WITH(read(kDrumHeader, in_ms), Catch::Contains("a run of more than three days"));
}

TEST_CASE("a run of more rows than memory is meant for is refused, and says how to average them", "[slow]") {
  std::vector<std::string> rows;
  rows.reserve(1000001);
  for (int i = 0; i < 1000001; ++i) rows.push_back(fmt::format("{:.2f},80,5400,25,,", 0.02 * i));
  const tests::TemporaryFolder folder;
  const std::string path = write_drum_set(folder, {rows});
  CHECK_THROWS_WITH(measurements::read_measurement_set(path),
                    Catch::Contains("1000001 rows") && Catch::Contains("interval_s"));
}

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  boost::algorithm::split(parts, text, [separator](char c) { return c == separator; });
  return parts;
}

/// A file of a run: the lines of its header and its rows, with which mistakes are planted.
struct RunLines {
  std::string path;
  std::vector<std::string> lines;  // with the header

  explicit RunLines(const std::string& file) : path(file) {
    lines = split(tests::read_file(file), '\n');
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    for (std::string& line : lines) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
    }
  }
  std::size_t find_column(const std::string& name) const {
    const std::vector<std::string> names = split(lines.front(), ',');
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  std::string cell(std::size_t line, const std::string& column) const {
    return split(lines[line], ',')[find_column(column)];
  }
  void set_cell(std::size_t line, const std::string& column, const std::string& value) {
    std::vector<std::string> cells = split(lines[line], ',');
    cells[find_column(column)] = value;
    lines[line] = boost::algorithm::join(cells, ",");
  }
  double time_s(std::size_t line) const { return std::stod(cell(line, "time_s")); }
  void write() const { tests::write_file(path, boost::algorithm::join(lines, "\n") + "\n"); }
};

double draw(Random& random, double from, double to) { return std::uniform_real_distribution<>(from, to)(random); }

template <class T>
const T& draw_one(Random& random, const std::vector<T>& from) {
  return from[std::uniform_int_distribution<std::size_t>(0, from.size() - 1)(random)];
}

/// A kind of bad row: makes line `at` of a file bad, and returns the column that is to be named (empty: the row).
struct Mistake {
  const char* name;
  std::function<std::string(RunLines&, std::size_t at, Random&)> plant;
};

std::string plant_cell(RunLines& file, std::size_t at, const std::string& column, const std::string& value) {
  file.set_cell(at, column, value);
  return column;
}

const std::vector<std::string> kTexts{"abc", "OVER", "#REF!", "12.3.4", "8O.5", "--", "1e", "0x1F", "12 3", "\"1,5\""};

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> kinds{
      {"a speed beyond what there is",
       [](RunLines& file, std::size_t at, Random& random) {
         return plant_cell(file, at, "speed_km_h", fmt::format("{:.2f}", draw(random, 401.0, 5000.0)));
       }},
      {"an air temperature in kelvin",
       [](RunLines& file, std::size_t at, Random& random) {
         return plant_cell(file, at, "ambient_degC", fmt::format("{:.1f}", draw(random, 270.0, 310.0)));
       }},
      {"a line that was cut",
       [](RunLines& file, std::size_t at, Random& random) {
         std::string& line = file.lines[at];
         const std::size_t last = line.rfind(',');
         line.resize(1 + static_cast<std::size_t>(draw(random, 0.0, static_cast<double>(last) - 1.0)));
         return std::string();
       }},
      {"two lines in one",
       [](RunLines& file, std::size_t at, Random&) {
         file.lines[at] += file.lines[at - 1];
         return std::string();
       }},
      {"a text for an input",
       [](RunLines& file, std::size_t at, Random& random) {
         return plant_cell(file, at, "speed_km_h", draw_one(random, kTexts));
       }},
      {"a text for a measured value",
       [](RunLines& file, std::size_t at, Random& random) {
         const std::string& header = file.lines.front();
         const bool is_road = header.find("traction_force_N") != std::string::npos;
         return plant_cell(file, at, is_road ? "traction_force_N" : "drum_torque_Nm", draw_one(random, kTexts));
       }},
      {"an empty input",
       [](RunLines& file, std::size_t at, Random& random) {
         return plant_cell(file, at, draw_one(random, std::vector<std::string>{"speed_km_h", "ambient_degC"}), "");
       }},
      {"no finite number",
       [](RunLines& file, std::size_t at, Random& random) {
         return plant_cell(file, at, "ambient_degC", draw_one(random, std::vector<std::string>{"nan", "inf", "-inf"}));
       }},
      {"a text for a time", [](RunLines& file, std::size_t at,
                               Random& random) { return plant_cell(file, at, "time_s", draw_one(random, kTexts)); }},
      {"a time that falls",
       [](RunLines& file, std::size_t at, Random& random) {
         const double latest_s = file.time_s(at - 1);
         return plant_cell(file, at, "time_s", fmt::format("{:.3f}", draw(random, latest_s - 200.0, latest_s)));
       }},
      {"the time of the row before",
       [](RunLines& file, std::size_t at, Random&) {
         return plant_cell(file, at, "time_s", file.cell(at - 1, "time_s"));
       }},
      {"a time ahead of the next",
       [](RunLines& file, std::size_t at, Random& random) {
         const bool is_last = at + 1 == file.lines.size();  // then nothing but a time days ahead is wrong
         const double next_s = is_last ? 1e9 : file.time_s(at + 1);
         return plant_cell(file, at, "time_s", fmt::format("{:.3f}", next_s + std::pow(10.0, draw(random, -1.0, 9.0))));
       }},
      {"a quote that does not end", [](RunLines& file, std::size_t at, Random&) {
         file.lines[at].insert(0, "\"");
         return std::string();
       }}};
  return kinds;
}

struct Planted {
  std::string mistake;
  std::string column;
  std::string expected_file;
  int line = 0;
};

/// Plants one mistake of each kind in a set, at rows that are apart.
std::vector<Planted> plant_all(std::vector<RunLines>& files, Random& random) {
  constexpr std::size_t kApart = 4;  // rows: what a neighbor tells of a time is then right
  std::vector<Planted> planted;
  std::map<std::string, std::set<std::size_t>> taken;
  for (const Mistake& mistake : mistakes()) {
    for (;;) {
      RunLines& file = files[std::uniform_int_distribution<std::size_t>(0, files.size() - 1)(random)];
      const std::size_t at = std::uniform_int_distribution<std::size_t>(2, file.lines.size() - 1)(random);
      std::set<std::size_t>& rows = taken[file.path];
      const auto near = rows.lower_bound(at - std::min(at, kApart));
      if (near != rows.end() && *near <= at + kApart) continue;
      rows.insert(at);
      const std::string column = mistake.plant(file, at, random);
      planted.push_back({mistake.name, column, file.path, static_cast<int>(at) + 1});
      break;
    }
  }
  return planted;
}

struct Counts {
  std::map<std::string, int> planted, found;
  int accused = 0;  // rows that were as they should be
  int read_clean = 0;
};

/// Makes mistakes in the copy of a set, and compares what is found with them.
void try_once(const std::string& folder, Random& random, Counts& counts) {
  std::vector<RunLines> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") files.emplace_back(entry.path().string());
  }
  std::sort(files.begin(), files.end(), [](const RunLines& a, const RunLines& b) { return a.path < b.path; });
  const std::vector<RunLines> clean = files;
  const std::vector<Planted> planted = plant_all(files, random);
  for (const RunLines& file : files) file.write();
  const MeasurementSet set = measurements::read_measurement_set(folder, BadRows::kLeaveOut);
  std::set<std::tuple<std::string, int, std::string>> found;
  for (const MeasuredRun& run : set.runs) {
    for (const InputProblem& problem : run.left_out.problems) found.emplace(problem.file, problem.line, problem.key);
  }
  std::string all;
  try {
    measurements::read_measurement_set(folder);
  } catch (const InputError& error) {
    all = error.what();
  }
  for (const Planted& one : planted) {
    ++counts.planted[one.mistake];
    const bool named = found.erase({one.expected_file, one.line, one.column}) == 1;
    INFO(one.mistake << ", " << one.expected_file << ", line " << one.line << ", " << one.column);
    CHECK(named);
    CHECK_THAT(all, Catch::Contains(fmt::format("{:>4}  {}", one.line, one.column.empty() ? "(row)" : one.column)));
    counts.found[one.mistake] += named ? 1 : 0;
  }
  counts.accused += static_cast<int>(found.size());
  for (const RunLines& file : clean) file.write();
}

void report(const char* what, const Counts& counts, int trials) {
  std::string text = fmt::format("{}: {} sets, {} innocent rows accused\n", what, trials, counts.accused);
  for (const auto& [mistake, number] : counts.planted) {
    text += fmt::format("  {:<32} {:>4} of {}\n", mistake, counts.found.at(mistake), number);
  }
  WARN(text);
}

int count_trials() {
  const char* given = std::getenv("ROLLRIG_PLANTED_TRIALS");
  return given != nullptr ? std::max(1, std::atoi(given)) : 30;
}

}  // namespace

TEST_CASE("every kind of bad row is found and named in made sets, at random places", "[slow]") {
  Random random(20);
  Counts counts;
  const int trials = count_trials();
  for (int trial = 0; trial < trials; ++trial) {
    const tests::TemporaryFolder folder;
    std::vector<std::vector<std::string>> runs;
    for (const double interval_s : {0.1, 1.0, 2.5}) {
      runs.push_back(make_steady_rows(300 + static_cast<std::size_t>(draw(random, 0.0, 900.0)), interval_s));
    }
    write_drum_set(folder, runs);
    for (const MeasuredRun& run : measurements::read_measurement_set(folder.path(), BadRows::kLeaveOut).runs) {
      counts.accused += static_cast<int>(run.left_out.problems.size());
    }
    try_once(folder.path(), random, counts);
  }
  report("made sets", counts, trials);
  CHECK(counts.accused == 0);
}

TEST_CASE("every kind of bad row is found and named in the real road set, at random places", "[slow]") {
  const char* data = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path real =
      fs::path(data != nullptr ? data : ROLLRIG_SOURCE_DIR "/../shared/data/measured") / "road_trips_i3";
  if (!fs::exists(real)) {
    WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
    return;
  }
  const tests::TemporaryFolder folder;
  fs::copy(real, folder.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  Random random(21);
  Counts counts;
  for (const MeasuredRun& run : measurements::read_measurement_set(folder.path(), BadRows::kLeaveOut).runs) {
    counts.accused += static_cast<int>(run.left_out.problems.size());
  }
  const int trials = count_trials();
  for (int trial = 0; trial < trials; ++trial) try_once(folder.path(), random, counts);
  report("road set", counts, trials);
  CHECK(counts.accused == 0);
}
