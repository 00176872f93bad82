#include "sim/core/nesting.h"

#include <catch2/catch.hpp>

#include "sim/core/error.h"

using namespace rollrig;
using Catch::Contains;

namespace {

std::string repeat(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

void check(const std::string& text) { require_shallow(text, "file.toml"); }

}  // namespace

TEST_CASE("brackets may stand within each other as deep as the limit, and no deeper", "[fast]") {
  const auto nested = [](const char* open, const char* close, std::size_t levels) {
    return "\n\nx = " + repeat(open, levels) + repeat(close, levels);
  };
  CHECK_NOTHROW(check(nested("[", "]", kDeepestNesting)));
  CHECK_THROWS_WITH(check(nested("[", "]", kDeepestNesting + 1)),
                    Contains("nested too deeply") && Contains("file.toml, line 3"));
  CHECK_THROWS_WITH(check(nested("{a=", "}", kDeepestNesting + 1)), Contains("nested too deeply"));
  CHECK_NOTHROW(check(repeat("[table]\n", 10 * kDeepestNesting)));  // beside each other
}

TEST_CASE("a dotted key may have as many parts as the limit", "[fast]") {
  CHECK_NOTHROW(check("a" + repeat(".a", kMostKeyParts - 1) + " = 1"));
  CHECK_THROWS_WITH(check("x = 1\na" + repeat(".a", kMostKeyParts) + " = 1"),
                    Contains("too many parts") && Contains("line 2"));
  CHECK_THROWS_WITH(check("[a" + repeat(".a", kMostKeyParts) + "]"), Contains("too many parts"));
  CHECK_NOTHROW(check("x = [" + repeat("1.5, ", 100) + "]"));
  CHECK_NOTHROW(check(repeat("a = 1.5\n", 100)));
}

TEST_CASE("what stands in strings and comments is not counted", "[fast]") {
  const std::string deep = repeat("[", kDeepestNesting + 1);
  for (const std::string start : {"# ", "x = \"\\\"", "x = '\\", "x = '''\n'", "x = \"\"\"\n\\\"\"\" "}) {
    INFO(start);
    CHECK_NOTHROW(check(start + deep));
  }
  for (const std::string start :
       {"# \n", "x = \"\\\\\"", "x = '\\'", "x = ''' '''''", "x = \"\"\"\\\"\"\"\"", "x = \"\"", "x = \"no end\n"}) {
    INFO(start);
    CHECK_THROWS_WITH(check(start + deep), Contains("nested too deeply"));
  }
}

TEST_CASE("one object has no more keys than can be looked up one after the other", "[fast]") {
  CHECK_NOTHROW(check("{" + repeat("\"a\": 1,", kMostFieldsInBraces - 1) + "\"a\": 1}"));
  CHECK_THROWS_WITH(check("{" + repeat("\"a\": 1,", kMostFieldsInBraces) + "\"a\": 1}"), Contains("too many keys"));
  CHECK_NOTHROW(check("[" + repeat("1,", 10 * kMostFieldsInBraces) + "1]"));
}

TEST_CASE("four megabytes of quotes are passed over in one go", "[fast]") {  // minutes, if each looked for the last
  constexpr std::size_t kQuotes = 4 << 20;
  for (const char* quote : {"\"", "'"}) CHECK_NOTHROW(check("x = " + repeat(quote, kQuotes)));
}
