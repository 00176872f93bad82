// What a regression on the inputs takes of a run that it did not see.
#include "diagnosis/comparison/black_box.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::PreparedSet;
using diagnosis::Series;

TEST_CASE("what decays with the time of a run is taken from another run, what follows nothing is not", "[fast]") {
  const PreparedSet set(tests::make_gap_set({}, 4));
  const auto judge = [&set](const std::function<double(const Series&, std::size_t)>& shape) {
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(diagnosis::to_index(set.residual_count()));
    for (const Series& series : set.series()) {
      for (std::size_t k = 0; k < series.size(); ++k) {
        series.rows_of(difference)(diagnosis::to_index(k)) = 50.0 * series.floor * shape(series, k);
      }
    }
    constexpr std::size_t kHeldOut = 1;
    const Eigen::VectorXd rest = diagnosis::subtract_black_box(set, difference, kHeldOut);
    double before = 0.0, after = 0.0;
    for (const Series& series : set.series()) {
      if (series.run != kHeldOut) {
        CHECK(series.rows_of(rest) == series.rows_of(difference));
        continue;
      }
      before += series.rows_of(difference).squaredNorm() / (series.floor * series.floor);
      after += series.rows_of(rest).squaredNorm() / (series.floor * series.floor);
    }
    return std::sqrt(after / before);
  };
  for (const double time_constant_s : {300.0, 1200.0}) {
    CHECK(judge([&](const Series& series, std::size_t k) {
            return std::exp(-(series.time_s[k] - set.runs()[series.run].measured.time_s.front()) / time_constant_s);
          }) < 0.08);  // the weight of one noise floor keeps a little of it
  }
  CHECK(judge([](const Series&, std::size_t k) { return k % 2 == 0 ? 1.0 : -1.0; }) > 0.9);
}
