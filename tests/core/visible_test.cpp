// What a terminal would carry out is shown.
#include "sim/core/visible.h"

#include <catch2/catch.hpp>

#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

using namespace rollrig;

TEST_CASE("control characters are written out, layout and other letters stay", "[fast]") {
  CHECK(show_controls("a\x1b[31mred\a") == "a\\x1b[31mred\\x07");
  CHECK(show_controls("a\rb\x7f") == "a\\rb\\x7f");
  CHECK(show_controls("two\nlines\tand \xC2\xB0"
                      "C, \xE6\x97\xA5, \xF0\x9F\x9A\x97") ==
        "two\nlines\tand \xC2\xB0"
        "C, \xE6\x97\xA5, \xF0\x9F\x9A\x97");
  CHECK(show_controls("\xC2\x9B"
                      "31m") == "\\u009b31m");  // the one-character form of escape [
  CHECK(show_controls("a\xE2\x80\xAE"
                      "b\xE2\x81\xA6") == "a\\u202eb\\u2066");  // changes of direction
  CHECK(show_controls("\x9B\xFF\xC3") == "\\x9b\\xff\\xc3");    // no UTF-8
  CHECK(show_controls(std::string("\0", 1)) == "\\x00");
  CHECK(show_on_one_line("name\nerror: forged\t\x1b") == "name\\nerror: forged\\t\\x1b");
  CHECK(show_controls(show_controls("\x1b\n")) == "\\x1b\n");
}

TEST_CASE("of a value that is long beyond reason, an error shows the beginning", "[fast]") {
  const InputProblem problem{"no number", "set.toml", 3, "load_N", std::string(100'000, '1'), "a number", ""};
  for (const std::string& text : {format_error("error: ", problem), std::string(InputError(problem).what())}) {
    CHECK(text.size() < 2000);
    CHECK_THAT(text, Catch::Contains("1111...") && Catch::Contains("a number"));
  }
}

TEST_CASE("errors, wrapped text and tables hold no control character of a name", "[fast]") {
  const std::string name = "a\x1b[2J\nerror: forged\r";
  const std::string shown = "a\\x1b[2J\\nerror: forged\\r";
  const InputProblem problem{"wrong \x1b", name, 3, name, name, "\x1b", name};
  const std::string error = format_error("error: ", problem);
  CHECK_THAT(error, Catch::Contains(shown) && !Catch::Contains("\x1b") && !Catch::Contains("\nerror: forged"));
  CHECK_THAT(format_error("", unknown_name("tire", name, {})), !Catch::Contains("\nerror: forged"));
  CHECK(wrap("a \x1b[2J b\rc", 0) == "a \\x1b[2J b\\rc\n");
  CHECK_THAT(text_columns({{"name", "value"}, {name, "1"}}, {true, 0}), Catch::Contains(shown));
}
