// What cmake --install leaves: a program that works wherever its prefix is moved, and libraries that others use.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::ProgramResult;
using rollrig::tests::read_file;
using rollrig::tests::run_other;
using rollrig::tests::TemporaryFolder;

namespace {

/// The project installed to one prefix and moved to another.
class InstalledPrefix {
 public:
  InstalledPrefix() {
    const std::string first = folder_.file("first");
    const ProgramResult installed =
        run_other(ROLLRIG_CMAKE, "--install '" ROLLRIG_BINARY_DIR "' --prefix '" + first + "'");
    INFO(installed.err);
    REQUIRE(installed.status == 0);
    fs::rename(first, path());
  }

  std::string path() const { return folder_.file("second"); }
  std::string file(const std::string& name) const { return path() + "/" + name; }

 private:
  TemporaryFolder folder_;
};

/// RRc as the installed program finds it, with its own assets.
double run_installed_program(const InstalledPrefix& prefix) {
  const TemporaryFolder elsewhere;
  const ProgramResult run =
      run_other(prefix.file("bin/rollrig").c_str(), "run iso_28580 --tire a50 --out results --quiet", elsewhere.path(),
                "env -u ROLLRIG_ASSETS");
  INFO(run.err);
  REQUIRE(run.status == 0);
  const json manifest = json::parse(read_file(elsewhere.file("results/manifest.json")));
  CHECK(manifest["tire"]["file"] == prefix.file("share/rollrig/assets/tires/a50.toml"));
  return json::parse(read_file(elsewhere.file("results/result.json")))["result"]["rrc_25degC_2m_N_per_kN"];
}

}  // namespace

TEST_CASE("an installed program runs from anywhere, and a project that finds the package gets the same RRc", "[slow]") {
  const InstalledPrefix prefix;
  const double rrc_N_per_kN = run_installed_program(prefix);
  for (const char* file :
       {"share/man/man1/rollrig.1.gz", "share/zsh/site-functions/_rollrig", "share/bash-completion/completions/rollrig",
        "include/rollrig/rollrig.h", "lib/pkgconfig/rollrig.pc"}) {
    INFO(file);
    CHECK(fs::exists(prefix.file(file)));
  }

  const TemporaryFolder build;
  const ProgramResult configured = run_other(ROLLRIG_CMAKE,
                                             "-G Ninja -S '" ROLLRIG_SOURCE_DIR
                                             "/tests/install/program' -B . -DCMAKE_BUILD_TYPE=Release "
                                             "-DCMAKE_PREFIX_PATH='" +
                                                 prefix.path() + "'",
                                             build.path());
  INFO(configured.err);
  REQUIRE(configured.status == 0);
  const ProgramResult built = run_other(ROLLRIG_CMAKE, "--build .", build.path());
  INFO(built.out << built.err);
  REQUIRE(built.status == 0);
  for (const char* program : {"program_17_on", "program_17_off", "program_20_on", "program_20_off"}) {
    const ProgramResult run = run_other(build.file(program).c_str(), "", "/", "env -u ROLLRIG_ASSETS");
    INFO(program << run.err);
    REQUIRE(run.status == 0);
    std::istringstream out(run.out);
    double found_N_per_kN = 0.0;
    std::string unit;
    std::string tire_file;
    out >> found_N_per_kN >> unit >> tire_file;
    CHECK(found_N_per_kN == rrc_N_per_kN);
    CHECK(unit == "N/kN");
    CHECK(tire_file == prefix.file("share/rollrig/assets/tires/a50.toml"));
  }
}

TEST_CASE("what is installed shows the API alone", "[fast]") {
  const ProgramResult symbols = run_other("nm", "--dynamic --defined-only --demangle " ROLLRIG_LIBRARY);
  REQUIRE(symbols.status == 0);
  CHECK_THAT(symbols.out, Contains("rollrig::Run::carry_out"));
  CHECK_THAT(symbols.out, Contains("rollrig::InputError::InputError"));
  for (const char* inside : {"rollrig::scenarios", "rollrig::models", "rollrig::exports",
                             "rollrig::diagnosis::", "rollrig::sim::", " rollrig::read_config", "CVode"}) {
    INFO(inside);
    std::istringstream lines(symbols.out);
    for (std::string line; std::getline(lines, line);) {
      const bool is_of_std = line.find(" std::") != std::string::npos || line.find(" void std::") != std::string::npos;
      if (!is_of_std) CHECK_THAT(line, !Contains(inside));
    }
  }
  const std::string config = read_file(ROLLRIG_BINARY_DIR "/rollrigConfig.cmake");
  CHECK_THAT(config, !Contains("find_dependency"));
  for (const auto& entry : fs::directory_iterator(ROLLRIG_SOURCE_DIR "/include/rollrig")) {
    std::istringstream header(read_file(entry.path().string()));
    for (std::string line; std::getline(header, line);) {
      if (line.rfind("#include", 0) != 0) continue;
      INFO(entry.path() << ": " << line);
      const bool is_own = line[9] == '"' && line.find('/') == std::string::npos;
      CHECK((is_own || (line[9] == '<' && line.find('.') == std::string::npos)));
    }
  }
}

TEST_CASE("the manual page names every command", "[fast]") {
  const std::string page = rollrig::tests::run_program("man").out;
  for (const char* command : {"run", "sweep", "regress", "validate", "list", "describe", "fit tire", "fit road\\-load",
                              "diagnose", "import", "export", "convert", "align", "compare"}) {
    CHECK_THAT(page, Contains(std::string(".SS rollrig ") + command + "\n"));
  }
  const TemporaryFolder folder;
  rollrig::tests::write_file(folder.file("rollrig.1"), page);
  if (std::system("command -v mandoc > /dev/null") != 0) return;  // NOLINT: a shell is wanted here
  const ProgramResult lint = run_other("mandoc", "-Tlint -Wstyle rollrig.1", folder.path());
  INFO(lint.out << lint.err);
  CHECK(lint.status == 0);
}
