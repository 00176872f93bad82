// The library that links Simbody is loaded for multibody runs alone.
#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;

TEST_CASE("without the multibody library a multibody run says what is missing, and all else works", "[fast]") {
  const tests::TemporaryFolder folder;
  const fs::path prefix = folder.path();
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "lib");
  const fs::path program = prefix / "bin" / "rollrig";
  fs::copy_file(ROLLRIG_PROGRAM, program);
  for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_LIBRARY).parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("librollrig_cvodes.so", 0) == 0) fs::copy(entry.path(), prefix / "lib" / name);
  }
  const std::string assets = "export ROLLRIG_ASSETS=" ROLLRIG_SOURCE_DIR "/assets;";
  const auto run = [&](const std::string& fidelity) {
    return tests::run_other(program.c_str(), "run iso_28580 --tire a50 --out result --fidelity " + fidelity,
                            folder.path(), assets);
  };
  const tests::ProgramResult multibody = run("multibody");
  CHECK(multibody.status == 3);
  CHECK_THAT(tests::flatten(multibody.err),
             Catch::Contains("the library of the multibody rigs cannot be loaded: librollrig_multibody.so") &&
                 Catch::Contains("it is installed with rollrig, beside its other libraries"));
  CHECK_FALSE(fs::exists(prefix / "result"));
  const tests::ProgramResult quasi_static = run("quasi_static");
  INFO(quasi_static.err);
  CHECK(quasi_static.status == 0);
  CHECK(fs::exists(prefix / "result" / "result.json"));
}

TEST_CASE("the program and its library do not load Simbody when they start", "[fast]") {
  for (const char* binary : {ROLLRIG_PROGRAM, ROLLRIG_LIBRARY}) {
    const tests::ProgramResult loaded = tests::run_other("ldd", binary);
    REQUIRE(loaded.status == 0);
    CHECK_THAT(loaded.out, Catch::Contains("librollrig_cvodes") && !Catch::Contains("SimTK"));
  }
}
