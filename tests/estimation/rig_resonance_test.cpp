// A bump at 10 m/s is found where there is one, and nowhere else.
#include <catch2/catch.hpp>

#include "tests/support/coast_study.h"

using namespace rollrig;
using tests::CoastStudy;

namespace {

std::vector<estimation::Resonance> search(const CoastStudy& study, std::uint64_t seed) {
  std::vector<estimation::Coast> coasts;
  const estimation::CoastSet set = tests::make_coasts(study, seed);
  for (std::size_t i = 0; i < 2; ++i) {
    coasts.push_back(estimation::find_coast(*set.runs[i].drum, set.drum_pulse_length_m, set.runs[i]));
  }
  return estimation::find_resonances(coasts);
}

}  // namespace

TEST_CASE("a resonance of the rig is found at its speed", "[fast]") {
  for (const double at_m_s : {8.0, 10.0, 15.0}) {
    CoastStudy study;
    study.resonance = 0.10;
    study.resonance_m_s = at_m_s;
    study.noise_m_s = 0.01;
    const auto found = search(study, 3);
    REQUIRE(found.size() == 1);
    CHECK(found[0].range.contains(at_m_s));
    CHECK(found[0].peak_m_s == Approx(at_m_s).margin(0.6));
    CHECK(found[0].excess > 0.02);
    CHECK(found[0].excess < 0.12);
  }
}

TEST_CASE("without one nothing is found, in any of a hundred pairs of runs but one at most", "[fast]") {
  CoastStudy study;
  study.resonance = 0.0;
  study.pressures_Pa = {420e3};
  study.lifted_runs = 0;
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) wrong += search(study, seed).empty() ? 0 : 1;
  CHECK(wrong <= 1);
}
