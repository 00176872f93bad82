// The source's own gap (Table 4.3) and its open question (§5.2): what the program says of them.
#include <catch2/catch.hpp>

#include <cmath>

#include "build_paths.h"
#include "sim/core/file_io.h"
#include "tests/support/page_numbers.h"
#include "tools/source_gap.h"

using namespace rollrig;
using tools::GapCandidate;
using tools::GapCurve;
using tools::PowerErrors;

namespace {

std::vector<GapCurve> curves_of(const std::string& id) {
  return tools::simulate_gap_curves({&models::find_effect(id)});
}

}  // namespace

TEST_CASE("a drag on the wheel makes the measured power larger than the model's, most where the tire has least",
          "[published]") {
  for (const GapCurve& curve : curves_of("toe_camber_drag")) {
    for (std::size_t i = 0; i < curve.u.size(); ++i) {
      for (const auto& tire : curve.error[i]) {
        for (const double error : tire) CHECK(error < 0.0);
      }
      if (i == 0) continue;
      CHECK(curve.error[i][0][0] < curve.error[i - 1][0][0]);  // the larger the more
    }
  }
}

TEST_CASE("an effect finds itself in the table that it makes", "[published]") {
  const std::vector<GapCurve> curves = tools::simulate_gap_curves(
      {&models::find_effect("toe_camber_drag"), &models::find_effect("bearing_load_friction")});
  for (const GapCurve& curve : curves) {
    PowerErrors table = curve.error[4];  // at the middle of its prior: u = 0
    REQUIRE(curve.u[4] == Approx(0.0).margin(1e-12));
    for (auto& tire : table) {
      for (double& error : tire) error = -error;  // printed without sign; measured above the model
    }
    const std::vector<GapCandidate> ranked = tools::rank_gap(curves, table, true);
    REQUIRE(ranked.size() == 2);
    CHECK(ranked.front().effect == curve.effect);
    CHECK(ranked.front().common.u == Approx(0.0).margin(0.01));
    CHECK(ranked.front().common.rms_points < 0.1);
    CHECK(ranked.front().log_weight > -0.01);
  }
}

TEST_CASE("docs/source_gap.md says what the program gives (§4.5.1, §5.2)", "[weekly]") {
  // Out of date? cmake --build build/release --target source_gap_page
  tests::check_page(read_text_file(ROLLRIG_SOURCE_DIR "/docs/source_gap.md"), tools::make_source_gap_page());
}
