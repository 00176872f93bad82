#include "report/campaign_page.h"

#include <fmt/format.h>

#include "report/blocks.h"
#include "report/diagnosis_page.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

using diagnosis::PlannedCampaign;

Block make_course(const PlannedCampaign& campaign) {
  ChartSeries visible;
  visible.add(0.0, 0.0);
  for (const CampaignTest& test : campaign.ledger) {
    visible.add(test.hours_until_end, static_cast<double>(test.visible));
  }
  return make_curves({"hours", "h"}, {"Visible effects", "", true}, Json::array({visible.finish("visible", "line")}),
                     "Each point is the end of a test; set-up and soaks are counted.");
}

/// How much of each effect's prior is visible.
Block make_shares(const PlannedCampaign& campaign) {
  Json names = Json::array();
  Json shares = Json::array();
  std::vector<const EffectVisibility*> effects;
  for (const EffectVisibility& one : campaign.effects) effects.push_back(&one);
  std::stable_sort(effects.begin(), effects.end(), [](const EffectVisibility* a, const EffectVisibility* b) {
    return a->share_percent > b->share_percent;
  });
  for (const EffectVisibility* one : effects) {
    names.push_back(name_effect(one->effect));
    shares.push_back(rounded(one->share_percent));
  }
  return make_bars(
      {"Chance that the effect is visible if it acts, whatever its size", "%"}, names,
      Json::array({{{"name", "visible"}, {"values", shares}}}),
      "Over all sizes that the effect may have: a very small one stays invisible.");
}

Section make_hand_work(const PlannedCampaign& campaign) {
  Section section{"By hand", "What is done beside the runs."};
  for (const CampaignTest& test : campaign.ledger) {
    for (const std::string& step : test.by_hand) section.blocks.push_back(make_paragraph(test.id + ": " + step));
  }
  return section;
}

/// The tables of the terminal, with names in place of words that files and options have.
Table make_named_effects(const PlannedCampaign& campaign) {
  Table table = diagnosis::make_visibility_table(campaign);
  for (std::size_t i = 0; i < campaign.effects.size(); ++i) {
    const EffectVisibility& one = campaign.effects[i];
    table.rows[i].front() = name_effect(one.effect) + (one.is_visible ? "" : " (not visible)");
  }
  return table;
}

Table make_named_tests(const PlannedCampaign& campaign) {
  Table table = diagnosis::make_test_table(campaign);
  for (std::size_t i = 0; i < campaign.ledger.size(); ++i) {
    const CampaignTest& test = campaign.ledger[i];
    std::string shown;
    for (const std::string& effect : test.shows) shown += (shown.empty() ? "" : ", ") + name_effect(effect);
    table.rows[i][2] = fmt::format("{}: {}", plain_name(test.id), test.test);
    table.rows[i].back() = shown.empty() ? "-" : shown;
  }
  return table;
}

}  // namespace

Page make_campaign_page(const PlannedCampaign& campaign) {
  Page page{
      "plan",
      fmt::format("Plan of tests on {} with tire {}", diagnosis::name_machine(campaign.set), campaign.set.tire.name),
      fmt::format("{:.1f} of {:g} h", campaign.hours, campaign.most_hours)};
  Section what{"What it would show"};
  const std::size_t visible = diagnosis::count_visible(campaign);
  what.blocks.push_back(
      make_lead(visible > 0 ? "good" : "doubt",
                fmt::format("In {:.1f} h, {} would show {} of {} effects that have their usual size.", campaign.hours,
                            format_count(campaign.ledger.size(), "test"), visible, campaign.effects.size())));
  what.blocks.push_back(
      make_tiles({{"Visible effects",
                   fmt::format("{} of {}", visible, campaign.effects.size()),
                   "",
                   "effects that the tests would show, at their usual size",
                   visible > 0 ? "good" : "doubt",
                   {"/visible"}},
                  {"Time",
                   fmt::format("{:.1f}", campaign.hours),
                   "h",
                   fmt::format("of {:g} h", campaign.most_hours),
                   "",
                   {"/hours"}},
                  {"Tests", fmt::format("{}", campaign.ledger.size()), "", "in their order below", "", {}}}));
  what.blocks.push_back(make_shares(campaign));
  what.blocks.push_back(make_paragraph(
      "A visible effect changes the measurement by 5 standard deviations more than the uncertain numbers of the files "
      "can imitate. Which effect it is, the diagnosis of the tests says."));
  what.blocks.push_back(make_table(make_named_effects(campaign)));
  page.add(std::move(what));
  page.add({"Tests", "", {make_course(campaign), make_table(make_named_tests(campaign))}});
  page.add(make_hand_work(campaign));
  if (!campaign.left_out.empty()) {
    page.add({"Left out",
              "A measurement set has no place for what these tests read.",
              {{{"type", "text"}, {"items", campaign.left_out}}}});
  }
  return page;
}

}  // namespace rollrig::report
