// Campaigns at the command line: the same results in however many goes and processes.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

#include "build_paths.h"

#include "sim/core/json.h"
#include "tests/support/run_program.h"

namespace {

namespace fs = std::filesystem;
using namespace rollrig::tests;
using rollrig::Json;

/// Runs the program and requires that it is done.
std::string run_to_end(const std::string& arguments, const TemporaryFolder& at, const std::string& prefix = "") {
  const ProgramResult result = run_program(arguments, at.path(), prefix);
  INFO(arguments << "\n" << result.err);
  REQUIRE(result.status == 0);
  return result.out;
}

constexpr const char* kRun = "iso_28580 --tire a50 --fidelity quasi_static";

/// Lines of a CSV text without the first column.
std::string without_first_column(const std::string& csv) {
  std::string text;
  std::size_t start = 0;
  while (start < csv.size()) {
    const std::size_t end = csv.find('\n', start);
    text += csv.substr(csv.find(',', start) + 1, end - csv.find(',', start));
    start = end + 1;
  }
  return text;
}

}  // namespace

TEST_CASE("a campaign of a grid has the numbers of a sweep", "[fast]") {
  const TemporaryFolder at;
  const std::string grid = std::string(kRun) + " --vary pressure_kPa=210,250 --vary ambient_degC=20:30:5";
  run_to_end("sweep " + grid + " --out sweep", at);
  run_to_end("campaign new c " + grid, at);
  run_to_end("campaign run c --shard 2/2", at);
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("3 of 6 items done"));
  run_to_end("campaign run c --threads 2", at);
  run_to_end("campaign export c --csv c.csv", at);
  CHECK(without_first_column(read_file(at.file("c.csv"))) == read_file(at.file("sweep/sweep.csv")));
  run_to_end("campaign merge c", at);
  run_to_end("campaign export c --csv merged.csv --mat c.mat --hdf5 c.h5", at);
  CHECK(read_file(at.file("merged.csv")) == read_file(at.file("c.csv")));
  CHECK_THAT(run_to_end("campaign run c", at), Catch::Contains("6 of 6 items done"));
}

TEST_CASE("of two merges at once, the second one says that the first one is at work", "[fast]") {
  const TemporaryFolder at;
  run_to_end("campaign new c " + std::string(kRun) + " --vary pressure_kPa=210:250:10", at);
  for (const char* part : {"1/2", "2/2"}) run_to_end(std::string("campaign run c --shard ") + part, at);
  run_to_end("campaign export c --csv before.csv", at);
  const ProgramResult second = run_program("campaign merge c", at.path(), "flock c");  // what the first one does
  CHECK(second.status == 2);
  CHECK_THAT(flatten(second.err), Catch::StartsWith("error: another process merges the results of this campaign now"));
  CHECK(fs::exists(at.file("c/results_0001_of_0002.sqlite")));
  // At once, whichever comes first: both are done, or one is told to wait.
  const ProgramResult both = run_program("campaign merge c & first=$!; '" ROLLRIG_PROGRAM
                                         "' campaign merge c; second=$?; wait $first; test $? -eq 0 -o $second -eq 0",
                                         at.path());
  INFO(both.err);
  CHECK(both.status == 0);
  CHECK_THAT(both.err, !Catch::Contains("database") && !Catch::Contains("cannot"));
  run_to_end("campaign export c --csv after.csv", at);
  CHECK(read_file(at.file("after.csv")) == read_file(at.file("before.csv")));
}

TEST_CASE("a campaign that is killed goes on, with the same results", "[slow]") {
  const TemporaryFolder at;
  const std::string draws = std::string(kRun) + " --draw-sd tire --draw load_N=normal:5000:50 --points 1500 --seed 4";
  run_to_end("campaign new whole " + draws, at);
  run_to_end("campaign run whole", at);
  run_to_end("campaign export whole --csv whole.csv", at);
  run_to_end("campaign new killed " + draws, at);
  for (const char* seconds : {"0.1", "0.25", "0.2", "0.4"}) {
    CHECK(run_program("campaign run killed", at.path(), std::string("timeout -s KILL ") + seconds).status == 137);
  }
  CHECK(run_program("campaign run killed", at.path(), "timeout --preserve-status -s INT 0.3").status == 130);
  const Json state = Json::parse(run_to_end("campaign status killed --json -", at));
  CHECK(state["done"].get<int>() > 0);
  CHECK(state["done"].get<int>() < 1500);
  run_to_end("campaign resume killed", at);
  run_to_end("campaign export killed --csv killed.csv", at);
  CHECK(read_file(at.file("killed.csv")) == read_file(at.file("whole.csv")));
}

