// Bad rows of coastdowns: all of them are found and named at once, and without them the others are as they were.
#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/split.hpp>
#include <catch2/catch.hpp>
#include <functional>
#include <random>
#include <set>
#include <sstream>

#include "estimation/drum_deceleration/coast_set.h"
#include "estimation/road_load/coastdown_file.h"
#include "sim/core/error.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using Catch::Contains;
using estimation::CoastdownFile;
using estimation::CoastdownRun;
using estimation::CoastSet;
using estimation::read_coast_set;
using estimation::read_coastdowns;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

using RowLines = std::vector<std::string>;
using RowRandom = std::mt19937;

RowLines split_lines(const std::string& text) {
  RowLines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string join_lines(const RowLines& lines) { return boost::algorithm::join(lines, "\n") + "\n"; }

CoastdownFile read_lines(const RowLines& lines, BadRows bad_rows) {
  const TemporaryFolder folder;
  write_file(folder.file("coast.csv"), join_lines(lines));
  return read_coastdowns(folder.file("coast.csv"), bad_rows);
}

std::string read_refused(const RowLines& lines) {
  try {
    read_lines(lines, BadRows::kRefuse);
  } catch (const InputError& error) {
    return format_error("error: ", error.problem());
  }
  return "";
}

void set_cell(std::string& line, std::size_t column, const std::string& value) {
  RowLines cells;
  boost::algorithm::split(cells, line, [](char c) { return c == ','; });
  cells.at(column) = value;
  line = boost::algorithm::join(cells, ",");
}

void require_same(const CoastdownFile& a, const CoastdownFile& b) {
  REQUIRE(a.data.runs.size() == b.data.runs.size());
  for (std::size_t i = 0; i < a.data.runs.size(); ++i) {
    const CoastdownRun& one = a.data.runs[i];
    const CoastdownRun& other = b.data.runs[i];
    CHECK(one.id == other.id);
    CHECK(one.heading == other.heading);
    CHECK(one.time_s == other.time_s);
    CHECK(one.speed_m_s == other.speed_m_s);
    CHECK(one.conditions.ambient_K == other.conditions.ambient_K);
    REQUIRE(one.bins.size() == other.bins.size());
    for (std::size_t k = 0; k < one.bins.size(); ++k) {
      CHECK(one.bins[k].high_m_s == other.bins[k].high_m_s);
      CHECK(one.bins[k].duration_s == other.bins[k].duration_s);
    }
  }
}

/// Ten bins of 5 km/h from 100 to 50 km/h, four runs; each bin has the way of the run beside it.
RowLines write_bin_lines() {
  RowLines lines{"run,use,heading,start_time,v_hi_kmh,v_lo_kmh,dt_s,run_total_s"};
  for (int run = 1; run <= 4; ++run) {
    for (int bin = 0; bin < 10; ++bin) {
      lines.push_back(fmt::format("{},On,{},10:{:02d}:00,{},{},{:.2f},75", run, run % 2 == 1 ? "+" : "-", 5 * run,
                                  100 - 5 * bin, 95 - 5 * bin, 5.25 + 0.5 * bin));
    }
  }
  return lines;
}

/// A kind of bad row: makes line `at` of a trace bad, and returns the column that is to be named (empty: the row).
struct BadRowKind {
  const char* name;
  std::function<std::string(RowLines&, std::size_t at, RowRandom&)> plant;
};

double draw_between(RowRandom& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

std::string plant_cell(RowLines& lines, std::size_t at, std::size_t column, const std::string& value) {
  set_cell(lines[at], column, value);
  RowLines names;
  boost::algorithm::split(names, lines.front(), [](char c) { return c == ','; });
  return names.at(column);
}

double time_of(const RowLines& lines, std::size_t at) { return std::stod(lines[at]); }

const std::vector<BadRowKind> kBadRowKinds{
    {"a speed beyond what there is",
     [](RowLines& lines, std::size_t at, RowRandom& random) {
       return plant_cell(lines, at, 1, fmt::format("{:.2f}", draw_between(random, 501.0, 5000.0)));
     }},
    {"a text for a speed",
     [](RowLines& lines, std::size_t at, RowRandom&) { return plant_cell(lines, at, 1, "OVER"); }},
    {"an empty speed", [](RowLines& lines, std::size_t at, RowRandom&) { return plant_cell(lines, at, 1, ""); }},
    {"an air temperature in kelvin",
     [](RowLines& lines, std::size_t at, RowRandom& random) {
       return plant_cell(lines, at, 4, fmt::format("{:.1f}", draw_between(random, 270.0, 310.0)));
     }},
    {"a heading that is none",
     [](RowLines& lines, std::size_t at, RowRandom&) { return plant_cell(lines, at, 3, "north"); }},
    {"a heading against the run's",
     [](RowLines& lines, std::size_t at, RowRandom&) {
       const bool is_plus = lines[at].find(",+,") != std::string::npos;
       return plant_cell(lines, at, 3, is_plus ? "-" : "+");
     }},
    {"a line that was cut",
     [](RowLines& lines, std::size_t at, RowRandom& random) {
       const auto last = static_cast<double>(lines[at].rfind(','));
       lines[at].resize(1 + static_cast<std::size_t>(draw_between(random, 0.0, last - 1.0)));
       return std::string();
     }},
    {"two lines in one",
     [](RowLines& lines, std::size_t at, RowRandom&) {
       lines[at] += lines[at - 1];
       return std::string();
     }},
    {"a text for a time", [](RowLines& lines, std::size_t at, RowRandom&) { return plant_cell(lines, at, 0, "12:3"); }},
    {"a time that falls",
     [](RowLines& lines, std::size_t at, RowRandom& random) {
       const double before_s = time_of(lines, at - 1);
       return plant_cell(lines, at, 0, fmt::format("{:.3f}", draw_between(random, before_s - 200.0, before_s)));
     }},
    {"the time of the row before",
     [](RowLines& lines, std::size_t at, RowRandom&) {
       return plant_cell(lines, at, 0, lines[at - 1].substr(0, lines[at - 1].find(',')));
     }},
    {"a time ahead of the next",
     [](RowLines& lines, std::size_t at, RowRandom& random) {
       return plant_cell(lines, at, 0,
                         fmt::format("{:.3f}", time_of(lines, at + 1) + draw_between(random, 0.5, 900.0)));
     }},
    {"a quote that does not end", [](RowLines& lines, std::size_t at, RowRandom&) {
       lines[at].insert(0, "\"");
       return std::string();
     }}};

/// RowLines that are apart and in the middle of a run, so that its neighbors tell what is right.
std::vector<std::size_t> draw_lines(const RowLines& lines, std::size_t count, RowRandom& random) {
  constexpr std::size_t kApart = 4;
  const auto run_of = [&](std::size_t at) {
    RowLines cells;
    boost::algorithm::split(cells, lines[at], [](char c) { return c == ','; });
    return cells[2];
  };
  std::vector<std::size_t> drawn;
  while (drawn.size() < count) {
    const std::size_t at = std::uniform_int_distribution<std::size_t>(4, lines.size() - 4)(random);
    const bool inside = run_of(at - 3) == run_of(at) && run_of(at + 3) == run_of(at);
    const bool apart = std::none_of(drawn.begin(), drawn.end(), [at](std::size_t other) {
      return (at > other ? at - other : other - at) <= kApart;
    });
    if (inside && apart) drawn.push_back(at);
  }
  return drawn;
}

std::string write_drum_coast(double deceleration_m_s2, double from_m_s = 30.0) {
  std::string text = "time_s,speed_km_h\n";
  for (int i = 0; i < 100; ++i) {
    text += fmt::format("{},{:.3f}\n", i, 3.6 * std::max(0.5, from_m_s - deceleration_m_s2 * i));
  }
  return text;
}

std::string write_coast_set(const TemporaryFolder& folder, const std::string& loaded, const std::string& lifted) {
  write_file(folder.file("loaded.csv"), loaded);
  write_file(folder.file("lifted.csv"), lifted);
  write_file(folder.file("set.toml"), R"(format = "rollrig-drum-coastdown/1"
[drum]
diameter_m = 1.7
[[run]]
file = "loaded.csv"
state = "loaded"
pressure_kPa = 250.0
[[run]]
file = "lifted.csv"
state = "lifted"
)");
  return folder.file("set.toml");
}

}  // namespace

TEST_CASE("each kind of bad row of a speed trace is found and named, and the other rows stay as they are", "[slow]") {
  RowRandom random(22);
  for (int trial = 0; trial < 30; ++trial) {
    const RowLines clean =
        split_lines(tests::write_coastdown_csv(tests::simulate_coastdowns({}, static_cast<std::uint64_t>(trial + 1))));
    RowLines lines = clean;
    const std::vector<std::size_t> at = draw_lines(clean, kBadRowKinds.size(), random);
    std::set<std::pair<int, std::string>> planted;
    for (std::size_t i = 0; i < kBadRowKinds.size(); ++i) {
      planted.emplace(static_cast<int>(at[i]) + 1, kBadRowKinds[i].plant(lines, at[i], random));
    }
    const CoastdownFile file = read_lines(lines, BadRows::kLeaveOut);
    std::set<std::pair<int, std::string>> found;
    for (const InputProblem& problem : file.left_out.problems) found.emplace(problem.line, problem.key);
    CHECK(found == planted);
    CHECK(file.left_out.rows == kBadRowKinds.size());
    CHECK(file.left_out.file_rows == clean.size() - 1);
    const std::string refused = read_refused(lines);
    CHECK_THAT(refused,
               Contains(fmt::format("error: {} bad rows\n", kBadRowKinds.size())) && Contains("--skip-bad-rows"));
    for (const auto& [line, column] : planted) {
      CHECK_THAT(refused, Contains(fmt::format("{:>4}  {}", line, column.empty() ? "(row)" : column)));
    }
    RowLines others;
    for (std::size_t i = 0; i < clean.size(); ++i) {
      if (std::find(at.begin(), at.end(), i) == at.end()) others.push_back(clean[i]);
    }
    require_same(file, read_lines(others, BadRows::kRefuse));
  }
}

TEST_CASE("a bad bin is left out, and the totals of its run do not hold any more", "[fast]") {
  const RowLines clean = write_bin_lines();
  struct Case {
    std::size_t column;
    const char* value;
    const char* named;
  };
  for (const Case& bad : {Case{6, "-5.9", "dt_s"}, Case{6, "", "dt_s"}, Case{1, "maybe", "use"},
                          Case{2, "north", "heading"}, Case{4, "nan", "v_hi_kmh"}, Case{5, "99", "v_lo_kmh"}}) {
    INFO(bad.named << " " << bad.value);
    RowLines lines = clean, others = clean;
    set_cell(lines[15], bad.column, bad.value);  // of run 2
    others.erase(others.begin() + 15);
    const CoastdownFile file = read_lines(lines, BadRows::kLeaveOut);
    REQUIRE(file.left_out.problems.size() == 1);
    CHECK(file.left_out.problems[0].line == 16);
    CHECK(file.left_out.problems[0].key == bad.named);
    CHECK(file.rows_off == 0);
    require_same(file, read_lines(others, BadRows::kRefuse));
    CHECK_FALSE(file.data.runs[1].total_s.has_value());
    CHECK(file.data.runs[0].total_s == 75.0);
    CHECK_THAT(read_refused(lines), Contains("line 16") && Contains("--skip-bad-rows"));
  }
}

TEST_CASE("bins out of order: the one is named that the others contradict", "[fast]") {
  RowLines lines = write_bin_lines();
  set_cell(lines[15], 4, "20");  // 80 to 75 km/h becomes 20 to 15
  set_cell(lines[15], 5, "15");
  const CoastdownFile file = read_lines(lines, BadRows::kLeaveOut);
  REQUIRE(file.left_out.problems.size() == 1);
  CHECK(file.left_out.problems[0].line == 16);
  CHECK_THAT(file.left_out.problems[0].what, Contains("overlap or rise"));
  CHECK(file.data.runs[1].bins.size() == 9);
}

TEST_CASE("fields of bins that the fit does not need are left empty, and their row stays", "[fast]") {
  RowLines lines = write_bin_lines();
  set_cell(lines[1], 3, "abc");
  set_cell(lines[13], 7, "OVER");
  const CoastdownFile file = read_lines(lines, BadRows::kLeaveOut);
  CHECK(file.left_out.problems.size() == 2);
  CHECK(file.left_out.rows == 0);
  CHECK(file.left_out.fields == 2);
  CHECK(file.data.runs[0].bins.size() == 10);
  CHECK(*file.data.runs[0].start_s == Approx(10 * 3600 + 300));  // of its other rows
  CHECK_THAT(read_refused(lines), Contains("2 bad rows") && Contains("start_time") && Contains("run_total_s"));
}

TEST_CASE("more than 5 % of bad rows are refused, one always passes", "[fast]") {
  RowLines lines = write_bin_lines();
  for (const std::size_t at : {3U, 14U}) set_cell(lines[at], 6, "0");
  CHECK(read_lines(lines, BadRows::kLeaveOut).left_out.rows == 2);  // of 40
  set_cell(lines[25], 6, "0");
  CHECK_THROWS_WITH(read_lines(lines, BadRows::kLeaveOut), Contains("3 of 40 rows") && Contains("too many"));
  CHECK_THAT(read_refused(lines), Contains("only if they are few"));
  lines.resize(6);
  CHECK(read_lines(lines, BadRows::kLeaveOut).left_out.rows == 1);  // of 5
}

TEST_CASE("bad rows of all files of a drum's coastdowns are in one error, or are left out", "[fast]") {
  RowLines loaded = split_lines(write_drum_coast(0.25)), lifted = split_lines(write_drum_coast(0.1));
  RowLines loaded_others = loaded, lifted_others = lifted;
  loaded[30] = "29,8O.5";
  loaded[40] = "39";
  lifted[50] = "20,90";  // a time that falls
  loaded_others.erase(loaded_others.begin() + 40);
  loaded_others.erase(loaded_others.begin() + 30);
  lifted_others.erase(lifted_others.begin() + 50);
  const TemporaryFolder folder, other_folder;
  const std::string path = write_coast_set(folder, join_lines(loaded), join_lines(lifted));
  CHECK_THROWS_WITH(read_coast_set(path), Contains("3 bad rows in 2 of 2 files") && Contains("31  speed_km_h") &&
                                              Contains("41  (row)") && Contains("51  time_s"));
  const CoastSet set = read_coast_set(path, "", BadRows::kLeaveOut);
  const CoastSet others =
      read_coast_set(write_coast_set(other_folder, join_lines(loaded_others), join_lines(lifted_others)));
  for (const std::size_t run : {0U, 1U}) {
    CHECK(set.runs[run].drum->time_s == others.runs[run].drum->time_s);
    CHECK(set.runs[run].drum->speed_m_s == others.runs[run].drum->speed_m_s);
  }
  CHECK(set.runs[0].left_out.rows == 2);
  CHECK(set.runs[1].left_out.rows == 1);
  CHECK(list_runs_with_bad_rows(set).size() == 2);
}

TEST_CASE("rows of two bodies in one file: a time counts against its own body, and a file in two runs once", "[fast]") {
  std::string text = "src,t_s,speed_mps\n";
  for (int i = 0; i < 40; ++i) text += fmt::format("D,{},{}\nW,{},{}\n", i, 30.0 - 0.2 * i, i + 0.5, 29.9 - 0.2 * i);
  RowLines lines = split_lines(text);
  lines[21] = "W,10,28";  // at 10 s; the drum's clock says 10 s as well
  lines[22] = "X,10.5,27.9";
  const TemporaryFolder folder;
  write_coast_set(folder, join_lines(lines), join_lines(lines));
  std::string toml = tests::read_file(folder.file("set.toml"));
  toml.replace(toml.find("lifted.csv"), 10, "loaded.csv");
  write_file(folder.file("set.toml"), toml);
  const CoastSet set = read_coast_set(folder.file("set.toml"), "", BadRows::kLeaveOut);
  CHECK(set.runs[0].drum->time_s.size() == 39);
  CHECK(set.runs[0].wheel->time_s.size() == 40);  // 10 s lies between its neighbors
  REQUIRE(list_runs_with_bad_rows(set).size() == 1);
  CHECK(set.runs[0].left_out.problems.size() == 1);
  CHECK_THROWS_WITH(read_coast_set(folder.file("set.toml")), Contains("'X' is no body") && Contains("line 23"));
}
