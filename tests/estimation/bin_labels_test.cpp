#include "estimation/road_load/bin_labels.h"

#include <catch2/catch.hpp>

#include "tests/support/planted_mistakes.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

CoastdownData make_bins() {
  RandomStream random(7, "labels");
  return tests::make_random_coastdowns(random, true);
}

}  // namespace

TEST_CASE("labels that go with times and distances are not doubted, and nothing is said where a file has neither",
          "[fast]") {
  CoastdownData data = make_bins();
  CHECK(check_bin_labels(data).empty());
  data.runs[0].bins.front().high_m_s += 2.0;
  for (CoastdownRun& run : data.runs) {
    run.total_s.reset();
    run.distance_m.reset();
    run.start_s.reset();
  }
  CHECK(check_bin_labels(data).empty());
}

TEST_CASE("a run whose labels are wrong is named with its size and the likely mistake", "[fast]") {
  CoastdownData data = make_bins();
  CoastdownRun& run = data.runs[2];
  std::string words;
  SECTION("mph") {
    for (SpeedBin& bin : run.bins) {
      bin.high_m_s /= 1.609344;
      bin.low_m_s /= 1.609344;
    }
    words = "mph";
  }
  SECTION("shifted") {
    for (SpeedBin& bin : run.bins) {
      bin.high_m_s -= 5.0 / 3.6;
      bin.low_m_s -= 5.0 / 3.6;
    }
    words = "shifted down by one bin";
  }
  SECTION("distance in feet") {
    *run.distance_m /= 0.3048;
    words = "feet";
  }
  const auto doubts = check_bin_labels(data);
  REQUIRE(doubts.size() == 1);
  CHECK(doubts[0].run == 2);
  CHECK(doubts[0].doubt.runs == std::vector<std::string>{run.id});
  CHECK_THAT(doubts[0].doubt.likely, Contains(words));
  CHECK(std::abs(doubts[0].doubt.relative) > 0.03);
}

TEST_CASE("a bin that is missing, and a run that begins within another one, are named", "[fast]") {
  CoastdownData data = make_bins();
  CoastdownRun& run = data.runs[1];
  run.bins.erase(run.bins.begin() + 3);
  *data.runs[3].start_s = *data.runs[2].start_s + 10.0;
  const auto doubts = check_bin_labels(data);
  REQUIRE(doubts.size() == 2);
  CHECK(doubts[0].run == 1);
  CHECK(doubts[0].doubt.kind == DoubtKind::kTimes);
  CHECK_THAT(doubts[0].doubt.text, Contains("are missing"));
  CHECK(doubts[1].run == 2);
  CHECK_THAT(doubts[1].doubt.text, Contains("the next run starts 10 s after"));
}
