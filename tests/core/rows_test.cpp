#include "sim/core/rows.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "sim/core/text.h"

using namespace rollrig;

namespace {
InputProblem problem_at(const std::string& file, int line) {
  return {"out of range", file, line, "speed_km_h", "627", "a number >= 0 and <= 400", ""};
}
}  // namespace

TEST_CASE("the rows outside the longest sequence of increasing times are those that are wrong", "[fast]") {
  const auto kept = [](const std::vector<double>& times) {
    std::string text;
    for (const bool belongs : find_increasing(times)) text += belongs ? '+' : '-';
    return text;
  };
  CHECK(kept({0, 1, 2, 3}) == "++++");
  CHECK(kept({0, 1, 500, 3, 4}) == "++-++");    // one time ahead of all others
  CHECK(kept({0, 1, 2, 0, 4, 5}) == "+++-++");  // one that falls
  CHECK(kept({0, 1, 1, 3}) == "++-+");          // of equal times the first stays
  CHECK(kept({0, 1, 2, 1.5, 4, 5}) == "+++-++");
  CHECK(kept({0, 1, 3.5, 3, 4, 5}) == "++-+++");
  CHECK(kept({9, 1, 2, 3}) == "-+++");
  CHECK(kept({0, 1, 2, -7}) == "+++-");
  CHECK(kept({0, std::nan(""), 2}) == "+-+");
  CHECK(kept({0, 1, 2, 3, 2.5}) == "++++-");  // the last row falls, not the one before it
  CHECK(kept({0, -0.5, 2, 3, 4}) == "+-+++");
  CHECK(kept({0.5, 0, 1, 2, 3}) == "-++++");
  CHECK(kept({0, 20, 10}) == "++-");  // nothing tells: the later one
  CHECK(kept({1}) == "+");
  CHECK(kept({5, 4, 3, 2, 1}).find('+') != std::string::npos);
  CHECK(kept({}).empty());
}

TEST_CASE("one bad row is told as itself, several as a table of at most twenty rows a file", "[fast]") {
  const InputError one = make_rows_error("1 bad row", {problem_at("a.csv", 7)}, "or another remedy", "a hint");
  CHECK(one.problem().what == "out of range");
  CHECK(one.problem().line == 7);
  CHECK(one.problem().allowed == "a number >= 0 and <= 400; or another remedy");

  RowProblems many;
  for (int line = 2; line < 52; ++line) many.push_back(problem_at("a.csv", line));
  many.push_back(problem_at("b.csv", 9));
  many.push_back(problem_at("a.csv", 2));  // a second field of a row
  CHECK(count_rows(many) == 51);
  const InputError error = make_rows_error("51 bad rows", many, "a remedy", "a hint");
  const std::string text = format_error("error: ", error.problem());
  CHECK_THAT(text, Catch::Contains("a.csv: 50 bad rows") && Catch::Contains("b.csv: 1 bad row"));
  CHECK_THAT(text, Catch::Contains("and 30 rows more") && Catch::Contains("a remedy; a hint"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) CHECK(count_characters(line) <= 80);
}
