// Words that a shell reads back as they are.
#include "sim/core/shell_word.h"

#include <catch2/catch.hpp>

#include "tests/support/run_program.h"

TEST_CASE("a shell reads a quoted word as it is", "[fast]") {
  for (const std::string word :
       {"plain", "/a/b-c_d.toml", "two words", "it's", "", "$HOME `id` \"x\" *", "a\\b", "ä;é"}) {
    const auto echoed = rollrig::tests::run_other("printf", "%s " + rollrig::quote_for_shell(word));
    CHECK(echoed.out == word);
  }
  CHECK(rollrig::quote_for_shell("/a/b-c_d.toml") == "/a/b-c_d.toml");
}
