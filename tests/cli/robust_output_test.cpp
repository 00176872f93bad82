// What a command leaves when something stops it: all of its outputs or none of them, and a word on why.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "build_paths.h"
#include "sim/core/json.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using rollrig::Json;
using rollrig::tests::flatten;
using rollrig::tests::ProgramResult;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

constexpr const char* kEverything = "run skim --tire a50 --out out --json run.json --html run.html";

/// Bins of three coastdowns each way; all of one heading begin at one time of the day.
std::string make_headings_apart() {
  std::istringstream rows(read_file(ROLLRIG_SOURCE_DIR "/assets/examples/coastdown_bins.csv"));
  std::string text;
  for (std::string row; std::getline(rows, row);) {
    const bool is_heading_line = text.empty();
    const bool is_plus = row.find(",+,") != std::string::npos;
    text += row + (is_heading_line ? ",start_time\n" : is_plus ? ",10:00:00\n" : ",11:00:00\n");
  }
  return text;
}

/// A recording that takes a second to read.
std::string make_long_recording() {
  std::string text = "time_s,speed_km_h,load_N,ambient_degC\n";
  for (int i = 0; i < 600000; ++i) text += std::to_string(i) + ",80,5000,25\n";
  return text;
}

}  // namespace

TEST_CASE("where one output cannot be written, none is", "[fast]") {
  const TemporaryFolder folder;
  // room for result.json, recording.csv (260 kB) and manifest.json, but not for the page (770 kB)
  const auto run = run_program(kEverything, folder.path(), "trap '' XFSZ; ulimit -f 1000;");
  INFO(run.err);
  CHECK(run.status == 2);
  CHECK_THAT(run.err, Contains("run.html"));
  CHECK(run.out.empty());
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("standard output that is closed or full costs no half result", "[fast]") {
  for (const char* lost : {" >&-", " > /dev/full"}) {
    const TemporaryFolder folder;
    const auto run = run_program(std::string(kEverything) + lost, folder.path());
    INFO(lost << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("standard output cannot be written to"));
    CHECK(folder.entry_count() == 0);
    CHECK(run_program(std::string(kEverything) + " --quiet" + lost, folder.path()).status == 0);
    CHECK(fs::exists(folder.file("out/result.json")));
    // no file that is opened takes the place of standard output
    CHECK(Json::parse(read_file(folder.file("run.json"))) == Json::parse(read_file(folder.file("out/result.json"))));
  }
}

TEST_CASE("a result that cannot be written to a device is not told", "[fast]") {
  for (const char* option : {" --json /dev/full", " --html /dev/full"}) {
    const TemporaryFolder folder;
    const auto run = run_program(std::string("run skim --tire a50 --out out") + option, folder.path());
    INFO(option << "\n" << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("/dev/full"));
    CHECK(run.out.empty());
    CHECK(folder.entry_count() == 0);
  }
}

TEST_CASE("a reader that goes takes no file away, and nothing is said", "[fast]") {
  const TemporaryFolder folder;
  const auto run = run_program(std::string(kEverything) + " | true", folder.path());
  CHECK(run.err.empty());
  for (const char* file : {"out/result.json", "run.json", "run.html"}) CHECK(fs::exists(folder.file(file)));
  CHECK(run_program("man | head -1").err.empty());
}

TEST_CASE("of two commands with one new folder one is done, and the other one is told", "[fast]") {
  const TemporaryFolder folder;
  const std::string command = "run skim --tire a50 --quiet --out out";
  const auto run = run_program(command + " 2> first & '" ROLLRIG_PROGRAM "' " + command +
                                   " 2> second; echo $? > status; wait $!; echo $? >> status",
                               folder.path());
  std::istringstream statuses(read_file(folder.file("status")));
  int second = -1;
  int first = -1;
  statuses >> second >> first;
  CHECK(first + second == 2);
  CHECK(first * second == 0);
  CHECK_THAT(read_file(folder.file(first == 2 ? "first" : "second")), Contains("folder 'out' holds files"));
  CHECK(fs::exists(folder.file("out/manifest.json")));
}

TEST_CASE("every command that is stopped ends with 130 and leaves nothing", "[slow]") {
  const TemporaryFolder inputs;
  write_file(inputs.file("recording.csv"), make_long_recording());
  write_file(inputs.file("torque.csv"), make_long_recording());
  for (const char* signal : {"INT", "TERM"}) {
    for (const std::string& command :
         {std::string("export recording.csv --mat out.mat --hdf5 out.h5"),
          std::string("import --guess . --tire a50 --rig drum_2m --out out"),
          std::string("validate recording.csv torque.csv"),
          std::string("run follow_drum --tire a50 --set program=recording.csv --out out")}) {
      // once it says what it reads, it listens to signals
      write_file(inputs.file("log"), "");
      const std::size_t before = inputs.entry_count();
      const auto run =
          run_program(command + " --log debug > said 2> log & until grep -q 'reads ' log; do sleep 0.01; done; " +
                          "rm said; kill -s " + signal + " $!; wait $!",
                      inputs.path());
      const std::string log = read_file(inputs.file("log"));
      INFO(command << "\n" << log);
      CHECK(run.status == 130);
      CHECK_THAT(log, Contains("nothing was written"));
      CHECK(inputs.entry_count() == before);
    }
  }
}

TEST_CASE("coastdowns of one heading after those of the other tell no drift in time", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("apart.csv"), make_headings_apart());
  const auto run = run_program("fit road-load apart.csv --mass 2203 --json fit.json", folder.path());
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, !Contains("nan"));
  const Json fit = Json::parse(read_file(folder.file("fit.json")));
  CHECK(fit["session_drift"].empty());
  CHECK(fit["A_N"].is_number());
}

