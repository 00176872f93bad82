// What a person on the page is told has no option of the command line in it.
#include "serve/page_words.h"

#include <catch2/catch.hpp>

using rollrig::serve::speak_of_page;

TEST_CASE("messages on the page speak of its fields and not of options", "[fast]") {
  CHECK(speak_of_page("--cold-pressure NUMBER, in kPa, gauge") ==
        "the field 'Pressure of the cold tire', in kPa, gauge");
  CHECK(speak_of_page("--column \"load_N=HEADING\", or --value load_N=NUMBER of what was not logged") ==
        "choose the column of 'load_N' in the table, or 'a constant' where it was not logged");
  CHECK(speak_of_page("--date-order dmy or --date-order mdy") == "dmy or mdy beside 'Order of dates'");
  CHECK(speak_of_page("--rest run-2=MINUTES; 0 right after another run") ==
        "minutes in the field 'Rest before run-2'; 0 right after another run");
  CHECK(speak_of_page("a constant, as --value says") == "a constant, as you have said");
  CHECK(speak_of_page("--unit") == "unit");
  CHECK(speak_of_page("no option -- at all") == "no option -- at all");
}

TEST_CASE("a text of a file of any length is given as it is", "[fast]") {
  const std::string text = "--column \"" + std::string(1000000, 'x') + "=HEADING";
  CHECK(speak_of_page(text) == text);
}
