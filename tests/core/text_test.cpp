// Numbers as a person types them.
#include "sim/core/text.h"

#include <catch2/catch.hpp>

using rollrig::format_count;
using rollrig::parse_number;

TEST_CASE("a number is read whole, with a sign or without", "[fast]") {
  CHECK(parse_number("80") == 80.0);
  CHECK(parse_number("+0.5") == 0.5);
  CHECK(parse_number("-1.5e-3") == -0.0015);
  CHECK(parse_number(".25") == 0.25);
}

TEST_CASE("what is not a finite number as a whole is none", "[fast]") {
  for (const char* text : {"", "+", "-", "+-1", "--1", "1,5", "80 km/h", " 80", "0x10", "1e", "nan", "inf", "1e999"}) {
    INFO(text);
    CHECK_FALSE(parse_number(text).has_value());
  }
}

TEST_CASE("one is told in the singular", "[fast]") {
  CHECK(format_count(0, "run") == "0 runs");
  CHECK(format_count(1, "run") == "1 run");
  CHECK(format_count(2, "speed bin") == "2 speed bins");
}
