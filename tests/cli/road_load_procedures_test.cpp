#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>

#include "build_paths.h"
#include "sim/core/csv.h"
#include "sim/core/json.h"
#include "tests/cli/longest_line.h"
#include "tests/support/procedure_study.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

using namespace rollrig;
using Catch::Contains;
using tests::longest_line;
using tests::run_program;
using tests::TemporaryFolder;

namespace {

tests::ProcedureStudy make_study(int pairs) {
  tests::ProcedureStudy study;
  study.pairs = pairs;
  study.interval_s = 0.5;
  study.wind_m_s = 1.0;
  return study;
}

/// The example of times through bins, its speeds and its times multiplied.
std::string write_example_bins(double speed_factor, double time_factor) {
  const CsvTable table = CsvTable::read(ROLLRIG_SOURCE_DIR "/assets/examples/coastdown_bins.csv");
  CsvWriter csv(table.columns());
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    for (const std::string& column : table.columns()) {
      const std::string cell = table.text(column)[row];
      const double factor = column == "dt_s" ? time_factor : column.rfind("v_", 0) == 0 ? speed_factor : 1.0;
      if (factor == 1.0) {
        csv.add(cell);
      } else {
        csv.add(factor * std::stod(cell));
      }
    }
    csv.end_row();
  }
  return csv.take();
}

}  // namespace

TEST_CASE("fit road-load by procedures: tables of 80 columns, JSON, points and page", "[fast]") {
  const TemporaryFolder folder;
  tests::ProcedureStudy study = make_study(5);
  tests::write_file(folder.file("wind.csv"), tests::write_procedure_csv(tests::simulate_procedure(study, 1).file.data));
  study.on_board = true;
  tests::write_file(folder.file("air.csv"), tests::write_procedure_csv(tests::simulate_procedure(study, 1).file.data));
  const std::pair<const char*, const char*> cases[]{{"wltp", "wind.csv"}, {"j1263", "wind.csv"}, {"j2263", "air.csv"}};
  for (const auto& [method, file] : cases) {
    INFO(method);
    const std::string command = std::string("fit road-load ") + file + " --mass 1850 --rotating-mass 55.5 --method " +
                                method + " --force --out fitted --html page.html";
    const auto run = run_program(command, folder.path());
    INFO(run.err << run.out);
    REQUIRE(run.status == 0);
    CHECK(longest_line(run.out) <= 80);
    CHECK_THAT(run.out, Contains("scatter of the runs") && Contains("air temperature"));
    CHECK_THAT(tests::read_file(folder.file("page.html")), Contains("scatter of the runs"));
    const Json json = Json::parse(tests::read_file(folder.file("fitted/road_load.json")));
    CHECK(json["format"] == "rollrig-road-load-procedure/2");
    CHECK(json["procedure"] == method);
    CHECK(json["f2_N_per_km_h2"].get<double>() == Approx(0.031).epsilon(0.2));
    CHECK_FALSE(json.contains("uncertainty"));
    const auto asked = run_program(command + " --monte-carlo 300 --seed 5 --threads 1", folder.path());
    REQUIRE(asked.status == 0);
    CHECK(longest_line(asked.out) <= 80);
    CHECK_THAT(asked.out, Contains("Uncertainty of f0:") && Contains("Monte Carlo beside the GUM, 300 trials, seed 5"));
    Json more = Json::parse(tests::read_file(folder.file("fitted/road_load.json")));
    CHECK(more["uncertainty"]["budgets"].size() == (method == std::string("j1263") ? 2 : 3));  // it has no f1
    for (const Json& budget : more["uncertainty"]["budgets"]) {
      const std::string key = budget["key"].get<std::string>();
      CHECK(budget["value"].get<double>() == Approx(json[key].get<double>()).margin(1e-12));
      CHECK(budget["combined_standard_uncertainty"].get<double>() ==
            Approx(json[key + "_sd"].get<double>()).epsilon(0.01).margin(1e-12));
    }
    more.erase("uncertainty");
    CHECK(more == json);
    CHECK(json["f0_N_sd"].get<double>() >= json["sd_of_runs"]["f0_N"].get<double>());
    CHECK(CsvTable::read(folder.file("fitted/points.csv")).has("measured_N"));
  }
}

TEST_CASE("fit road-load by procedures: options and files that do not go together", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("coast.csv"),
                    tests::write_procedure_csv(tests::simulate_procedure(make_study(3), 1).file.data));
  const auto error_of = [&](const std::string& options) {
    const auto run = run_program("fit road-load coast.csv " + options, folder.path());
    INFO(run.out);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(error_of("--method wltp"), Contains("mass is missing"));
  CHECK_THAT(error_of("--method wltpp --mass 1850"), Contains("wltp"));
  CHECK_THAT(error_of("--method wltp --per-mass"), Contains("--per-mass has no meaning"));
  CHECK_THAT(error_of("--mass 1850 --corrected-mass 1800"),
             Contains("--corrected-mass has no meaning") && !Contains("j1263"));
  CHECK_THAT(error_of("--method wltp --mass 1850 --wheel-radius 0.3"), Contains("torque-meter"));
  CHECK_THAT(error_of("--method j1263 --mass 1850 --corrected-mass 1800"), Contains("no correction for the mass"));
  CHECK_THAT(error_of("--method wltp --mass 1850 --monte-carlo 5"), Contains("--monte-carlo"));
  CHECK_THAT(error_of("--method torque-meter --mass 1850"), Contains("column"));
  CHECK_THAT(error_of("--method wltp --mass 1850 --leave-out 9"), Contains("run '9'"));
  CHECK_THAT(error_of("--method wltp --mass 1850 --leave-out 1"),
             Contains("fewer than 3 pairs") && Contains("coast.csv"));
  std::string mixed = tests::read_file(folder.file("coast.csv"));
  mixed.insert(mixed.find('\n'), ",vehicle");
  std::string with_vehicle;
  std::size_t line = 0;
  for (std::size_t at = 0; at < mixed.size(); ++line) {
    const std::size_t end = mixed.find('\n', at);
    with_vehicle += mixed.substr(at, end - at) + (line == 0 ? "" : line < 40 ? ",a" : ",b") + "\n";
    at = end + 1;
  }
  tests::write_file(folder.file("coast.csv"), with_vehicle);
  CHECK_THAT(error_of("--method wltp --mass 1850"), Contains("another vehicle than 'a'") && Contains("line 41"));
}

