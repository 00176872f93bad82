// How often mistakes are found that were planted in measured and made coastdowns, and how often runs are accused that
// are right. The tables of docs/fit_drum_coastdown.md and docs/fit_road_load.md are printed here.
// ROLLRIG_PLANTED_TRIALS is the number of sets for each mistake (default 30).
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "build_paths.h"
#include "estimation/drum_deceleration/coast_doubts.h"
#include "estimation/road_load/checked_road_load.h"
#include "sim/core/parallel.h"
#include "tests/support/planted_mistakes.h"

namespace fs = std::filesystem;
using namespace rollrig;
using namespace rollrig::estimation;
using tests::Planted;

namespace {

std::size_t trial_count() {
  const char* given = std::getenv("ROLLRIG_PLANTED_TRIALS");
  return given != nullptr ? static_cast<std::size_t>(std::max(1, std::atoi(given))) : 30;
}

std::string find_measured(const char* name) {
  const char* folder = std::getenv("ROLLRIG_MEASURED_DATA");
  const fs::path place = fs::path(folder != nullptr ? folder : ROLLRIG_SOURCE_DIR "/../shared/data/measured") / name;
  if (fs::exists(place)) return place.string();
  WARN("skipped: no measured data; ROLLRIG_MEASURED_DATA names their folder");
  return {};
}

/// What came of the sets of one kind.
struct Tally {
  std::size_t sets = 0;
  std::size_t found = 0;
  std::size_t accusing = 0;  // sets in which an innocent run is accused
};

/// Makes sets, plants a mistake in each (none: nothing), and counts what the check says.
template <class Set, class Make, class Plant, class Check>
Tally count_found(const char* name, std::uint64_t seed, const Make& make, const Plant& plant, const Check& check) {
  const std::size_t sets = trial_count();
  std::vector<tests::Judged> judged(sets);
  std::vector<std::string> missed(sets);
  parallel_for(sets, 0, [&](std::size_t i) {
    RandomStream random(seed + i, name);
    Set set = make(random);
    const Planted planted = plant(set, random);
    const std::vector<RunDoubt> doubts = check(set);
    judged[i] = tests::judge(planted, doubts);
    if (judged[i].is_found && !judged[i].accuses_innocent) return;
    for (const std::string& run : planted.runs) missed[i] += run + " ";
    missed[i] += "(" + planted.likely + "):";
    for (const RunDoubt& doubt : doubts) missed[i] += "\n      " + doubt.text;
  });
  Tally tally;
  for (std::size_t i = 0; i < sets; ++i) {
    ++tally.sets;
    tally.found += judged[i].is_found ? 1 : 0;
    tally.accusing += judged[i].accuses_innocent ? 1 : 0;
    if (!missed[i].empty() && std::getenv("ROLLRIG_PLANTED_SHOW") != nullptr) std::cout << "    " << missed[i] << "\n";
  }
  std::cout << fmt::format("{:<44} sets {:>4}  found {:>4}  innocent accused in {:>3}\n", name, tally.sets, tally.found,
                           tally.accusing);
  return tally;
}

Tally operator+(const Tally& a, const Tally& b) {
  return {a.sets + b.sets, a.found + b.found, a.accusing + b.accusing};
}

void require_bar(const std::vector<Tally>& planted, const Tally& unplanted) {
  Tally all;
  for (const Tally& tally : planted) {
    CHECK(static_cast<double>(tally.found) >= 0.9 * static_cast<double>(tally.sets));
    all = all + tally;
  }
  CHECK(static_cast<double>(all.accusing) <= 0.01 * static_cast<double>(all.sets));
  CHECK(static_cast<double>(unplanted.accusing) <= 0.02 * static_cast<double>(unplanted.sets));
}

template <class Set>
Planted plant_nothing(Set&, RandomStream&) {
  return {DoubtKind::kOdd, {"nobody"}, "nothing"};
}

std::vector<RunDoubt> check_road(CoastdownData& data) { return check_coastdowns(data, {}).doubts; }

std::vector<RunDoubt> check_drum(const CoastSet& set) {
  std::vector<CoastAnalysis> analyses = find_coasts(set);
  std::vector<RunDoubt> doubts = leave_out_repeated_coasts(set, analyses);
  const CoastDoubts checked = check_coasts(set, analyses);
  doubts.insert(doubts.end(), checked.doubts.begin(), checked.doubts.end());
  return doubts;
}

using Road = CoastdownData;
using PlantRoad = Planted (*)(Road&, RandomStream&);
using PlantDrum = Planted (*)(CoastSet&, RandomStream&);

template <class Make>
void study_road(const std::string& where, std::uint64_t seed, bool bins, const Make& make) {
  std::cout << where << "\n";
  const auto count = [&](const char* name, PlantRoad plant) {
    return count_found<Road>(name, seed, make, plant, &check_road);
  };
  std::vector<Tally> planted{count("  the same recording twice", &tests::plant_repeat),
                             count("  a part of it twice", &tests::plant_shared_part),
                             count("  braked run", &tests::plant_brake)};
  if (bins) planted.push_back(count("  wrong labels of bins", &tests::plant_labels));
  require_bar(planted, count("  nothing", &plant_nothing<Road>));
}

template <class Make>
void study_drum(const std::string& where, std::uint64_t seed, const Make& make) {
  std::cout << where << "\n";
  const auto count = [&](const char* name, PlantDrum plant) {
    return count_found<CoastSet>(name, seed, make, plant, &check_drum);
  };
  const std::vector<Tally> planted{count("  the same recording twice", &tests::plant_repeat),
                                   count("  a part of it twice", &tests::plant_shared_part),
                                   count("  loaded and lifted mistaken", &tests::plant_state),
                                   count("  other load at a pressure", &tests::plant_load),
                                   count("  braked run", &tests::plant_brake)};
  require_bar(planted, count("  nothing", &plant_nothing<CoastSet>));
}

}  // namespace

