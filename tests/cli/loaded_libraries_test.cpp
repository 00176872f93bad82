// The libraries that link Simbody and Ceres are loaded for multibody runs and fits alone.
#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {

const std::string kAssetsSet = "export ROLLRIG_ASSETS=" ROLLRIG_SOURCE_DIR "/assets;";

/// Copies the program and the libraries that it cannot start without. Returns the program's path.
std::string install_without_loaded_libraries(const fs::path& prefix) {
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "lib");
  const fs::path program = prefix / "bin" / "rollrig";
  fs::copy_file(ROLLRIG_PROGRAM, program);
  for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_LIBRARY).parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("librollrig_cvodes.so", 0) == 0) fs::copy(entry.path(), prefix / "lib" / name);
  }
  return program.string();
}

}  // namespace

TEST_CASE("without the multibody library a multibody run says what is missing, and all else works", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string program = install_without_loaded_libraries(folder.path());
  const auto run = [&](const std::string& fidelity) {
    return tests::run_other(program.c_str(), "run iso_28580 --tire a50 --out result --fidelity " + fidelity,
                            folder.path(), kAssetsSet);
  };
  const tests::ProgramResult multibody = run("multibody");
  CHECK(multibody.status == 3);
  CHECK_THAT(tests::flatten(multibody.err),
             Catch::Contains("the library of the multibody rigs cannot be loaded: librollrig_multibody.so") &&
                 Catch::Contains("it is installed with rollrig, beside its other libraries"));
  CHECK_FALSE(fs::exists(fs::path(folder.path()) / "result"));
  const tests::ProgramResult quasi_static = run("quasi_static");
  INFO(quasi_static.err);
  CHECK(quasi_static.status == 0);
  CHECK(fs::exists(fs::path(folder.path()) / "result" / "result.json"));
}

TEST_CASE("without the library of least squares a fit says what is missing", "[fast]") {
  const tests::TemporaryFolder folder;
  const std::string program = install_without_loaded_libraries(folder.path());
  const tests::ProgramResult measured =
      tests::run_other(program.c_str(),
                       "run speed_sweep --tire c1_205_55r16 --sensors source --fidelity quasi_static --set "
                       "'speeds_km_h=[60, 110]' --set measurement_cycles=1 --set settle_min=0 --write-set set --quiet",
                       folder.path(), kAssetsSet);
  INFO(measured.err);
  REQUIRE(measured.status == 0);
  const tests::ProgramResult fit =
      tests::run_other(program.c_str(), "fit tire set --out fitted --name mine", folder.path(), kAssetsSet);
  CHECK(fit.status == 3);
  CHECK_THAT(tests::flatten(fit.err),
             Catch::Contains("the library of least squares cannot be loaded: librollrig_least_squares.so"));
  CHECK_FALSE(fs::exists(fs::path(folder.path()) / "fitted"));
}

TEST_CASE("the program and its library load neither Simbody nor the libraries of Ceres when they start", "[fast]") {
  for (const char* binary : {ROLLRIG_PROGRAM, ROLLRIG_LIBRARY}) {
    const tests::ProgramResult loaded = tests::run_other("ldd", binary);
    REQUIRE(loaded.status == 0);
    CHECK_THAT(loaded.out, Catch::Contains("librollrig_cvodes") && !Catch::Contains("SimTK") &&
                               !Catch::Contains("libglog") && !Catch::Contains("libcholmod"));
  }
}
