// The API as a program of somebody else's has it: through the shared library. What it gives is what the command line
// writes.
#include <rollrig/rollrig.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "build_paths.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using nlohmann::json;
using rollrig::tests::read_file;
using rollrig::tests::run_other;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;

namespace {

rollrig::RunInput make_input(const std::string& scenario, const std::vector<std::string>& settings = {}) {
  rollrig::RunInput input;
  input.scenario_or_file = scenario;
  input.tire = "a50";
  input.fidelity = "quasi_static";
  input.settings = settings;
  return input;
}

/// A drum run with sensors, as a set in `folder`.
void write_set(const TemporaryFolder& folder) {
  rollrig::RunInput input = make_input("speed_sweep", {"speeds_km_h=[80,120]", "warm_up_min=10", "settle_min=0"});
  input.sensors = "source";
  const rollrig::Run run(input);
  CHECK(run.writes_set());
  CHECK(run.has_sensors());
  rollrig::write_folder(folder.file("set"), run.carry_out().make_set_files());
}

template <class Call>
rollrig::InputProblem find_problem(const Call& call) {
  try {
    call();
  } catch (const rollrig::InputError& error) {
    return error.problem();
  }
  FAIL("no InputError");
  return {};
}

}  // namespace

TEST_CASE("headers and library are of one version", "[fast]") {
  CHECK(std::string(rollrig::library_version()) == rollrig::kVersion);
}

TEST_CASE("a run gives as data what the command line writes", "[fast]") {
  double last_done = 0.0;
  const rollrig::RunResult result =
      rollrig::Run(make_input("iso_28580")).carry_out([&](double done, const std::string&) {
        CHECK(done >= last_done);
        last_done = done;
      });
  CHECK(last_done == Approx(1.0).margin(0.01));
  const auto told = run_program("run iso_28580 --tire a50 --fidelity quasi_static");
  CHECK(result.text == told.out);
  CHECK(result.json == run_program("run iso_28580 --tire a50 --fidelity quasi_static --json -").out);
  const json written = json::parse(result.json)["result"];
  std::size_t numbers = 0;
  for (const rollrig::ResultValue& at : result.values) {
    INFO(at.name);
    const json::json_pointer place("/" + std::regex_replace(at.name, std::regex("\\."), "/"));  // in an object
    REQUIRE(written.contains(place));
    if (!written[place].is_number()) continue;
    CHECK(at.number == written[place].get<double>());
    CHECK_FALSE(at.label.empty());
    ++numbers;
  }
  CHECK(numbers > 3);
  CHECK(std::abs(result.mechanical_closure) < 1e-3);
  CHECK_THAT(result.make_page(), Contains("<html"));
}

TEST_CASE("a recording has the rows and units of recording.csv", "[fast]") {
  const rollrig::RunResult result = rollrig::Run(make_input("iso_28580")).carry_out();
  const rollrig::Recording recording = result.make_recording();
  std::string csv;
  for (const auto& [name, content] : result.make_files()) {
    if (name == "recording.csv") csv = content;
  }
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == recording.time_s.size() + 1);
  std::string heading = "time_s,phase";
  for (const rollrig::Channel& channel : recording.channels) {
    heading += "," + channel.name;
    CHECK(channel.values.size() == recording.time_s.size());
    if (channel.name == "ambient_degC") CHECK(channel.values.front() == Approx(25.0));
    if (channel.name == "speed_km_h") CHECK(channel.unit == "km/h");
  }
  CHECK(csv.substr(0, csv.find('\n')) == heading);
  for (const std::size_t phase : recording.phase) CHECK(phase < recording.phases.size());
}

TEST_CASE("a mistake says what, where and what is near", "[fast]") {
  const auto scenario = find_problem([] { rollrig::Run(make_input("iso_28581")); });
  CHECK(scenario.key == "scenario");
  CHECK(scenario.value == "iso_28581");
  CHECK(scenario.nearest == "iso_28580");
  const auto setting = find_problem([] { rollrig::Run(make_input("iso_28580", {"presure_kPa=210"})); });
  CHECK(setting.nearest == "pressure_kPa");
  rollrig::RunInput no_tire = make_input("iso_28580");
  no_tire.tire.clear();
  CHECK(find_problem([&] { rollrig::Run{no_tire}; }).key == "--tire");
}

