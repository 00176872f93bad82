#include "diagnosis/comparison/prepared_set.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::PreparedSet;
using diagnosis::Series;

namespace {

double recorded_s(const measurements::MeasurementSet& set) {
  double sum_s = 0.0;
  for (const measurements::MeasuredRun& run : set.runs) sum_s += run.time_s.back() - run.time_s.front();
  return sum_s;
}

/// Its runs again and again, under other names, for about so many hours.
measurements::MeasurementSet repeat(const measurements::MeasurementSet& set, double hours) {
  measurements::MeasurementSet repeated = set;
  const auto times = static_cast<std::size_t>(hours * 3600.0 / recorded_s(set));
  for (std::size_t i = 1; i < times; ++i) {
    for (measurements::MeasuredRun run : set.runs) {
      run.id += "-" + std::to_string(i);
      repeated.runs.push_back(run);
    }
  }
  return repeated;
}

/// From the first to the last sample.
double longest_block_s(const PreparedSet& set) {
  double longest_s = 0.0;
  for (const Series& series : set.series()) {
    const std::vector<double>& time_s = set.runs()[series.run].measured.time_s;
    for (const diagnosis::Block& block : series.blocks) {
      longest_s = std::max(longest_s, time_s[series.rows[block.last - 1]] - time_s[series.rows[block.first]]);
    }
  }
  return longest_s;
}

}  // namespace

TEST_CASE("blocks are 10 s long, and longer in a set of more than 24 h, whose number of blocks hardly grows",
          "[slow]") {
  const measurements::MeasurementSet measured = tests::make_gap_set({}, 2);
  const PreparedSet day(repeat(measured, 24.0));
  CHECK(day.block_length_s() == 10.0);
  CHECK(longest_block_s(day) < 10.0);

  const measurements::MeasurementSet recorded = repeat(measured, 240.0);
  const PreparedSet ten_days(recorded);
  const double length_s = ten_days.block_length_s();
  CHECK(length_s == Approx(10.0 * recorded_s(recorded) / (24.0 * 3600.0)));
  CHECK(longest_block_s(ten_days) < length_s);
  CHECK(longest_block_s(ten_days) > 0.9 * length_s);
  // Ten times the recordings; a phase that is shorter than a block has one all the same.
  CHECK(ten_days.residual_count() < 2 * day.residual_count());
}
