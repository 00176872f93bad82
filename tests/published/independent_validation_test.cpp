// Statements of sources to which no tire was fitted, on virtual tires; docs/independent_validation.md says what could
// be read of each source. "Does not hold" in a name: the test holds the figure of today, so that a change is noticed.
#include <catch2/catch.hpp>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/page_numbers.h"
#include "tools/independent.h"
#include "tools/pages.h"

using namespace rollrig;
using namespace rollrig::tools;
using namespace rollrig::tools::independent;

namespace {

template <class Names, class Check>
void for_tires(const Names& names, Check check) {
  for (const std::string& name : names) {
    INFO(name);
    check(read_study_tire(name));
  }
}

/// Holds a figure of each tire, as of today.
void hold(const std::vector<double>& today, double margin, double (*measure)(const StudyTire&)) {
  for (std::size_t i = 0; i < today.size(); ++i) {
    INFO(kStudyTires[i]);
    CHECK(measure(read_study_tire(kStudyTires[i])) == Approx(today[i]).margin(margin));
  }
}

}  // namespace

TEST_CASE("EPA LDTP 78-11, Mullins: less pressure gives more resistance", "[published]") {
  for_tires(kStudyCarTires, [](StudyTire tire) {
    tire.change_drum(kEpaRoll_m);
    CHECK(find_pressure_change(tire, 45.0, 26.0) > 0.0);
    tire.change_drum(2.0);
    CHECK(find_pressure_change(tire, 50.0, 20.0) > 0.0);
  });
}

TEST_CASE("Schuring in TRB 286: a psi counts more below 24 psi than above", "[published]") {
  for_tires(kStudyCarTires, [](const StudyTire& tire) {
    CHECK(find_rise_per_psi(tire, 24.0, 20.0) > find_rise_per_psi(tire, 36.0, 24.0));
  });
}

TEST_CASE("does not hold: 10 % less from 24 to 29 psi, 1.4 % for each psi, p^-0.4 (TRB 286)", "[published]") {
  hold({-0.048, -0.048, -0.049, -0.047}, 1e-3, [](const StudyTire& t) { return find_pressure_change(t, 24.0, 29.0); });
  hold({0.0089, 0.0089, 0.0091, 0.0088}, 2e-4, [](const StudyTire& t) { return find_rise_per_psi(t, 36.0, 24.0); });
  hold({-0.267, -0.268, -0.274, -0.258, -0.131}, 5e-3, &find_pressure_exponent);
}

TEST_CASE("does not hold: 3 % of fuel economy from 20 to 28 psi (EPA-AA-SDSB-80-9)", "[published]") {
  // Would be 15 to 30 % of the resistance.
  hold({-0.081, -0.081, -0.084, -0.081}, 1e-3, [](const StudyTire& t) { return find_pressure_change(t, 20.0, 28.0); });
}

TEST_CASE("TST 6 (1978) 163: in equilibrium linear in the load and in the reciprocal of pressure", "[published]") {
  for_tires(kStudyTires, [](const StudyTire& tire) {
    CHECK(find_bend_over_load(tire) < 0.01);  // Assumed: what a laboratory can tell from a straight line
    CHECK(find_bend_over_inverse_pressure(tire) < 0.01);
  });
}

TEST_CASE("VECTO: the loss of a truck tire in proportion to load^0.9 (fitted)", "[published]") {
  CHECK(find_load_exponent(read_study_tire(kTruckTire)) == Approx(0.9).margin(0.05));
}

TEST_CASE("does not hold: the rise with speed of the Engineering ToolBox, 27 to 29 %", "[published]") {
  hold({0.049, 0.031, -0.036, 0.015}, 2e-3, &find_speed_rise);
}

TEST_CASE("UN R117: K_t of C1 and C3 (fitted), and does not hold for a40, a50, a60", "[published]") {
  const auto slope = [](const StudyTire& t) { return find_air_slope_per_K(t, &SteadyLoss::reported_N); };
  CHECK(slope(read_study_tire(kCarTire)) == Approx(0.008).margin(0.0004));
  CHECK(slope(read_study_tire(kTruckTire)) == Approx(0.006).margin(0.0003));
  hold({0.0122, 0.0124, 0.0107}, 2e-4, slope);
}

