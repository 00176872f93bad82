// rollrig import as users meet it: a set torn into two logs on other clocks comes back as it was.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "build_paths.h"
#include "measurements/measurement_set.h"
#include "tests/support/run_program.h"

namespace fs = std::filesystem;
using Catch::Contains;
using nlohmann::json;
using namespace rollrig;
using tests::read_file;
using tests::run_program;
using tests::TemporaryFolder;
using tests::write_file;

namespace {

constexpr double kShift_s = -37.4;
constexpr double kRate = 60e-6;

std::string with_comma(double value, int digits = 9) {
  std::string text = std::isnan(value) ? "" : fmt::format("{:.{}g}", value, digits);
  for (char& c : text) c = c == '.' ? ',' : c;
  return text;
}

/// Torque log: clock time, semicolons, decimal commas, kN. Tire log: spreadsheet days, bar, on a clock that is
/// kShift_s behind and slower by kRate.
void tear(const measurements::MeasuredRun& run, const std::string& folder, bool load_in_both) {
  std::string torque = "Prüfstand 3\nUhrzeit;v;Last;Luft;Moment\n;km/h;kN;°C;Nm\n";
  std::string tire = load_in_both ? "day,T,p,F\n" : "day,T,p\n";
  const auto cell = [&run](const char* column, std::size_t row) {
    return unit_of_key(column).from_si(run.columns.at(column)[row]);
  };
  const auto plain = [](double value) { return std::isnan(value) ? std::string("---") : fmt::format("{:.9g}", value); };
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double day_s = 8.0 * 3600.0 + run.time_s[row];
    const int whole = static_cast<int>(day_s + 1e-6);
    torque += fmt::format("{:02}:{:02}:{:02},{:03};{};{};{};{}\n", whole / 3600, whole / 60 % 60, whole % 60,
                          static_cast<int>(std::lround(1e3 * (day_s - whole))), with_comma(cell("speed_km_h", row)),
                          with_comma(1e-3 * cell("load_N", row)), with_comma(cell("ambient_degC", row)),
                          with_comma(cell("drum_torque_Nm", row)));
    const double tire_s = (day_s - 8.0 * 3600.0 - kShift_s) / (1.0 + kRate) + 8.0 * 3600.0;
    tire += fmt::format("{:.10f},{},{}", 45356.0 + tire_s / 86400.0, plain(cell("liner_temperature_degC", row)),
                        plain(0.01 * cell("cavity_pressure_kPa", row)));
    tire += load_in_both ? fmt::format(",{:.1f}\n", cell("load_N", row)) : "\n";
  }
  write_file(folder + "/torque.csv", torque);
  write_file(folder + "/tire.csv", tire);
}

const char* const kMapping = R"(format = "rollrig-import/1"
name = "joined"
tire = "set/tire.toml"
rig = "set/rig.toml"
sensors = "source"
[torque_log]
separator = "semicolon"
decimal = "comma"
header_line = 2
first_row_line = 4
time = { column = "Uhrzeit", form = "clock", date = "2024-03-05" }
[torque_log.columns]
speed_km_h = "v"
load_N = { column = "Last", unit = "kN" }
ambient_degC = "Luft"
drum_torque_Nm = "Moment"
[tire_log]
time = { column = "day", form = "spreadsheet_days" }
[tire_log.columns]
liner_temperature_degC = "T"
cavity_pressure_kPa = { column = "p", unit = "bar" }
)";

/// A folder with "set" as simulated, its two logs and the mapping.
struct TornSet {
  TemporaryFolder folder;
  measurements::MeasurementSet set;

