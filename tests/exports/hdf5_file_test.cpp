// Files read back with the library itself.
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "exports/tree.h"
#include "tests/exports/exported_run.h"

using namespace rollrig;
using exports::Column;
using exports::Group;
using exports::List;
using exports::Node;
using exports::Texts;

namespace {

/// An HDF5 file on disk, by paths such as "/recording/load_N".
class File {
 public:
  explicit File(const std::string& path) : id_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    REQUIRE(id_ >= 0);
  }
  ~File() { H5Fclose(id_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  Column numbers(const std::string& path) const {
    const hid_t set = open(path);
    Column values(count(set));
    CHECK(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    H5Dclose(set);
    return values;
  }

  Texts texts(const std::string& path) const {
    const hid_t set = open(path);
    const hid_t type = H5Dget_type(set);
    const std::size_t length = H5Tget_size(type);
    std::string cells(length * count(set), '\0');
    CHECK(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()) >= 0);
    H5Tclose(type);
    H5Dclose(set);
    Texts texts;
    for (std::size_t at = 0; at < cells.size(); at += length) texts.push_back(cells.substr(at, length).c_str());
    return texts;
  }

  std::string unit(const std::string& path) const {
    const hid_t set = open(path);
    std::string unit;
    if (H5Aexists(set, "unit") > 0) {
      const hid_t attribute = H5Aopen(set, "unit", H5P_DEFAULT);
      const hid_t type = H5Aget_type(attribute);
      unit.resize(H5Tget_size(type));
      CHECK(H5Aread(attribute, type, unit.data()) >= 0);
      H5Tclose(type);
      H5Aclose(attribute);
    }
    H5Dclose(set);
    return unit;
  }

  bool has(const std::string& path) const { return H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0; }

 private:
  hid_t open(const std::string& path) const {
    INFO(path);
    const hid_t set = H5Dopen2(id_, path.c_str(), H5P_DEFAULT);
    REQUIRE(set >= 0);
    return set;
  }

  static std::size_t count(hid_t set) {
    const hid_t space = H5Dget_space(set);
    const auto size = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    H5Sclose(space);
    return size;
  }

  hid_t id_;
};

}  // namespace

TEST_CASE("HDF5 holds the recording to the bit, with units, phases, results and manifest", "[fast]") {
  const tests::ExportedRun run;
  const auto exported = tests::run_program("export result --hdf5 run.h5", run.folder().path());
  REQUIRE(exported.status == 0);
  CHECK_THAT(exported.out, Catch::Contains("run.h5"));
  const File file(run.folder().file("run.h5"));
  const CsvTable csv = run.recording();
  for (const std::string& column : csv.columns()) {
    if (column == "phase") continue;
    INFO(column);
    const Column wanted = csv.plain_numbers(column, {});
    const Column got = file.numbers("/recording/" + column);
    REQUIRE(got.size() == wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (got[i] != wanted[i] && !(std::isnan(got[i]) && std::isnan(wanted[i]))) FAIL("row " << i);
    }
  }
  CHECK(file.texts("/recording/phase") == csv.text("phase"));
  CHECK(file.unit("/recording/speed_km_h") == "km/h");
  CHECK(file.unit("/recording/liner_temperature_degC") == "degC");
  CHECK(file.texts("/manifest") == Texts{tests::read_file(run.result() + "/manifest.json")});
  const Json json = Json::parse(tests::read_file(run.result() + "/result.json"));
  for (const auto& [key, value] : json["result"].items()) {
    if (value.is_number()) CHECK(file.numbers("/result/result/" + key) == Column{value.get<double>()});
  }
  for (std::size_t i = 0; i < json["phases"].size(); ++i) {
    CHECK(file.texts("/result/phases/name")[i] == json["phases"][i]["name"].get<std::string>());
    CHECK(file.numbers("/result/phases/start_s")[i] == json["phases"][i]["start_s"].get<double>());
  }
}

TEST_CASE("HDF5 holds what else a tree can have", "[fast]") {
  Group inner;
  inner.add("a/b", {1.0});
  inner.add("a_b", {2.0});
  inner.add("empty", {std::string()});
  inner.add("no numbers", {Column{}});
  inner.add("no texts", {Texts{}});
  inner.add("\xC2\xA7", {Texts{"\xC2\xA7 3", ""}});
  inner.add("yes", {true});
  inner.add("list", {List{{Node{1.0}, Node{std::string("two")}}}});
  inner.add("empty list", {List{}});
  inner.add("empty group", {Group{}});
  Group tree;
  tree.add("inner", {inner});
  const std::string bytes = exports::make_hdf5(tree);
  CHECK(bytes == exports::make_hdf5(tree));
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("tree.h5"), bytes);
  const File file(folder.file("tree.h5"));
  CHECK(file.numbers("/inner/a_b") == Column{1.0});
  CHECK(file.numbers("/inner/a_b_2") == Column{2.0});
  CHECK(file.unit("/inner/a_b").empty());
  CHECK(file.texts("/inner/empty") == Texts{""});
  CHECK(file.numbers("/inner/no numbers").empty());
  CHECK(file.texts("/inner/no texts").empty());
  CHECK(file.texts("/inner/\xC2\xA7") == Texts{"\xC2\xA7 3", ""});
  CHECK(file.numbers("/inner/list/0") == Column{1.0});
  CHECK(file.texts("/inner/list/1") == Texts{"two"});
  for (const char* path : {"/inner/yes", "/inner/empty list", "/inner/empty group"}) CHECK(file.has(path));
}

TEST_CASE("HDF5 of a set has a group a run", "[fast]") {
  const tests::ExportedRun run;
  REQUIRE(tests::run_program("export set --hdf5 set.h5 --quiet", run.folder().path()).status == 0);
  const File file(run.folder().file("set.h5"));
  CHECK(file.numbers("/runs/warm-up-80/cold_pressure_kPa") == Column{250.0});
  CHECK(file.unit("/runs/warm-up-80/recording/drum_torque_Nm") == "N m");
  CHECK(file.has("/tire/thermal"));
}
