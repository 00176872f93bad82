// Designs: each point where it belongs, whatever was asked for before it; wrong ones are refused.
#include "campaigns/design.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <set>

#include "include/rollrig/error.h"

namespace {

using namespace rollrig::campaigns;

Factor uniform(const std::string& key, double low, double high) { return {key, Factor::Kind::kUniform, {}, low, high}; }

double to_number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// A column of a design, as numbers.
std::vector<double> list_values(const Design& design, std::size_t factor) {
  std::vector<double> values;
  for (std::size_t i = 0; i < design.count_items(); ++i) values.push_back(to_number(design.calc_values(i)[factor]));
  return values;
}

/// How many parts of [0, 1) of equal width have a value.
std::size_t count_parts_met(const std::vector<double>& values, std::size_t parts) {
  std::set<std::size_t> met;
  for (const double value : values) met.insert(static_cast<std::size_t>(value * static_cast<double>(parts)));
  return met.size();
}

const DesignInput kTwoFactors{"", {uniform("a", 0.0, 1.0), uniform("b", 0.0, 1.0)}, 64, 7};

DesignInput with_name(const char* name) {
  DesignInput input = kTwoFactors;
  input.name = name;
  return input;
}

}  // namespace

TEST_CASE("a grid has every value with every other, the last factor first", "[fast]") {
  const auto grid = make_design(
      {kGrid,
       {{"tire", Factor::Kind::kValues, {"a40", "a50"}}, {"speed_km_h", Factor::Kind::kValues, {"60", "80", "100"}}}});
  REQUIRE(grid->count_items() == 6);
  CHECK(grid->calc_values(0) == std::vector<std::string>{"a40", "60"});
  CHECK(grid->calc_values(2) == std::vector<std::string>{"a40", "100"});
  CHECK(grid->calc_values(4) == std::vector<std::string>{"a50", "80"});
}

TEST_CASE("a Latin hypercube meets each part of each factor once", "[fast]") {
  DesignInput input = with_name(kLatinHypercube);
  input.points = 37;
  const auto design = make_design(input);
  REQUIRE(design->count_items() == 37);
  for (const std::size_t factor : {std::size_t{0}, std::size_t{1}}) {
    CHECK(count_parts_met(list_values(*design, factor), 37) == 37);
  }
  CHECK(list_values(*design, 0) != list_values(*design, 1));
}

TEST_CASE("64 points of a Sobol' sequence meet each of 64 boxes once, however long and narrow", "[fast]") {
  const auto design = make_design(with_name(kSobol));
  const std::vector<double> a = list_values(*design, 0);
  const std::vector<double> b = list_values(*design, 1);
  for (const std::size_t columns : {1U, 2U, 4U, 8U, 16U, 32U, 64U}) {
    const std::size_t rows = 64 / columns;
    std::set<std::pair<std::size_t, std::size_t>> met;
    for (std::size_t i = 0; i < a.size(); ++i) {
      met.emplace(static_cast<std::size_t>(a[i] * static_cast<double>(columns)),
                  static_cast<std::size_t>(b[i] * static_cast<double>(rows)));
    }
    CHECK(met.size() == 64);
  }
}

TEST_CASE("draws have the moments of their distributions", "[fast]") {
  DesignInput input{
      kMonteCarlo, {{"load_N", Factor::Kind::kNormal, {}, 5400.0, 100.0}, uniform("p", 2.0, 5.0)}, 4000, 3};
  for (const char* name : {kMonteCarlo, kLatinHypercube, kSobol}) {
    input.name = name;
    const auto design = make_design(input);
    const std::vector<double> loads = list_values(*design, 0);
    const std::vector<double> pressures = list_values(*design, 1);
    double mean_N = 0.0;
    double square = 0.0;
    for (const double load : loads) mean_N += load / 4000.0;
    for (const double load : loads) square += std::pow(load - mean_N, 2) / 4000.0;
    CHECK(mean_N == Approx(5400.0).margin(4.0 * 100.0 / std::sqrt(4000.0)));
    CHECK(std::sqrt(square) == Approx(100.0).epsilon(0.05));
    CHECK(*std::min_element(pressures.begin(), pressures.end()) >= 2.0);
    CHECK(*std::max_element(pressures.begin(), pressures.end()) <= 5.0);
  }
}

TEST_CASE("another seed gives another design, and the same one the same", "[fast]") {
  for (const char* name : {kMonteCarlo, kLatinHypercube, kSobol, kSobolIndices, kMorris}) {
    DesignInput input = with_name(name);
    const auto first = make_design(input);
    const auto again = make_design(input);
    input.seed = 8;
    const auto other = make_design(input);
    CHECK(first->calc_values(5) == again->calc_values(5));
    CHECK(first->calc_values(5) != other->calc_values(5));
  }
}

