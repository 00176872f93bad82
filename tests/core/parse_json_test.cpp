#include "sim/core/parse_json.h"

#include <catch2/catch.hpp>

#include "sim/core/error.h"

using namespace rollrig;
using Catch::Contains;

namespace {
Json parse_text(const std::string& text) { return parse_json(text, "result.json"); }
}  // namespace

TEST_CASE("JSON is read with its keys in order", "[fast]") {
  CHECK(parse_text(R"({"b": [1, 2.5], "a": null})").dump() == R"({"b":[1,2.5],"a":null})");
}

TEST_CASE("what is not JSON is told with its file and line", "[fast]") {
  CHECK_THROWS_WITH(parse_text("{\n\"a\": 1,\n\"b\": x\n}"), Contains("not JSON") && Contains("result.json, line 3"));
  CHECK_THROWS_WITH(parse_text("{\n\"a\": 1,\n"), Contains("not JSON") && Contains("line 3"));
  CHECK_THROWS_AS(parse_text(""), InputError);
  CHECK_THROWS_AS(parse_text("nan"), InputError);
}

TEST_CASE("a number that no double holds is told with its line", "[fast]") {
  CHECK_THROWS_WITH(parse_text("{\n\"a\": 1e999\n}"),
                    Contains("a number that is too large") && Contains("line 2") && Contains("1e999"));
}

TEST_CASE("JSON that is nested too deeply is refused before a parser follows it", "[fast]") {
  for (const std::size_t levels : {100U, 800U, 20000U, 1000000U}) {
    CHECK_THROWS_WITH(parse_text(std::string(levels, '[')), Contains("nested too deeply"));
    CHECK_THROWS_WITH(parse_text(std::string(levels, '[') + std::string(levels, ']')), Contains("nested too deeply"));
  }
}
