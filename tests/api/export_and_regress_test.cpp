// Exports and regressions by a program of somebody else's, through the shared library.
#include <rollrig/error.h>
#include <rollrig/export.h>
#include <rollrig/regress.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using rollrig::regress;
using rollrig::Regression;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

/// A folder `runs` with one run file and its golden.
class RegressionFolder {
 public:
  RegressionFolder() {
    fs::create_directory(runs());
    for (const char* file : {"skim_a40.toml", "skim_a40.golden.csv"}) {
      fs::copy(std::string(ROLLRIG_SOURCE_DIR "/assets/regression/") + file, runs());
    }
  }

  std::string runs() const { return folder_.file("runs"); }
  std::string golden() const { return runs() + "/skim_a40.golden.csv"; }
  const std::string& path() const { return folder_.path(); }

  /// Doubles the golden's result.parasitic_N.
  void change_golden() const {
    std::string text = read_file(golden());
    const std::string key = "result.parasitic_N,,";
    const std::size_t at = text.find(key) + key.size();
    const std::size_t end = text.find(',', at);
    write_file(golden(), text.replace(at, end - at, std::to_string(2.0 * std::stod(text.substr(at, end - at)))));
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("an export has the bytes that the command writes, of a result, a set and a recording", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run warm_up --tire a50 --fidelity quasi_static --sensors source "
                      "--out result --write-set set --quiet",
                      folder.path())
              .status == 0);
  for (const char* source : {"result", "set", "result/recording.csv"}) {
    INFO(source);
    const std::string command = std::string("export ") + source + " --mat told.mat --hdf5 told.h5 --quiet";
    REQUIRE(run_program(command, folder.path()).status == 0);
    const rollrig::Export made = rollrig::read_export(folder.file(source));
    CHECK(made.make_mat() == read_file(folder.file("told.mat")));
    CHECK(made.make_hdf5() == read_file(folder.file("told.h5")));
    CHECK(made.make_hdf5().substr(1, 3) == "HDF");
  }
  CHECK_THROWS_AS(rollrig::read_export(folder.path()), rollrig::InputError);
  CHECK_THROWS_WITH(rollrig::read_export(folder.file("result/recordng.csv")), Contains("recording.csv"));
}

TEST_CASE("an unchanged result passes, as the command says it", "[fast]") {
  const RegressionFolder folder;
  double done = 0.0;
  const Regression found = regress(folder.runs(), {1, [&done](double share, const std::string&) { done = share; }});
  CHECK(done == 1.0);
  REQUIRE(found.runs.size() == 1);
  CHECK(found.runs[0].name == "skim_a40");
  CHECK(found.runs[0].status == "same");
  CHECK(found.runs[0].problems.empty());
  CHECK(found.runs[0].compared > 10);
  CHECK(found.runs[0].worst_share <= 1.0);
  CHECK(found.text == run_program("regress runs", folder.path()).out);
  CHECK(found.json == run_program("regress runs --json -", folder.path()).out);
  CHECK_THAT(found.make_page(), Contains("<html"));
  const std::string before = read_file(folder.golden());
  CHECK(update_goldens(found).runs[0].status == "same");
  CHECK(read_file(folder.golden()) == before);
}

TEST_CASE("a changed result is named with its key, until its golden is updated", "[fast]") {
  const RegressionFolder folder;
  folder.change_golden();
  const Regression changed = regress(folder.runs());
  REQUIRE(changed.runs.size() == 1);
  CHECK(changed.runs[0].status == "differs");
  CHECK_THAT(changed.runs[0].worst_quantity, Contains("result.parasitic_N"));
  CHECK(changed.runs[0].worst_share > 1.0);
  REQUIRE(changed.runs[0].problems.size() == 1);
  CHECK_THAT(changed.runs[0].problems[0], Contains("result.parasitic_N"));
  CHECK_THAT(changed.text, Contains("differs") && Contains("result.parasitic_N"));
  const Regression updated = update_goldens(changed);
  CHECK(updated.runs[0].status == "updated");
  CHECK_THAT(updated.json, Contains("\"updated\""));
  CHECK(read_file(folder.golden()) == changed.runs[0].golden);
  CHECK(regress(folder.runs()).runs[0].status == "same");
}

TEST_CASE("where one golden cannot be written, no golden changes", "[fast]") {
  const RegressionFolder folder;
  folder.change_golden();
  const std::string before = read_file(folder.golden());
  write_file(folder.runs() + "/z_last.toml", read_file(folder.runs() + "/skim_a40.toml"));
  const Regression changed = regress(folder.runs());
  REQUIRE(changed.runs.size() == 2);
  fs::create_directory(folder.runs() + "/z_last.golden.csv");
  CHECK_THROWS_WITH(update_goldens(changed), Contains("z_last.golden.csv"));
  CHECK(read_file(folder.golden()) == before);
  CHECK(std::distance(fs::directory_iterator(folder.runs()), fs::directory_iterator()) == 4);  // nothing is left
}

TEST_CASE("a run that cannot be compared says why, and the others are compared", "[fast]") {
  const RegressionFolder folder;
  const std::string run = read_file(folder.runs() + "/skim_a40.toml");
  write_file(folder.runs() + "/bad_golden.toml", run);
  write_file(folder.runs() + "/bad_golden.golden.csv", "quantity,value\n");
  write_file(folder.runs() + "/bad_run.toml", "format = \"rollrig-run/1\"\nscenario = \"skimm\"\n");
  write_file(folder.runs() + "/no_golden.toml", run);
  write_file(folder.runs() + "/renamed.golden.csv", read_file(folder.golden()));
  const Regression found = regress(folder.runs());
  std::map<std::string, std::string> status;
  for (const rollrig::RegressedRun& at : found.runs) status[at.name] = at.status;
  CHECK(status == std::map<std::string, std::string>{{"bad_golden", "bad golden"},
                                                     {"bad_run", "bad run file"},
                                                     {"no_golden", "no golden"},
                                                     {"renamed", "no run file"},
                                                     {"skim_a40", "same"}});
  CHECK_THAT(found.text, Contains("skimm"));
  const TemporaryFolder empty;
  CHECK_THROWS_AS(regress(empty.path()), rollrig::InputError);
}
