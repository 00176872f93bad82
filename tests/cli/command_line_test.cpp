// The command line as users and CI jobs meet it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "build_paths.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using rollrig::tests::flatten;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {
std::size_t longest_line(const std::string& text) {
  std::istringstream in(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(in, line);) {
    const auto characters =
        std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}
}  // namespace

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
  CHECK(rrc("--set tire.rolling_resistance.A0_N=40") > plain);
  CHECK(rrc("--set rig.environment.ambient_degC=20") > plain);
  CHECK(rrc("--set effects.load_exponent.exponent=1.1") > plain);
  CHECK(rrc("--set effects.bearing_warmup.fall_per_K=0.02") == Approx(plain).epsilon(0.02));
  CHECK(rrc("--sensors source --seed 2") != plain);
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
  CHECK(fs::exists(folder.file("one/manifests/0006.json")));
  CHECK(longest_line(one.out) <= 80);
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

TEST_CASE("all regression scenarios are as their goldens", "[fast]") {
  const auto run = run_program("regress");
  INFO(run.out << run.err);
  CHECK(run.status == 0);
}

TEST_CASE("a set is written, validated and fitted", "[fast]") {
  const TemporaryFolder folder;
  REQUIRE(run_program("run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80, 120]' "
                      "--set measurement_cycles=1 --write-set set --quiet",
                      folder.path())
              .status == 0);
  CHECK_THAT(run_program("validate set", folder.path()).out, Contains("2 runs"));
  const auto fit = run_program("fit tire set --out fitted --name mine", folder.path());
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  CHECK(longest_line(fit.out) <= 80);
  CHECK(run_program("validate fitted/mine.toml", folder.path()).status == 0);
  const json result = json::parse(read_file(folder.file("fitted/fit.json")));
  CHECK(result["parameters"].size() == 6);
  CHECK(run_program("run iso_28580 --tire fitted/mine.toml", folder.path()).status == 0);
}

TEST_CASE("a set that is written without sensors is said to hold no measurement", "[fast]") {
  const TemporaryFolder folder;
  const auto plain = run_program("run skim --tire a50 --write-set plain", folder.path());
  CHECK(plain.status == 0);
  CHECK_THAT(plain.out, Contains("nothing is measured in it") && Contains("--sensors"));
  const auto measured = run_program("run skim --tire a50 --sensors source --write-set measured", folder.path());
  CHECK(measured.status == 0);
  CHECK_THAT(measured.out, !Contains("nothing is measured"));
}

namespace {
/// A set of two runs in "set", its pressures in bar under a kPa heading where wanted.
void write_small_set(const TemporaryFolder& folder, bool in_bar) {
  REQUIRE(run_program("run speed_sweep --tire a50 --sensors source --set 'speeds_km_h=[80, 120]' "
                      "--set measurement_cycles=1 --write-set set --quiet",
                      folder.path())
              .status == 0);
  if (!in_bar) return;
  for (const char* run : {"set/speed-80.csv", "set/speed-120.csv"}) {
    std::istringstream in(read_file(folder.file(run)));
    std::string line;
    std::getline(in, line);
    REQUIRE(line.substr(line.rfind(',') + 1) == "cavity_pressure_kPa");
    std::string out = line + "\n";
    while (std::getline(in, line)) {
      const std::size_t last = line.rfind(',') + 1;
      if (last < line.size()) line.replace(last, std::string::npos, std::to_string(std::stod(line.substr(last)) / 100));
      out += line + "\n";
    }
    write_file(folder.file(run), out);
  }
}
}  // namespace

TEST_CASE("a fit says that a column looks as if it were in another unit", "[fast]") {
  const TemporaryFolder good;
  write_small_set(good, false);
  const auto right = run_program("fit tire set", good.path());
  CHECK(right.status == 0);
  CHECK_THAT(right.out, !Contains("looks as if"));
  const TemporaryFolder bad;
  write_small_set(bad, true);
  const auto fit = run_program("fit tire set --json fit.json", bad.path());
  CHECK_THAT(fit.out + fit.err, Contains("cavity_pressure_kPa holds bar"));
  CHECK(fit.status == 1);
  CHECK_THAT(read_file(bad.file("fit.json")), Contains("cavity_pressure_kPa holds bar"));
}

