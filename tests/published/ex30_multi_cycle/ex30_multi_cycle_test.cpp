// Certificate of a multi-cycle test, predicted from A, B, C and one efficiency: README.md.
#include <catch2/catch.hpp>

#include "build_paths.h"
#include "rigs/vehicle_file.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"
#include "tests/support/page_numbers.h"
#include "tools/multi_cycle.h"
#include "tools/pages.h"

using namespace rollrig;
using namespace rollrig::tools;

namespace {

const std::string kPhases = ROLLRIG_SOURCE_DIR "/tests/published/ex30_multi_cycle/phases.csv";

}  // namespace

TEST_CASE("EX30: one efficiency from two sections gives the others within 3 %, the cold first one apart",
          "[published]") {
  const auto certificate = read_certificate(kPhases);
  const auto simulated = simulate_multi_cycle({}, certificate);
  REQUIRE(simulated.size() == 8);
  const double efficiency = fit_efficiency(simulated, certificate, {2, 3});
  CHECK(efficiency > 0.80);
  CHECK(efficiency < 0.90);
  for (const std::size_t i : {1U, 4U, 5U, 6U, 7U}) {
    INFO(certificate[i].phase << " " << certificate[i].kind);
    CHECK(simulated[i].per_m(efficiency) == Approx(certificate[i].per_m()).epsilon(0.03));
  }
  // The cold section: 15 % above the third in the certificate; A, B, C know nothing of it.
  CHECK(certificate[0].per_m() / certificate[4].per_m() == Approx(1.15).margin(0.01));
  CHECK(simulated[0].per_m(efficiency) == Approx(simulated[4].per_m(efficiency)).epsilon(1e-6));
  const auto vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
  CHECK(vehicle.powertrain.efficiency == Approx(efficiency).margin(5e-4));
}

TEST_CASE("EX30: at constant speed the wheels need the road load over the distance", "[published]") {
  const auto certificate = read_certificate(kPhases);
  const auto simulated = simulate_multi_cycle({}, certificate);
  const auto vehicle = rigs::read_vehicle(read_config(find_asset("vehicles", "volvo_ex30")));
  const double force_N = models::calc_road_load_N(*vehicle.road_load, 65.0 * 0.44704);
  for (const std::size_t i : {3U, 7U}) {
    CHECK(simulated[i].distance_m == Approx(certificate[i].distance_m).epsilon(1e-4));
    // Ramps: kinetic energy given once and taken back but for the last meters, less drag on the way.
    CHECK((simulated[i].drive_J - simulated[i].recuperated_J) / simulated[i].distance_m ==
          Approx(force_N).epsilon(0.01));
  }
  for (const std::size_t i : {0U, 2U, 4U, 6U})
    CHECK(simulated[i].distance_m == Approx(11990.4).epsilon(1e-3));  // 7.45 mi
}

TEST_CASE("EX30: warm-up of the tires explains part of the cold first section, more for tires that lose more",
          "[published]") {
  const auto certificate = read_certificate(kPhases);
  const double excess = certificate[0].per_m() / certificate[4].per_m() - 1.0;
  double last = 0.0;
  for (const double rrc_N_per_kN : {5.5, 6.5, 7.7}) {
    const auto simulated = simulate_multi_cycle({"volvo_ex30", rrc_N_per_kN, 0.0}, certificate);
    const double share = (simulated[0].per_m(0.84) / simulated[4].per_m(0.84) - 1.0) / excess;
    INFO(rrc_N_per_kN << " N/kN: " << share);
    CHECK(share > last);
    CHECK(share < 1.0);
    last = share;
  }
  // Out of date? cmake --build build/release --target test_record_pages
  tests::check_page(read_text_file(ROLLRIG_SOURCE_DIR "/docs/ex30.md"), make_ex30_page());
}
