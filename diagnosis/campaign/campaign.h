#pragma once
/// A campaign from nothing: the tests of the menu that make most effects visible within so many hours.

#include "diagnosis/next_test/test_menu.h"
#include "include/rollrig/plan.h"
#include "measurements/measurement_set.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

using rollrig::CampaignInput, rollrig::CampaignTest, rollrig::EffectVisibility;

/// What is planned, with what its files need.
struct PlannedCampaign {
  measurements::MeasurementSet set;  // machine, tire and sensors; its one run stands for the usual conditions
  double most_hours = 0.0;
  double hours = 0.0;
  std::vector<PlannedTest> tests;    // in the order in which they are done
  std::vector<CampaignTest> ledger;  // of each of them
  std::vector<EffectVisibility> effects;
  std::vector<std::string> left_out;  // tests of the menu that no set could hold
};

/// Hours that a campaign may have.
constexpr double kLeastHours = 0.5;
constexpr double kMostHours = 1000.0;

/// Machine, tire and sensors that an input names, under the usual conditions: the load and pressure of the tire's
/// [iso_28580], else those to which its law refers.
/// Errors  InputError
measurements::MeasurementSet make_usual_set(const CampaignInput& input);

/// Chooses greedily by what a test adds to the expected number of visible effects, per hour, until no test fits, then
/// takes each test out in turn and fills its hours anew, as long as that makes more effects visible. Each test is done
/// once; its hours are those of the menu: set-up, soaks and runs.
///
/// Equation  value = sum over effects of P(|x - off| >= |m - off| 5/d') + 0.1 min(1, d'/5)
/// Symbols   x an effect's size, distributed by its prior; m its middle; off the size at which it does nothing; d' its
///           detectability at the middle, the lower of both signs
/// Validity  linear in the size; a visible effect may still be taken for another one. Assumed: the 0.1, so that tests
///           count that bring an effect nearer to being visible
/// Errors    InputError: an unknown effect; hours out of range, or too few for any test
/// Checked   tests/diagnosis/campaign_test.cpp
PlannedCampaign plan_campaign(const CampaignInput& input);

/// How many effects are visible at their usual size.
std::size_t count_visible(const PlannedCampaign& campaign);
/// Of its rig or vehicle.
std::string name_machine(const measurements::MeasurementSet& set);
/// A row each test, a row each effect.
Table make_test_table(const PlannedCampaign& campaign);
Table make_visibility_table(const PlannedCampaign& campaign);
/// For a terminal.
std::string format_campaign(const PlannedCampaign& campaign);
/// rollrig-campaign/1
Json make_campaign_json(const PlannedCampaign& campaign);

}  // namespace rollrig::diagnosis