TEST_CASE("a campaign of which something has changed is refused", "[fast]") {
  const TemporaryFolder at;
  const std::string tire = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml");
  write_file(at.file("mine.toml"), tire);
  run_to_end("campaign new c iso_28580 --tire ./mine.toml --fidelity quasi_static --vary ambient_degC=20,25", at);
  run_to_end("campaign run c --shard 1/2", at);
  write_file(at.file("mine.toml"), tire + "\n# changed\n");
  const ProgramResult result = run_program("campaign run c", at.path());
  CHECK(result.status == 2);
  CHECK_THAT(flatten(result.err),
             Catch::Contains("the file has changed since the campaign was begun") && Catch::Contains("mine.toml"));
  run_to_end("campaign export c --csv c.csv", at);  // what is done can be read all the same
  write_file(at.file("mine.toml"), tire);
  run_to_end("campaign run c", at);
}

TEST_CASE("a campaign that was begun when its format had another name goes on", "[fast]") {
  const TemporaryFolder at;
  run_to_end("campaign new c " + std::string(kRun) + " --vary pressure_kPa=210,250", at);
  std::string definition = read_file(at.file("c/campaign.json"));
  const std::string name = "rollrig-item-campaign/1";
  REQUIRE(definition.find(name) != std::string::npos);
  write_file(at.file("c/campaign.json"), definition.replace(definition.find(name), name.size(), "rollrig-campaign/1"));
  run_to_end("campaign run c --shard 1/2", at);
  run_to_end("campaign run c --shard 2/2", at);
  run_to_end("campaign merge c", at);
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("2 of 2 items done"));
  run_to_end("campaign export c --csv c.csv", at);
}

TEST_CASE("traces of a campaign are watched and found from any folder", "[fast]") {
  const TemporaryFolder at;
  for (const char* name : {"a.csv", "b.csv", "c.csv"}) {
    write_file(at.file(name), "time_s,speed_km_h,load_N,ambient_degC\n0,0,5000,25\n30,80,5000,25\n300,80,5000,25\n");
  }
  run_to_end("campaign new c follow_drum --tire a50 --fidelity quasi_static --vary program=a.csv,b.csv,c.csv", at);
  const ProgramResult elsewhere = run_program("campaign run '" + at.file("c") + "' --shard 1/3", "/");
  INFO(elsewhere.err);
  CHECK(elsewhere.status == 0);
  write_file(at.file("b.csv"), "time_s,speed_km_h,load_N,ambient_degC\n0,0,5000,25\n30,60,5000,25\n300,60,5000,25\n");
  const ProgramResult changed = run_program("campaign run c", at.path());
  CHECK(changed.status == 2);
  CHECK_THAT(changed.err, Catch::Contains("b.csv"));
}

TEST_CASE("a list has its rows as items", "[fast]") {
  const TemporaryFolder at;
  write_file(at.file("list.csv"), "load_N,ambient_degC,tire.name\n5000,20,\n6000,25,\n");
  const ProgramResult empty = run_program(std::string("campaign new c ") + kRun + " --list list.csv", at.path());
  CHECK(empty.status == 2);
  CHECK_THAT(flatten(empty.err), Catch::Contains("list.csv, line 2") && Catch::Contains("tire.name"));
  write_file(at.file("list.csv"), "load_N,ambient_degC\n5000,20\n6000,25\n4000,30\n");
  run_to_end(std::string("campaign new c ") + kRun + " --list list.csv", at);
  run_to_end("campaign run c", at);
  const std::string csv = run_to_end("campaign export c --csv -", at);
  CHECK_THAT(csv,
             Catch::Contains("\n1,5000,20,") && Catch::Contains("\n2,6000,25,") && Catch::Contains("\n3,4000,30,"));
  run_to_end(
      std::string("campaign new pairs ") + kRun + " --design list --vary load_N=5000,6000 --vary ambient_degC=20,25",
      at);
  CHECK_THAT(run_to_end("campaign status pairs", at), Catch::Contains("0 of 2 items"));
  for (const char* wrong : {" --list list.csv --vary pressure_kPa=250,260", " --list list.csv --design grid",
                            " --design list --vary load_N=5000,6000 --vary ambient_degC=20"}) {
    CHECK(run_program(std::string("campaign new wrong ") + kRun + wrong, at.path()).status == 2);
  }
}

