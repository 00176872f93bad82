// The command line as users and CI jobs meet it: runs, sweeps and regressions, their settings and what they write.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "build_paths.h"
#include "sim/core/csv.h"
#include "tests/cli/longest_line.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::CsvTable;
using rollrig::tests::flatten;
using rollrig::tests::longest_line;
using rollrig::tests::read_file;
using rollrig::tests::run_other;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

TEST_CASE("the main job prints a short table and exits with 0", "[fast]") {
  const auto run = run_program("run iso_28580 --tire a50");
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("RRc at 25 degC, 2 m drum") && Contains("5.200") && Contains("N/kN"));
  CHECK(run.err.empty());
  CHECK(longest_line(run.out) <= 80);
}

TEST_CASE("the tables of a multi-cycle test stay within 80 columns", "[fast]") {
  const auto run = run_program("run sae_j1634 --tire a50 --set wheels=1 --fidelity quasi_static");
  INFO(run.out);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("all sections"));
  CHECK(longest_line(run.out) <= 80);
}

TEST_CASE("results land in a folder: JSON of the contract, recording, manifest", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run iso_28580 --tire a50 --out results", folder.path()).status == 0);
  const json result = json::parse(read_file(folder.file("results/result.json")));
  CHECK(result["format"] == "rollrig-result/1");
  CHECK(result["scenario"] == "iso_28580");
  CHECK(result["tire"] == "a50");
  CHECK(result["rig"] == "drum_2m");
  CHECK(result["fidelity"] == "multibody");
  for (const char* key : {"drum_torque_Nm", "parasitic_N", "rolling_resistance_N", "rrc_N_per_kN",
                          "rrc_25degC_2m_N_per_kN", "rrc_uncertainty_N_per_kN", "liner_temperature_degC"}) {
    INFO(key);
    CHECK(result["result"][key].is_number());
  }
  bool warm_up_found = false;
  for (const json& phase : result["phases"]) {
    if (phase["name"] == "warm-up") warm_up_found = phase["start_s"] == 0.0 && phase["end_s"] == 1800.0;
  }
  CHECK(warm_up_found);
  CHECK(result["energy"]["mechanical_closure"].get<double>() < 1e-6);
  CHECK(result["energy"]["thermal_closure"].get<double>() < 1e-6);
  CHECK(result["energy"]["terms_J"]["motor"].get<double>() > 1e6);
  const std::string csv = read_file(folder.file("results/recording.csv"));
  CHECK_THAT(csv, Catch::StartsWith("time_s,phase,speed_km_h,load_N,ambient_degC,drum_torque_Nm,"));
  const json manifest = json::parse(read_file(folder.file("results/manifest.json")));
  CHECK(manifest["tire"]["sha256"].get<std::string>().size() == 64);
  CHECK(manifest["tire"]["rolling_resistance"]["pressure_exponent"] == 0.4);
  CHECK(manifest["settings"]["soak_h"] == 3.0);  // a default, written out
  CHECK(manifest["rig"]["carriage"]["mass_kg"] == 155.0);
}

TEST_CASE("the same inputs give the same files, to the bit", "[fast]") {
  const TemporaryFolder folder;
  for (const char* out : {"one", "two"}) {
    REQUIRE(
        run_program(std::string("run transient_skim --tire a60 --sensors source --seed 5 --out ") + out, folder.path())
            .status == 0);
  }
  for (const char* file : {"result.json", "recording.csv", "manifest.json"}) {
    CHECK(read_file(folder.file(std::string("one/") + file)) == read_file(folder.file(std::string("two/") + file)));
  }
}

TEST_CASE("a folder that holds files is refused without --force, and nothing in it is touched", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("results"));
  write_file(folder.file("results/notes.txt"), "mine");
  const auto refused = run_program("run skim --tire a50 --out results", folder.path());
  CHECK(refused.status == 2);
  CHECK_THAT(refused.err, Contains("holds files") && Contains("--force"));
  CHECK(fs::directory_iterator(folder.file("results")) != fs::directory_iterator{});
  CHECK_FALSE(fs::exists(folder.file("results/result.json")));
  CHECK(run_program("run skim --tire a50 --out results --force", folder.path()).status == 0);
  CHECK(read_file(folder.file("results/notes.txt")) == "mine");
  CHECK(fs::exists(folder.file("results/result.json")));
}

