#include "report/blocks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "sim/core/random.h"

using rollrig::RandomStream;
using rollrig::report::thin;

namespace {

struct Made {
  std::vector<double> time_s;
  std::vector<double> values;
};

/// A slow wave with noise and a few single peaks.
Made make_noisy(std::size_t rows) {
  Made made;
  RandomStream random(7, "thinning");
  for (std::size_t i = 0; i < rows; ++i) {
    made.time_s.push_back(0.1 * static_cast<double>(i));
    made.values.push_back(std::sin(1e-3 * static_cast<double>(i)) + 0.1 * random.uniform());
  }
  made.values[rows / 3] = 50.0;
  made.values[rows / 2] = -70.0;
  return made;
}

double interpolate(const Made& made, const std::vector<std::size_t>& kept, std::size_t row) {
  const auto after = std::lower_bound(kept.begin(), kept.end(), row);
  if (*after == row) return made.values[row];
  const std::size_t b = *after;
  const std::size_t a = *(after - 1);
  const double share = (made.time_s[row] - made.time_s[a]) / (made.time_s[b] - made.time_s[a]);
  return made.values[a] + share * (made.values[b] - made.values[a]);
}

}  // namespace

TEST_CASE("thinning keeps first, last and every extreme, and keeps to its bound", "[fast]") {
  for (const std::size_t rows : {10u, 999u, 7200u, 72000u}) {
    for (const std::size_t most : {8u, 100u, 2000u}) {
      const Made made = make_noisy(rows);
      const std::vector<std::size_t> kept = thin(made.time_s, made.values, most);
      INFO(rows << " rows, at most " << most);
      CHECK(kept.size() <= most);
      CHECK(std::is_sorted(kept.begin(), kept.end()));
      CHECK(std::adjacent_find(kept.begin(), kept.end()) == kept.end());
      CHECK(kept.front() == 0);
      CHECK(kept.back() == rows - 1);
      const auto is_kept = [&](auto at) {
        const auto row = static_cast<std::size_t>(at - made.values.begin());
        return std::binary_search(kept.begin(), kept.end(), row);
      };
      CHECK(is_kept(std::min_element(made.values.begin(), made.values.end())));
      CHECK(is_kept(std::max_element(made.values.begin(), made.values.end())));
    }
  }
}

TEST_CASE("beside every row a row at least as high and one at least as low is kept", "[fast]") {
  const Made made = make_noisy(72000);
  constexpr std::size_t kMost = 2000;
  constexpr std::size_t kKept = 9;  // rows of a stretch that are kept: extremes, ends, a gap, and sides of two steps
  constexpr std::size_t kNear = 72000 * kKept / (kMost - 2) + kKept;  // rows of a stretch
  const std::vector<std::size_t> kept = thin(made.time_s, made.values, kMost);
  for (std::size_t row = 0; row < made.values.size(); row += 97) {
    double least = 1e9;
    double greatest = -1e9;
    for (auto at = std::lower_bound(kept.begin(), kept.end(), row - std::min(row, kNear));
         at != kept.end() && *at <= row + kNear; ++at) {
      least = std::min(least, made.values[*at]);
      greatest = std::max(greatest, made.values[*at]);
    }
    REQUIRE(least <= made.values[row]);
    REQUIRE(greatest >= made.values[row]);
  }
}

TEST_CASE("a series at rest is two points, and a ramp too, and what is left out lies on the lines", "[fast]") {
  Made made;
  for (int i = 0; i < 5000; ++i) {
    made.time_s.push_back(i);
    made.values.push_back(i < 2500 ? 20.0 : 20.0 + 0.5 * (i - 2500));
  }
  const std::vector<std::size_t> kept = thin(made.time_s, made.values, 2000, 1e-6);
  CHECK(kept.size() <= 20);
  for (std::size_t row = 0; row < made.values.size(); ++row) {
    CHECK(std::abs(interpolate(made, kept, row) - made.values[row]) < 2.0);  // the knee lies in one stretch
  }
  const std::vector<std::size_t> at_rest = thin({0.0, 1.0, 2.0, 3.0}, {5.0, 5.0, 5.0, 5.0}, 2000, 1e-6);
  CHECK(at_rest == std::vector<std::size_t>{0, 3});
}

TEST_CASE("a gap stays a gap", "[fast]") {
  Made made = make_noisy(10000);
  for (std::size_t i = 4000; i < 5000; ++i) made.values[i] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> kept = thin(made.time_s, made.values, 500, 1e-3);
  CHECK(kept.size() <= 500);
  const auto is_gap = [&](std::size_t row) { return std::isnan(made.values[row]); };
  CHECK(std::any_of(kept.begin(), kept.end(), is_gap));
  std::vector<double> all_gap(100, std::numeric_limits<double>::quiet_NaN());
  CHECK(thin(std::vector<double>(made.time_s.begin(), made.time_s.begin() + 100), all_gap, 50).size() <= 50);
}

TEST_CASE("short series", "[fast]") {
  CHECK(thin({}, {}, 100).empty());
  CHECK(thin({1.0}, {2.0}, 100) == std::vector<std::size_t>{0});
  CHECK(thin({1.0, 2.0}, {2.0, 2.0}, 100) == std::vector<std::size_t>{0, 1});
}

TEST_CASE("thinning keeps a jump at its time", "[fast]") {
  Made made;
  for (std::size_t i = 0; i < 7200; ++i) {
    made.time_s.push_back(static_cast<double>(i));
    made.values.push_back(i < 3607 ? 6865.0 : 200.0);
  }
  const std::vector<std::size_t> kept = thin(made.time_s, made.values, 500);
  CHECK(std::find(kept.begin(), kept.end(), 3606u) != kept.end());
  CHECK(std::find(kept.begin(), kept.end(), 3607u) != kept.end());
}
