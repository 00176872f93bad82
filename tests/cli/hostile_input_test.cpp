// Input that no person writes: too deep, too long, too large, or under a name that leads nowhere. Each is answered with
// an error of the input, and the program neither crashes nor waits.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using namespace rollrig;
using tests::flatten;
using tests::run_program;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

/// Checks that a run of the program is an error of the input that has these words.
void check_refused(const tests::ProgramResult& run, const std::string& words) {
  INFO(run.err.substr(0, 2000));
  CHECK(run.status == 2);
  CHECK(flatten(run.err).find(words) != std::string::npos);
  CHECK(run.err.find("internal error") == std::string::npos);
  CHECK(run.err.size() < 5000);
}

std::string nested(std::size_t levels) {
  std::string text;
  for (std::size_t i = 0; i < levels; ++i) text += "{\"a\":";
  return text + "1" + std::string(levels, '}');
}

constexpr const char* kMapping = R"(format = "rollrig-import/1"
name = "logs"
tire = "a50"
rig = "drum_2m"
sensors = "source"
[torque_log]
HEADER
time = { column = "t", form = "iso_8601" }
[torque_log.columns]
speed_km_h = { column = "v", unit = "km/h" }
load_N = { column = "F", unit = "N" }
ambient_degC = { column = "T", unit = "degC" }
drum_torque_Nm = { column = "M", unit = "N m" }
[[run]]
id = "one"
session = "day"
torque_log = "log.csv"
initial_tire_temperature_degC = 25.0
cold_pressure_kPa = 280.0
)";

/// A folder with a mapping and its log.
struct Logs {
  TemporaryFolder folder;

  Logs(const std::string& log, const std::string& header = "") {
    std::string mapping = kMapping;
    mapping.replace(mapping.find("HEADER"), 6, header);
    write_file(folder.file("import.toml"), mapping);
    write_file(folder.file("log.csv"), log);
  }
  tests::ProgramResult import() const { return run_program("import import.toml --out set", folder.path()); }
};

}  // namespace

TEST_CASE("a time stamp of 50 kB is refused", "[fast]") {
  for (const char c : {'1', ' ', ':', 'T'}) {
    const Logs logs("t,v,F,T,M\n2024-03-05T12:00:00" + std::string(50000, c) +
                    "9,80,5000,25,10\n2024-03-05T12:00:01Z,80,5000,25,10\n");
    check_refused(logs.import(), "a time stamp is not understood");
  }
}

TEST_CASE("a header line behind the end of a log is refused", "[fast]") {
  const Logs logs("t,v,F,T,M\n2024-03-05T12:00:00Z,80,5000,25,10", "header_line = 9");
  check_refused(logs.import(), "the file ends before its header");
}

TEST_CASE("TOML and JSON that are nested too deeply are refused", "[fast]") {
  const TemporaryFolder folder;
  std::string key = "a";
  for (int i = 0; i < 10000; ++i) key += ".a";
  write_file(folder.file("keys.toml"), key + " = 1\n");
  check_refused(run_program("run keys.toml", folder.path()), "a key with too many parts");
  check_refused(run_program("run iso_28580 --tire a50 --set " + key + "=1", folder.path()), "too many parts");
  fs::create_directory(folder.file("result"));
  for (const std::size_t levels : {100U, 800U, 20000U, 200000U}) {
    write_file(folder.file("result/result.json"), nested(levels));
    for (const char* format : {"--mat x.mat", "--hdf5 x.h5"}) {
      check_refused(run_program(std::string("export result ") + format, folder.path()), "nested too deeply");
    }
  }
  write_file(folder.file("result/result.json"), "{\"format\": \"rollrig-result/1\",\n\"a\": 1e999}");
  check_refused(run_program("export result --mat x.mat", folder.path()), "a number that is too large");
  CHECK_FALSE(fs::exists(folder.file("x.mat")));
}

TEST_CASE("the ledger of a loop that is nested too deeply is refused", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("loop"));
  write_file(folder.file("loop/loop.json"), nested(200000));
  const std::string set = ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect";
  check_refused(run_program("diagnose '" + set + "' --loop loop --hours 8", folder.path()), "nested too deeply");
}