TEST_CASE("what is wrong with a row of a list is told with its line", "[fast]") {
  const TemporaryFolder at;
  const auto complain_of = [&at](const char* list) {
    write_file(at.file("list.csv"), list);
    const ProgramResult result =
        run_program("campaign new c iso_28580 --fidelity quasi_static --list list.csv", at.path());
    CHECK(result.status == 2);
    return flatten(result.err);
  };
  CHECK_THAT(complain_of("tire,load_N\na50,5000\na50,much\n"),
             Catch::Contains("list.csv, line 3") && Catch::Contains("load_N") && !Catch::Contains("--set"));
  CHECK_THAT(complain_of("tire,load_N\na50,5000\na50,5100\na51,5000\n"),
             Catch::Contains("list.csv, line 4") && Catch::Contains("unknown tire 'a51'"));
}

TEST_CASE("what is wrong with a factor is told of its option", "[fast]") {
  const TemporaryFolder at;
  const auto complain_of = [&at](const std::string& factors) {
    const ProgramResult result = run_program(std::string("campaign new c ") + kRun + factors, at.path());
    CHECK(result.status == 2);
    return flatten(result.err);
  };
  CHECK_THAT(complain_of(" --draw load_N=uniform:-3:-1 --points 4"), Catch::Contains("where --draw"));
  CHECK_THAT(complain_of(" --vary load_N=5000,-1"), Catch::Contains("where --vary"));
  // The median, 3, would be allowed.
  CHECK_THAT(complain_of(" --draw measurement_cycles=uniform:1:5 --points 4"),
             Catch::Contains("'measurement_cycles' takes whole numbers") &&
                 Catch::Contains("--vary measurement_cycles=1,2,3"));
  run_to_end(std::string("campaign new c ") + kRun +
                 " --draw load_N=normal:5000:9 --vary measurement_cycles=1,2,3 --design monte_carlo --points 4",
             at);
  run_to_end("campaign run c", at);
}

TEST_CASE("of many items, the least and the largest number and each word of a factor are checked", "[fast]") {
  const TemporaryFolder at;
  std::string list = "ambient_degC,pressure_kPa\n";
  for (int row = 0; row < 1200; ++row) list += row == 600 ? "200,250\n" : row == 700 ? "25,abc\n" : "25,250\n";
  write_file(at.file("list.csv"), list);
  const std::string start = std::string("campaign new c ") + kRun;
  CHECK_THAT(flatten(run_program(start + " --list list.csv", at.path()).err), Catch::Contains("list.csv, line 602"));
  write_file(at.file("list.csv"), list.replace(list.find("200,"), 4, "20,"));
  CHECK_THAT(flatten(run_program(start + " --list list.csv", at.path()).err), Catch::Contains("list.csv, line 702"));
  const ProgramResult grid =
      run_program(start + " --vary ambient_degC=10:30:0.05 --vary pressure_kPa=250,2500,260", at.path());
  CHECK(grid.status == 2);
  CHECK_THAT(flatten(grid.err), Catch::Contains("where --vary") && Catch::Contains("2500"));
}

TEST_CASE("the header of a list may have spaces, and --draw-sd takes one word", "[fast]") {
  const TemporaryFolder at;
  write_file(at.file("list.csv"), "ambient_degC, pressure_kPa\n25,250\n20,240\n");
  run_to_end(std::string("campaign new c ") + kRun + " --list list.csv", at);
  write_file(at.file("words.csv"), "tire , load_N\n a50 ,5000\n");
  run_to_end("campaign new w iso_28580 --fidelity quasi_static --list words.csv", at);
  write_file(at.file("wrong.csv"), "tire,load N\na50,5000\n");
  CHECK_THAT(flatten(run_program("campaign new x iso_28580 --list wrong.csv", at.path()).err),
             Catch::Contains("wrong.csv, line 1"));
  write_file(at.file("wrong.csv"), "tire,lode_N\na50,5000\n");
  CHECK_THAT(flatten(run_program("campaign new x iso_28580 --list wrong.csv", at.path()).err),
             Catch::Contains("wrong.csv, line 1"));
  run_to_end("campaign new --draw-sd 'tire, rig' d iso_28580 --tire a50 --fidelity quasi_static --points 3", at);
}

