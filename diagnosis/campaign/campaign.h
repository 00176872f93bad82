#pragma once
/// A campaign: the tests of the menu that make most effects visible within so many hours, chosen before any is
/// measured.

#include "diagnosis/next_test/test_menu.h"
#include "include/rollrig/plan.h"
#include "measurements/measurement_set.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

using rollrig::CampaignInput, rollrig::CampaignTest, rollrig::EffectVisibility;

/// A planned campaign, and what its files need.
struct PlannedCampaign {
  measurements::MeasurementSet set;  // machine, tire and sensors; its one run stands for the usual conditions
  double most_hours = 0.0;           // as asked for
  double hours = 0.0;                // that the tests take
  std::vector<PlannedTest> tests;    // in the order in which they are done
  std::vector<CampaignTest> ledger;  // what each of them makes visible, in the same order
  std::vector<EffectVisibility> effects;
  std::vector<std::string> left_out;  // tests of the menu whose readings no measurement set could hold
};

/// Machine, tire and sensors that an input names, under the usual conditions: the load and pressure of the tire's
/// [iso_28580], else those to which its law refers.
/// Errors  InputError
measurements::MeasurementSet make_usual_set(const CampaignInput& input);

/// Adds tests one by one, each time the one with the largest gain of value per hour, until none that fits gains 0.001
/// per hour. Then takes out one or two tests and fills their hours again, as long as this makes more effects visible,
/// or as many with a higher value. No test is done twice; its hours are those of the menu: set-up, soaks and runs.
///
/// Equation  value = sum over effects of P(|x - off| >= |m - off| 5/d') + 0.1 min(1, d'/5)
/// Symbols   x an effect's size, distributed by its prior; m the size at which it is judged (list_judged_sizes); off
///           the size at which it does nothing; d' its detectability at m. Of several m, the one with the lowest d'
///           counts
/// Validity  linear in the size; a visible effect may still be taken for another one. Assumed: the 0.1, so that tests
///           count that bring an effect nearer to being visible
/// Errors    InputError: an unknown effect; hours out of range, or too few for any test
/// Checked   tests/diagnosis/campaign_test.cpp
PlannedCampaign plan_campaign(const CampaignInput& input);

/// How many effects are visible at their usual size.
std::size_t count_visible(const PlannedCampaign& campaign);
/// Of its rig or vehicle.
std::string name_machine(const measurements::MeasurementSet& set);
/// A row for each test.
Table make_test_table(const PlannedCampaign& campaign);
/// A row for each effect.
Table make_visibility_table(const PlannedCampaign& campaign);
/// For a terminal.
std::string format_campaign(const PlannedCampaign& campaign);
/// rollrig-campaign/1
Json make_campaign_json(const PlannedCampaign& campaign);

}  // namespace rollrig::diagnosis
