// rollrig diagnose as users and CI jobs meet it. What it finds is tested in tests/diagnosis.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::read_file;
using rollrig::tests::run_other;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

/// A folder with a small set of two runs, "set"; `effects` as of --set.
struct SetFolder {
  TemporaryFolder folder;
  explicit SetFolder(const std::string& effects = "") {
    const auto made = run_program(
        "run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80,120]' --set "
        "warm_up_min=10 --set settle_min=0 --write-set set --quiet " +
            effects,
        folder.path());
    INFO(made.err);
    REQUIRE(made.status == 0);
  }
};

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Divides the second column, the speed, of a run's file.
void divide_speeds(const std::string& file, double by) {
  std::istringstream in(read_file(file));
  std::string out;
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(',') + 1;
    const std::size_t last = line.find(',', first);
    const std::string field = line.substr(first, last - first);
    if (field != "speed_km_h") line.replace(first, last - first, std::to_string(std::stod(field) / by));
    out += line + "\n";
  }
  write_file(file, out);
}

}  // namespace

TEST_CASE("a diagnosis prints ten lines and writes the JSON of the contract", "[slow]") {
  const SetFolder made;
  const auto run = run_program("diagnose set --only bearing_warmup,load_exponent --json why.json", made.folder.path());
  INFO(run.out << run.err);
  REQUIRE(run.status == 0);
  CHECK(count_lines(run.out) >= 10);
  std::istringstream in(run.out);
  for (std::string line; std::getline(in, line);) CHECK(line.size() <= 80);
  for (const char* label :
       {"Verdict", "Cause", "Where", "Equation", "Gap", "Shrinks by", "Not excluded", "Next test"}) {
    CHECK_THAT(run.out, Contains(label));
  }
  const json result = json::parse(read_file(made.folder.file("why.json")));
  CHECK(result["format"] == "rollrig-diagnosis/1");
  CHECK(result["set"].is_string());
  for (const char* name : {"none", "unknown", "bearing_warmup", "load_exponent"}) {
    INFO(name);
    CHECK(result["probability"][name].is_number());
  }
  CHECK(result["probability"].size() == 4);  // --only
}

TEST_CASE("with --json - nothing but JSON, with --quiet nothing at all", "[slow]") {
  const SetFolder made;
  const auto to_stdout = run_program("diagnose set/set.toml --only bearing_warmup --json -", made.folder.path());
  INFO(to_stdout.err);
  CHECK(to_stdout.status == 0);
  CHECK(json::parse(to_stdout.out)["format"] == "rollrig-diagnosis/1");
  CHECK(to_stdout.err.empty());
  const auto quiet = run_program("diagnose set --only bearing_warmup --quiet", made.folder.path());
  CHECK(quiet.status == 0);
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
}

TEST_CASE("the same JSON from one or two threads, and from runs in another order", "[slow]") {
  const SetFolder made("--set effects.bearing_warmup.fall_per_K=0.02");
  const std::string options = " --only bearing_warmup,tire_loss_in_skim --quiet --json ";
  REQUIRE(run_program("diagnose set --threads 1" + options + "one.json", made.folder.path()).status == 0);
  REQUIRE(run_program("diagnose set --threads 2" + options + "two.json", made.folder.path()).status == 0);
  const std::string one = read_file(made.folder.file("one.json"));
  CHECK(one == read_file(made.folder.file("two.json")));
  std::string set = read_file(made.folder.file("set/set.toml"));
  const std::size_t first = set.find("[[run]]");
  const std::size_t second = set.find("[[run]]", first + 1);
  write_file(made.folder.file("set/set.toml"),
             set.substr(0, first) + set.substr(second) + "\n" + set.substr(first, second - first));
  REQUIRE(run_program("diagnose set" + options + "other.json", made.folder.path()).status == 0);
  CHECK(one == read_file(made.folder.file("other.json")));
}

TEST_CASE("a speed in m/s under a km/h heading comes out as unexplained, with the mistake named", "[slow]") {
  const SetFolder made;
  for (const char* run : {"set/speed-80.csv", "set/speed-120.csv"}) divide_speeds(made.folder.file(run), 3.6);
  const auto run = run_program("diagnose set --json -", made.folder.path());
  INFO(run.out << run.err);
  REQUIRE(run.status == 0);
  const json result = json::parse(run.out);
  CHECK(result["verdict"] == "unexplained");
  CHECK(result["causes"].empty());
  CHECK_THAT(result["warnings"].dump(), Contains("speed_km_h holds m/s"));
}