TEST_CASE("no file that a command reads is written over, and then nothing is written", "[fast]") {
  const TemporaryFolder folder;
  const std::string source = ROLLRIG_SOURCE_DIR;
  fs::copy(source + "/tests/bad_input/coastdown_good.csv", folder.file("coast.csv"));
  fs::copy(source + "/assets/tires/a50.toml", folder.file("mine.toml"));
  fs::copy(source + "/assets/regression/follow_road_a50.csv", folder.file("drive.csv"));
  fs::create_directory(folder.file("runs"));
  fs::copy(source + "/assets/regression/skim_a40.toml", folder.file("runs/skim_a40.toml"));
  fs::create_symlink("mine.toml", folder.file("link.toml"));
  struct Case {
    std::string arguments, file;
  };
  const std::vector<Case> cases{
      {"fit road-load coast.csv --per-mass --out out --html", "coast.csv"},
      {"run skim --tire ./mine.toml --out out --json", "mine.toml"},
      {"run skim --tire ./mine.toml --out out --html", "link.toml"},
      {"sweep skim --tire ./mine.toml --vary load_N=4000,5000 --out out --json", "mine.toml"},
      {"run drive --tire a50 --fidelity quasi_static --set program=drive.csv --out out --json", "drive.csv"},
      {"regress runs --update --json", "runs/skim_a40.toml"},  // read once the work has begun
      {"convert --force 32 --from-drum 2 --to-drum 1.7 --tire ./mine.toml --json", "mine.toml"},
      {"export drive.csv --mat", "drive.csv"},
  };
  for (const Case& each : cases) {
    const std::string before = read_file(folder.file(each.file));
    const std::size_t entries = folder.entry_count();
    const auto run = run_program(each.arguments + " " + each.file, folder.path());
    INFO(each.arguments << "\n" << run.out << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("is read by this command") && Contains(each.file) && Contains("command line"));
    CHECK(read_file(folder.file(each.file)) == before);
    CHECK(folder.entry_count() == entries);
  }
}

TEST_CASE("a file of an earlier call is replaced", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("skim.json"), "an earlier result");
  REQUIRE(run_program("run skim --tire a50 --quiet --json skim.json", folder.path()).status == 0);
  CHECK(json::parse(read_file(folder.file("skim.json")))["scenario"] == "skim");
}

TEST_CASE("with --json - a run prints JSON and nothing else", "[fast]") {
  const auto run = run_program("run iso_28580 --tire a50 --fidelity quasi_static --json -");
  CHECK(run.status == 0);
  CHECK(json::parse(run.out)["fidelity"] == "quasi_static");
  CHECK(json::parse(run_program("list --json -").out)["scenarios"].size() >= 8);
  const auto quiet = run_program("run skim --tire a50 --quiet");
  CHECK(quiet.out.empty());
}

TEST_CASE("settings, tire and rig values, effects and sensors can be set", "[fast]") {
  const auto rrc = [](const std::string& more) {
    const auto run = run_program("run iso_28580 --tire a50 --fidelity quasi_static --json - " + more);
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out)["result"]["rrc_N_per_kN"].get<double>();
  };
  const double plain = rrc("");
  CHECK(rrc("--set pressure_kPa=300") < plain);
  CHECK(rrc("--set tire.bounded.loss_N=40") > plain);
  CHECK(rrc("--set rig.environment.ambient_degC=20") > plain);
  CHECK(rrc("--set effects.load_exponent.exponent=1.1") > plain);
  CHECK(rrc("--set effects.bearing_warmup.fall_per_K=0.02") == Approx(plain).epsilon(0.02));
  CHECK(rrc("--sensors source --seed 2") != plain);
  CHECK(rrc("--sensors source --seed 357058000000000") != rrc("--sensors source --seed 8223680000000000"));
  CHECK(rrc("--sensors none") == plain);
}

TEST_CASE("a run file runs, its paths relative to itself, options over its own", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("here"));
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/tires/a60.toml", folder.file("here/my.toml"));
  write_file(folder.file("here/run.toml"),
             "format = \"rollrig-run/1\"\nscenario = \"iso_28580\"\ntire = \"./my.toml\"\nfidelity = \"quasi_static\"\n"
             "[settings]\nspeed_km_h = 60\n[override.rig.environment]\nambient_degC = 24.0\n");
  const auto run = run_program("run here/run.toml --json - --set speed_km_h=70", folder.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const json result = json::parse(run.out);
  CHECK(result["tire"] == "a60");
  CHECK(result["result"]["speed_km_h"].get<double>() == Approx(70.0));
  CHECK(run_program("validate here/run.toml", folder.path()).status == 0);
}