TEST_CASE("fit road-load: times in minutes are refused by every way to fit, from traces and from bins", "[fast]") {
  const TemporaryFolder folder;
  auto data = tests::simulate_procedure(make_study(3), 1).file.data;
  for (auto& run : data.runs) {
    for (double& time_s : run.time_s) time_s /= 60.0;
  }
  tests::write_file(folder.file("traces.csv"), tests::write_procedure_csv(data));
  tests::write_file(folder.file("bins.csv"), write_example_bins(1.0, 1.0 / 60.0));
  const std::pair<const char*, const char*> files[]{{"traces.csv", "time_s"}, {"bins.csv", "dt_s"}};
  for (const auto& [file, column] : files) {
    for (const char* method : {"", " --method wltp", " --method j1263", " --method j2263"}) {
      INFO(file << method);
      const auto run =
          run_program(std::string("fit road-load ") + file + " --mass 1850 --out fitted" + method, folder.path());
      CHECK(run.status == 2);
      CHECK_THAT(run.err, Contains(file) && Contains(std::string("key      ") + column) && Contains("minutes") &&
                              Contains("m/s2, the median deceleration of the runs"));
      CHECK_FALSE(std::filesystem::exists(folder.file("fitted")));
    }
  }
}

TEST_CASE("fit road-load by procedures: where copies are dropped, an error about headings names them", "[fast]") {
  const TemporaryFolder folder;
  auto data = tests::simulate_procedure(make_study(3), 1).file.data;
  for (std::size_t i = 1; i < data.runs.size(); i += 2) {  // each - run becomes the + run before it
    const std::string id = data.runs[i].id;
    data.runs[i] = data.runs[i - 1];
    data.runs[i].id = id;
    data.runs[i].heading = -1;
  }
  tests::write_file(folder.file("copies.csv"), tests::write_procedure_csv(data));
  for (const char* method : {"wltp", "j1263", "j2263"}) {
    INFO(method);
    const auto run = run_program(std::string("fit road-load copies.csv --mass 1850 --method ") + method, folder.path());
    CHECK(run.status == 2);
    const std::string one_line = std::regex_replace(run.err, std::regex("\\s+"), " ");
    CHECK_THAT(one_line, Contains("all runs have the same heading") &&
                             Contains("Dropped, since each is a copy of another run: 2, 4, 6 "));
  }
}

TEST_CASE("fit road-load: bins in mph are doubted without a procedure, too", "[fast]") {
  const TemporaryFolder folder;
  tests::write_file(folder.file("right.csv"), write_example_bins(1.0, 1.0));
  tests::write_file(folder.file("mph.csv"), write_example_bins(1.0 / 1.609344, 1.0));
  for (const char* file : {"right.csv", "mph.csv"}) {
    const auto run =
        run_program(std::string("fit road-load ") + file + " --mass 2203 --force --json fit.json", folder.path());
    INFO(file << run.err);
    REQUIRE(run.status == 0);
    const std::string warnings = Json::parse(tests::read_file(folder.file("fit.json")))["warnings"].dump();
    const std::string doubt = "All would be usual if they were in mph and not in km/h";
    CHECK((warnings.find(doubt) != std::string::npos) == (file == std::string("mph.csv")));
  }
}

TEST_CASE("fit default-road-load: coefficients, class of a tire, what it is not", "[fast]") {
  const TemporaryFolder folder;
  const auto run = run_program(
      "fit default-road-load --mass 1500 --width 1.8 --height 1.5 --tire-class C1 --rrc 7.3 --html page.html",
      folder.path());
  INFO(run.err << run.out);
  REQUIRE(run.status == 0);
  CHECK(longest_line(run.out) <= 80);
  CHECK_THAT(run.out, Contains("210") && Contains("0.0501") && Contains("7.1 N/kN") && Contains("no measurement"));
  const auto heavy = run_program("fit default-road-load --mass 40000 --width 2.5 --height 4", folder.path());
  CHECK_THAT(heavy.out, Catch::Contains("up to 3500 kg"));
  const auto truck_tires = run_program(
      "fit default-road-load --mass 1500 --width 1.8 --height 1.5 --tire-class C3 --rrc 5.5", folder.path());
  CHECK_THAT(truck_tires.out, Catch::Contains("tires of class C3"));
  const auto json = run_program("fit default-road-load --mass 1500 --width 1.8 --height 1.5 --json -", folder.path());
  CHECK(Json::parse(json.out)["f1_N_per_km_h"] == 0.0);
  CHECK_THAT(
      run_program("fit default-road-load --mass 1500 --width 1.8 --height 1.5 --tire-class C9 --rrc 7", folder.path())
          .err,
      Contains("C9"));
  CHECK_THAT(
      run_program("fit default-road-load --mass 1500 --width 1.8 --height 1.5 --tire-class C1", folder.path()).err,
      Contains("--rrc"));
}
