#include "sim/core/columns.h"

#include <catch2/catch.hpp>

using rollrig::text_columns;

TEST_CASE("columns of names stand to the left, of numbers to the right, two spaces apart", "[fast]") {
  CHECK(text_columns({{"name", "force, N", "unit of it"}, {"a50", "12.5", "N"}, {"a", "-3", "kN"}}, {true, 2, 80}) ==
        "  name  force, N  unit of it\n"
        "  a50       12.5  N\n"
        "  a           -3  kN\n");
  CHECK(text_columns({{"mass", "12"}, {"°C", "3"}}, {false, 0, 80}) == "mass  12\n°C    3\n");
  CHECK(text_columns({}).empty());
}

TEST_CASE("what is too wide continues under its own column, headers above their numbers", "[fast]") {
  CHECK(text_columns({{"one", "some words that go on"}}, {false, 2, 20}) ==
        "  one  some words\n"
        "       that go on\n");
  CHECK(text_columns({{"rrc_25degC_N_per_kN", "load of the tire"}, {"5.2", "4000"}}, {true, 0, 20}) ==
        "                load\n"
        " rrc_25degC_  of the\n"
        "    N_per_kN    tire\n"
        "         5.2    4000\n");
}

TEST_CASE("a word that is longer than its column is broken after a part of it", "[fast]") {
  CHECK(text_columns({{"a", "tire_loss_in_skim_and_more"}}, {false, 0, 20}) ==
        "a  tire_loss_in_\n"
        "   skim_and_more\n");
  CHECK(text_columns({{"a", "abcdefghijklmnopqrstuvwxyz"}}, {false, 0, 18}) ==
        "a  abcdefghijklmno\n"
        "   pqrstuvwxyz\n");
}

TEST_CASE("columns for which there is no room follow below, beside the first one", "[fast]") {
  CHECK(text_columns({{"run", "one", "two", "three"}, {"a", "1000000", "2000000", "3000000"}}, {true, 0, 22}) ==
        "run      one      two\n"
        "a    1000000  2000000\n"
        "run    three\n"
        "a    3000000\n");
}

TEST_CASE("a table without columns is a list, and a terminal leaves out what only a page has room for", "[fast]") {
  using rollrig::format_table;
  CHECK(format_table({"", {}, {{"mass", "12 kg"}, {"reference", "200 kPa"}}}) ==
        "  mass       12 kg\n  reference  200 kPa\n");
  CHECK(format_table({"Checks", {"check", "found", "clause"}, {{"slope", "0.1 %", "SAE J1263"}}, 1}) ==
        "  Checks\n  check  found\n  slope  0.1 %\n");
}
