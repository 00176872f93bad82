// Pairs of simulated machines, aligned: what docs/alignment.md states, in small.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "tools/machine_pairs.h"

using namespace rollrig::tools;

TEST_CASE("a force cell with a gain is aligned away, and the slope undoes the gain", "[slow]") {
  const std::vector<MachinePair> pairs = simulate_pairs({"torque_gain"}, TireLoads::kOfItsOwn, 3, 7);
  REQUIRE(pairs.size() == 3);
  CHECK(find_share_within(pairs) >= 0.8);  // of fifteen tires
  for (const MachinePair& pair : pairs) {
    CHECK(pair.sigma_m_N_per_kN < 0.075);
    CHECK(pair.cases.size() == 5);
    CHECK(std::abs(pair.A2 - 1.0) < 0.1);
  }
}

TEST_CASE("an alignment makes two machines agree better than they did", "[slow]") {
  std::vector<std::string> all;
  for (const MachineDifference& difference : list_machine_differences()) all.push_back(difference.name);
  const std::vector<MachinePair> pairs = simulate_pairs(all, TireLoads::kAlike, 2, 11);
  double before = 0.0, after = 0.0;
  for (const MachinePair& pair : pairs) {
    for (const AlignedCase& one : pair.cases) {
      before += one.error_before() * one.error_before();
      after += one.error() * one.error();
    }
  }
  CHECK(after < 0.25 * before);
  CHECK(find_share_within(pairs) > 0.85);  // of eighty tires
}

TEST_CASE("a pair is the same whatever other pairs are simulated", "[slow]") {
  const MachinePair one = simulate_pair("texture", TireLoads::kAlike, 3, 1);
  const std::vector<MachinePair> several = simulate_pairs({"speed_record", "texture"}, TireLoads::kAlike, 2, 3);
  CHECK(one.A2 == several[3].A2);
  CHECK(one.cases[4].aligned_N_per_kN == several[3].cases[4].aligned_N_per_kN);
}