TEST_CASE("a program is told how far a campaign is, also where nothing is left to do", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20,25", at);
  run_to_end("campaign run c", at);
  const ProgramResult again = run_program("campaign run c --progress --quiet", at.path());
  CHECK(again.err == "{\"done\":1.0000,\"seconds_left\":0.0}\n");
}

TEST_CASE("a program is told each second how far a campaign is, also within an item", "[slow]") {
  const TemporaryFolder at;
  run_to_end("campaign new c sae_j1634 --tire a50 --vary ambient_degC=20,25", at);
  const ProgramResult stopped =
      run_program("campaign run c --progress --quiet --threads 1", at.path(), "timeout -s INT 5");
  const Json first = Json::parse(stopped.err.substr(0, stopped.err.find('\n')));
  CHECK(first["done"] == 0.0);
  CHECK(first["seconds_left"].is_null());
  CHECK(std::count(stopped.err.begin(), stopped.err.end(), '{') >= 3);
}

TEST_CASE("processes of one launcher do not write one file", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20,25", at);
  const ProgramResult result = run_program("campaign run c --json c.json --threads 1", at.path(),
                                           "OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=0");
  CHECK(result.status == 2);
  CHECK_THAT(flatten(result.err), Catch::Contains("each process would write this file"));
}

TEST_CASE("an export and a sensitivity say what they lack", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20:29:1", at);
  run_to_end("campaign run c --shard 1/2", at);
  CHECK_THAT(run_to_end("campaign export c --csv c.csv", at), Catch::Contains("5 of 10 items are in the table"));
  run_to_end("campaign run c", at);
  CHECK_THAT(run_to_end("campaign export c --csv all.csv", at), !Catch::Contains("in the table"));
  run_to_end(std::string("campaign new s ") + kRun +
                 " --draw pressure_kPa=uniform:60:400 --draw load_N=uniform:-1000:6000 --design morris --points 16",
             at);
  CHECK(run_program("campaign run s", at.path()).status == 3);
  const std::string text = flatten(run_to_end("campaign sensitivity s --result rrc_N_per_kN --json s.json", at));
  const Json found = Json::parse(read_file(at.file("s.json")));
  const int left_out = found["points_left_out"].get<int>();
  CHECK(left_out > 0);
  CHECK(left_out + found["points"].get<int>() == 16);
  CHECK_THAT(text, Catch::Contains(std::to_string(left_out) + " of 16 points are left out"));
}

TEST_CASE("a campaign of other sources of the same version is refused", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20,25", at);
  Json definition = Json::parse(read_file(at.file("c/campaign.json")));
  CHECK(definition.at("sources").get<std::string>().size() == 16);
  definition["sources"] = "0123456789abcdef";
  write_file(at.file("c/campaign.json"), definition.dump());
  const ProgramResult result = run_program("campaign run c", at.path());
  CHECK(result.status == 2);
  CHECK_THAT(flatten(result.err), Catch::Contains("other sources of rollrig"));
  definition.erase("sources");  // begun before they were told
  write_file(at.file("c/campaign.json"), definition.dump());
  CHECK(run_program("campaign run c", at.path()).status == 2);
}

#ifndef ROLLRIG_SANITIZED  // whose runtime must be loaded before any other library
TEST_CASE("a drive that cannot lock files is told as one", "[slow]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20,25", at);
  const ProgramResult result = run_program("campaign run c", at.path(), "LD_PRELOAD=" ROLLRIG_NO_LOCKS_LIBRARY);
  CHECK(result.status == 2);
  CHECK_THAT(flatten(result.err), Catch::Contains("does not lock files") && !Catch::Contains("another process"));
}
#endif