TEST_CASE("of a folder of sets all are validated and diagnosed, whatever one of them is like", "[slow]") {
  const SetFolder made;
  const std::string sets = made.folder.path() + "/sets";
  fs::create_directory(sets);
  for (const char* name : {"good", "mistyped", "in_m_s"}) fs::copy(made.folder.path() + "/set", sets + "/" + name);
  for (const auto& entry : fs::directory_iterator(sets + "/in_m_s")) {
    if (entry.path().extension() == ".csv") divide_speeds(entry.path().string(), 3.6);
  }
  fs::create_directory(sets + "/forgotten");
  fs::copy(sets + "/good/speed-80.csv", sets + "/forgotten");
  std::string text = read_file(sets + "/mistyped/set.toml");
  text.replace(text.find("session"), 7, "sesion");
  write_file(sets + "/mistyped/set.toml", text);
  const auto valid = run_program("validate sets", made.folder.path());
  CHECK(valid.status == 2);
  CHECK_THAT(valid.out, Contains("sets/good: good") && Contains("sets/in_m_s: doubtful"));
  CHECK_THAT(valid.err, Contains("missing key 'session'") && Contains("sets/mistyped/set.toml"));
  const auto run = run_program("diagnose sets --only bearing_warmup --json all.json", made.folder.path());
  INFO(run.out << run.err);
  CHECK(run.status == 2);  // as of that set alone
  CHECK_THAT(run.err, Contains("left out") && Contains("sets/forgotten"));
  CHECK_THAT(run.out, Contains("mistyped  failed") && Contains("mistyped: missing key 'session'"));
  CHECK_THAT(run.out, Contains("in doubt") && Contains("Files in doubt, so no cause is named\n  in_m_s: "));
  const auto quiet = run_program("diagnose sets --only bearing_warmup --quiet", made.folder.path());
  CHECK(quiet.out.empty());
  CHECK_THAT(quiet.err, Contains("sets/mistyped: missing key 'session'"));
  const json all = json::parse(read_file(made.folder.path() + "/all.json"));
  CHECK(all["sets"][0]["diagnosis"]["verdict"] == "no_gap");
  CHECK(all["sets"][2]["diagnosis"].is_null());
}

TEST_CASE("an interrupted diagnosis writes nothing", "[slow]") {
  const SetFolder made;
  const auto run = run_program("diagnose set --threads 1 --json why.json", made.folder.path(),
                               "timeout --foreground -s INT --preserve-status 0.5");
  INFO(run.out << run.err);
  CHECK(run.status == 130);
  CHECK_THAT(run.err, Contains("nothing was written"));
  CHECK_FALSE(fs::exists(made.folder.file("why.json")));
}

TEST_CASE("effects are explained", "[fast]") {
  const auto run = run_program("diagnose --explain bearing_warmup");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("Equation") && Contains("fall_per_K") && Contains("1/K") && Contains("drum_torque_Nm") &&
                          Contains("tire_loss_in_skim") && Contains("torque at standstill"));
  CHECK(run_program("diagnose --explain unknown").status == 0);
  CHECK_THAT(run_program("diagnose --explain nope").err, !Contains("nearest  none"));  // near to any short word
}

#ifdef ROLLRIG_EXAMPLE_DIAGNOSE
TEST_CASE("the example program diagnoses through the library", "[slow]") {
  const SetFolder made;
  const auto run = run_other(ROLLRIG_EXAMPLE_DIAGNOSE, "set", made.folder.path());
  INFO(run.out << run.err);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("Verdict"));
  const auto missing = run_other(ROLLRIG_EXAMPLE_DIAGNOSE, "nowhere", made.folder.path());
  CHECK(missing.status == 2);
  CHECK_THAT(missing.err, Contains("error:"));
}
#endif