TEST_CASE("Saltelli's items: A, B, and A with one column of B each", "[fast]") {
  const auto design = make_design(with_name(kSobolIndices));
  REQUIRE(design->count_items() == 64 * 4);
  for (const std::size_t point : {std::size_t{0}, std::size_t{17}, std::size_t{63}}) {
    const auto a = design->calc_values(4 * point);
    const auto b = design->calc_values(4 * point + 1);
    CHECK(a[0] != b[0]);
    CHECK(design->calc_values(4 * point + 2) == std::vector<std::string>{b[0], a[1]});
    CHECK(design->calc_values(4 * point + 3) == std::vector<std::string>{a[0], b[1]});
  }
}

TEST_CASE("a trajectory of Morris changes one factor after the other, by half of its range", "[fast]") {
  const auto design = make_design(with_name(kMorris));
  REQUIRE(design->count_items() == 64 * 3);
  for (std::size_t t = 0; t < 64; ++t) {
    std::set<std::size_t> changed;
    for (std::size_t step = 0; step < 2; ++step) {
      const auto before = design->calc_values(3 * t + step);
      const auto after = design->calc_values(3 * t + step + 1);
      for (std::size_t f = 0; f < 2; ++f) {
        if (before[f] == after[f]) continue;
        changed.insert(f);
        CHECK(std::fabs(to_number(after[f]) - to_number(before[f])) == Approx(0.5));
        CHECK(to_number(after[f]) > 0.0);
        CHECK(to_number(after[f]) < 1.0);
      }
      CHECK(changed.size() == step + 1);
    }
  }
}

TEST_CASE("a design that cannot be made is refused", "[fast]") {
  const auto refuse = [](const DesignInput& input) { CHECK_THROWS_AS(make_design(input), rollrig::InputError); };
  refuse(with_name("sobel"));
  refuse({kMonteCarlo, {}, 10});
  refuse({kMonteCarlo, {uniform("a", 0.0, 1.0)}, 0});
  refuse({kMonteCarlo, {uniform("a", 0.0, 1.0), uniform("a", 0.0, 2.0)}, 10});
  refuse({kGrid, {uniform("a", 0.0, 1.0)}, 0});
  refuse({kGrid, {{"a", Factor::Kind::kValues, {"1"}}}, 10});
  refuse({kSobolIndices, {uniform("a", 0.0, 1.0)}, kMostItems});
}

TEST_CASE("a draw says its distribution", "[fast]") {
  const Factor factor = read_drawn_factor("pressure_kPa=normal:250:5");
  CHECK(factor.key == "pressure_kPa");
  CHECK(factor.calc_value(0.5) == "250");
  CHECK(to_number(factor.calc_value(0.975)) == Approx(250.0 + 5.0 * 1.959964));
  CHECK(read_drawn_factor("x=uniform:-1:3").calc_value(0.25) == "0");
  for (const char* text :
       {"x", "x=normal:1", "x=normal:1:0", "x=uniform:2:1", "x=norml:1:2", "x=normal:nan:1", "=normal:1:2"}) {
    CHECK_THROWS_AS(read_drawn_factor(text), rollrig::InputError);
  }
}

TEST_CASE("correlated draws have their correlation, and their own spread", "[fast]") {
  const Factor first{"a", Factor::Kind::kNormal, {}, 10.0, 2.0};
  const Factor second{"b", Factor::Kind::kNormal, {}, -1.0, 0.5};
  for (const char* name : {kMonteCarlo, kLatinHypercube, kSobol}) {
    const auto design = make_design({name, {first, uniform("u", 0.0, 1.0), second}, 4000, 5, {{0, 2, -0.7}}});
    const std::vector<double> a = list_values(*design, 0);
    const std::vector<double> b = list_values(*design, 2);
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      product += (a[i] - 10.0) / 2.0 * (b[i] + 1.0) / 0.5 / 4000.0;
      square += std::pow((b[i] + 1.0) / 0.5, 2) / 4000.0;
    }
    CHECK(product == Approx(-0.7).margin(0.05));
    CHECK(square == Approx(1.0).margin(0.07));
  }
  for (const char* name : {kSobolIndices, kMorris}) {
    CHECK_THROWS_AS(make_design({name, {first, second}, 64, 5, {{0, 1, 0.3}}}), rollrig::InputError);
  }
  const Factor third{"c", Factor::Kind::kNormal, {}, 0.0, 1.0};
  const DesignInput impossible{kMonteCarlo, {first, second, third}, 9, 5, {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, -0.9}}};
  CHECK_THROWS_AS(make_design(impossible), rollrig::InputError);
}
