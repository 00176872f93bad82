// Test reports: what they say and leave blank, that all text of files is escaped, and their pages on A4.
#include <catch2/catch.hpp>
#include <filesystem>

#include "build_paths.h"
#include "include/rollrig/error.h"
#include "report/run_reports.h"
#include "report/test_report.h"
#include "sim/core/file_io.h"
#include "sim/core/json.h"
#include "tests/support/coastdown_study.h"
#include "tests/support/procedure_study.h"
#include "tests/support/run_program.h"

using namespace rollrig;
using namespace rollrig::report;
using tests::read_file;
using tests::run_other;
using tests::run_program;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

/// Runs `rollrig <arguments> --report ... --json ...`, prints the report on A4 and compares its numbers with the JSON.
void check_report_of(const TemporaryFolder& folder, const std::string& arguments, const std::string& asked = "") {
  const auto run = run_program(arguments + " --report report.html --json result.json", folder.path());
  INFO(arguments << '\n' << run.out << run.err);
  REQUIRE(run.status == 0);
  CHECK(run.out.find("test report written to report.html") != std::string::npos);
  const std::string script = std::string(ROLLRIG_SOURCE_DIR) + "/tests/report/check_report.mjs";
  const auto checked = run_other(ROLLRIG_NODE, "'" + script + "' '" + folder.file("report.html") + "' --json '" +
                                                   folder.file("result.json") + "' " + asked);
  INFO(checked.out << checked.err);
  CHECK(checked.status == 0);
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

TestReport make_small_report() {
  TestReport report;
  report.title = "T";
  report.sections = {{"S", {ReportForm{{make_blank("Laboratory"), make_field("Tire", "a")}}}}};
  return report;
}

}  // namespace

TEST_CASE("text of files is escaped wherever it stands in a report", "[fast]") {
  const std::string hostile = "<img src=x onerror='a()'>&\"\x1b";
  TestReport report;
  report.title = report.standard = report.subject = hostile;
  report.warnings = {hostile};
  report.sections = {{hostile,
                      {ReportForm{{ReportField{hostile, {{hostile, hostile}}, hostile}, make_blank(hostile)}},
                       ReportTable{hostile, {hostile}, {{{hostile, hostile}}}, 0}, ReportText{hostile}}}};
  report.files = {{hostile, hostile, hostile}};
  report.origin = {make_field(hostile, hostile)};
  const std::string html = make_report_html(report, "2026-01-01");
  CHECK(html.find("<img") == std::string::npos);
  CHECK(html.find("onerror='") == std::string::npos);
  CHECK(html.find('\x1b') == std::string::npos);
  CHECK(count(html, "&lt;img src=x onerror=&#39;a()&#39;&gt;&amp;&quot;\\x1b") > 15);
}

TEST_CASE("a field that is not known is a line to be filled in by hand, signatures are empty", "[fast]") {
  const std::string html = make_report_html(make_small_report(), "2026-01-01");
  CHECK(html.find("<th scope=\"row\">Laboratory</th><td class=\"blank\">to be filled in by hand</td>") !=
        std::string::npos);
  CHECK(html.find("<th scope=\"row\">Approved by</th><td></td><td></td><td></td>") != std::string::npos);
  CHECK(html.find("No tire and no vehicle was tested") != std::string::npos);
  CHECK(html.find("2026-01-01") != std::string::npos);
  CHECK(html.find("<script") == std::string::npos);
  TestReport measured = make_small_report();
  measured.is_simulated = false;
  CHECK(make_report_html(measured, "2026-01-01").find("simulation") == std::string::npos);
}

TEST_CASE("values of a report come from the JSON with the unit of their key", "[fast]") {
  const Json json = {{"result", {{"load_N", 6865.04}, {"ambient_degC", 25.0}, {"none_N", nullptr}, {"good", true}}}};
  const ReportValues values(json);
  CHECK(values.value("/result/load_N", ".0f").text == "6865 N");
  CHECK(values.number("/result/load_N", ".1f").text == "6865.0");
  CHECK(values.number("/result/load_N").place == "/result/load_N");
  CHECK(values.value("/result/ambient_degC", ".1f").text == "25.0 °C");
  CHECK(values.number("/result/good").text == "yes");
  CHECK_FALSE(values.has("/result/none_N"));
  CHECK_FALSE(values.has("/result/absent/deeper"));
  CHECK(values.field("x", "/result/none_N").values[0].text == "-");
}

TEST_CASE("the date of a report can be given, so that a report is made again to the bit", "[fast]") {
  const TemporaryFolder folder;
  const std::string command = "run iso_28580 --tire a50 --fidelity quasi_static --quiet --report ";
  for (const char* file : {"one.html", "two.html"}) {
    REQUIRE(run_program(command + file, folder.path(), "SOURCE_DATE_EPOCH=86400").status == 0);
  }
  CHECK(read_file(folder.file("one.html")) == read_file(folder.file("two.html")));
  CHECK(read_file(folder.file("one.html")).find("1970-01-02") != std::string::npos);
  const auto bad = run_program(command + "three.html", folder.path(), "SOURCE_DATE_EPOCH=now");
  CHECK(bad.status == 2);
  CHECK(bad.err.find("SOURCE_DATE_EPOCH") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder.file("three.html")));
}

