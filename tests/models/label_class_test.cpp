// Classes of the EU label and limits of type approval, as published.
#include "models/tire/label_class.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

using namespace rollrig;
using models::TireClass;

namespace {

std::string find_class(TireClass tire_class, double rrc_N_per_kN) {
  return models::kLabelClasses[models::find_label_class(tire_class, 1e-3 * rrc_N_per_kN)];
}

}  // namespace

TEST_CASE("label classes are those of the published table, at both ends of each row", "[fast]") {
  // Regulation (EC) 1222/2009, Annex I, part A: first and last value of each row, in kg/t. The letters are those of
  // Regulation (EU) 2020/740, which has no empty class.
  struct Row {
    TireClass tire_class;
    const char* name;
    double first, last;
  };
  const std::vector<Row> rows{
      {TireClass::kC1, "A", 4.0, 6.5},  {TireClass::kC1, "B", 6.6, 7.7},   {TireClass::kC1, "C", 7.8, 9.0},
      {TireClass::kC1, "D", 9.1, 10.5}, {TireClass::kC1, "E", 10.6, 15.0}, {TireClass::kC2, "A", 4.0, 5.5},
      {TireClass::kC2, "B", 5.6, 6.7},  {TireClass::kC2, "C", 6.8, 8.0},   {TireClass::kC2, "D", 8.1, 9.2},
      {TireClass::kC2, "E", 9.3, 12.0}, {TireClass::kC3, "A", 3.0, 4.0},   {TireClass::kC3, "B", 4.1, 5.0},
      {TireClass::kC3, "C", 5.1, 6.0},  {TireClass::kC3, "D", 6.1, 7.0},   {TireClass::kC3, "E", 7.1, 9.0}};
  for (const Row& row : rows) {
    INFO(name_of(row.tire_class) << " " << row.name);
    CHECK(find_class(row.tire_class, row.first) == row.name);
    CHECK(find_class(row.tire_class, row.last) == row.name);
  }
}

TEST_CASE("an RRc between two rows of the table is declared with one decimal, a half upwards", "[fast]") {
  CHECK(models::round_declared_rrc(6.549e-3) == Approx(6.5e-3));
  CHECK(models::round_declared_rrc(6.55e-3) == Approx(6.6e-3));
  CHECK(models::round_declared_rrc(8.05e-3) == Approx(8.1e-3));
  CHECK(find_class(TireClass::kC1, 6.549) == "A");
  CHECK(find_class(TireClass::kC1, 6.55) == "B");
  CHECK(find_class(TireClass::kC3, 4.0499) == "A");
}

TEST_CASE("probabilities of the classes are what random errors give", "[fast]") {
  const double rrc = 7.72e-3;
  const double sd = 0.6e-3;  // wide, so that four classes matter
  const auto expected = models::calc_label_probabilities(TireClass::kC1, rrc, sd);
  CHECK(std::accumulate(expected.begin(), expected.end(), 0.0) == Approx(1.0));
  std::mt19937_64 random(1);
  std::normal_distribution<double> error(0.0, sd);
  constexpr int kDraws = 200000;
  std::array<double, models::kLabelClassCount> shares{};
  for (int i = 0; i < kDraws; ++i) {
    shares[models::find_label_class(TireClass::kC1, rrc + error(random))] += 1.0 / kDraws;
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    CHECK(shares[i] == Approx(expected[i]).margin(0.005));  // four standard deviations of a share
  }
}

TEST_CASE("without uncertainty one class is certain, at a bound two are equally likely", "[fast]") {
  const auto certain = models::calc_label_probabilities(TireClass::kC2, 6.0e-3, 0.0);
  CHECK(certain[1] == 1.0);
  const auto at_bound = models::calc_label_probabilities(TireClass::kC2, 6.75e-3, 0.05e-3);
  CHECK(at_bound[1] == Approx(0.5).epsilon(1e-6));
  CHECK(at_bound[2] == Approx(0.5).epsilon(1e-6));
}

TEST_CASE("limits of type approval fall from stage to stage and rise for severe snow", "[fast]") {
  for (const TireClass tire_class : {TireClass::kC1, TireClass::kC2, TireClass::kC3}) {
    const auto limits = models::list_rrc_limits(tire_class, false);
    const auto snow = models::list_rrc_limits(tire_class, true);
    REQUIRE(limits.size() == 2);
    CHECK(limits[1].rrc < limits[0].rrc);
    for (std::size_t i = 0; i < 2; ++i) CHECK(snow[i].rrc - limits[i].rrc == Approx(1e-3));
  }
  // The former label's last class begins above the limit of stage 1 (Regulation (EC) 1222/2009, Annex I, part A).
  CHECK(models::list_rrc_limits(TireClass::kC1, false)[0].rrc == Approx(12.0e-3));
  CHECK(models::list_rrc_limits(TireClass::kC2, false)[0].rrc == Approx(10.5e-3));
  CHECK(models::list_rrc_limits(TireClass::kC3, false)[0].rrc == Approx(8.0e-3));
}

TEST_CASE("the class of tires is asked about by their mean RRc, and that of one by its RRc", "[fast]") {
  struct Bounds {
    TireClass tire_class;
    double least, most, most_of_one;  // N/kN: 0.6 times class A, stage 1, 1.5 times stage 1; by hand
  };
  for (const Bounds& each : {Bounds{TireClass::kC1, 3.9, 12.0, 18.0}, Bounds{TireClass::kC2, 3.3, 10.5, 15.75},
                             Bounds{TireClass::kC3, 2.4, 8.0, 12.0}}) {
    CHECK(models::doubt_class_by_mean(each.tire_class, 1e-3 * (each.least - 0.01)).has_value());
    CHECK_FALSE(models::doubt_class_by_mean(each.tire_class, 1e-3 * (each.least + 0.01)).has_value());
    CHECK_FALSE(models::doubt_class_by_mean(each.tire_class, 1e-3 * (each.most - 0.01)).has_value());
    CHECK(models::doubt_class_by_mean(each.tire_class, 1e-3 * (each.most + 0.01)).has_value());
    CHECK_FALSE(models::doubt_class_by_rrc(each.tire_class, 1e-3 * (each.most_of_one - 0.01), false).has_value());
    CHECK(models::doubt_class_by_rrc(each.tire_class, 1e-3 * (each.most_of_one + 0.01), false).has_value());
    CHECK_FALSE(models::doubt_class_by_rrc(each.tire_class, 1e-3 * (each.most_of_one + 1.4), true).has_value());
  }
}