TEST_CASE("a sweep tables a grid, the same from one and two threads", "[fast]") {
  const TemporaryFolder folder;
  const std::string sweep = "sweep iso_28580 --tire a50 --vary pressure_kPa=210:310:50 --vary load_N=5000,6000 ";
  const auto one = run_program(sweep + "--threads 1 --out one", folder.path());
  INFO(one.err);
  REQUIRE(one.status == 0);
  REQUIRE(run_program(sweep + "--threads 2 --out two --quiet", folder.path()).status == 0);
  CHECK(read_file(folder.file("one/sweep.csv")) == read_file(folder.file("two/sweep.csv")));
  CHECK(read_file(folder.file("one/sweep.json")) == read_file(folder.file("two/sweep.json")));
  CHECK(json::parse(read_file(folder.file("one/sweep.json")))["points"].size() == 6);
  const json manifests = json::parse(read_file(folder.file("one/manifests.json")))["manifests"];
  REQUIRE(manifests.size() == 6);
  CHECK(manifests[5]["settings"]["load_N"] == Approx(6000.0));
  CHECK(!fs::exists(folder.file("one.unfinished")));
  CHECK(longest_line(one.out) <= 80);
}

TEST_CASE("a sweep that is interrupted goes on where it stopped", "[slow]") {
  const TemporaryFolder folder;
  const std::string sweep =
      "sweep iso_28580 --tire a50 --fidelity quasi_static --vary ambient_degC=20:30:0.02 --threads 1 ";
  REQUIRE(run_program(sweep + "--out whole --quiet", folder.path()).status == 0);
  write_file(folder.file("stop.sh"),  // as soon as the first of the 501 points are kept
             std::string(ROLLRIG_PROGRAM " ") + sweep +
                 "--out out/ & \n"
                 "until [ -s out.unfinished/*.progress ]; do sleep 0.02; done; kill -TERM $!; wait $!\n");
  const auto stopped = run_other("sh", "stop.sh", folder.path());
  CHECK(stopped.status == 130);
  CHECK_THAT(flatten(stopped.err), Catch::Contains("the finished points are saved in out.unfinished"));
  CHECK(!fs::exists(folder.file("out/sweep.csv")));
  const auto other = run_program(sweep + "--set load_N=5000 --out out", folder.path());
  CHECK(other.status == 2);
  CHECK_THAT(flatten(other.err), Catch::Contains("holds the points of another, unfinished sweep"));
  REQUIRE(run_program(sweep + "--out out", folder.path()).status == 0);
  for (const char* file : {"sweep.csv", "sweep.json", "manifests.json"}) {
    CHECK(read_file(folder.file(std::string("out/") + file)) == read_file(folder.file(std::string("whole/") + file)));
  }
  CHECK(!fs::exists(folder.file("out.unfinished")));
}

TEST_CASE("a sweep into the working folder keeps its points beside it", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("here"));
  const std::string sweep = "sweep iso_28580 --tire a50 --fidelity quasi_static --vary load_N=5000,6000 --out ";
  for (const char* out : {". --force", "./ --force", "deeper/."}) {
    const auto run = run_program(sweep + out, folder.file("here"));
    INFO(out << run.err);
    CHECK(run.status == 0);
  }
  CHECK(fs::exists(folder.file("here/sweep.csv")));
  CHECK(fs::exists(folder.file("here/deeper/sweep.csv")));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("what is not of a sweep stays in the folder of its points", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("out.unfinished"));  // empty: as if it were not there
  const std::string sweep = "sweep iso_28580 --tire a50 --fidelity quasi_static --vary load_N=5000,6000 --out out";
  REQUIRE(run_program(sweep + " --json out.unfinished/mine.json", folder.path()).status == 0);
  CHECK(fs::exists(folder.file("out.unfinished/mine.json")));
}

TEST_CASE("a kill while a sweep writes its definition does not stop the next one", "[fast]") {
  const TemporaryFolder folder;
  fs::create_directories(folder.file("out.unfinished"));
  write_file(folder.file("out.unfinished/.sweep_definition.json.partial-0123456789abcdef"), "{");
  const std::string sweep = "sweep iso_28580 --tire a50 --fidelity quasi_static --vary load_N=5000,6000 --out out";
  REQUIRE(run_program(sweep, folder.path()).status == 0);
  CHECK(!fs::exists(folder.file("out.unfinished")));
}

