#include "sim/core/text_cursor.h"

#include <catch2/catch.hpp>

using rollrig::TextCursor;

TEST_CASE("a cursor takes what comes next, and stays where something else comes", "[fast]") {
  TextCursor cursor("205/55 zr16 x");
  CHECK_FALSE(cursor.take_digits(4, 4).has_value());
  CHECK_FALSE(cursor.take_digits(1, 2).has_value());
  CHECK_FALSE(cursor.take_letters(1).has_value());
  CHECK(cursor.take_digits(1, 3) == "205");
  CHECK(cursor.take_one_of("-./") == '/');
  CHECK_FALSE(cursor.take('/'));
  CHECK(cursor.take_digits(2) == "55");
  CHECK(cursor.skip_blanks() == 1);
  CHECK(cursor.take_word("ZR"));
  CHECK_FALSE(cursor.take_word("16 x and more"));
  CHECK(cursor.rest() == "16 x");
  CHECK_FALSE(cursor.at_end());
}

TEST_CASE("a cursor is not afraid of long texts, nor of their end", "[fast]") {
  TextCursor cursor(std::string_view{});
  CHECK(cursor.at_end());
  CHECK(cursor.take_one_of("abc") == '\0');
  CHECK(cursor.skip_blanks() == 0);
  const std::string digits(1000000, '7');
  TextCursor longer(digits);
  CHECK_FALSE(longer.take_digits(1, 9).has_value());
  CHECK(longer.take_digits(1)->size() == digits.size());
}