TEST_CASE("an output without a name is refused, in every command", "[slow]") {
  const TemporaryFolder folder;
  for (const char* command :
       {"run skim --tire a50 --out", "run skim --tire a50 --json", "run skim --tire a50 --html",
        "run skim --tire a50 --write-set", "sweep skim --tire a50 --vary load_N=4000 --out", "regress --json",
        "fit road-load x.csv --out", "import x.toml --out", "export x.csv --mat", "export x.csv --hdf5",
        "new rig --diameter 1.7 --out", "plan --out", "diagnose x --plan", "diagnose x --loop", "list --json",
        "convert --force 32 --from-drum 2 --to-drum 1 --tire a50 --json", "align x.csv --out"}) {
    const auto run = run_program(command + std::string(" ''"), folder.path());
    INFO(command << "\n" << run.out << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("is empty") && Contains("key      --"));
    CHECK(run.out.empty());
    CHECK(run_program(command + std::string("=''"), folder.path()).status == 2);
  }
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("an output may have any name that is UTF-8", "[fast]") {
  const TemporaryFolder folder;
  const auto refused = run_program("run skim --tire a50 --out 'caf\xE9'", folder.path());
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("not UTF-8"));
  CHECK(folder.entry_count() == 0);
  for (const char* name : {"with space",
                           "gr\xC3\xB6\xC3\x9F"
                           "e",
                           "<script>", "a%s{}"}) {
    const auto run = run_program(
        std::string("run skim --tire a50 --out '") + name + "' --json '" + name + ".json' --html '" + name + ".html'",
        folder.path());
    INFO(name << "\n" << run.err);
    CHECK(run.status == 0);
    CHECK(fs::exists(folder.file(std::string(name) + "/manifest.json")));
    CHECK(fs::exists(folder.file(std::string(name) + ".html")));
  }
}

