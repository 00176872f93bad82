// 95 % intervals of `fit j2452` on simulated tires: how often do they hold the truth?
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <array>
#include <iostream>

#include "estimation/rolling_law/j2452_fit.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"

using namespace rollrig;

namespace {

const estimation::J2452Law kTruth{-0.4, 0.9, 0.06, 1.0e-4, 4e-7};

/// The points of the scenario sae_j2452, with normal noise.
std::vector<estimation::RollingPoint> simulate_points(std::uint64_t seed, double noise_N) {
  RandomStream noise(seed, "j2452");
  std::vector<estimation::RollingPoint> points;
  for (const auto& [share, above_kPa] :
       {std::pair(0.3, 10.0), std::pair(0.6, -40.0), std::pair(0.9, 60.0), std::pair(0.9, -40.0)}) {
    for (const double km_h : {115.0, 95.0, 75.0, 55.0, 35.0, 15.0}) {
      estimation::RollingPoint point{km_h / 3.6, share * 8581.0, 1e3 * (240.0 + above_kPa), 0.0};
      point.force_N = kTruth.calc_force_N(point.pressure_Pa, point.load_N, point.speed_m_s) + noise_N * noise.normal();
      points.push_back(point);
    }
  }
  return points;
}

/// Seven speeds at up to seven loads and pressures, with normal noise of each point and of each set of one load and
/// pressure.
std::vector<estimation::RollingPoint> simulate_sets(std::uint64_t seed, double noise_N, double set_sd,
                                                    std::size_t sets) {
  RandomStream noise(seed, "sets");
  std::vector<estimation::RollingPoint> points;
  for (const auto& [load_N, pressure_kPa] :
       {std::pair(6000.0, 180.0), std::pair(4500.0, 210.0), std::pair(3000.0, 260.0), std::pair(2000.0, 290.0),
        std::pair(3000.0, 180.0), std::pair(4500.0, 290.0), std::pair(6000.0, 260.0)}) {
    if (points.size() == 7 * sets) break;
    const double factor = 1.0 + set_sd * noise.normal();
    for (const double km_h : {115.0, 95.0, 80.0, 65.0, 50.0, 35.0, 15.0}) {
      estimation::RollingPoint point{km_h / 3.6, load_N, 1e3 * pressure_kPa, 0.0};
      point.force_N =
          factor * kTruth.calc_force_N(point.pressure_Pa, point.load_N, point.speed_m_s) + noise_N * noise.normal();
      points.push_back(point);
    }
  }
  return points;
}

/// Whether the intervals of alpha, beta, a, b, c hold the truth.
using Covered = std::array<bool, 5>;

template <class MakeFit>
std::vector<Covered> find_covered(std::size_t seeds, const MakeFit& make_fit) {
  std::vector<Covered> covered(seeds);
  parallel_for(seeds, 0, [&](std::size_t i) {
    const estimation::J2452Fit fit = make_fit(i + 1);
    const std::array<double, 5> truth{kTruth.alpha, kTruth.beta, kTruth.a, kTruth.b, kTruth.c};
    for (std::size_t k = 0; k < truth.size(); ++k) {
      covered[i][k] = fit.coefficients[k].low_95 <= truth[k] && truth[k] <= fit.coefficients[k].high_95;
    }
  });
  return covered;
}

/// Shares of those from `first` on, before `end`.
std::array<double, 5> calc_shares(const std::vector<Covered>& covered, std::size_t first, std::size_t end) {
  std::array<double, 5> shares{};
  for (std::size_t i = first; i < end; ++i) {
    for (std::size_t k = 0; k < shares.size(); ++k) {
      shares[k] += covered[i][k] ? 1.0 / static_cast<double>(end - first) : 0.0;
    }
  }
  return shares;
}

}  // namespace

TEST_CASE("95 % intervals of the five coefficients of SAE J2452 cover at their rate", "[slow]") {
  constexpr std::size_t kStudy = 400;
  constexpr std::size_t kAll = 4000;
  for (const double noise_N : {0.1, 0.3}) {  // 0.1 N: the coefficients a and c have 4 and 18 %, 0.3 N: 12 and 55 %
    const std::vector<Covered> covered = find_covered(
        kAll, [noise_N](std::uint64_t seed) { return estimation::fit_j2452(simulate_points(seed, noise_N)); });
    for (const std::size_t seeds : {kStudy, kAll}) {
      const std::array<double, 5> shares = calc_shares(covered, 0, seeds);
      std::cout << fmt::format("noise {} N, {} seeds: alpha, beta, a, b, c covered", noise_N, seeds);
      double mean = 0.0;
      for (const double share : shares) {
        std::cout << fmt::format(" {:.2f}", 100.0 * share);
        mean += share / 5.0;
        if (seeds == kAll) CHECK(share == Approx(0.95).margin(0.02));
      }
      std::cout << fmt::format(" %, mean {:.2f} %\n", 100.0 * mean);
      CHECK(mean == Approx(0.95).margin(0.02));
    }
    // Of exact intervals, a share of 400 seeds is from 93 to 97 % with a probability of 95 %: in every fourth study one
    // of five coefficients is outside by chance. Of 50 shares, 47.3 +- 1.6 are then inside.
    int inside = 0;
    for (std::size_t first = 0; first < kAll; first += kStudy) {
      for (const double share : calc_shares(covered, first, first + kStudy)) {
        if (0.93 <= share && share <= 0.97) ++inside;
      }
    }
    std::cout << fmt::format("noise {} N: {} of 50 shares of {} seeds are 93 to 97 %\n", noise_N, inside, kStudy);
    CHECK(inside >= 43);
  }
}

TEST_CASE("and they do where whole sets of one load and pressure scatter", "[slow]") {
  constexpr std::size_t kSeeds = 2000;
  // Few sets estimate their scatter poorly: seven give 93 % at 0.2 and 0.5 %, five less.
  for (const auto& [sets, least] : {std::pair(std::size_t{7}, 0.92), std::pair(std::size_t{5}, 0.80)}) {
    for (const double set_sd : {0.0, 0.002, 0.005, 0.01}) {
      for (const auto random : {estimation::RandomPart::kPoints, estimation::RandomPart::kPointsAndSets}) {
        const std::vector<Covered> covered =
            find_covered(kSeeds, [set_sd = set_sd, random, sets = sets](std::uint64_t seed) {
              return estimation::fit_j2452(simulate_sets(seed, 0.1, set_sd, sets), random);
            });
        const bool includes_sets = random == estimation::RandomPart::kPointsAndSets;
        std::cout << fmt::format("{} sets scatter by {} %, {}: alpha, beta, a, b, c covered", sets, 100.0 * set_sd,
                                 includes_sets ? "included" : "not included");
        const std::array<double, 5> shares = calc_shares(covered, 0, kSeeds);
        for (std::size_t k = 0; k < shares.size(); ++k) {
          std::cout << fmt::format(" {:.2f}", 100.0 * shares[k]);
          if (!includes_sets) continue;
          // b and c, the shape over speed, are determined by the points within sets, whose many degrees of freedom
          // their intervals do not use: they are wide.
          CHECK(shares[k] >= least);
          CHECK(shares[k] <= (k < 3 ? 0.98 : 0.995));
        }
        std::cout << " %\n";
      }
    }
  }
}