TEST_CASE("items that fail are kept, counted and told", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --draw pressure_kPa=uniform:-100:400 --points 12 --seed 2", at);
  const ProgramResult result = run_program("campaign run c", at.path());
  CHECK(result.status == 3);
  CHECK_THAT(result.out, Catch::Contains("12 of 12 items done") && Catch::Contains("of them failed"));
  CHECK_THAT(run_to_end("campaign export c --csv -", at), Catch::Contains("pressure_kPa"));
}

TEST_CASE("which factor a result depends on", "[slow]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun +
                 " --draw ambient_degC=uniform:20:30 --draw pressure_kPa=uniform:249:251 --design sobol_indices "
                 "--points 16",
             at);
  run_to_end("campaign run c", at);
  const Json found = Json::parse(run_to_end("campaign sensitivity c --result rrc_N_per_kN --json -", at));
  CHECK(found["factors"][0]["key"] == "ambient_degC");
  CHECK(found["factors"][0]["first"]["value"].get<double>() == Approx(1.0).margin(0.15));
  CHECK(found["factors"][1]["total"]["value"].get<double>() < 0.1);
  run_to_end("campaign sensitivity c --result rrc_N_per_kN --html c.html", at);
  CHECK_THAT(read_file(at.file("c.html")), Catch::Contains("Mean of RRc in N/kN over ambient and pressure"));
  run_to_end(std::string("campaign new few ") + kRun +
                 " --vary ambient_degC=20,30 --vary load_N=5000,5400 --design sobol_indices --points 16",
             at);
  run_to_end("campaign run few", at);
  run_to_end("campaign sensitivity few --result rrc_N_per_kN --html few.html", at);
  CHECK_THAT(read_file(at.file("few.html")), Catch::Contains("\"columns\":[\"20\",\"30\"]"));
  run_to_end(std::string("campaign new tires iso_28580 --fidelity quasi_static --vary tire=a40,a50,a60 ") +
                 "--draw ambient_degC=uniform:20:30 --design sobol_indices --points 16",
             at);
  run_to_end("campaign run tires", at);
  run_to_end("campaign sensitivity tires --result rrc_N_per_kN --html tires.html --json tires.json", at);
  CHECK_THAT(read_file(at.file("tires.html")), Catch::Contains("RRc by tire"));
  const Json tires = Json::parse(read_file(at.file("tires.json")));
  CHECK(tires["over_two_factors"]["across"]["ranges"] == Json({"a40", "a50", "a60"}));
  const ProgramResult unknown = run_program("campaign sensitivity c --result rrc_N_per_k", at.path());
  CHECK(unknown.status == 2);
  CHECK_THAT(flatten(unknown.err), Catch::Contains("rrc_N_per_kN"));
}

// Without an influence of temperature and of pressure on the loss, RRc at 25 degC is c loss (1 + K_t (ambient - 25
// degC)) for uniform loss and ambient, K_t = 0.008 /K of ISO 28580. The variance of a product of independent a and b is
// var(a) E(b)^2 + var(b) E(a)^2 + var(a) var(b), and these three are the parts of a alone, b alone and of both.
TEST_CASE("indices of RRc are those of its closed form", "[slow]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun +
                 " --set tire.bounded.fall_per_degC=0 --set tire.rolling_resistance.pressure_exponent=0"
                 " --draw ambient_degC=uniform:20:30 --draw tire.bounded.loss_N=uniform:20:24"
                 " --draw tire.geometry.wheel_mass_kg=uniform:12:16 --design sobol_indices --points 256 --seed 5",
             at);
  run_to_end("campaign run c", at);
  const double mean_loss = 22.0;
  const double variance_loss = 16.0 / 12.0;
  const double variance_ambient = 0.08 * 0.08 / 12.0;
  const double variance = variance_ambient * mean_loss * mean_loss + variance_loss + variance_ambient * variance_loss;
  const double ambient = variance_ambient * mean_loss * mean_loss / variance;
  const double both = variance_ambient * variance_loss / variance;
  const Json found = Json::parse(run_to_end("campaign sensitivity c --result rrc_25degC_2m_N_per_kN --json -", at));
  const std::map<std::string, std::pair<double, double>> expected{
      {"ambient_degC", {ambient, ambient + both}},
      {"tire.bounded.loss_N", {variance_loss / variance, variance_loss / variance + both}},
      {"tire.geometry.wheel_mass_kg", {0.0, 0.0}}};
  REQUIRE(found["factors"].size() == expected.size());
  for (const Json& factor : found["factors"]) {
    const auto& [first, total] = expected.at(factor["key"].get<std::string>());
    INFO(factor.dump());
    CHECK(factor["first"]["low_95"].get<double>() <= first + 1e-9);
    CHECK(factor["first"]["high_95"].get<double>() >= first - 1e-9);
    CHECK(factor["total"]["low_95"].get<double>() <= total + 1e-9);
    CHECK(factor["total"]["high_95"].get<double>() >= total - 1e-9);
    CHECK(factor["first"]["high_95"].get<double>() - factor["first"]["low_95"].get<double>() < 0.35);
  }
}

