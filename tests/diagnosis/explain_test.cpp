// Explanations of effects: complete, from the catalog, within 80 columns.
#include "diagnosis/output/explain.h"
#include "rigs/machine.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "models/effect.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

using Catch::Contains;
using namespace rollrig;

TEST_CASE("every name can be explained within 80 columns", "[fast]") {
  for (const std::string& name : diagnosis::explainable_names()) {
    INFO(name);
    const std::string text = diagnosis::explain_effect(name);
    CHECK_THAT(text, Catch::StartsWith(name + ":"));
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      // a word longer than a line stands alone
      CHECK((count_characters(line) <= 80 || line.find(' ', line.find_first_not_of(' ')) == std::string::npos));
    }
  }
}

TEST_CASE("an effect's explanation holds all that its declaration knows", "[fast]") {
  for (const models::Effect* effect : models::all_effects()) {
    const models::EffectInfo& info = effect->info;
    const std::string text = diagnosis::explain_effect(info.id);
    INFO(text);
    for (const char* title :
         {"Equation", "Source", "Own parameters", "Acts on", "Visible in", "Confused with", "Separated by"}) {
      CHECK_THAT(text, Contains(title));
    }
    for (const models::EffectParameter& parameter : info.parameters) {
      // from its key to the line that no longer continues its row
      const std::size_t begin = text.find(std::string("\n  ") + parameter.key + "  ");
      REQUIRE(begin != std::string::npos);
      std::size_t end = text.find('\n', begin + 1);
      while (text.compare(end + 1, 3, "   ") == 0) end = text.find('\n', end + 1);
      std::istringstream words(text.substr(begin, end - begin));
      std::string prior;
      for (std::string word; words >> word;) prior += word + " ";
      const bool is_log = prior.find("on a log scale") != std::string::npos;
      CHECK(is_log == (parameter.prior.scale == models::Prior::Scale::kLog));
    }
    for (const std::string& channel : rigs::list_visible(info)) CHECK_THAT(text, Contains(channel));
    for (const std::string& id : info.confused_with) CHECK_THAT(text, Contains(id));
  }
}

TEST_CASE("an effect that only two machines show says so, and names no key of a run file", "[fast]") {
  for (const char* name : {"surface_roughness", "drum_diameter", "ambient_record", "liner_record"}) {
    CHECK_THAT(diagnosis::explain_effect(name), Contains("Compared only by") && Contains("--against"));
    CHECK_THAT(diagnosis::explain_effect(name), !Contains("[effects."));
  }
  CHECK_THAT(diagnosis::explain_effect("bearing_warmup"), !Contains("Compared only by"));
}

TEST_CASE("none and unknown are explained", "[fast]") {
  CHECK_THAT(diagnosis::explain_effect("none"), Contains("no_gap"));
  CHECK_THAT(diagnosis::explain_effect("unknown"), Contains("unexplained"));
}

TEST_CASE("a misspelled effect is answered with the nearest", "[fast]") {
  CHECK_THROWS_WITH(diagnosis::explain_effect("bearing_warmpu"), Contains("bearing_warmup"));
  CHECK_THROWS_AS(diagnosis::explain_effect(""), InputError);
}
