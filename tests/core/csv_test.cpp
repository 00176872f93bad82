#include "sim/core/csv.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/temporary_folder.h"

using namespace rollrig;

namespace {
CsvTable parse(const std::string& content) {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("run.csv"), content);
  return CsvTable::read(folder.file("run.csv"));
}
}  // namespace

TEST_CASE("quotes, line ends, byte order mark and blank last lines of RFC 4180", "[fast]") {
  const CsvTable csv = parse("\xEF\xBB\xBFtime_s,\"a \"\"name\"\"\"\r\n0,\"x,y\"\r\n1,\"two\nlines\"\r\n\r\n");
  CHECK(csv.columns() == std::vector<std::string>{"time_s", "a \"name\""});
  CHECK(csv.row_count() == 2);
  CHECK(csv.text("a \"name\"")[0] == "x,y");
  CHECK(csv.text("a \"name\"")[1] == "two\nlines");
}

TEST_CASE("numbers come in SI units and empty cells as NaN where they may be empty", "[fast]") {
  const CsvTable csv = parse("time_s,p_kPa\n0,1\n1,\n");
  CHECK(csv.numbers({"p_kPa", any_number(), ""}, true)[0] == 1000.0);
  CHECK(std::isnan(csv.numbers({"p_kPa", any_number(), ""}, true)[1]));
  CHECK_THROWS_WITH(csv.numbers({"p_kPa", any_number(), ""}), Catch::Contains("empty") && Catch::Contains("line 3"));
}

TEST_CASE("what is written is read back", "[fast]") {
  CsvWriter writer({"time_s", "text"});
  writer.add_row(CsvWriter::Rounded{1.0 / 3.0, 17}, "with \"quotes\", and comma");
  const CsvTable csv = parse(writer.take());
  CHECK(csv.numbers({"time_s", any_number(), ""})[0] == 1.0 / 3.0);
  CHECK(csv.text("text")[0] == "with \"quotes\", and comma");
}

TEST_CASE("with a list of problems, what is wrong with single rows is noted and the others are read", "[fast]") {
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("run.csv"), "time_s,a_kN\n0,1\n1\n\"2,1\n3,x\n4,\n2.5,1\n# a remark\n6,1,2\n7,1\n");
  RowProblems problems;
  const CsvTable csv = CsvTable::read(folder.file("run.csv"), {}, &problems);
  CHECK(csv.row_count() == 5);
  const std::vector<double> times = csv.increasing_times("time_s", &problems);
  const std::vector<double> values = csv.numbers({"a_kN", any_number(), ""}, false, &problems);
  CHECK(times.back() == 7.0);
  CHECK(values.front() == 1000.0);
  CHECK(std::isnan(values[1]));
  CHECK(std::isnan(values[2]));
  std::vector<int> lines;
  for (const InputProblem& problem : problems) lines.push_back(problem.line);
  CHECK(lines == std::vector<int>{3, 4, 8, 9, 7, 5, 6});
  CHECK_THROWS_WITH(CsvTable::read(folder.file("run.csv")), Catch::Contains("ragged") && Catch::Contains("line 3"));
}

TEST_CASE("wrong files are refused with line and column", "[fast]") {
  CHECK_THROWS_WITH(parse("a,b\n1\n"), Catch::Contains("ragged") && Catch::Contains("line 2"));
  CHECK_THROWS_WITH(parse("a,a\n1,2\n"), Catch::Contains("stands twice"));
  CHECK_THROWS_WITH(parse("a,\n1,2\n"), Catch::Contains("no name"));
  CHECK_THROWS_WITH(parse("a\n\"1\n"), Catch::Contains("never ends"));
  CHECK_THROWS_WITH(parse("a,b\n"), Catch::Contains("no rows"));
  CHECK_THROWS_WITH(parse("time_s\n1\n1\n").increasing_times("time_s"), Catch::Contains("does not increase"));
  CHECK_THROWS_WITH(parse("a_N\nx\n").numbers({"a_N", any_number(), ""}), Catch::Contains("not a number"));
  CHECK_THROWS_WITH(parse("a_N\n\"1,5\"\n").numbers({"a_N", any_number(), ""}), Catch::Contains("decimal point"));
  CHECK_THROWS_WITH(parse("# rig log\na_N,b_N\n1,2\n"), Catch::Contains("a comment") && Catch::Contains("line 1"));
  CHECK_THROWS_WITH(parse("a_N,b_N\n1,2\n# stop\n"), Catch::Contains("a comment") && Catch::Contains("line 3"));
  CHECK_THROWS_WITH(parse("# a_N\n1\n").require_known({"a_N"}), Catch::Contains("a comment"));
  CHECK_THROWS_WITH(parse("a_kN\n1\n").require_known({"a_N"}), Catch::Contains("unknown column 'a_kN'"));
  CHECK_THROWS_WITH(parse(" a_N\n1\n").require_known({"a_N"}), Catch::Contains("a blank before or after"));
  CHECK_THROWS_WITH(parse("#,a_N\n1,2\n3\n"), Catch::Contains("ragged") && Catch::Contains("line 3"));  // a counter
  CHECK_THROWS_WITH(parse("a_N\nnan\n").numbers({"a_N", any_number(), ""}), Catch::Contains("not finite"));
}

TEST_CASE("a header that is to stand behind the end of the file is told", "[fast]") {
  for (const std::string content : {"a,b\n1,2", "a,b\n1,2\n", "a"}) {
    for (const int line : {4, 9, 1000000}) {
      const tests::TemporaryFolder folder;
      tests::write_file(folder.file("run.csv"), content);
      CsvForm form;
      form.header_line = line;
      form.first_row_line = line + 1;
      CHECK_THROWS_WITH(CsvTable::read(folder.file("run.csv"), form), Catch::Contains("ends before its header"));
    }
  }
}

TEST_CASE("a table may have as many columns as the limit, which are found at once", "[fast]") {
  const auto make = [](std::size_t columns) {
    std::string header, row;
    for (std::size_t i = 0; i < columns; ++i) {
      header += (i > 0 ? ",c" : "c") + std::to_string(i);
      row += i > 0 ? ",1" : "0";
    }
    return header + "\n" + row + "\n";
  };
  const CsvTable csv = parse(make(kMostColumns));
  CHECK(csv.text("c0")[0] == "0");
  CHECK(csv.has("c" + std::to_string(kMostColumns - 1)));
  CHECK_THROWS_WITH(parse(make(kMostColumns + 1)), Catch::Contains("too many columns"));
}

TEST_CASE("a long cell is told by its beginning", "[fast]") {
  const std::string cell(50000, 'x');
  try {
    parse("a\n" + cell + "\n").numbers({"a", any_number(), ""});
    FAIL("a text was taken for a number");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).size() < 1000);
  }
}