TEST_CASE("a sweep has in each row what its run alone has, whatever the threads", "[fast]") {
  rollrig::SweepInput input;
  input.run = make_input("iso_28580");
  input.axes = {rollrig::read_sweep_axis("pressure_kPa=200:220:20"), {"load_N", {"5000", "6000"}}};
  input.threads = 1;
  const rollrig::SweepResult one = rollrig::Sweep(input).carry_out();
  input.threads = 2;
  const rollrig::SweepResult two = rollrig::Sweep(input).carry_out();
  CHECK(one.json == two.json);
  REQUIRE(one.points.size() == 4);
  CHECK(one.points[1] == std::vector<std::string>{"200", "6000"});
  const auto alone = rollrig::Run(make_input("iso_28580", {"pressure_kPa=200", "load_N=6000"})).carry_out();
  int compared = 0;
  for (const rollrig::ResultValue& at : alone.values) {
    for (std::size_t k = 0; k < one.results.size(); ++k) {
      if (one.results[k] != at.name) continue;
      CHECK(one.values[1][k] == at.number);
      ++compared;
    }
  }
  CHECK(compared > 3);
  CHECK_THROWS_AS(rollrig::read_sweep_axis("pressure_kPa"), rollrig::InputError);
}

TEST_CASE("a set is read with its runs, columns and units, and checked", "[fast]") {
  const TemporaryFolder folder;
  write_set(folder);
  const rollrig::MeasurementSet set(folder.file("set"));
  CHECK(set.kind() == "drum");
  CHECK(set.tire() == "a50");
  const std::vector<rollrig::MeasuredRun> runs = set.list_runs();
  REQUIRE(runs.size() == 2);
  std::vector<double> speeds_km_h;
  for (const rollrig::MeasuredRun& run : runs) {
    for (const rollrig::Channel& column : run.columns) {
      CHECK(column.values.size() == run.time_s.size());
      if (column.name == "speed_km_h") speeds_km_h.push_back(column.values.back());
    }
  }
  REQUIRE(speeds_km_h.size() == 2);
  CHECK(speeds_km_h[0] == Approx(80.0).epsilon(0.01));
  CHECK(speeds_km_h[1] == Approx(120.0).epsilon(0.01));
  const rollrig::FileCheck check = rollrig::check_file(folder.file("set"));
  CHECK(check.is_good);
  CHECK_THAT(check.what, Contains("2 runs"));
  CHECK_THROWS_AS(rollrig::write_folder(folder.file("set"), {{"a", "b"}}), rollrig::InputError);  // it is not empty
}

TEST_CASE("two logs give a set that can be read, the same as from the command line", "[fast]") {
  const TemporaryFolder folder;
  const std::string mapping = ROLLRIG_SOURCE_DIR "/assets/examples/logs/import.toml";
  const rollrig::Report imported = rollrig::import_logs(mapping);
  const auto told = run_program("import " + mapping + " --out " + folder.file("told"));
  CHECK(told.out.rfind(imported.text, 0) == 0);  // what the checks of the set say follows
  const rollrig::FolderFiles files = imported.make_files();
  CHECK(files.size() > 3);
  for (const auto& [name, content] : files) CHECK(content == read_file(folder.file("told/" + name)));
  CHECK(imported.json == read_file(folder.file("told/import.json")));
  rollrig::write_folder(folder.file("joined"), files);
  CHECK_FALSE(rollrig::MeasurementSet(folder.file("joined")).list_runs().empty());
  CHECK_THROWS_AS(rollrig::import_logs(mapping, folder.file("told")), rollrig::InputError);  // no log is there
}