TEST_CASE("names that lead nowhere are errors of the input", "[slow]") {
  const TemporaryFolder folder;
  const std::string long_name(300, 'n');
  fs::create_symlink("loop", folder.file("loop"));
  fs::create_symlink("loop.toml", folder.file("loop.toml"));
  check_refused(run_program("run iso_28580 --tire " + long_name, folder.path()), "unknown tire");
  check_refused(run_program("describe " + long_name, folder.path()), "");
  for (const char* command :
       {"run iso_28580 --tire ./", "run ./", "fit road-load ./", "validate ./", "diagnose ./", "fit tire ./",
        "import --guess ./", "export --mat x.mat ./", "compare a50 ./", "regress ./"}) {
    const bool is_import = std::string(command).find("import") == 0;
    const std::string rest = is_import ? " --tire a50 --rig drum_2m --out set" : "";
    INFO(command);
    check_refused(run_program(command + long_name + ".toml" + rest, folder.path()), "File name too long");
    check_refused(run_program(command + std::string("loop.toml") + rest, folder.path()), "symbolic links");
  }
}

TEST_CASE("names that are not UTF-8 are errors of the input", "[fast]") {
  const TemporaryFolder folder;
  const std::string latin1 = "caf\xE9";
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml", folder.file(latin1 + ".toml"));
  check_refused(run_program("run iso_28580 --json - --tire ./" + latin1 + ".toml", folder.path()), "not UTF-8");
  fs::create_directory(folder.file(latin1));
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml", folder.file(latin1 + "/a50.toml"));
  check_refused(run_program("run iso_28580 --json - --tire ./a50.toml", folder.file(latin1)), "not UTF-8");
  check_refused(run_program("run iso_28580 --tire a50 --set tire.name=" + latin1 + " --json -", folder.path()),
                "not UTF-8");
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/examples/own_logs", folder.file("logs"));
  fs::copy(folder.file(latin1 + ".toml"), folder.file("logs/" + latin1 + ".csv"));
  check_refused(run_program("import --guess logs --tire a50 --rig drum_2m --out set", folder.path()), "not UTF-8");
}

TEST_CASE("a working folder that is gone is an error of the input", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("gone"));
  const std::string gone = folder.file("gone");
  check_refused(run_program("run iso_28580 --tire ./x.toml --out out", gone, "rmdir '" + gone + "';"),
                "No such file or directory");
}

TEST_CASE("a pipe is refused, and nobody waits for it", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(::mkfifo(folder.file("pipe.toml").c_str(), 0600) == 0);
  REQUIRE(::mkfifo(folder.file("pipe.csv").c_str(), 0600) == 0);
  for (const char* command : {"run pipe.toml", "run iso_28580 --tire ./pipe.toml", "validate pipe.toml",
                              "import pipe.toml --out x", "fit road-load pipe.csv"}) {
    INFO(command);
    check_refused(run_program(command, folder.path(), "timeout -k 1 20"), "is a pipe, not a file");
  }
  const Logs logs("");
  fs::remove(logs.folder.file("log.csv"));
  REQUIRE(::mkfifo(logs.folder.file("log.csv").c_str(), 0600) == 0);
  check_refused(run_program("import import.toml --out set", logs.folder.path(), "timeout -k 1 20"),
                "is a pipe, not a file");
}

TEST_CASE("a sweep of more points than memory holds is refused", "[fast]") {
  check_refused(run_program("sweep iso_28580 --tire a50 --vary pressure_kPa=200:300:0.01 --vary load_N=1:10001:1"),
                "too many points in a sweep");
}

TEST_CASE("a wrong ROLLRIG_ASSETS is named", "[fast]") {
  for (const char* folder : {"/nowhere", "/tmp"}) {
    const auto run = run_program("run iso_28580 --tire a50", "/tmp", std::string("env ROLLRIG_ASSETS=") + folder);
    check_refused(run, std::string("the folder '") + folder + "' of the variable ROLLRIG_ASSETS has no tires");
    check_refused(run_program("list", "/tmp", std::string("env ROLLRIG_ASSETS=") + folder),
                  std::string("there are no assets in '") + folder + "'");
  }
}

TEST_CASE("an empty name of a folder does not stand for the folder of all regression runs", "[fast]") {
  check_refused(run_program("regress ''", "/tmp"), "the name of a folder is empty");
}