TEST_CASE("a fit leaves out what a diagnosis leaves out", "[fast]") {
  const TemporaryFolder folder;
  write_small_set(folder, false);
  REQUIRE(run_program("fit tire set --json clean.json --quiet", folder.path()).status == 0);
  std::istringstream in(read_file(folder.file("set/speed-80.csv")));
  std::string out;
  std::string line;
  for (int row = 0; std::getline(in, line); ++row) {
    std::size_t at = 0;  // the fifth column is the torque
    for (int column = 0; column < 4; ++column) at = line.find(',', at) + 1;
    if (row > 0 && row % 97 == 0 && line[at] != ',') line.replace(at, line.find(',', at) - at, "-9999");
    out += line + "\n";
  }
  write_file(folder.file("set/speed-80.csv"), out);
  const auto fit = run_program("fit tire set --json spiked.json", folder.path());
  CHECK(fit.status == 0);
  CHECK_THAT(flatten(fit.out), Contains("samples of stuck sensors or that stand alone were left out"));
  const auto A0_N = [&](const char* file) {
    return json::parse(read_file(folder.file(file)))["parameters"][0]["value"].get<double>();
  };
  CHECK(A0_N("spiked.json") == Approx(A0_N("clean.json")).epsilon(0.02));
}

TEST_CASE("validate: 0 for a good set, 1 for one whose columns cannot be right, 2 for one that cannot be read",
          "[fast]") {
  const TemporaryFolder good;
  write_small_set(good, false);
  const auto passed = run_program("validate set", good.path());
  CHECK(passed.status == 0);
  CHECK_THAT(passed.out, Contains("good measurement set") && !Contains("measured nothing"));
  const TemporaryFolder bad;
  write_small_set(bad, true);
  const auto doubtful = run_program("validate set '" ROLLRIG_SOURCE_DIR "/assets/tires/a50.toml'", bad.path());
  CHECK(doubtful.status == 1);
  CHECK_THAT(doubtful.out, Contains("doubtful measurement set") && Contains("good tire"));  // the rest is looked at too
  fs::remove(bad.file("set/speed-80.csv"));
  CHECK(run_program("validate set", bad.path()).status == 2);
}

TEST_CASE("validate says how many rows are of runs that measured nothing", "[fast]") {
  const TemporaryFolder folder;
  write_small_set(folder, false);
  std::istringstream in(read_file(folder.file("set/speed-80.csv")));
  std::string line;
  std::getline(in, line);
  const auto columns = std::count(line.begin(), line.end(), ',') + 1;
  std::string out = line + "\n";
  std::size_t rows = 0;
  for (; std::getline(in, line); ++rows) {
    std::size_t last = line.size();
    for (int i = 0; i < 3; ++i) last = line.rfind(',', last - 1);  // torque, temperature, pressure
    out += line.substr(0, last) + ",,,\n";
  }
  REQUIRE(columns >= 7);
  write_file(folder.file("set/speed-80.csv"), out);
  const auto run = run_program("validate set", folder.path());
  INFO(run.out << run.err);
  CHECK_THAT(flatten(run.out), Contains(std::to_string(rows) + " of them in runs that measured nothing"));
}

TEST_CASE("every asset is valid", "[fast]") {
  for (const char* kind : {"tires", "rigs", "sensors", "regression"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_SOURCE_DIR) / "assets" / kind)) {
      if (entry.path().extension() != ".toml") continue;
      const auto run = run_program("validate '" + entry.path().string() + "'");
      INFO(run.err);
      CHECK(run.status == 0);
    }
  }
}

TEST_CASE("every number of an asset cites its place in the source or says that it is assumed", "[fast]") {
  for (const char* kind : {"tires", "rigs", "sensors"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(ROLLRIG_SOURCE_DIR) / "assets" / kind)) {
      std::istringstream in(read_file(entry.path().string()));
      for (std::string line; std::getline(in, line);) {
        const bool assigns_number = line.find(" = ") != std::string::npos && line.find('"') == std::string::npos;
        if (!assigns_number) continue;
        INFO(entry.path() << ": " << line);
        CHECK_THAT(line, Contains("§") || Contains("Table") || Contains("Figure") || Contains("(3.") ||
                             Contains("Assumed") || Contains("Calibrated"));
      }
    }
  }
}

TEST_CASE("describe explains scenarios, effects and assets within 80 columns", "[fast]") {
  for (const char* name : {"iso_28580", "warm_up", "skim", "skim_series", "transient_skim", "load_sweep",
                           "pressure_sweep", "speed_sweep", "load_exponent", "bearing_warmup", "tire_loss_in_skim"}) {
    const auto run = run_program(std::string("describe ") + name);
    INFO(name);
    CHECK(run.status == 0);
    CHECK(longest_line(run.out) <= 80);
    CHECK_THAT(run.out, Contains("Source"));
  }
  CHECK_THAT(run_program("describe a50").out, Contains("Table 3.1"));
  CHECK(longest_line(run_program("list").out) <= 80);
  const auto typo = run_program("describe iso_28850");
  CHECK(typo.status == 2);
  CHECK_THAT(typo.err, Contains("iso_28580"));
}

