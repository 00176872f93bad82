#pragma once
/// A campaign from nothing: which tests of a machine, within so many hours, make most effects visible.

#include <optional>
#include <string>
#include <vector>

#include "progress.h"
#include "result.h"

#pragma GCC visibility push(default)
namespace rollrig {

struct CampaignInput {
  std::string rig = "drum";  // a kind of machine ("drum", "flat_belt", "dyno", "road"), or a rig by name or path
  std::string tire = "a50";  // by name or path
  std::string vehicle = "source_car";  // by name or path; of the road
  std::string sensors;                 // a preset by name or path; empty: the usual ones of the machine
  double hours = 8.0;                  // of the machine at most: set-up, soaks and runs
  std::vector<std::string> only;       // where not empty, the effects that count
  std::vector<std::string> without;    // effects that do not count
  int threads = 0;                     // 0: as many as the machine has
  Progress progress = {};
};

/// What a campaign would show of an effect.
struct EffectVisibility {
  std::string effect;
  double detectability = 0.0;      // d' at its usual size: change over its standard deviation, all else free
  bool is_visible = false;         // d' >= 5
  double share_percent = 0.0;      // of what is believed of its size before any test: so much is visible
  std::string size;                // key of its size
  std::string unit;                // symbol
  double usual = 0.0;              // the middle of what is believed of it, in the unit of the key
  std::optional<double> smallest;  // visible size on the same side; none within its range: nothing
};

/// A test of a campaign.
struct CampaignTest {
  std::string id;
  std::string test;                  // what is done, in words
  double hours = 0.0;                // of the machine
  double hours_until_end = 0.0;      // of the campaign, this test included
  bool is_soaked = false;            // every run starts after a soak
  std::vector<std::string> by_hand;  // what is done beside the runs, a sentence each
  std::vector<std::string> runs;     // their ids
  std::vector<std::string> shows;    // effects that become visible with it
  std::size_t visible = 0;           // effects that are visible after it
};

/// A campaign; as a report with the files of a folder: run files for `rollrig run`, a set.toml to be filled, plan.txt.
struct Campaign : Report {
  std::string machine;
  std::string tire;
  double most_hours = 0.0;
  double hours = 0.0;
  std::vector<CampaignTest> tests;
  std::vector<EffectVisibility> effects;
};

/// Chooses the tests of a machine's menu that make most effects visible within the hours.
/// Errors  InputError: a machine, tire, vehicle, sensor or effect that there is not, with the nearest name; hours out of
///         range, or too few for any test
Campaign plan_campaign(const CampaignInput& input);

}  // namespace rollrig
#pragma GCC visibility pop