TEST_CASE("a sweep in several processes of one launcher is refused", "[fast]") {
  const TemporaryFolder folder;
  const std::string sweep = "sweep iso_28580 --tire a50 --fidelity quasi_static --vary load_N=5000,6000";
  const auto launched = run_program(sweep, folder.path(), "env OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=4");
  CHECK(launched.status == 2);
  CHECK_THAT(flatten(launched.err), Catch::Contains("4 processes were started") && Catch::Contains("rollrig campaign"));
  const auto task = run_program(sweep, folder.path(),
                                "env SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=7 "
                                "SLURM_ARRAY_TASK_COUNT=3");
  CHECK(task.status == 0);
  CHECK_THAT(flatten(task.err), Catch::Contains("warning: this is a task of a job array"));
}

namespace {

const std::string kCombinedTire = ROLLRIG_SOURCE_DIR "/tests/published/combined_law/a50.toml";

}  // namespace

TEST_CASE("a point of a sweep that fails is named, and the others are written", "[fast]") {
  const TemporaryFolder folder;
  const auto sweep = run_program("sweep warm_up --fidelity quasi_static --tire " + kCombinedTire +
                                     " --set tire.rolling_resistance.A0_N=50 --vary "
                                     "tire.rolling_resistance.A1_N_s_per_m=1,-3,0 --out out",
                                 folder.path());
  INFO(sweep.out << sweep.err);
  CHECK(sweep.status == 3);
  CHECK_THAT(flatten(sweep.out), Catch::Contains("failed: tire.rolling_resistance.A1_N_s_per_m -3: "
                                                 "rolling_resistance_N is -"));
  CHECK_THAT(sweep.err, Catch::Contains("1 of 3 points"));
  const CsvTable csv = CsvTable::read(folder.file("out/sweep.csv"));
  REQUIRE(csv.row_count() == 3);
  const std::vector<std::string> failures = csv.text("failure");
  const std::vector<std::string> loss_N = csv.text("rolling_resistance_N");
  CHECK(failures[0].empty());
  CHECK_THAT(failures[1], Catch::Contains("no tire gives energy to the motion"));
  CHECK(failures[2].empty());
  CHECK(!loss_N[0].empty());
  CHECK(loss_N[1].empty());
  CHECK(!loss_N[2].empty());
  const json sweep_json = json::parse(read_file(folder.file("out/sweep.json")));
  CHECK(sweep_json["points"].size() == 3);
  CHECK(sweep_json["points"][1]["failure"] == failures[1]);
  CHECK(!sweep_json["points"][0].contains("failure"));
  const json manifests = json::parse(read_file(folder.file("out/manifests.json")))["manifests"];
  REQUIRE(manifests.size() == 3);
  CHECK(manifests[1].is_null());
  CHECK(manifests[2]["scenario"] == "warm_up");
}