TEST_CASE("regress says of every run that is not the same why, also where it prints no table", "[fast]") {
  const std::string source = ROLLRIG_SOURCE_DIR "/assets/regression/skim_a40";
  const std::string run_file = read_file(source + ".toml");
  const std::string golden = read_file(source + ".golden.csv");
  const TemporaryFolder folder;
  const auto add = [&folder](const std::string& name, const std::string& toml, const std::string& csv) {
    if (!toml.empty()) write_file(folder.file(name + ".toml"), toml);
    write_file(folder.file(name + ".golden.csv"), csv);
  };
  add("empty_golden", run_file, "");
  add("json_golden", run_file, "{\"x\": ");
  add("no_run_file", "", golden);
  std::string no_tire = run_file;
  const std::size_t at = no_tire.find("tire = ");
  no_tire.erase(at, no_tire.find('\n', at) - at);
  add("no_tire", no_tire, golden);
  for (const char* output : {"--quiet", "--json -", ""}) {
    const auto run = run_program(std::string("regress . ") + output, folder.path());
    const std::string said = flatten(*output == '\0' ? run.out : run.err);
    INFO(said);
    CHECK(run.status == 2);
    for (const char* name : {"empty_golden.golden.csv", "json_golden.golden.csv", "no_run_file.toml", "no_tire.toml"}) {
      CHECK_THAT(said, Contains(name));
    }
    CHECK_THAT(said, Contains("missing key 'tire'"));
  }
  fs::remove(folder.file("no_run_file.golden.csv"));
  write_file(folder.file("no_tire.toml"), run_file);
  const auto updated = run_program("regress . --update --quiet", folder.path());
  CHECK(updated.status == 0);
  CHECK(updated.err.empty());
}

TEST_CASE("a tolerance of zero compares equal numbers as equal", "[fast]") {
  const TemporaryFolder folder;
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/regression/skim_a40.toml", folder.file("skim.toml"));
  REQUIRE(run_program("regress . --update --quiet", folder.path()).status == 0);
  std::istringstream rows(read_file(folder.file("skim.golden.csv")));
  std::string exact;
  for (std::string row; std::getline(rows, row);) {
    exact += exact.empty() ? row + "\n" : row.substr(0, row.rfind(',', row.rfind(',') - 1)) + ",0,0\n";
  }
  write_file(folder.file("skim.golden.csv"), exact);
  const auto run = run_program("regress . --json found.json --html page.html", folder.path());
  INFO(run.out << run.err);
  CHECK(run.status <= 1);  // ten digits of the file are not all of the number
  CHECK_THAT(run.out, !Contains("nan"));
  CHECK_THAT(read_file(folder.file("found.json")), !Contains("nan"));
}

#ifndef ROLLRIG_SANITIZED  // which open files themselves
TEST_CASE("a mistake of the program ends with 70 and says what to report", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("recording.csv"), "time_s,speed_km_h\n0,80\n1,80\n");
  // so few files may be open that the library of .mat files gives up
  const auto run =
      run_program("export recording.csv --mat 'my file.mat'", folder.path(), "exec 3>&- 4>&- 5>&- 6>&-; ulimit -n 4;");
  INFO(run.out << run.err);
  CHECK(run.status == 70);
  CHECK_THAT(run.err, Contains("internal error: ") && Contains("version  rollrig 0.") &&
                          Contains("command  rollrig export recording.csv --mat 'my file.mat'") && Contains("report"));
  CHECK(folder.entry_count() == 1);
}
#endif

TEST_CASE("the launcher says what to do in a clone that may not be written to", "[fast]") {
  const TemporaryFolder clone;
  fs::create_directory(clone.file("tools"));
  for (const char* file : {"rollrig", "tools/progress.sh", "tools/install_packages.sh"}) {
    fs::copy(std::string(ROLLRIG_SOURCE_DIR "/") + file, clone.file(file));
  }
  write_file(clone.file("tools/packages.txt"), "");
  const auto all = fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec;
  fs::permissions(clone.path(), all);
  const std::string other = ::geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups" : "";
  const auto run = rollrig::tests::run_other(clone.file("rollrig").c_str(), "--version", "/tmp", other);
  INFO(run.out << run.err);
  CHECK(run.status == 2);
  CHECK_THAT(flatten(run.err), Contains("may not write") && Contains(clone.path()) && Contains("git clone"));
  // what another user has built runs
  fs::permissions(clone.path(), fs::perms::all);
  fs::create_directories(clone.file("build/user/bin"));
  write_file(clone.file("build/user/bin/rollrig"), "#!/bin/sh\necho built \"$@\"\n");
  fs::permissions(clone.file("build/user/bin/rollrig"), all);
  fs::permissions(clone.path(), all);
  const auto built = rollrig::tests::run_other(clone.file("rollrig").c_str(), "--version", "/tmp", other);
  CHECK(built.status == 0);
  CHECK(built.out == "built --version\n");
  fs::permissions(clone.path(), fs::perms::all);
}