TEST_CASE("only the report of a recording with the manifest of a simulation says that it is simulated", "[fast]") {
  const TemporaryFolder folder;
  tests::ProcedureStudy study;
  study.pairs = 3;
  write_file(folder.file("coast.csv"), tests::write_procedure_csv(tests::simulate_procedure(study, 1).file.data));
  for (const std::string method : {"", " --method wltp", " --method j1263", " --method j2263"}) {
    const auto run = run_program("fit road-load coast.csv --mass 1850" + method + " --quiet --report -", folder.path());
    REQUIRE(run.status == 0);
    CHECK(run.out.find("simulation") == std::string::npos);
  }
  REQUIRE(
      run_program("run coastdown --tire a50 --rig road --fidelity quasi_static --quiet --set pairs=3 --out simulated",
                  folder.path())
          .status == 0);
  for (const std::string method : {"", " --method wltp"}) {
    const auto run = run_program("fit road-load simulated" + method + " --quiet --report -", folder.path());
    REQUIRE(run.status == 0);
    CHECK(run.out.find("come from a simulation") != std::string::npos);
  }
}

TEST_CASE("a report names every file that was read, with its hash", "[fast]") {
  const TemporaryFolder folder;
  const std::string tire = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml");
  write_file(folder.file("mine.toml"), tire);
  const auto run = run_program(
      "run iso_28580 --tire ./mine.toml --sensors source --fidelity quasi_static --quiet --report -", folder.path());
  REQUIRE(run.status == 0);
  CHECK(run.out.find(calc_sha256(tire)) != std::string::npos);
  CHECK(run.out.find(calc_sha256(read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/rigs/drum_2m.toml"))) !=
        std::string::npos);
  CHECK(run.out.find(calc_sha256(read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/sensors/source.toml"))) !=
        std::string::npos);
}

TEST_CASE("the result with an uncertainty is that without", "[fast]") {
  const TemporaryFolder folder;
  const std::string command = "run iso_28580 --tire a50 --fidelity quasi_static --quiet --json ";
  REQUIRE(run_program(command + "plain.json", folder.path()).status == 0);
  REQUIRE(run_program(command + "more.json --monte-carlo 200 --threads 1", folder.path()).status == 0);
  REQUIRE(run_program(command + "again.json --monte-carlo 200 --threads 3", folder.path()).status == 0);
  CHECK(read_file(folder.file("more.json")) == read_file(folder.file("again.json")));
  Json more = Json::parse(read_file(folder.file("more.json")));
  CHECK(more["uncertainty"]["monte_carlo"]["trials"] == 200);
  more.erase("uncertainty");
  CHECK(more == Json::parse(read_file(folder.file("plain.json"))));
}

TEST_CASE("report of an ISO test on A4", "[slow]") {
  check_report_of(TemporaryFolder(), "run iso_28580 --tire a50 --fidelity quasi_static",
                  "--shows 'to be filled in by hand'");
}

TEST_CASE("report of an ISO test of many cycles with Monte Carlo on A4", "[slow]") {
  check_report_of(TemporaryFolder(),
                  "run iso_28580 --tire a50 --fidelity quasi_static --sensors source --set measurement_cycles=40 "
                  "--monte-carlo 2000 --set effects.bearing_warmup.fall_per_K=0.03",
                  "--shows 'repeatability, cycle to cycle'");
}

TEST_CASE("report of an ISO test by the force method on A4", "[slow]") {
  check_report_of(TemporaryFolder(),
                  "run iso_28580 --tire a50 --fidelity quasi_static --set method=force --monte-carlo 1000",
                  "--shows 'angle of the force cell to the load'");
}

TEST_CASE("report of an ISO test on a flat belt on A4", "[slow]") {
  check_report_of(TemporaryFolder(), "run iso_28580 --tire a50 --rig flat_belt --fidelity quasi_static");
}

TEST_CASE("reports of coastdowns on A4", "[slow]") {
  check_report_of(TemporaryFolder(),
                  "run coastdown --tire a50 --fidelity quasi_static --set pairs=3 --monte-carlo 1000");
  check_report_of(TemporaryFolder(), "run coastdown --tire a50 --fidelity quasi_static --rig dyno_1m2");
  tests::CoastdownStudy study;
  study.run_force_sd_N = 3.0;
  const TemporaryFolder folder;
  write_file(folder.file("coastdowns.csv"), tests::write_coastdown_csv(tests::simulate_coastdowns(study, 1)));
  check_report_of(folder, "fit road-load coastdowns.csv --mass 2100", "--shows coastdowns.csv");
  check_report_of(folder, "fit road-load coastdowns.csv --per-mass --monte-carlo 1000 --seed 3");
}

TEST_CASE("a report has class, load index, method and label class where the tire file says them", "[fast]") {
  const TemporaryFolder folder;
  const auto run =
      run_program("run iso_28580 --tire c2_215_65r16c --fidelity quasi_static --set method=force --quiet --report -",
                  folder.path());
  REQUIRE(run.status == 0);
  const auto row = [](const std::string& label) { return "<th scope=\"row\">" + label + "</th>"; };
  CHECK(run.out.find(row("Tire class") + "<td><span>C2</span></td>") != std::string::npos);
  CHECK(run.out.find(row("Load index and speed symbol") + "<td>") != std::string::npos);
  CHECK(run.out.find(row("Load index and speed symbol") + "<td class=\"blank\">") == std::string::npos);
  CHECK(run.out.find("data-json=\"/result/method\"") != std::string::npos);
  CHECK(run.out.find("data-json=\"/result/label_class\"") != std::string::npos);
  CHECK(run.out.find("data-json=\"/result/methods/2/rolling_resistance_N\"") != std::string::npos);
}

TEST_CASE("a report of another method than torque has the budget of that method", "[fast]") {
  const TemporaryFolder folder;
  const auto run = run_program(
      "run iso_28580 --tire a50 --fidelity quasi_static --quiet --set method=deceleration --report - ", folder.path());
  REQUIRE(run.status == 0);
  CHECK(run.out.find("data-json=\"/result/method\"") != std::string::npos);
  CHECK(run.out.find("/uncertainty/budgets/0") != std::string::npos);
  CHECK(run.out.find("inertias of drum and wheel") != std::string::npos);
}

TEST_CASE("reports of laws of rolling resistance on A4", "[slow]") {
  const std::string examples = std::string(ROLLRIG_SOURCE_DIR) + "/assets/examples/";
  const std::string tire = " --maximum-load 6570 --base-pressure 240";
  check_report_of(TemporaryFolder(), "fit j2452 '" + examples + "j2452_points.csv'" + tire + " --monte-carlo 500",
                  "--shows SMERF");
  check_report_of(TemporaryFolder(), "fit j2452 '" + examples + "j2452_points.csv'",
                  "--shows 'maximum load or base pressure is not known'");
  check_report_of(TemporaryFolder(), "fit j1269 '" + examples + "j1269_points.csv'" + tire, "--shows J1269");
  const TemporaryFolder folder;
  REQUIRE(run_program("run sae_j2452 --tire c1_205_55r16 --rig drum_1m7 --fidelity quasi_static --out coastdown",
                      folder.path())
              .status == 0);
  check_report_of(folder, "fit j2452 coastdown", "--shows 'come from a simulation'");
}

TEST_CASE("reports of road loads by procedures on A4", "[slow]") {
  tests::ProcedureStudy study;
  study.wind_m_s = 1.0;
  study.run_force_sd_N = 3.0;
  const TemporaryFolder folder;
  write_file(folder.file("wind.csv"), tests::write_procedure_csv(tests::simulate_procedure(study, 1).file.data));
  study.on_board = true;
  write_file(folder.file("air.csv"), tests::write_procedure_csv(tests::simulate_procedure(study, 1).file.data));
  const std::string mass = " --mass 1850 --rotating-mass 55.5 --method ";
  check_report_of(folder, "fit road-load wind.csv" + mass + "wltp --monte-carlo 1000", "--shows 'Reference speeds'");
  check_report_of(folder, "fit road-load wind.csv" + mass + "j1263", "--shows 'SAE J1263'");
  check_report_of(folder, "fit road-load air.csv" + mass + "j2263", "--shows 'air speed'");
}

TEST_CASE("report of a multi-cycle test on A4", "[slow]") {
  check_report_of(TemporaryFolder(), "run sae_j1634 --tire a50 --fidelity quasi_static",
                  "--shows 'Dynamometer setting A'");
  check_report_of(TemporaryFolder(),
                  "run sae_j1634 --tire a50 --vehicle volvo_ex30 --rig road --fidelity quasi_static --set mid_min=170",
                  "--shows 'label range'");
}

TEST_CASE("report of a tire whose names are long and hold a script on A4", "[slow]") {
  const TemporaryFolder folder;
  const std::string name = "<img src=x onerror=attacked=1>" + std::string(60, 'W') + "</td></table>";
  std::string tire = read_file(std::string(ROLLRIG_SOURCE_DIR) + "/assets/tires/a50.toml");
  const std::size_t at = tire.find("name");
  tire.replace(at, tire.find('\n', at) - at, "name = '" + name + "'");
  write_file(folder.file("mine.toml"), tire);
  check_report_of(folder, "run iso_28580 --tire ./mine.toml --fidelity quasi_static", "--shows '" + name + "'");
}
