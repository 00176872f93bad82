// Files whose names and values hold what a terminal would carry out: they are shown, in every kind of output.
#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::tests;

namespace {

const std::string kHostile = "e\x1b[2J\x07\xC2\x9B\xE2\x80\xAE";
constexpr const char* kInToml = "e\\u001b[2J\\u0007\\u009b\\u202e\\nerror: forged";

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
}

void check_harmless(const ProgramResult& result) {
  for (const std::string* text : {&result.out, &result.err}) {
    INFO(*text);
    for (const char* hidden : {"\x1b", "\x07", "\xC2\x9B", "\xE2\x80\xAE", "\nerror: forged"}) {
      CHECK_THAT(*text, !Catch::Contains(hidden));
    }
  }
}

/// Harmless, and the name is there to be seen.
void check_visible(const ProgramResult& result) {
  check_harmless(result);
  CHECK_THAT(result.out + result.err, Catch::Contains("\\x1b"));
}

}  // namespace

TEST_CASE("names in files and paths reach the terminal with their control characters shown", "[fast]") {
  const TemporaryFolder folder;
  std::string tire = read_file(ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml");
  replace(tire, "name = \"a50\"", "name = \"" + std::string(kInToml) + "\"");
  write_file(folder.file("tire.toml"), tire);
  write_file(folder.file(kHostile + ".toml"), tire);
  const auto run = [&folder](const std::string& arguments) { return run_program(arguments, folder.path()); };
  check_visible(run("run skim --fidelity quasi_static --tire ./tire.toml"));
  check_visible(run("run skim --fidelity quasi_static --log debug --tire './" + kHostile + ".toml'"));
  check_visible(run("validate tire.toml"));
  check_visible(run("validate '" + kHostile + ".toml' './" + kHostile + ".none'"));
  check_visible(run("run skim --tire '" + kHostile + "'"));
  check_visible(run("run skim --tire a50 --set '" + kHostile + "=3'"));
  check_visible(run("run skim --tire a50 --" + kHostile));
  check_visible(run("'" + kHostile + "'"));
  check_visible(run("sweep skim --fidelity quasi_static --tire a50 --vary '" + kHostile + "=1,2'"));
  check_visible(run("describe '" + kHostile + "'"));
}

TEST_CASE("a measurement set of hostile names is shown as text, and its exports can be read", "[slow]") {
  const TemporaryFolder folder;
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect", folder.file("set"), fs::copy_options::recursive);
  std::string set = read_file(folder.file("set/set.toml"));
  replace(set, "name = \"campaign\"", "name = \"" + std::string(kInToml) + "\"");
  replace(set, "id = \"2-load-sweep\"", "id = \"" + std::string(kInToml) + "\"");
  write_file(folder.file("set/set.toml"), set);
  check_visible(run_program("validate set", folder.path()));
  const ProgramResult found =
      run_program("diagnose set --only bearing_warmup,load_exponent --json why.json", folder.path());
  check_harmless(found);
  CHECK(found.status == 0);
  CHECK_NOTHROW(Json::parse(read_file(folder.file("why.json"))));
  const ProgramResult exported = run_program("export set --mat set.mat --hdf5 set.h5", folder.path());
  INFO(exported.err);
  check_harmless(exported);
  CHECK(exported.status == 0);
}

TEST_CASE("what goes to standard output as a file goes as it is", "[fast]") {
  const TemporaryFolder folder;
  std::string tire = read_file(ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml");
  replace(tire, "name = \"a50\"", "name = \"" + std::string(kInToml) + "\"");
  write_file(folder.file("tire.toml"), tire);
  const ProgramResult page = run_program("run skim --fidelity quasi_static --tire ./tire.toml --html -", folder.path());
  CHECK(page.status == 0);
  CHECK_THAT(page.out, Catch::Contains("\xC2\x9B"));
  CHECK_THAT(page.out, Catch::EndsWith("</html>\n"));
}
