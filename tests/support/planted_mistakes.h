#pragma once
/// Mistakes that people make with coastdowns, planted at random places and sizes in sets that are right.

#include <string>
#include <vector>

#include "estimation/drum_deceleration/drum_coastdown.h"
#include "estimation/road_load/coastdown_file.h"
#include "estimation/run_checks/run_doubt.h"
#include "sim/core/random.h"

namespace rollrig::tests {

/// What was planted, and what must be said of it.
struct Planted {
  estimation::DoubtKind kind = estimation::DoubtKind::kOdd;
  std::vector<std::string> runs;
  std::string likely;  // words that must be in the likely mistake; empty: any
};

/// Whether the doubts name what was planted, and whether they accuse others.
struct Judged {
  bool is_found = false;
  bool accuses_innocent = false;
};
Judged judge(const Planted& planted, const std::vector<estimation::RunDoubt>& doubts);

/// A whole number below `count`.
std::size_t draw_index(RandomStream& random, std::size_t count);
/// A number between two.
double draw_between(RandomStream& random, double low, double high);

Planted plant_repeat(estimation::CoastdownData& data, RandomStream& random);
Planted plant_shared_part(estimation::CoastdownData& data, RandomStream& random);
Planted plant_labels(estimation::CoastdownData& data, RandomStream& random);
/// A brake that drags with 25 to 100 % of the force, over the whole run or at least 40 % of its speeds.
Planted plant_brake(estimation::CoastdownData& data, RandomStream& random);

/// Some runs of one session, in their order; names are unique.
estimation::CoastdownData draw_runs(const estimation::CoastdownData& data, RandomStream& random);
/// Made up, as traces or as bins with totals and distances.
estimation::CoastdownData make_random_coastdowns(RandomStream& random, bool bins);

Planted plant_repeat(estimation::CoastSet& set, RandomStream& random);
Planted plant_shared_part(estimation::CoastSet& set, RandomStream& random);
Planted plant_state(estimation::CoastSet& set, RandomStream& random);
Planted plant_load(estimation::CoastSet& set, RandomStream& random);
/// A brake of 25 to 100 % of the deceleration (net, of loaded runs) at the middle speed.
Planted plant_brake(estimation::CoastSet& set, RandomStream& random);

estimation::CoastSet make_random_coasts(RandomStream& random);

}  // namespace rollrig::tests