  explicit TornSet(bool load_in_both, const std::string& effects = "") {
    const auto made =
        run_program("run transient_skim --tire a50 --sensors source --set repeats=3 --write-set set --quiet " + effects,
                    folder.path());
    INFO(made.err);
    REQUIRE(made.status == 0);
    set = measurements::read_measurement_set(folder.file("set"));
    REQUIRE(set.runs.size() == 1);
    tear(set.runs[0], folder.path(), load_in_both);
    write_file(
        folder.file("import.toml"),
        kMapping + std::string(load_in_both ? "load_N = \"F\"\n" : "") +
            fmt::format("[clock]\nload_changes = \"at_rows\"\nlargest_shift_s = 120\n[[run]]\nid = \"skims\"\n"
                        "session = \"session\"\ntorque_log = \"torque.csv\"\ntire_log = \"tire.csv\"\n"
                        "initial_tire_temperature_degC = {:.10g}\ncold_pressure_kPa = {:.10g}\n",
                        set.runs[0].initial_tire_temperature_K - kZeroCelsius_K, set.runs[0].cold_pressure_Pa / 1e3));
  }
  json import_it(const std::string& options = "") const {
    const auto run = run_program("import import.toml --out joined --json - " + options, folder.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  }
  json diagnose(const std::string& name) const {
    const auto run =
        run_program("diagnose " + name + " --only bearing_warmup,clock_shift,load_exponent --json -", folder.path());
    INFO(run.err);
    REQUIRE(run.status == 0);
    return json::parse(run.out);
  }
};

}  // namespace

TEST_CASE("a set torn into two logs comes back as it was", "[slow]") {
  for (const bool load_in_both : {false, true}) {
    const TornSet torn(load_in_both);
    const json report = torn.import_it();
    const json& clock = report["clocks"][0];
    INFO(clock.dump(2));
    CHECK(clock["method"] == (load_in_both ? "common" : "response"));
    // At the start of the run the clocks are kShift_s apart.
    const double since_start_s = clock["at_tire_log_s"].get<double>() - (45356.0 - 25569.0) * 86400.0 - 8.0 * 3600.0;
    const double truth_s = kShift_s + kRate * since_start_s;
    CHECK(std::abs(clock["shift_s"].get<double>() - truth_s) < 2.6 * clock["shift_sd_s"].get<double>());
    const measurements::MeasurementSet joined = measurements::read_measurement_set(torn.folder.file("joined"));
    const measurements::MeasuredRun& before = torn.set.runs[0];
    const measurements::MeasuredRun& after = joined.runs[0];
    REQUIRE(after.time_s.size() == before.time_s.size());
    double largest_K = 0.0;
    for (std::size_t row = 1; row + 1 < before.time_s.size(); ++row) {
      for (const char* column : {"speed_km_h", "load_N", "drum_torque_Nm"}) {
        CHECK(after.columns.at(column)[row] == Approx(before.columns.at(column)[row]));
      }
      const double difference_K =
          after.columns.at("liner_temperature_degC")[row] - before.columns.at("liner_temperature_degC")[row];
      if (!std::isnan(difference_K)) largest_K = std::max(largest_K, std::abs(difference_K));
    }
    CHECK(largest_K < 1.0);  // noise of 0.1 K, and what a warm-up of 0.05 K/s does in some seconds
  }
}

TEST_CASE("the diagnosis of a joined set says what that of the set itself says", "[slow]") {
  struct Case {
    const char* effects;
    bool load_in_both;
  };
  for (const Case& one : {Case{"", true}, Case{"", false}, Case{"--set effects.bearing_warmup.fall_per_K=0.02", true},
                          Case{"--set effects.bearing_warmup.fall_per_K=0.02", false}}) {
    const TornSet torn(one.load_in_both, one.effects);
    torn.import_it();
    const json before = torn.diagnose("set");
    const json after = torn.diagnose("joined");
    INFO(one.effects << " " << before["probability"].dump() << " " << after["probability"].dump());
    CHECK(after["verdict"] == before["verdict"]);
    REQUIRE(after["causes"].empty() == before["causes"].empty());
    if (!before["causes"].empty()) CHECK(after["causes"][0]["effects"] == before["causes"][0]["effects"]);
  }
}