TEST_CASE("Ejsmont 2024: more loss at 15 and -5 degC than at 25 degC, and not equally for all tires", "[published]") {
  double least = 1.0, most = 0.0;
  for_tires(kStudyCarTires, [&](const StudyTire& tire) {
    const double mild = find_air_excess(tire, 15.0), cold = find_air_excess(tire, -5.0);
    CHECK(mild > 0.0);
    CHECK(cold > mild);
    least = std::min(least, cold);
    most = std::max(most, cold);
  });
  CHECK(most - least > 0.10);
}

TEST_CASE("in the cold, at all speeds, a50, a60, C1 and C3 meet what is demanded of shipped tires", "[published]") {
  for (const char* name : {"a50", "a60", kCarTire, kTruckTire}) {
    for (const double speed_km_h : {20.0, 50.0, 80.0, 120.0}) {
      INFO(name << " " << speed_km_h << " km/h");
      const double ratio = find_cold_ratio(read_study_tire(name), speed_km_h);
      CHECK(ratio > 1.0);
      CHECK(ratio <= 1.45);
    }
  }
}

TEST_CASE("in the cold a40 meets it up to 80 km/h, and misses it at 120 km/h", "[published]") {
  const StudyTire a40 = read_study_tire("a40");
  for (const double speed_km_h : {20.0, 50.0, 80.0}) {
    INFO(speed_km_h << " km/h");
    CHECK(find_cold_ratio(a40, speed_km_h) > 1.0);
    CHECK(find_cold_ratio(a40, speed_km_h) <= 1.45);
  }
  CHECK(find_cold_ratio(a40, 120.0) == Approx(1.655).margin(0.01));
}

TEST_CASE("Hyttinen 2022: a truck tire loses more the colder the air, from 25 to -30 degC", "[published]") {
  const StudyTire tire = read_study_tire(kTruckTire);
  double before = -1.0;
  for (const double air_degC : {25.0, 10.0, -5.0, -20.0, -30.0}) {
    const double excess = find_air_excess(tire, air_degC);
    CHECK(excess > before);
    before = excess;
  }
}

TEST_CASE("Hyttinen 2022: the loss follows the temperature of the rubber better than that of the air", "[published]") {
  const Correlation correlation = correlate_truck_tire();
  CHECK(correlation.with_tread < -0.9);
  CHECK(correlation.with_tread < correlation.with_air);
}

TEST_CASE("Hyttinen 2024, 2022: insulated, a truck tire is warmer and loses less at all speeds, and sprayed more",
          "[published]") {
  for (const double factor : {0.9, kInsulated}) {  // whatever the wheelhouse keeps
    for (const SpeedStep& step : step_truck_tire(factor)) {
      INFO(step.speed_km_h << " km/h, " << factor);
      CHECK(step.changed.loss_N < step.usual.loss_N);
      CHECK(step.changed.tread_K > step.usual.tread_K);
      CHECK(step.changed.carcass_K > step.usual.carcass_K);
      CHECK(step.changed.pressure_Pa > step.usual.pressure_Pa);
    }
  }
  for (const SpeedStep& step : step_truck_tire(kSprayed)) CHECK(step.changed.loss_N > step.usual.loss_N);
}

TEST_CASE("SAE J2452: its form describes the coastdowns of a60, C1 and C3", "[published]") {
  for (const char* name : {"a60", kCarTire, kTruckTire}) {
    INFO(name);
    const J2452Fit fit = fit_j2452(read_study_tire(name));
    CHECK(fit.rms < 0.02);
    CHECK(fit.alpha < 0.0);
    CHECK(fit.beta > 0.0);
  }
}

TEST_CASE("SAE J2452 does not hold: a parabola over speed does not describe a40 and a50", "[published]") {
  hold({0.069, 0.039}, 2e-3, [](const StudyTire& tire) { return fit_j2452(tire).rms; });
}

TEST_CASE("docs/independent_validation.md says what the program gives", "[published]") {
  // Out of date? cmake --build build/release --target independent_page
  tests::check_page(read_text_file(ROLLRIG_SOURCE_DIR "/docs/independent_validation.md"),
                    tools::make_independent_page());
}