TEST_CASE("help stands everywhere and completion scripts parse", "[fast]") {
  for (const char* command : {"", "run", "sweep", "regress", "validate", "list", "describe", "fit", "fit tire",
                              "fit road-load", "diagnose", "export", "completion", "man"}) {
    const auto run = run_program(std::string(command) + " --help");
    INFO(command);
    CHECK(run.status == 0);
    CHECK_THAT(run.out, Contains("Usage"));
    CHECK(longest_line(run.out) <= 80);
  }
  CHECK_THAT(run_program("--help").out, Contains("--log debug|info|warning|error|off\n"));
  CHECK_THAT(run_program("man").out, Contains("debug|info|warning|error|off"));
  CHECK_THAT(run_program("fit road-load --help").out, Contains("--mass positive FLOAT\n"));
  const TemporaryFolder folder;
  write_file(folder.file("completion.bash"), run_program("completion bash").out);
  write_file(
      folder.file("try.sh"),
      "source ./completion.bash\nCOMP_WORDS=(rollrig run iso)\nCOMP_CWORD=2\n_rollrig\necho \"${COMPREPLY[@]}\"\n"
      "COMP_WORDS=(rollrig run --tire a5)\nCOMP_CWORD=3\n_rollrig\necho \"${COMPREPLY[@]}\"\n");
  const auto tried = run_program("--version && bash try.sh", folder.path());
  CHECK_THAT(tried.out, Contains("iso_28580") && Contains("a50"));
  CHECK(run_program("completion fish").status == 0);
  CHECK(run_program("completion zsh").status == 0);
}

TEST_CASE("usage errors name the nearest word and exit with 2", "[fast]") {
  const auto option = run_program("run iso_28580 --tyre a50");
  CHECK(option.status == 2);
  CHECK_THAT(option.err, Contains("--tire"));
  const auto command = run_program("rnu iso_28580");
  CHECK(command.status == 2);
  CHECK_THAT(command.err, Contains("run"));
  CHECK(run_program("").status == 2);
  CHECK(run_program("run iso_28580").status == 2);
}

TEST_CASE("errors stay within 80 columns, with all that is allowed and paths whole", "[fast]") {
  for (const char* arguments : {"run nope --tire a50", "diagnose --explain nope", "describe nope",
                                "run iso_28580 --tire a50 --set effects.nope.x=1", "export . --mat x"}) {
    const auto run = run_program(arguments);
    INFO(run.err);
    CHECK(run.status == 2);
    CHECK(longest_line(run.err) <= 80);
  }
  const std::string path = "no_such_folder_of_a_rather_long_name/and another one below it/and at last a tire file.toml";
  CHECK_THAT(run_program("validate '" + path + "'").err, Contains("  where    " + path + "\n"));
}

TEST_CASE("every command that writes a page says where", "[fast]") {
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
  // long enough to be met: a sweep of some hundred runs
  const auto run = run_program("sweep speed_sweep --tire a50 --vary load_N=4000:7000:5 --threads 1 --out results",
                               folder.path(), "timeout --foreground -s INT --preserve-status 0.7");
  CHECK(run.status == 130);
  CHECK_THAT(run.err, Contains("nothing was written"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a run that fails exits with 3 and says why", "[fast]") {
  // a drum that cannot turn the tire: a stiffness that no machine number holds
  const auto run = run_program("run iso_28580 --tire a50 --set tire.rolling_resistance.A0_N=1e300");
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("run failed"));
}

TEST_CASE("a tire that an effect cools without end is a failed run that names the effect", "[fast]") {
  // a loss of -800 N: the tire drives, and what it gives is taken from its heat
  const std::string effect =
      " --set effects.tire_loss_in_skim.force_N=-20 --set effects.tire_loss_in_skim.load_power=1";
  for (const char* fidelity : {"multibody", "quasi_static"}) {
    const auto run = run_program(std::string("run warm_up --tire a50 --fidelity ") + fidelity + effect, "",
                                 "timeout --foreground 60");
    INFO(fidelity);
    CHECK(run.status == 3);
    CHECK_THAT(run.err, Contains("temperature of the tire's rubber") && Contains("tire_loss_in_skim (force_N = -20"));
  }
}

TEST_CASE("a tire that heats without end is a failed run of recorded rows, too", "[fast]") {
  // no cooling, and a loss that does not fall with temperature
  const TemporaryFolder folder;
  std::string rows = "time_s,speed_km_h,load_N,ambient_degC,longitudinal_force_N\n";
  for (int i = 0; i <= 2000; i += 2) rows += std::to_string(i) + ",120,5000,25,0\n";
  write_file(folder.file("rows.csv"), rows);
  const auto run = run_program(
      "run follow_roller --tire a50 --set program=rows.csv --set tire.rolling_resistance.B0_per_degC=0 --set "
      "tire.rolling_resistance.B1_s_per_m_degC=0 --set tire.rolling_resistance.A0_N=5000 --set "
      "tire.thermal.z_W_per_K=0.01 --set tire.thermal.f_W_s_per_m_K=0",
      folder.path());
  INFO(run.out);
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("temperature of the tire's rubber"));
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
