// Files read back with the library itself.
#include <matio.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "exports/tree.h"
#include "tests/exports/exported_run.h"

using namespace rollrig;
using exports::Column;
using exports::Group;
using exports::List;
using exports::Node;
using exports::Texts;

namespace {

using MatFile = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

MatFile open(const std::string& path) {
  MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  REQUIRE(file);
  return file;
}

Variable read(const MatFile& file, const char* name) {
  Variable variable(Mat_VarRead(file.get(), name), Mat_VarFree);
  INFO(name);
  REQUIRE(variable);
  return variable;
}

matvar_t& field(matvar_t& structure, const std::string& name) {
  matvar_t* found = Mat_VarGetStructFieldByName(&structure, name.c_str(), 0);
  INFO(name);
  REQUIRE(found != nullptr);
  return *found;
}
matvar_t& field(const Variable& structure, const std::string& name) { return field(*structure, name); }

Column numbers(const matvar_t& variable) {
  REQUIRE(variable.class_type == MAT_C_DOUBLE);
  const auto* data = static_cast<const double*>(variable.data);
  return {data, data + variable.dims[0] * variable.dims[1]};
}

/// Of characters in UTF-16 that are ASCII, or '?'.
std::string text(const matvar_t& variable) {
  REQUIRE(variable.class_type == MAT_C_CHAR);
  std::string text;
  const std::size_t size = variable.dims[0] * variable.dims[1];
  for (std::size_t i = 0; i < size; ++i) {
    const unsigned code = variable.data_size == 1 ? static_cast<const unsigned char*>(variable.data)[i]
                                                  : static_cast<const std::uint16_t*>(variable.data)[i];
    text += code < 128 ? static_cast<char>(code) : '?';
  }
  return text;
}

Texts texts(matvar_t& cell) {
  REQUIRE(cell.class_type == MAT_C_CELL);
  Texts all;
  for (std::size_t i = 0; i < cell.dims[0]; ++i) all.push_back(text(*Mat_VarGetCell(&cell, static_cast<int>(i))));
  return all;
}

}  // namespace

TEST_CASE(".mat holds the recording to the bit, with units, phases, results and manifest", "[fast]") {
  const tests::ExportedRun run;
  REQUIRE(tests::run_program("export result --mat run.mat --hdf5 run.h5", run.folder().path()).status == 0);
  const MatFile file = open(run.folder().file("run.mat"));
  const Variable recording = read(file, "recording");
  const CsvTable csv = run.recording();
  for (const std::string& column : csv.columns()) {
    if (column == "phase") continue;
    INFO(column);
    const Column wanted = csv.plain_numbers(column, {});
    const Column got = numbers(field(recording, column));
    REQUIRE(got.size() == wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (got[i] != wanted[i] && !(std::isnan(got[i]) && std::isnan(wanted[i]))) FAIL("row " << i);
    }
  }
  CHECK(texts(field(recording, "phase")) == csv.text("phase"));
  CHECK(text(field(field(recording, "units"), "speed_km_h")) == "km/h");
  CHECK(text(*read(file, "manifest")) == tests::read_file(run.result() + "/manifest.json"));
  const Json json = Json::parse(tests::read_file(run.result() + "/result.json"));
  const Variable result = read(file, "result");
  for (const auto& [key, value] : json["result"].items()) {
    if (value.is_number()) CHECK(numbers(field(field(result, "result"), key)) == Column{value.get<double>()});
  }
  CHECK(texts(field(field(result, "phases"), "name")).at(0) == json["phases"][0]["name"].get<std::string>());
}

TEST_CASE(".mat holds what else a tree can have, under names that MATLAB reads", "[fast]") {
  Group inner;
  inner.add("run 1/2", {1.0});
  inner.add("run_1_2", {2.0});
  inner.add("2nd", {3.0});
  inner.add(std::string(70, 'n'), {4.0});
  inner.add("empty", {std::string()});
  inner.add("none", {Column{}});
  inner.add("no_texts", {Texts{}});
  inner.add("section", {Texts{"\xC2\xA7 3", ""}});
  inner.add("yes", {true});
  inner.add("list", {List{{Node{1.0}, Node{std::string("two")}}}});
  inner.add("empty_group", {Group{}});
  Group tree;
  tree.add("inner", {inner});
  tree.add("last", {std::string("end")});
  const std::string bytes = exports::make_mat(tree);
  CHECK(bytes == exports::make_mat(tree));
  const tests::TemporaryFolder folder;
  tests::write_file(folder.file("tree.mat"), bytes);
  const MatFile file = open(folder.file("tree.mat"));
  const Variable read_inner = read(file, "inner");
  CHECK(numbers(field(read_inner, "run_1_2")) == Column{1.0});
  CHECK(numbers(field(read_inner, "run_1_2_2")) == Column{2.0});
  CHECK(numbers(field(read_inner, "x2nd")) == Column{3.0});
  CHECK(numbers(field(read_inner, std::string(60, 'n'))) == Column{4.0});
  CHECK(text(field(read_inner, "empty")).empty());
  CHECK(numbers(field(read_inner, "none")).empty());
  CHECK(texts(field(read_inner, "no_texts")).empty());
  CHECK(texts(field(read_inner, "section")) == Texts{"? 3", ""});
  CHECK(field(read_inner, "yes").isLogical);
  CHECK(numbers(*Mat_VarGetCell(&field(read_inner, "list"), 0)) == Column{1.0});
  CHECK(text(*Mat_VarGetCell(&field(read_inner, "list"), 1)) == "two");
  CHECK(field(read_inner, "empty_group").class_type == MAT_C_STRUCT);
  CHECK(text(*read(file, "last")) == "end");
}

TEST_CASE(".mat of a set has a struct a run", "[fast]") {
  const tests::ExportedRun run;
  REQUIRE(tests::run_program("export set --mat set.mat", run.folder().path()).status == 0);
  const MatFile file = open(run.folder().file("set.mat"));
  const Variable runs = read(file, "runs");
  matvar_t& warm_up = field(runs, "warm_up_80");
  CHECK(text(field(warm_up, "id")) == "warm-up-80");
  CHECK(numbers(field(field(warm_up, "recording"), "time_s")).size() > 100);
}
