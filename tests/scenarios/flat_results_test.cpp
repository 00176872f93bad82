// The numbers of several results as columns: every one of them, under a name that tells where it stands.
#include "scenarios/run/flat_results.h"

#include <catch2/catch.hpp>

using rollrig::Json;
using rollrig::scenarios::flatten_results;

namespace {

std::vector<std::string> list_keys(const Json& flat) {
  std::vector<std::string> keys;
  for (const auto& member : flat.items()) keys.push_back(member.key());
  return keys;
}

}  // namespace

TEST_CASE("numbers of records have the names of the records", "[fast]") {
  const Json result = Json::parse(R"({"sections": [{"name": "city 1", "energy_Wh": 3.5},
      {"name": "105 km/h, end", "energy_Wh": 4}], "rrc": 7.5, "text": "a", "none": null, "is_settled": true})");
  const Json flat = flatten_results({result}).front();
  CHECK(list_keys(flat) ==
        std::vector<std::string>{"rrc", "is_settled", "sections.city_1.energy_Wh", "sections.105_km_h_end.energy_Wh"});
  CHECK(flat["sections.city_1.energy_Wh"] == 3.5);
  CHECK(flat["is_settled"] == 1);
}

TEST_CASE("records without names, or with names that differ from run to run, are numbered", "[fast]") {
  const Json unnamed = Json::parse(R"({"cycles": [{"load_N": 1.0}, {"load_N": 2.0}]})");
  CHECK(list_keys(flatten_results({unnamed}).front()) ==
        std::vector<std::string>{"cycles.1.load_N", "cycles.2.load_N"});
  const Json at_100 = Json::parse(R"({"sections": [{"name": "100 km/h", "energy_Wh": 3}]})");
  const Json at_120 = Json::parse(R"({"sections": [{"name": "120 km/h", "energy_Wh": 5}]})");
  for (const Json& flat : flatten_results({at_100, at_120})) {
    CHECK(list_keys(flat) == std::vector<std::string>{"sections.1.energy_Wh"});
  }
  const Json twice = Json::parse(R"({"sections": [{"name": "a", "x": 3}, {"name": "a", "x": 4}]})");
  CHECK(list_keys(flatten_results({twice}).front()) == std::vector<std::string>{"sections.1.x", "sections.2.x"});
}

TEST_CASE("lists of numbers and lists in records are flattened too", "[fast]") {
  const Json result = Json::parse(R"({"a": [1, 2], "b": [{"c": [{"d": 3}]}]})");
  CHECK(list_keys(flatten_results({result}).front()) == std::vector<std::string>{"a.1", "a.2", "b.1.c.1.d"});
}