TEST_CASE("a campaign of diagnoses has what a diagnosis of the folder has", "[slow]") {
  const TemporaryFolder at;
  const std::string example = std::string(ROLLRIG_SOURCE_DIR) + "/assets/examples/hidden_effect";
  for (const char* name : {"sets/one", "sets/two", "sets/broken", "sets/empty"}) {
    std::filesystem::create_directories(at.file("sets"));
    std::filesystem::copy(example, at.file(name), std::filesystem::copy_options::recursive);
  }
  write_file(at.file("sets/empty/tire.toml"), "");
  write_file(at.file("sets/broken/tire.toml"), "format = \"rollrig-tire/2\"\n");
  // Of a tire that fits far worse than others, the diagnosis reads those of the assets.
  std::string tire = read_file(example + "/tire.toml");
  tire.replace(tire.find("A0_N = 32.325"), 13, "A0_N = 60");
  write_file(at.file("sets/two/tire.toml"), tire);
  const std::string options = " --only bearing_warmup,convection_law,torque_gain";
  const ProgramResult alone = run_program("diagnose sets --quiet --json alone.json" + options, at.path());
  CHECK(alone.status == 2);
  const ProgramResult made = run_program("campaign new-diagnoses c sets" + options, at.path());
  CHECK(made.status == 0);
  CHECK_THAT(flatten(made.err), Catch::Contains("this set will fail") && Catch::Contains("is empty"));
  CHECK(run_program("campaign new-diagnoses wrong sets --smallest-effect 200", at.path()).status == 2);
  const int one_part = run_program("campaign run c --shard 3/4", at.path()).status;
  CHECK((one_part == 0 || one_part == 3));  // two of the four sets fail
  CHECK_THAT(run_to_end("campaign summary c", at), Catch::Contains("3 sets not diagnosed yet"));
  CHECK(run_program("campaign run c", at.path()).status == 3);
  const ProgramResult summary = run_program("campaign summary c --json summary.json --html c.html", at.path());
  CHECK(summary.status == 0);
  CHECK_THAT(summary.out, Catch::Contains("Comes back from set to set"));
  const Json of_folder = Json::parse(read_file(at.file("alone.json")));
  const Json of_campaign = Json::parse(read_file(at.file("summary.json")));
  CHECK(of_campaign["recurring"] == of_folder["recurring"]);
  REQUIRE(of_campaign["sets"].size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(of_campaign["sets"][i]["diagnosis"] == of_folder["sets"][i]["diagnosis"]);
    CHECK(of_campaign["sets"][i]["failure"].is_null() == of_folder["sets"][i]["failure"].is_null());
  }
  const std::string csv = run_to_end("campaign export c --csv -", at);
  CHECK_THAT(csv, Catch::Contains("item,set,folder,") && Catch::Contains(",verdict,"));
  CHECK(run_program("campaign sensitivity c --result probability", at.path()).status == 2);
}