TEST_CASE("an import and the check of a set say how far they are, so that their time can be told", "[fast]") {
  const auto require_shares = [](const std::vector<double>& shares) {
    REQUIRE(shares.size() >= 4);  // after each of them, the time of the rest is known better
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.front() >= 0.0);
    CHECK(shares.back() > 0.5);
    CHECK(shares.back() <= 1.0);
  };
  std::vector<double> shares;
  const auto note = [&shares](double done, const std::string&) { shares.push_back(done); };
  const rollrig::Report imported =
      rollrig::import_logs(ROLLRIG_SOURCE_DIR "/assets/examples/logs/import.toml", "", rollrig::BadRows::kRefuse, note);
  require_shares(shares);
  const TemporaryFolder folder;
  rollrig::write_folder(folder.file("joined"), imported.make_files());
  shares.clear();
  rollrig::check_file(folder.file("joined"), rollrig::BadRows::kRefuse, note);
  require_shares(shares);
}

TEST_CASE("a process that is asked to stop does, until that is taken back", "[fast]") {
  const rollrig::Run run(make_input("iso_28580"));
  rollrig::request_interrupt();
  CHECK_THROWS_AS(run.carry_out(), rollrig::Interrupted);
  rollrig::clear_interrupt();
  CHECK_FALSE(run.carry_out().values.empty());
}

TEST_CASE("a road load has the coefficients of its JSON, with intervals around them", "[fast]") {
  rollrig::RoadLoadFitOptions options;
  options.mass_kg = 1500.0;
  const rollrig::RoadLoad fit = rollrig::fit_road_load(ROLLRIG_SOURCE_DIR "/assets/examples/coastdowns.csv", options);
  REQUIRE(fit.coefficients.size() == 3);
  const std::string text = fit.json;
  CHECK_THAT(text, Contains("\"A_N\""));
  for (const rollrig::ParameterEstimate& at : fit.coefficients) {
    INFO(at.name);
    CHECK(at.low_95 < at.value);
    CHECK(at.value < at.high_95);
    CHECK_FALSE(at.unit.empty());
  }
}

TEST_CASE("a law of SAE J2452 has five coefficients with intervals, and a file for another program", "[fast]") {
  rollrig::RollingLawOptions options;
  options.maximum_load_N = 6570.0;
  options.base_pressure_Pa = 240e3;
  const rollrig::RollingLaw law = rollrig::fit_j2452(ROLLRIG_SOURCE_DIR "/assets/examples/j2452_points.csv", options);
  REQUIRE(law.coefficients.size() == 5);
  // the file was made with these: docs/fit_j2452.md
  const double truth[]{-0.42, 0.93, 0.13, 2.0e-4, 8e-7};
  for (std::size_t i = 0; i < 5; ++i) {
    INFO(law.coefficients[i].name);
    CHECK(law.coefficients[i].low_95 < law.coefficients[i].value);
    CHECK(law.coefficients[i].value < law.coefficients[i].high_95);
    // one draw of the noise: 2.2 standard deviations for c
    CHECK(law.coefficients[i].value == Approx(truth[i]).margin(3.0 * law.coefficients[i].sd));
  }
  const TemporaryFolder folder;
  rollrig::write_folder(folder.file("fitted"), law.make_files());
  const std::string co2mpas = rollrig::export_coefficients(folder.file("fitted"), rollrig::CoefficientTarget::kCo2mpas);
  CHECK_THAT(co2mpas, Contains("\nf0: "));
  CHECK_THROWS_AS(rollrig::export_coefficients(folder.file("fitted"), rollrig::CoefficientTarget::kTir),
                  rollrig::InputError);
  CHECK(rollrig::fit_j1269(ROLLRIG_SOURCE_DIR "/assets/examples/j1269_points.csv", options).coefficients.size() == 4);
}

TEST_CASE("assets are listed, found and described", "[fast]") {
  CHECK(rollrig::list_scenarios().size() > 10);
  CHECK(rollrig::list_effects().size() > 20);
  for (const std::string& folder : rollrig::asset_folders()) {
    for (const std::string& name : rollrig::list_assets(folder)) CHECK_FALSE(rollrig::find_asset(folder, name).empty());
  }
  CHECK(rollrig::describe("iso_28580") == run_program("describe iso_28580").out);
  CHECK(find_problem([] { rollrig::describe("a5O"); }).nearest == "a50");
}

