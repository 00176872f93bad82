// What is exported: every number of the files, none made on the way.
#include <catch2/catch.hpp>
#include <cmath>

#include "build_paths.h"
#include "exports/tree.h"
#include "sim/core/error.h"
#include "tests/exports/exported_run.h"

using namespace rollrig;
using exports::Column;
using exports::Group;
using exports::List;
using exports::Node;
using exports::Texts;

namespace {

template <class Value>
const Value& member(const Group& group, const std::string& name) {
  for (const auto& [key, node] : group.members) {
    if (key == name) return std::get<Value>(node.value);
  }
  throw std::out_of_range("no member " + name);
}

}  // namespace

TEST_CASE("a result folder becomes recording, result and manifest", "[fast]") {
  const tests::ExportedRun run;
  const Group tree = exports::read_source(run.result());
  CHECK(member<std::string>(tree, "source") == "result");
  CHECK(member<std::string>(tree, "manifest") == tests::read_file(run.result() + "/manifest.json"));
  const CsvTable csv = run.recording();
  const auto& recording = member<Group>(tree, "recording");
  CHECK(recording.is_table);
  CHECK(recording.members.size() == csv.columns().size());
  CHECK(member<Texts>(recording, "phase") == csv.text("phase"));
  CHECK(member<Column>(recording, "load_N") == csv.plain_numbers("load_N", {}));
  const Json json = Json::parse(tests::read_file(run.result() + "/result.json"));
  const auto& result = member<Group>(tree, "result");
  CHECK(member<std::string>(result, "scenario") == "warm_up");
  for (const auto& [key, value] : json["energy"]["terms_J"].items()) {
    CHECK(member<double>(member<Group>(member<Group>(result, "energy"), "terms_J"), key) == value.get<double>());
  }
  CHECK(member<Texts>(member<Group>(result, "phases"), "name").size() == json["phases"].size());
}

TEST_CASE("a set becomes a group a run, with the units of its files", "[fast]") {
  const tests::ExportedRun run;
  for (const std::string& path : {run.set(), run.set() + "/set.toml"}) {
    const Group tree = exports::read_source(path);
    CHECK(member<std::string>(tree, "source") == "measurements");
    const auto& sensors = member<Group>(member<Group>(tree, "set"), "sensors");
    CHECK(member<double>(member<Group>(sensors, "drum_torque_Nm"), "noise_sd") > 0.0);
    CHECK(member<double>(member<Group>(member<Group>(tree, "tire"), "rolling_resistance"), "pressure_exponent") == 0.4);
    const auto& runs = member<Group>(tree, "runs");
    REQUIRE(runs.members.size() == 1);
    const auto& first = std::get<Group>(runs.members[0].second.value);
    CHECK(member<double>(first, "initial_tire_temperature_degC") == 25.0);  // not kelvin
    const CsvTable csv = CsvTable::read(run.set() + "/" + member<std::string>(first, "file"));
    const auto& torque = member<Column>(member<Group>(first, "recording"), "drum_torque_Nm");
    const Column wanted = csv.plain_numbers("drum_torque_Nm", {});
    REQUIRE(torque.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      CHECK((torque[i] == wanted[i] || (std::isnan(torque[i]) && std::isnan(wanted[i]))));
    }
  }
}

TEST_CASE("arrays of JSON: numbers, texts, tables, and lists of what is left", "[fast]") {
  const Node node = exports::make_node(Json::parse(R"({
    "numbers": [1.5, null], "texts": ["a", "b"], "none": [], "flag": true,
    "table": [{"name": "a", "x_N": 1}, {"name": "b", "x_N": null}],
    "uneven": [{"x": 1}, {"y": 2}], "deep": [{"x": [1, 2]}, {"x": [3]}]})"));
  const auto& group = std::get<Group>(node.value);
  CHECK(member<Column>(group, "numbers")[0] == 1.5);
  CHECK(std::isnan(member<Column>(group, "numbers")[1]));
  CHECK(member<Texts>(group, "texts") == Texts{"a", "b"});
  CHECK(member<Column>(group, "none").empty());
  CHECK(member<bool>(group, "flag"));
  const auto& table = member<Group>(group, "table");
  CHECK(table.is_table);
  CHECK(member<Texts>(table, "name") == Texts{"a", "b"});
  CHECK(std::isnan(member<Column>(table, "x_N")[1]));
  CHECK(member<List>(group, "uneven").items.size() == 2);
  CHECK(member<List>(group, "deep").items.size() == 2);
}

TEST_CASE("what is not a result says so", "[fast]") {
  const tests::ExportedRun run;
  tests::write_file(run.result() + "/result.json", "{\n\"format\": \"rollrig-result/1\",\n]");
  CHECK_THROWS_WITH(exports::read_source(run.result()), Catch::Contains("not JSON") && Catch::Contains("line 3"));
  tests::write_file(run.result() + "/result.json", R"({"format": "rollrig-diagnosis/1"})");
  CHECK_THROWS_WITH(exports::read_source(run.result()), Catch::Contains("rollrig-result/1"));
}

TEST_CASE("a set with bad rows is exported as it is used, with a list of what was left out", "[fast]") {
  const std::string path = ROLLRIG_SOURCE_DIR "/tests/bad_input/set_bad_rows.set";  // 60 rows, three of them bad
  CHECK_THROWS_AS(exports::read_source(path), InputError);
  std::vector<std::string> warnings;
  const Group tree = exports::read_source(path, BadRows::kLeaveOut, &warnings);
  CHECK(warnings.size() == 1);
  const auto& run = member<Group>(member<Group>(tree, "runs"), "a");
  const auto& recording = member<Group>(run, "recording");
  CHECK(recording.is_table);
  const auto& times = member<Column>(recording, "time_s");
  REQUIRE(times.size() == 57);
  CHECK(times[8] == 9.0);
  CHECK(member<Column>(recording, "speed_km_h")[8] == Approx(80.0));
  CHECK(member<Column>(recording, "ambient_degC")[8] == Approx(25.0));
  CHECK(std::isnan(member<Column>(recording, "drum_torque_Nm")[8]));
  CHECK(member<Column>(recording, "drum_torque_Nm")[12] == 40.0);
  const auto& list = member<List>(tree, "bad_rows");
  REQUIRE(list.items.size() == 1);
  CHECK(member<double>(std::get<Group>(list.items[0].value), "rows_left_out") == 3.0);
}