TEST_CASE("a plan is run from anywhere, and what it writes is diagnosed", "[slow]") {
  const SetFolder made("--set effects.bearing_warmup.fall_per_K=0.02");
  const std::string compared = " --only bearing_warmup,torque_zero_drift";
  const auto planned = run_program("diagnose set --plan next" + compared, made.folder.path());
  INFO(planned.out << planned.err);
  REQUIRE(planned.status == 0);
  CHECK_THAT(planned.out, Contains("plan.txt"));
  const std::string next = made.folder.file("next");
  for (const char* name : {"plan.txt", "run-1.toml", "tire.toml", "rig.toml"}) CHECK(fs::exists(next + "/" + name));
  const TemporaryFolder elsewhere;
  const auto run =
      run_program("run " + next + "/run-1.toml --fidelity quasi_static --write-set paper --quiet", elsewhere.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto diagnosed = run_program("diagnose paper --json why.json --quiet" + compared, elsewhere.path());
  INFO(diagnosed.err);
  REQUIRE(diagnosed.status == 0);
  CHECK(json::parse(read_file(elsewhere.file("why.json")))["verdict"] == "no_gap");  // nothing was switched on
  const auto again = run_program("diagnose set --plan next" + compared, made.folder.path());
  CHECK(again.status == 2);  // the folder holds the first plan
  CHECK_THAT(again.err, Contains("--force"));
}

TEST_CASE("a plan for a wheel or a vehicle is run, and what it writes is diagnosed", "[slow]") {
  for (const bool is_road : {false, true}) {
    const std::string scenario = is_road ? "follow_road" : "follow_roller";
    INFO(scenario);
    const TemporaryFolder folder;
    write_file(folder.file("run.toml"),
               "format = \"rollrig-run/1\"\nscenario = \"" + scenario + "\"\ntire = \"a50\"\n[settings]\nprogram = \"" +
                   ROLLRIG_SOURCE_DIR + "/assets/regression/" + scenario + "_a50.csv\"\n[sensors." +
                   (is_road ? "traction_force_N" : "loss_force_N") +
                   (is_road ? "]\noffset_sd = 10.0\ndrift_sd = 20.0\ndrift_time_s = 13.0\nnoise_sd = 14.0\n"
                            : "]\noffset_sd = 2.0\ndrift_sd = 1.0\ndrift_time_s = 60.0\nnoise_sd = 2.0\n") +
                   "resolution = 0.0\n");
    const std::string compared = " --quiet --only toe_camber_drag,torque_gain";
    for (const std::string& command :
         {std::string("run run.toml --write-set set --quiet --set effects.toe_camber_drag.force_N=10"),
          "diagnose set --plan next" + compared, std::string("validate next/run-1.toml"),
          std::string("run next/run-1.toml --write-set paper --quiet"), std::string("validate paper"),
          "diagnose paper --json why.json" + compared}) {
      const auto done = run_program(command, folder.path());
      INFO(command << "\n" << done.err);
      REQUIRE(done.status == 0);
    }
    CHECK(fs::exists(folder.file(is_road ? "next/vehicle.toml" : "next/rig.toml")));
    CHECK(json::parse(read_file(folder.file("why.json")))["verdict"] == "no_gap");  // nothing was switched on
  }
}

TEST_CASE("a tiny set, with rows a nanosecond or a year apart, has an answer or a reason why it has none", "[slow]") {
  const TemporaryFolder folder;
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/examples/hidden_effect", folder.file("set"), fs::copy_options::recursive);
  std::string set = read_file(folder.file("set/set.toml"));
  set.erase(set.find("[[run]]", set.find("[[run]]") + 1));
  write_file(folder.file("set/set.toml"), set);
  std::istringstream rows(read_file(folder.file("set/1-warm-up-120.csv")));
  std::vector<std::string> lines;
  for (std::string line; std::getline(rows, line);) lines.push_back(line);
  for (const double step_s : {1e-9, 1.0, 3e7}) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{5}}) {
      INFO(step_s << " s, " << count << " rows");
      std::string csv = lines[0] + "\n";
      for (std::size_t row = 0; row < count; ++row) {
        const std::string& line = lines[61 + row];
        csv += fmt::format("{}{}\n", step_s * static_cast<double>(row), line.substr(line.find(',')));
      }
      write_file(folder.file("set/1-warm-up-120.csv"), csv);
      const auto found = run_program("diagnose set --only bearing_warmup,load_exponent --json why.json", folder.path());
      INFO(found.out << found.err);
      CHECK((found.status == 0 || found.status == 2 || found.status == 3));
      CHECK_THAT(found.out + found.err, !Contains("nan") && !Contains("internal error"));
      if (found.status == 0) CHECK(json::parse(read_file(folder.file("why.json")))["probability"]["none"].is_number());
    }
  }
}
