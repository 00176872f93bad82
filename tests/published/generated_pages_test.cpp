#include <catch2/catch.hpp>

#include <sstream>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tools/pages.h"

using namespace rollrig;

namespace {

/// Numbers and words of a text, apart.
void split(const std::string& text, std::vector<double>& numbers, std::string& words) {
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    try {
      std::size_t used = 0;
      const double value = std::stod(word, &used);
      if (used == word.size()) {
        numbers.push_back(value);
        continue;
      }
    } catch (const std::exception&) {
      // a word
    }
    words += word + " ";
  }
}

}  // namespace

TEST_CASE("docs/published.md says what the program gives", "[published]") {
  std::vector<double> written, now;
  std::string written_words, now_words;
  split(read_text_file(ROLLRIG_SOURCE_DIR "/docs/published.md"), written, written_words);
  split(tools::make_published_page(), now, now_words);
  CHECK(written_words == now_words);
  REQUIRE(written.size() == now.size());
  for (std::size_t i = 0; i < now.size(); ++i) CHECK(now[i] == Approx(written[i]).epsilon(2e-3).margin(2e-3));
}

TEST_CASE("docs/reference.md says what the code declares", "[fast]") {
  // Out of date? cmake --build build/release --target docs_pages
  CHECK(read_text_file(ROLLRIG_SOURCE_DIR "/docs/reference.md") == tools::make_reference_page());
}

TEST_CASE("docs/physics.md has the equations and assumptions that the code states", "[fast]") {
  CHECK(read_text_file(ROLLRIG_SOURCE_DIR "/docs/physics.md") == tools::make_physics_page());
}
