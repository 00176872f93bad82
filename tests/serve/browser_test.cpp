// The page of `rollrig serve` in headless Chromium, moved with mouse and keyboard: sliders and their curves, messages
// beside controls, a folder that is dropped and ends in a diagnosis.
#include <catch2/catch.hpp>

#include <filesystem>

#include "build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig::tests;

TEST_CASE("the page of rollrig serve, from a slider to the diagnosis of a dropped folder", "[slow]") {
  const TemporaryFolder folder;
  const fs::path examples = fs::path(ROLLRIG_SOURCE_DIR) / "assets/examples";
  fs::create_directory(folder.file("my logs"));
  for (const char* name :
       {"own_logs/Warmlauf_40.csv", "own_logs/Warmlauf_120.csv", "hidden_effect/tire.toml", "hidden_effect/rig.toml"}) {
    fs::copy_file(examples / name, fs::path(folder.file("my logs")) / fs::path(name).filename());
  }
  const std::string script = std::string(ROLLRIG_SOURCE_DIR) + "/tests/serve/check_serve.mjs";
  const ProgramResult checked = run_other(ROLLRIG_NODE, "'" + script + "' '" + ROLLRIG_PROGRAM + "' '" + folder.path() +
                                                            "' '" + folder.file("my logs") + "'");
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}
