#include "estimation/road_load/default_road_load.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sim/core/error.h"

using namespace rollrig;
using namespace rollrig::estimation;

TEST_CASE("default road load: what it depends on, and of what size it is", "[fast]") {
  const Eigen::Vector3d car = calc_default_road_load(1500.0, 1.80, 1.50);
  CHECK(car(0) == Approx(210.0));
  CHECK(car(1) == 0.0);
  CHECK(car(2) / 12.96 == Approx(0.0501));  // 0.0042 + 0.0459 N/(km/h)^2
  // above that of real cars: 0.014 of the weight, and a drag area above 1 m2
  CHECK(car(0) / (1500.0 * 9.80665) > 0.012);
  CHECK(2.0 * car(2) / 1.2 > 0.9);
  // a larger front adds drag alone, mass adds both
  const Eigen::Vector3d high = calc_default_road_load(1500.0, 1.80, 2.00);
  CHECK(high(0) == car(0));
  CHECK((high(2) - car(2)) / 12.96 == Approx(0.0170 * 0.9));
}

TEST_CASE("classes of rolling resistance: each value lies in its class, in the middle of it", "[fast]") {
  for (const char* tire_class : {"C1", "C2", "C3"}) {
    const std::vector<RrcClass>& classes = list_rrc_classes(tire_class);
    REQUIRE(classes.size() == 6);
    for (std::size_t i = 0; i < classes.size(); ++i) {
      INFO(tire_class << " " << classes[i].label);
      CHECK(&find_rrc_class(tire_class, classes[i].value_N_per_kN) == &classes[i]);
      if (i == 0 || i + 1 == classes.size()) continue;
      const double middle = 0.5 * (classes[i - 1].most_N_per_kN + classes[i].most_N_per_kN);
      CHECK(classes[i].value_N_per_kN == Approx(middle).margin(0.051));
    }
  }
  // limits of Regulation (EC) 1222/2009: 6.5 is A and 6.6 is B; what is between goes by its one decimal
  CHECK(find_rrc_class("C1", 6.5).label == 'A');
  CHECK(find_rrc_class("C1", 6.54).label == 'A');
  CHECK(find_rrc_class("C1", 6.6).label == 'B');
  CHECK(find_rrc_class("C3", 6.1).label == 'D');
  CHECK(find_rrc_class("C2", 25.0).value_N_per_kN == Approx(11.2));
  CHECK_THROWS_AS(list_rrc_classes("C4"), InputError);
}
