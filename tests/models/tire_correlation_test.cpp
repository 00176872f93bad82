#include "models/tire/correlation.h"

#include <catch2/catch.hpp>

#include "models/tire/tire_file.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;

namespace {

models::TireFile make_tire() {
  models::TireFile tire = tests::read_combined_tire();
  tire.rig_thermal.clear();
  tire.standard_uncertainties.rolling_resistance.A0_N = 0.5;
  tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 700.0;
  tire.standard_uncertainties.thermal.rest_conductance_W_per_K = 0.6;
  tire.rig_thermal["here"].rest_conductance_W_per_K = 9.0;
  tire.rig_thermal["here"].rest_conductance_sd_W_per_K = 0.4;
  return tire;
}

models::TireFile read_with(const std::string& numbers, const std::string& matrix) {
  models::TireFile tire = make_tire();
  tire.correlation = {};
  const std::string table = "\n[correlation]\nnumbers = " + numbers + "\nmatrix = " + matrix + "\n";
  return models::read_tire(parse_config(models::write_tire(tire) + table, "t.toml"));
}

}  // namespace

TEST_CASE("correlations that are written are those that are read, to the last digit", "[fast]") {
  models::TireFile tire = make_tire();
  tire.correlation = {
      {"rolling_resistance.A0_N", "thermal.heat_capacity_J_per_K", "thermal.rig.here.conductance_at_rest_W_per_K"},
      {{1.0, 1.0 / 3.0, -0.1}, {1.0 / 3.0, 1.0, 0.2}, {-0.1, 0.2, 1.0}}};
  const models::TireFile back = models::read_tire(parse_config(models::write_tire(tire), "t.toml"));
  CHECK(back.correlation.numbers == tire.correlation.numbers);
  CHECK(back.correlation.matrix == tire.correlation.matrix);
  tire.correlation = {};
  CHECK_THAT(models::write_tire(tire), !Catch::Contains("correlation"));
}

TEST_CASE("a number may be called by the key of format 1", "[fast]") {
  const auto tire = read_with(R"(["thermal.z_W_per_K", "rolling_resistance.A0_N"])", "[[1, 0.5], [0.5, 1]]");
  CHECK(tire.correlation.numbers.front() == "thermal.conductance_at_rest_W_per_K");
}

TEST_CASE("a conductance of the rig's own stands there for the general one, with its correlations", "[fast]") {
  models::TireFile tire = make_tire();
  tire.correlation = {{"rolling_resistance.A0_N", "thermal.conductance_at_rest_W_per_K",
                       "thermal.rig.here.conductance_at_rest_W_per_K"},
                      {{1.0, 0.2, 0.7}, {0.2, 1.0, 0.0}, {0.7, 0.0, 1.0}}};
  const auto here = models::list_correlated_pairs(tire, "here");
  const auto there = models::list_correlated_pairs(tire, "there");
  REQUIRE(here.size() == 1);
  REQUIRE(there.size() == 1);
  CHECK(here.front().first == "tire.thermal.z_W_per_K");
  CHECK(here.front().second == "tire.rolling_resistance.A0_N");
  CHECK(here.front().correlation == 0.7);
  CHECK(there.front().first == "tire.thermal.z_W_per_K");
  CHECK(there.front().correlation == 0.2);
}

TEST_CASE("the two conductances that a rig gives go together, those of a tire do not", "[fast]") {
  models::TireFile tire = make_tire();
  tire.correlation = {};
  CHECK(models::list_correlated_pairs(tire, "here").empty());
  tire.values.thermal.rest_conductance_W_per_K = 0.0;
  tire.values.thermal.speed_conductance_W_s_per_m_K = 0.0;
  const auto pairs = models::list_correlated_pairs(tire, "of_no_tire");
  REQUIRE(pairs.size() == 1);
  CHECK(pairs.front().correlation > 0.9);
}

TEST_CASE("one conductance for a rig without the other is warned of", "[fast]") {
  models::TireFile tire = make_tire();
  models::CoolingRig rig;
  rig.name = "here";
  REQUIRE(tire.warn_of_conductances(rig).has_value());
  CHECK_THAT(*tire.warn_of_conductances(rig),
             Catch::Contains("[thermal.rig.here]") && Catch::Contains("one conductance"));
  tire.rig_thermal["here"].speed_conductance_W_s_per_m_K = 1.0;
  CHECK_FALSE(tire.warn_of_conductances(rig).has_value());
}

TEST_CASE("a number with a new uncertainty loses its old correlations, the others keep theirs", "[fast]") {
  models::TireFile tire = make_tire();
  tire.correlation = {
      {"rolling_resistance.A0_N", "thermal.heat_capacity_J_per_K", "thermal.conductance_at_rest_W_per_K"},
      {{1.0, 0.2, -0.1}, {0.2, 1.0, 0.3}, {-0.1, 0.3, 1.0}}};
  const models::TireCorrelation fitted{{"rolling_resistance.A0_N", "rolling_resistance.A1_N_s_per_m"},
                                       {{1.0, -0.9}, {-0.9, 1.0}}};
  const models::TireCorrelation now = models::replace_correlation(tire, fitted);
  CHECK(now.numbers == std::vector<std::string>{"rolling_resistance.A0_N", "rolling_resistance.A1_N_s_per_m",
                                                "thermal.heat_capacity_J_per_K",
                                                "thermal.conductance_at_rest_W_per_K"});
  CHECK(now.matrix == std::vector<std::vector<double>>{
                          {1.0, -0.9, 0.0, 0.0}, {-0.9, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.3}, {0.0, 0.0, 0.3, 1.0}});
  tire.standard_uncertainties.thermal.heat_capacity_J_per_K = 0.0;
  CHECK(models::replace_correlation(tire, fitted).numbers.size() == 3);
}

TEST_CASE("a matrix that cannot be one of correlations is refused, and one with rounding errors is not", "[fast]") {
  const std::string two = R"(["rolling_resistance.A0_N", "thermal.heat_capacity_J_per_K"])";
  CHECK_NOTHROW(read_with(two, "[[1, -0.9], [-0.9, 1]]"));
  CHECK_NOTHROW(read_with(two, "[[0.99999999999, 0.3], [0.30000000000000004, 1]]"));
  CHECK_THROWS_WITH(read_with(two, "[[1, 1], [1, 1]]"), Catch::Contains("positive definite"));
  CHECK_THROWS_WITH(read_with(two, "[[1, nan], [nan, 1]]"), Catch::Contains("out of range"));
  CHECK_THROWS_WITH(read_with(two, "0.3"), Catch::Contains("not a list"));
  CHECK_THROWS_WITH(read_with(two, "[[1, 0.3], [0.3]]"), Catch::Contains("a row of the matrix has 1 numbers"));
  CHECK_THROWS_WITH(read_with(R"(["rolling_resistance.A0_N", "rolling_resistance.A0_N"])", "[[1, 0], [0, 1]]"),
                    Catch::Contains("stands twice"));
}