TEST_CASE("spikes and gaps become empty fields and stand in the report", "[slow]") {
  const TornSet torn(true);
  std::string tire = read_file(torn.folder.file("tire.csv"));
  std::vector<std::size_t> starts{0};
  for (std::size_t at = tire.find('\n'); at + 1 < tire.size(); at = tire.find('\n', at + 1)) starts.push_back(at + 1);
  const std::size_t comma = tire.find(',', starts[700]);
  const std::string broken = tire.substr(0, comma + 1) + "99.9" + tire.substr(tire.find(',', comma + 1));
  write_file(torn.folder.file("tire.csv"),
             broken.substr(0, starts[300]) + broken.substr(starts[310]));  // lines 301 to 310 are lost
  const json report = torn.import_it();
  const json& marks = report["logs"][1]["marks"];
  bool gap = false, spike = false;
  for (const json& mark : marks) {
    gap = gap || (mark["reason"] == "no rows" && mark["line"] == 300);
    spike = spike || (mark["reason"] == "spike" && mark["line"] == 691 && mark["value"] == 99.9);
    CHECK((mark["reason"] != "spike" || mark["line"] == 691));
  }
  CHECK(gap);
  CHECK(spike);
  bool gap_rows = false, spike_rows = false;
  for (const json& range : report["runs"][0]["empty"]) {
    gap_rows = gap_rows || (range["reason"] == "no rows" && range["rows"] >= 10 && range["rows"] <= 12);
    spike_rows = spike_rows || (range["reason"] == "spike" && range["rows"] <= 2);
  }
  CHECK(gap_rows);
  CHECK(spike_rows);
  const measurements::MeasurementSet joined = measurements::read_measurement_set(torn.folder.file("joined"));
  for (const double value : joined.runs[0].columns.at("liner_temperature_degC")) {
    CHECK((std::isnan(value) || value < 350.0));  // K
  }
}

TEST_CASE("an import writes a whole folder, and only where it may", "[slow]") {
  const TornSet torn(true);
  torn.import_it("--quiet");
  for (const char* file : {"set.toml", "tire.toml", "rig.toml", "skims.csv", "marks.csv", "import.json"}) {
    CHECK(fs::exists(torn.folder.file(std::string("joined/") + file)));
  }
  CHECK(run_program("validate joined", torn.folder.path()).status == 0);
  const auto again = run_program("import import.toml --out joined", torn.folder.path());
  CHECK(again.status == 2);
  CHECK_THAT(again.err, Contains("--force"));
  const auto forced = run_program("import import.toml --out joined --force", torn.folder.path());
  CHECK(forced.status == 0);
  CHECK_THAT(forced.out, Contains("shift") && Contains("ppm") && Contains("run skims"));
}

TEST_CASE("the example is imported", "[slow]") {
  const TemporaryFolder folder;
  const fs::path example = fs::path(ROLLRIG_SOURCE_DIR) / "assets/examples/logs/import.toml";
  const auto run = run_program("import " + example.string() + " --out joined", folder.path());
  INFO(run.err << run.out);
  CHECK(run.status == 0);
  const json report = json::parse(read_file(folder.file("joined/import.json")));
  const json& clock = report["clocks"][0];
  CHECK(std::abs(clock["shift_s"].get<double>() - 93.7) < 3.0 * clock["shift_sd_s"].get<double>());
  CHECK(run_program("validate joined", folder.path()).status == 0);
}

TEST_CASE("a unit that the mapping leaves out is told once the set is written", "[slow]") {
  const TemporaryFolder folder;
  const fs::path example = fs::path(ROLLRIG_SOURCE_DIR) / "assets/examples/logs";
  fs::copy(example, folder.file("logs"));
  std::string mapping = read_file(folder.file("logs/import.toml"));
  const std::string unit = R"({ column = "p", unit = "bar" })";
  mapping.replace(mapping.find(unit), unit.size(), R"("p")");
  write_file(folder.file("logs/import.toml"), mapping);
  const auto run = run_program("import logs/import.toml --out joined", folder.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("cavity_pressure_kPa holds bar"));
}