TEST_CASE("a sweep whose points all fail writes nothing", "[fast]") {
  const TemporaryFolder folder;
  const auto sweep = run_program("sweep warm_up --fidelity quasi_static --tire " + kCombinedTire +
                                     " --set tire.rolling_resistance.A0_N=50 --vary "
                                     "tire.rolling_resistance.A1_N_s_per_m=-3,-4 --out out",
                                 folder.path());
  CHECK(sweep.status == 3);
  CHECK_THAT(flatten(sweep.err), Catch::Contains("no point of the sweep could be simulated"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a sweep has the results of all its points as columns, in whatever order they are run", "[fast]") {
  const TemporaryFolder folder;
  for (const char* order : {"25:-10:-35", "-10:25:35"}) {
    const auto sweep = run_program(
        fmt::format("sweep warm_up --fidelity quasi_static --tire a50 --vary ambient_degC={} --out out --force", order),
        folder.path());
    INFO(sweep.err);
    REQUIRE(sweep.status == 0);
    const CsvTable csv = CsvTable::read(folder.file("out/sweep.csv"));
    const std::vector<std::string> ambient = csv.text("ambient_degC");
    const std::vector<std::string> band_N = csv.text("band_low_N");
    for (std::size_t row = 0; row < ambient.size(); ++row) CHECK(band_N[row].empty() == (ambient[row] == "-10"));
  }
}

TEST_CASE("regress: same, differs with exit 1, updated", "[fast]") {
  const TemporaryFolder folder;
  fs::copy(ROLLRIG_SOURCE_DIR "/assets/regression/skim_a40.toml", folder.file("skim_a40.toml"));
  CHECK(run_program("regress .", folder.path()).status == 1);  // no golden yet
  CHECK(run_program("regress . --update", folder.path()).status == 0);
  CHECK(run_program("regress .", folder.path()).status == 0);
  std::string golden = read_file(folder.file("skim_a40.golden.csv"));
  const std::size_t digit = golden.find("result.parasitic_N,,") + std::string("result.parasitic_N,,").size();
  golden[digit] = golden[digit] == '1' ? '2' : '1';
  write_file(folder.file("skim_a40.golden.csv"), golden);
  const auto differs = run_program("regress .", folder.path());
  CHECK(differs.status == 1);
  CHECK_THAT(differs.out, Contains("differs") && Contains("result.parasitic_N"));
  CHECK(run_program("regress . --update --quiet", folder.path()).status == 0);
  CHECK(run_program("regress . --json -", folder.path()).status == 0);
}

TEST_CASE("all regression scenarios are as their goldens", "[slow]") {
  const auto run = run_program("regress");
  INFO(run.out << run.err);
  CHECK(run.status == 0);
}

TEST_CASE("every command that writes a page says where", "[slow]") {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("runs"));
  for (const char* file : {"skim_a40.toml", "skim_a40.golden.csv"}) {
    fs::copy(std::string(ROLLRIG_SOURCE_DIR) + "/assets/regression/" + file, folder.file(std::string("runs/") + file));
  }
  for (const char* command : {"run skim --tire a50", "sweep skim --tire a50 --vary load_N=4000,5000", "regress runs",
                              "fit road-load '" ROLLRIG_SOURCE_DIR "/tests/bad_input/coastdown_good.csv' --per-mass"}) {
    const auto run = run_program(std::string(command) + " --html page.html", folder.path());
    INFO(command << "\n" << run.err);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains("page written to page.html\n"));
    CHECK(run_program(std::string(command) + " --html page.html --quiet", folder.path()).out.empty());
  }
}

TEST_CASE("an interrupted run stops cleanly and leaves nothing behind", "[fast]") {
  const TemporaryFolder folder;
  // A sweep of some hundred runs is long enough to be met. On a busy machine the signal may come before the program has
  // begun to listen to signals, and ends it without a word.
  ProgramResult run;
  for (const char* delay_s : {"0.7", "3", "12", "48"}) {
    run = run_program("sweep speed_sweep --tire a50 --vary load_N=4000:7000:5 --threads 1 --json sweep.json",
                      folder.path(), fmt::format("timeout --foreground -s INT --preserve-status {}", delay_s));
    if (!run.err.empty()) break;
  }
  CHECK(run.status == 130);
  CHECK_THAT(run.err, Contains("nothing was written"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("scenarios are known by their former names as well, which nothing shows", "[fast]") {
  const std::string rows = ROLLRIG_SOURCE_DIR "/assets/regression/follow_roller_a50";
  const auto run = run_program("run wheel_program --tire a50 --set program=" + rows + ".csv --json -");
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(json::parse(run.out)["scenario"] == "follow_roller");
  const TemporaryFolder folder;
  write_file(folder.file("run.toml"),
             "format = \"rollrig-run/1\"\nscenario = \"wheel_program\"\ntire = \"a50\"\n[settings]\nprogram = \"" +
                 rows + ".csv\"\n");
  CHECK_THAT(run_program("validate run.toml", folder.path()).out, Contains("run of scenario 'follow_roller'"));
  CHECK_THAT(run_program("describe program").out, Contains("follow_drum: scenario"));
  CHECK_THAT(run_program("describe drive").out, Contains("follow_road: scenario"));
  for (const char* shown : {"list", "completion bash", "man"}) {
    CHECK_THAT(run_program(shown).out, !Contains("wheel_program"));
  }
}

TEST_CASE("one place under two names is refused before it is there", "[fast]") {
  const TemporaryFolder folder;
  const std::string run = "run warm_up --tire a50 --sensors source ";
  CHECK(run_program(run + "--json one --html " + folder.file("one"), folder.path()).status == 2);
  CHECK(run_program(run + "--out one --write-set " + folder.file("one"), folder.path()).status == 2);
  CHECK(folder.entry_count() == 0);
}