TEST_CASE("what is wrong with a campaign is said before anything is made", "[fast]") {
  const TemporaryFolder at;
  for (const char* wrong :
       {"new c iso_28580 --tire a50", "new c iso_28580 --tire a50 --vary ambient_degC=20,900",
        "new c iso_28580 --tire a50 --draw ambient_degC=normal:25:1", "new c iso_28580 --tire a50 --draw-sd tyre",
        "new c iso_28580 --tire a50 --vary ambient_degC=20 --design morris", "run c", "status c", "merge c",
        "new-diagnoses c .", "new-diagnoses c sets --only no_effect", "summary c", "run c --mpi",
        "run c --mpi --shard 1/2", "run c --shard 3/2", "export c --csv c.csv", "sensitivity c --result x",
        "slurm c --tasks 4"}) {
    const ProgramResult result = run_program(std::string("campaign ") + wrong, at.path());
    INFO(wrong << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(at.entry_count() == 0);
  }
}

TEST_CASE("each process of a launcher carries out its share", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20:29:1", at);
  for (const char* id : {"1", "3", "5"}) {
    run_to_end("campaign run c", at,
               std::string("SLURM_ARRAY_TASK_ID=") + id +
                   " SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=5 SLURM_ARRAY_TASK_STEP=2");
  }
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("10 of 10 items done"));
  const std::string job = run_to_end("campaign slurm c --tasks 3", at);
  CHECK_THAT(job, Catch::Contains("#SBATCH --array=1-3") && Catch::Contains("campaign run"));
}

TEST_CASE("a campaign reads the files that it was begun with, and no others", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary ambient_degC=20,25", at);
  for (const char* assets :
       {"ROLLRIG_ASSETS=/nonexistent", "ROLLRIG_ASSETS=", "ROLLRIG_ASSETS=" ROLLRIG_SOURCE_DIR, "ROLLRIG_ASSETS=/"}) {
    const ProgramResult result = run_program("campaign run c --shard 1/2", at.path(), assets);
    INFO(result.err);
    CHECK(result.status != 3);  // nothing may be kept as a failed item
  }
  run_to_end("campaign run c", at);
  CHECK_THAT(run_to_end("campaign status c", at), !Catch::Contains("failed"));
}

TEST_CASE("a tire that another assets folder lacks stops a campaign, and is no failed item", "[fast]") {
  namespace fs = std::filesystem;
  const TemporaryFolder at;
  const std::string assets = at.file("assets");
  fs::copy(std::string(ROLLRIG_SOURCE_DIR) + "/assets", assets, fs::copy_options::recursive);
  fs::copy_file(assets + "/tires/a50.toml", assets + "/tires/own_tire.toml");
  const std::string use = "ROLLRIG_ASSETS=" + assets;
  run_to_end("campaign new c iso_28580 --fidelity quasi_static --vary tire=a40,a50,own_tire --vary load_N=5000,5400",
             at, use);
  const ProgramResult result = run_program("campaign run c", at.path());
  INFO(result.err);
  CHECK(result.status == 2);
  CHECK_THAT(result.err, Catch::Contains("own_tire"));
  run_to_end("campaign run c", at, use);
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("6 of 6 items done") && !Catch::Contains("failed"));
}

TEST_CASE("words that have further files read are carried out before a campaign begins", "[fast]") {
  const TemporaryFolder at;
  // The torque method alone reads the usual sensors, and is no median here.
  run_to_end(std::string("campaign new c ") + kRun + " --vary method=torque,force", at);
  run_to_end("campaign run c", at);
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("2 of 2 items done") && !Catch::Contains("failed"));
}

TEST_CASE("a failed item does not stop the other processes of a launcher", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --draw pressure_kPa=uniform:-100:400 --points 6 --seed 2", at);
  for (const char* rank : {"0", "1"}) {  // mpirun stops all where one ends with another status than 0
    run_to_end("campaign run c --threads 1", at, std::string("OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=") + rank);
  }
  CHECK_THAT(run_to_end("campaign status c", at), Catch::Contains("6 of 6 items done") && Catch::Contains("failed"));
  CHECK(run_program("campaign run c", at.path()).status == 3);
}

TEST_CASE("results of a campaign are not overwritten by what a command writes", "[fast]") {
  const TemporaryFolder at;
  run_to_end(std::string("campaign new c ") + kRun + " --vary load_N=5000,5400", at);
  const std::string results = "c/results_0001_of_0001.sqlite";
  CHECK(run_program("campaign run c --json " + results, at.path()).status == 2);
  CHECK(run_program("campaign export c --csv " + results, at.path()).status == 2);
  CHECK(run_program("campaign status c --json " + results, at.path()).status == 2);
  const std::string csv = run_to_end("campaign export c --csv -", at);
  CHECK_THAT(csv, Catch::StartsWith("item,load_N,start_s") && Catch::Contains(",load_N_2,"));
}
