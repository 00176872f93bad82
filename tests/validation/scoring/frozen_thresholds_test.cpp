// What a blind proof has frozen stays as it was when its bank was made (docs/blind.md, "Freezing").
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "models/effect.h"
#include "sim/core/file_io.h"

using namespace rollrig;

namespace {

constexpr const char* kFrozen = ROLLRIG_SOURCE_DIR "/docs/blind_proof/frozen.sha256";

/// Priors of all effects and the errors of their laws, a line each.
std::string write_priors() {
  std::string text;
  for (const models::Effect* effect : models::all_effects()) {
    const models::LawError& error = effect->info.law_error;
    text += fmt::format("{} {:.17g} {:.17g}\n", effect->info.id, error.law_share, error.whole_share);
    for (const models::EffectParameter& parameter : effect->info.parameters) {
      const models::Prior& prior = parameter.prior;
      text += fmt::format("{}.{} {:.17g} {:.17g} {} {} {:.17g} {:.17g}\n", effect->info.id, parameter.key, prior.low,
                          prior.high, prior.scale == models::Prior::Scale::kLog ? "log" : "linear",
                          prior.either_sign ? "either" : "one", parameter.range.lower, parameter.range.upper);
    }
  }
  return text;
}

std::string find_frozen(const std::string& what) {
  std::istringstream in(read_text_file(kFrozen));
  for (std::string line; std::getline(in, line);) {
    if (line.size() > 66 && line.substr(66) == what) return line.substr(0, 64);
  }
  return "nothing";
}

void check_frozen(const std::string& what, const std::string& content) {
  INFO(what << " is not what " << kFrozen
            << " says. Whoever changes it runs a new blind bank, publishes it and writes the new hash: "
            << calc_sha256(content) << "  " << what);
  CHECK(calc_sha256(content) == find_frozen(what));
}

}  // namespace

TEST_CASE("thresholds and priors are those that the last blind bank was answered with", "[fast]") {
  check_frozen("diagnosis/thresholds.h", read_text_file(ROLLRIG_SOURCE_DIR "/diagnosis/thresholds.h"));
  check_frozen("priors of the catalog", write_priors());
}
