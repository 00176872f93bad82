// The two-step regression on a drum of another size than that on which the tire's values hold.
#include <catch2/catch.hpp>

#include "estimation/tire_fit/two_step.h"
#include "tests/support/fit_study.h"
#include "tests/support/uneven_machines.h"

using namespace rollrig;
using tests::find_truth;

TEST_CASE("the two-step regression finds the tire's law and its cooling on a drum of any size", "[fast]") {
  for (const double diameter_m : {1.707, 2.5}) {
    rigs::RigFile rig = tests::make_uneven_drum();
    rig.drum.diameter_m = diameter_m;
    const auto set = tests::make_warm_up_set("a50", "source_with_gas", "quasi_static", rig);
    const auto found = estimation::estimate_in_two_steps(set);
    INFO(diameter_m << " m");
    CHECK(found.A0_N == Approx(find_truth(set, "tire.rolling_resistance.A0_N")).epsilon(0.03));
    CHECK(found.speed_conductance_W_s_per_m_K == Approx(find_truth(set, "tire.thermal.f_W_s_per_m_K")).epsilon(0.05));
    CHECK(found.rest_conductance_W_per_K == Approx(find_truth(set, "tire.thermal.z_W_per_K")).epsilon(0.1));
    REQUIRE(found.H_gas_W_per_K.has_value());
    CHECK(*found.H_gas_W_per_K == Approx(find_truth(set, "tire.thermal.H_gas_W_per_K")).epsilon(0.1));
  }
}
