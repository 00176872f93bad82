// Intervals and reliability against published values, closed forms and cases counted by hand.
#include "validation/scoring/statistics.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rollrig::validation;

TEST_CASE("Wilson's interval is the published one", "[fast]") {
  // R. G. Newcombe, Stat. Med. 17 (1998) 857, Table I, method 3
  struct Published {
    std::size_t k, n;
    double low, high;
  };
  for (const Published& row : {Published{81, 263, 0.2553, 0.3662}, Published{15, 148, 0.0624, 0.1605},
                               Published{0, 20, 0.0, 0.1611}, Published{1, 29, 0.0061, 0.1718}}) {
    INFO(row.k << " of " << row.n);
    const Interval interval = calc_wilson_95(row.k, row.n);
    CHECK(interval.low == Approx(row.low).margin(5e-5));
    CHECK(interval.high == Approx(row.high).margin(5e-5));
  }
}

TEST_CASE("Wilson's ends are the shares from which k of n is 1.96 standard deviations away", "[fast]") {
  for (const std::size_t n : {5U, 30U, 200U}) {
    for (std::size_t k = 1; k < n; k += 3) {
      const Interval interval = calc_wilson_95(k, n);
      const double p = static_cast<double>(k) / static_cast<double>(n);
      for (const double end : {interval.low, interval.high}) {
        CHECK(std::abs(p - end) / std::sqrt(end * (1.0 - end) / static_cast<double>(n)) == Approx(1.959964));
      }
      const Interval others = calc_wilson_95(n - k, n);  // what is not counted has the same interval, mirrored
      CHECK(others.low == Approx(1.0 - interval.high));
    }
    CHECK(calc_wilson_95(n, n).high == 1.0);
    CHECK(calc_wilson_95(0, n).low == 0.0);
  }
  CHECK(calc_wilson_95(0, 0).low == 0.0);
  CHECK(calc_wilson_95(0, 0).high == 1.0);
}

TEST_CASE("what comes true as often as stated is calibrated, what never does is not", "[fast]") {
  const std::vector<Stated> calibrated{{0.75, true}, {0.75, true}, {0.75, true}, {0.75, false}};
  CHECK(calc_ece(find_reliability(calibrated)) == Approx(0.0).margin(1e-12));
  CHECK(calc_brier(calibrated) == Approx(0.75 * 0.25));  // the variance of what happens: the least at this share
  const std::vector<Stated> sure_and_wrong{{1.0, false}, {1.0, false}};
  CHECK(calc_ece(find_reliability(sure_and_wrong)) == 1.0);
  CHECK(calc_brier(sure_and_wrong) == 1.0);
  const std::vector<Stated> sure_and_right{{1.0, true}, {1.0, true}};
  CHECK(calc_ece(find_reliability(sure_and_right)) == 0.0);
  CHECK(calc_brier(sure_and_right) == 0.0);
  CHECK(calc_ece(find_reliability({})) == 0.0);
}

TEST_CASE("few cases have a calibration error even where all that is stated is right, many have none", "[fast]") {
  const auto repeat = [](double probability, std::size_t count) {
    return calc_ece_noise_floor(std::vector<Stated>(count, {probability, true}));
  };
  CHECK(repeat(1.0, 10) == 0.0);  // what is certain does not scatter
  // One bin: the mean distance of a share from its expectation, sqrt(2 p (1 - p)/(pi n)) for many cases.
  CHECK(repeat(0.5, 400) == Approx(std::sqrt(0.5 / (3.14159265 * 400.0))).epsilon(0.1));
  CHECK(repeat(0.55, 100) / repeat(0.55, 1600) == Approx(4.0).epsilon(0.2));
}

TEST_CASE("bins of the reliability table are weighted by their cases", "[fast]") {
  // 0.5 to 0.6: mean 0.54, one of two right; 0.9 to 1: mean 0.97, two of three right.
  const std::vector<Stated> stated{{0.5, true}, {0.58, false}, {0.95, true}, {0.96, false}, {1.0, true}};
  const Reliability bins = find_reliability(stated);
  CHECK(bins[5].cases == 2);
  CHECK(bins[5].right == 1);
  CHECK(bins[5].mean_probability == Approx(0.54));
  CHECK(bins[9].cases == 3);
  CHECK(bins[9].mean_probability == Approx(0.97));
  CHECK(calc_ece(bins) == Approx(0.4 * 0.04 + 0.6 * (0.97 - 2.0 / 3.0)));
  CHECK(calc_brier(stated) == Approx((0.25 + 0.3364 + 0.0025 + 0.9216 + 0.0) / 5.0));
}

TEST_CASE("quantiles lie on straight lines between the order statistics", "[fast]") {
  CHECK(calc_quantile({4.0, 1.0, 3.0, 2.0}, 0.5) == 2.5);
  CHECK(calc_quantile({4.0, 1.0, 3.0, 2.0}, 0.1) == Approx(1.3));
  CHECK(calc_quantile({7.0}, 0.9) == 7.0);
  CHECK(calc_quantile({1.0, 5.0}, 1.0) == 5.0);
}
