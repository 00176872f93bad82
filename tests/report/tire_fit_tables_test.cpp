// Tables of a fit, where the data leave something open.
#include <catch2/catch.hpp>
#include <cmath>

#include "report/fit_pages.h"
#include "tests/support/run_program.h"

using namespace rollrig;

TEST_CASE("a number that the data do not determine is told in words", "[fast]") {
  estimation::TireFit fit;
  fit.two_step.emplace();
  fit.two_step->rest_conductance_W_per_K = -std::nan("");  // as zero by zero is
  fit.two_step->speed_conductance_W_s_per_m_K = 0.5;
  const std::string text = tests::flatten(format_tables(report::make_tire_fit_tables(fit)));
  CHECK(text.find("z not determined") != std::string::npos);
  CHECK(text.find("f 0.5 ") != std::string::npos);
  CHECK(text.find("nan") == std::string::npos);
}
