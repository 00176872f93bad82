// What differs in the inputs is all that differs, however little, and nothing else.
#include "comparison/input_differences.h"

#include <catch2/catch.hpp>

using rollrig::DifferentInput;
using rollrig::Json;
using rollrig::comparison::find_different_inputs;
using rollrig::comparison::strip_manifest;

TEST_CASE("inputs that differ in the last digit are told apart", "[fast]") {
  const Json a = {{"tire", {{"loss_N", 43.46527}, {"mass_kg", 10.0}}}};
  const Json b = {{"tire", {{"loss_N", 43.46527000000001}, {"mass_kg", 10.0}}}};
  const std::vector<DifferentInput> found = find_different_inputs({&a, &b}, {});
  REQUIRE(found.size() == 1);
  CHECK(found.front().name == "tire.loss_N");
  CHECK(found.front().values.front() != found.front().values.back());
}

TEST_CASE("an effect that one run alone has is an input without a value in the others", "[fast]") {
  const Json a = {{"effects", Json::object()}, {"integrator", {{"steps", 7}}}};
  const Json b = {{"effects", {{"torque_gain", {{"gain_percent", 3.0}}}}}, {"integrator", {{"steps", 9}}}};
  const std::vector<DifferentInput> found = find_different_inputs({&a, &b, &a}, {"integrator"});
  REQUIRE(found.size() == 1);
  CHECK(found.front().values == std::vector<std::string>{"", "3", ""});
}

TEST_CASE("where a file lies is no input, what it says is", "[fast]") {
  const Json a = {{"tire", {{"file", "/a/x.toml"}, {"sha256", "1"}, {"name", "x"}}}};
  const Json b = {{"tire", {{"file", "/b/x.toml"}, {"sha256", "2"}, {"name", "x"}}}};
  CHECK(find_different_inputs({&a, &b}, {}).empty());
  CHECK(strip_manifest(a) == strip_manifest(b));
}