TEST_CASE("a diagnosis and a fit give what the command line writes", "[slow]") {
  const TemporaryFolder folder;
  write_set(folder);
  const rollrig::MeasurementSet set(folder.file("set"));
  rollrig::DiagnosisOptions options;
  options.only = {"bearing_warmup"};
  const rollrig::Diagnosis found = rollrig::diagnose(set, options);
  CHECK(found.json == run_program("diagnose set --only bearing_warmup --json -", folder.path()).out);
  CHECK(found.probability.count("bearing_warmup") == 1);
  CHECK(found.verdict == rollrig::Verdict::kNoGap);
  CHECK(found.make_plan().empty() == found.next_tests.empty());
  const rollrig::TireFit fit = rollrig::fit_tire(set);
  CHECK(fit.json == run_program("fit tire set --json -", folder.path()).out);
  CHECK(fit.suspicion.empty());
  CHECK(fit.parameters.size() > 5);
  const rollrig::FleetDiagnosis fleet = rollrig::diagnose_fleet(rollrig::find_sets(folder.path()), options);
  REQUIRE(fleet.members.size() == 1);
  CHECK(fleet.members[0].findings->probability == found.probability);
}

TEST_CASE("docs show programs as they are compiled", "[fast]") {
  const std::string api = read_file(ROLLRIG_SOURCE_DIR "/docs/api.md");
  for (const char* example : {"examples/campaign.cpp", "examples/diagnose.cpp", "examples/sweep.cpp"}) {
    const std::string source = read_file(ROLLRIG_SOURCE_DIR + ("/" + std::string(example)));
    CHECK_THAT(api, Contains("```cpp\n" + source.substr(source.find("#include")) + "```\n"));
  }
  const std::string program = read_file(ROLLRIG_SOURCE_DIR "/tests/install/program/main.cpp");
  const std::string install = read_file(ROLLRIG_SOURCE_DIR "/docs/install.md");
  CHECK_THAT(install, Contains("```cpp\n" + program.substr(program.find("#include")) + "```\n"));
}

#ifdef ROLLRIG_EXAMPLE_CAMPAIGN
TEST_CASE("the example campaign is shared by two processes, and a third one writes all rows", "[fast]") {
  const TemporaryFolder folder;
  for (const char* rank : {"0", "1"}) {
    const auto part = run_other(ROLLRIG_EXAMPLE_CAMPAIGN, "spread a50", folder.path(),
                                "env OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=" + std::string(rank));
    INFO(part.err);
    REQUIRE(part.status == 0);
    CHECK(part.out == "25 of 25 items done, 0 failed\n");
  }
  CHECK(run_other(ROLLRIG_EXAMPLE_CAMPAIGN, "spread a50", folder.path()).out == "50 of 50 items done, 0 failed\n");
  const std::string table = read_file(folder.file("spread/spread.csv"));
  CHECK(std::count(table.begin(), table.end(), '\n') == 51);
  CHECK_THAT(table, Contains("tire.") && Contains("rrc_N_per_kN"));
  CHECK(run_other(ROLLRIG_EXAMPLE_CAMPAIGN, "other a5O", folder.path()).status == 2);
}
#endif

#ifdef ROLLRIG_EXAMPLE_SWEEP
TEST_CASE("the example sweep prints a row a pressure, falling", "[fast]") {
  const auto run = run_other(ROLLRIG_EXAMPLE_SWEEP, "a60");
  INFO(run.err);
  REQUIRE(run.status == 0);
  std::istringstream rows(run.out);
  double before = 100.0;
  int count = 0;
  for (std::string line; std::getline(rows, line); ++count) {
    const double rrc_N_per_kN = std::stod(line.substr(line.find("kPa") + 3));
    CHECK(rrc_N_per_kN < before);
    before = rrc_N_per_kN;
  }
  CHECK(count == 3);
  CHECK(run_other(ROLLRIG_EXAMPLE_SWEEP, "a6O").status == 2);
}
#endif
