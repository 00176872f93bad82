// rollrig diagnose --loop as a test engineer meets it; the rig is a simulation with the effect on.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::flatten;
using rollrig::tests::ProgramResult;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

constexpr const char* kCompared = " --only windage,torque_gain,load_exponent";

/// A set with a drag on the wheel that is too small to be certain of, and the loop on it.
class LoopFolder {
 public:
  LoopFolder() {
    run("run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80]' --set warm_up_min=30 --set settle_min=0 "
        "--seed 5 --write-set set --quiet --set " +
        effect_);
  }

  ProgramResult run(const std::string& arguments, int status = 0) const {
    ProgramResult result = run_program(arguments, folder_.path());
    INFO(arguments << "\n" << result.out << result.err);
    REQUIRE(result.status == status);
    return result;
  }
  ProgramResult go_on(const std::string& options = "", int status = 0) const {
    return run("diagnose set --loop loop --quiet" + options, status);
  }
  json ledger() const { return json::parse(read_file(file("loop/loop.json"))); }
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Does the planned test: each of its runs simulated with the effect on, its file put where the plan says.
  void measure(std::size_t number) const {
    const std::string test = "loop/test-" + std::to_string(number);
    const json planned = ledger()["tests"][number - 1];
    for (std::size_t i = 1; i <= planned["runs"].size(); ++i) {
      const std::string made = "made-" + std::to_string(number) + "-" + std::to_string(i);
      run("run " + test + "/run-" + std::to_string(i) + ".toml --write-set " + made + " --force --quiet --set " +
          effect_ + " --seed " + std::to_string(10 * number + i));
      for (const auto& entry : fs::directory_iterator(file(made))) {
        if (entry.path().extension() != ".csv") continue;
        const std::string id = planned["runs"][i - 1];
        fs::copy_file(entry.path(), file(test + "/" + id + "_measured.csv"));
      }
    }
  }

 private:
  TemporaryFolder folder_;
  std::string effect_ = "effects.windage.force_N=0.8";
};

}  // namespace

TEST_CASE("a loop plans a test, waits for it, takes it in, and ends when the cause is named", "[slow]") {
  const LoopFolder loop;
  loop.go_on(kCompared);
  json ledger = loop.ledger();
  CHECK(ledger["format"] == "rollrig-loop/1");
  CHECK(ledger["hours"] == 8.0);
  loop.go_on(" --hours 9");  // while it waits
  CHECK(loop.ledger()["hours"] == 9.0);
  loop.go_on(" --hours 8");
  REQUIRE(ledger["state"] == "waiting");
  std::size_t done = 0;
  while (ledger["state"] == "waiting") {
    REQUIRE(done < 12);
    const std::string before = read_file(loop.file("loop/loop.json"));
    const ProgramResult waiting = loop.run("diagnose set --loop loop");
    CHECK_THAT(flatten(waiting.out), Contains("Waiting for loop/test-" + std::to_string(done + 1)));
    CHECK(read_file(loop.file("loop/loop.json")) == before);
    ++done;
    loop.measure(done);
    loop.go_on();
    ledger = loop.ledger();
    CHECK(ledger["answers"].size() == done + 1);
    CHECK(ledger["tests"][done - 1]["state"] == "measured");
    CHECK(ledger["hours_used"].get<double>() <= 8.0);
  }
  REQUIRE(ledger["state"] == "named");
  const json& last = ledger["answers"].back();
  CHECK(last["effects"] == json::array({"windage"}));
  CHECK(last["probability"].get<double>() >= 0.95);
  const std::string ended = read_file(loop.file("loop/loop.json"));
  loop.go_on();
  CHECK(read_file(loop.file("loop/loop.json")) == ended);
}

TEST_CASE("a failed test of a loop costs its hours, and the hours end the loop", "[slow]") {
  const LoopFolder loop;
  loop.go_on(std::string(kCompared) + " --hours 3");
  const double hours = loop.ledger()["tests"][0]["hours"];
  CHECK(hours <= 3.0);
  json ledger = loop.ledger();
  for (int i = 0; i < 6 && ledger["state"] == "waiting"; ++i) {
    loop.go_on(" --test-failed");
    ledger = loop.ledger();
    CHECK(ledger["tests"][static_cast<std::size_t>(i)]["state"] == "failed");
  }
  CHECK(ledger["state"] != "waiting");
  CHECK(ledger["hours_used"].get<double>() <= 3.0);
  CHECK(ledger["hours_used"].get<double>() >= hours);
  const ProgramResult none = loop.run("diagnose set --loop loop --test-failed", 2);
  CHECK_THAT(flatten(none.err), Contains("no test is planned that could have failed"));
}

TEST_CASE("a loop refuses another set, other effects, hours out of range and a file of its own that is wrong",
          "[slow]") {
  const LoopFolder loop;
  CHECK_THAT(flatten(loop.go_on(" --hours 0", 2).err), Contains("0.5 to 1000"));
  CHECK_FALSE(fs::exists(loop.file("loop")));
  CHECK_THAT(flatten(loop.run("diagnose set --loop set", 2).err), Contains("the folder holds files and no loop"));
  loop.go_on(kCompared);
  CHECK_THAT(flatten(loop.go_on(" --only slow_leak", 2).err), Contains("compares other effects"));
  const std::string test = loop.file("loop/test-1/");
  const json ledger = loop.ledger();
  for (const json& run : ledger["tests"][0]["runs"]) {
    write_file(test + run.get<std::string>() + "_measured.csv", "time_s,speed_km_h\n0,80\n");
  }
  const std::string before = read_file(loop.file("loop/loop.json"));
  CHECK_THAT(flatten(loop.go_on("", 2).err), Contains("_measured.csv"));
  CHECK(read_file(loop.file("loop/loop.json")) == before);
  for (const auto& entry : fs::directory_iterator(loop.file("set"))) {  // a copy of what is known
    if (entry.path().extension() != ".csv") continue;
    for (const json& run : ledger["tests"][0]["runs"]) {
      write_file(test + run.get<std::string>() + "_measured.csv", read_file(entry.path().string()));
    }
  }
  CHECK_THAT(flatten(loop.go_on("", 2).err), Contains("the samples are those of the run"));
  CHECK(read_file(loop.file("loop/loop.json")) == before);
  fs::rename(loop.file("loop/test-1"), loop.file("elsewhere"));
  CHECK_THAT(flatten(loop.go_on("", 2).err), Contains("the folder of the planned test is gone"));
  const std::string tire = read_file(loop.file("set/tire.toml"));
  write_file(loop.file("set/tire.toml"), tire + "\n# corrected\n");
  CHECK_THAT(flatten(loop.go_on("", 2).err), Contains("the loop began with other files"));
  write_file(loop.file("set/tire.toml"), tire);
  write_file(loop.file("set/set.toml"), read_file(loop.file("set/set.toml")) + "\n# corrected\n");
  CHECK_THAT(flatten(loop.go_on("", 2).err), Contains("the loop began with other files"));
  CHECK_THAT(flatten(loop.run("diagnose set --hours 3", 2).err), Contains("--loop"));
}