TEST_CASE("planted mistakes in made-up road coastdowns are found, and no innocent run is accused", "[slow]") {
  study_road("road coastdowns, made up, traces", 1, false,
             [](RandomStream& random) { return tests::make_random_coastdowns(random, false); });
  study_road("road coastdowns, made up, bins", 2, true,
             [](RandomStream& random) { return tests::make_random_coastdowns(random, true); });
}

TEST_CASE("planted mistakes in measured road coastdowns are found, and no innocent run is accused", "[slow]") {
  const std::string folder = find_measured("road_coastdown_bins");
  if (folder.empty()) return;
  CoastdownData data = read_coastdowns(folder + "/ioniq_2026-01-16.csv").data;
  for (CoastdownRun& run : data.runs) run.id = run.session.substr(0, 6) + " " + run.id;
  study_road("road coastdowns, measured, bins", 3, true,
             [&data](RandomStream& random) { return tests::draw_runs(data, random); });
  CoastdownData whole = data;
  CHECK(check_road(whole).empty());
}

TEST_CASE("planted mistakes in made-up drum coastdowns are found, and no innocent run is accused", "[slow]") {
  study_drum("drum coastdowns, made up", 4, [](RandomStream& random) { return tests::make_random_coasts(random); });
}

TEST_CASE("planted mistakes in measured drum coastdowns are found, and no innocent run is accused", "[slow]") {
  const std::string folder = find_measured("drum_coastdown");
  if (folder.empty()) return;
  const CoastSet set = read_coast_set(ROLLRIG_SOURCE_DIR "/tests/published/drum_coastdown/set.toml", folder);
  // all pressures, or a choice of them: the set as a person would have measured it
  const auto choose = [&set](RandomStream& random) {
    CoastSet chosen = set;
    chosen.runs.clear();
    const double share = tests::draw_between(random, 0.7, 1.0);
    for (const CoastRun& run : set.runs) {
      if (run.state == CoastState::kLoaded || random.uniform() < share) chosen.runs.push_back(run);
    }
    return chosen;
  };
  study_drum("drum coastdowns, measured", 5, choose);
}
