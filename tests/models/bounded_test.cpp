// The bounded law of the loss: its limits, its levels, the source's exponential between them.
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/parameters.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using tests::make_context_on;

namespace {

using Numbers = std::vector<std::pair<std::string, double>>;

models::Context<double> make_bounded(const Numbers& own = {}) {
  models::Context<double> context = make_context_on(tests::kDyno);
  context.tire.own = tests::make_own("bounded");
  for (const auto& [key, value_SI] : own) estimation::find_parameter(context, "tire.bounded." + key) = value_SI;
  return context;
}

/// Loss at the references of load and pressure.
double calc_loss_N(const models::Context<double>& context, double speed_km_h, double tire_degC,
                   double load_share = 1.0) {
  const models::Corner<double> corner(context, {});
  const auto& reference = context.tire.rolling_resistance;
  return corner.calc_law_N(speed_km_h / 3.6, load_share * reference.reference_load_N, reference.reference_pressure_Pa,
                           tire_degC + kZeroCelsius_K);
}

}  // namespace

TEST_CASE("between its levels the bounded loss falls by the source's exponential", "[fast]") {
  const models::Context<double> context = make_bounded(
      {{"fall_per_degC", 0.015}, {"cold_limit_degC", kZeroCelsius_K}, {"hot_limit_degC", kZeroCelsius_K + 100.0}});
  for (const double speed_km_h : {30.0, 80.0, 150.0}) {
    const double ratio = calc_loss_N(context, speed_km_h, 60.0) / calc_loss_N(context, speed_km_h, 40.0);
    CHECK(ratio == Approx(std::exp(-0.015 * 20.0)).epsilon(1e-4));
  }
}

TEST_CASE("the bounded loss neither rises in the cold nor falls in the heat without end", "[fast]") {
  const models::Context<double> context = make_bounded({{"fall_per_degC", 0.016},
                                                        {"cold_limit_degC", kZeroCelsius_K + 20.0},
                                                        {"hot_limit_degC", kZeroCelsius_K + 70.0}});
  const double coldest_N = calc_loss_N(context, 80.0, -60.0);
  const double hottest_N = calc_loss_N(context, 80.0, 200.0);
  CHECK(hottest_N / coldest_N == Approx(std::exp(-0.016 * 50.0)).epsilon(1e-6));  // what lies between the levels
  CHECK(calc_loss_N(context, 80.0, -20.0) == Approx(coldest_N).epsilon(1e-4));
  double before_N = coldest_N;
  for (double tire_degC = -58.0; tire_degC <= 200.0; tire_degC += 2.0) {
    const double loss_N = calc_loss_N(context, 80.0, tire_degC);
    CHECK(loss_N <= before_N);
    before_N = loss_N;
  }
}

TEST_CASE("the bounded loss rises once with speed, from one level to another", "[fast]") {
  const models::Context<double> context =
      make_bounded({{"speed_rise", 0.4}, {"step_speed_km_h", 60.0 / 3.6}, {"fall_per_degC", 0.0}});
  const double slow_N = calc_loss_N(context, 0.0, 30.0);
  const double fast_N = calc_loss_N(context, 1e6, 30.0);
  CHECK(std::log(fast_N / slow_N) == Approx(0.4).epsilon(1e-6));
  CHECK(calc_loss_N(context, 60.0, 30.0) == Approx(std::sqrt(slow_N * fast_N)).epsilon(1e-9));  // half way
  double before_N = slow_N;
  for (double speed_km_h = 5.0; speed_km_h <= 250.0; speed_km_h += 5.0) {
    const double loss_N = calc_loss_N(context, speed_km_h, 30.0);
    CHECK(loss_N > before_N);
    before_N = loss_N;
  }
}

TEST_CASE("at 80 km/h and 30 degC the bounded loss is the number of the file, whatever the rest", "[fast]") {
  const models::Context<double> flat = [] {
    models::Context<double> context =
        make_bounded({{"loss_N", 41.0}, {"speed_rise", 0.7}, {"speed_rise_of_fall", 0.5}});
    context.surface_curvature_per_m = 2.0 / context.tire.rolling_resistance.reference_drum_diameter_m;
    return context;
  }();
  CHECK(calc_loss_N(flat, 80.0, 30.0) == Approx(41.0).epsilon(1e-9));
  CHECK(calc_loss_N(flat, 80.0, 30.0, 2.0) == Approx(41.0 * std::pow(2.0, 1.1)).epsilon(1e-9));  // usual exponent
  CHECK(calc_loss_N(flat, 80.0, 30.0, 0.0) == 0.0);
}

TEST_CASE("the fall of the bounded loss may be another at low speed", "[fast]") {
  const models::Context<double> context = make_bounded({{"fall_per_degC", 0.016},
                                                        {"speed_rise_of_fall", 0.5},
                                                        {"cold_limit_degC", kZeroCelsius_K - 100.0},
                                                        {"hot_limit_degC", kZeroCelsius_K + 200.0}});
  const auto fall_per_K = [&](double speed_km_h) {
    return std::log(calc_loss_N(context, speed_km_h, 40.0) / calc_loss_N(context, speed_km_h, 50.0)) / 10.0;
  };
  CHECK(fall_per_K(80.0) == Approx(0.016).epsilon(1e-6));
  CHECK(fall_per_K(5000.0) - fall_per_K(0.0) == Approx(0.5 * 0.016).epsilon(1e-6));
}
