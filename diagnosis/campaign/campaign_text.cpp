// A campaign in a terminal, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/campaign/campaign.h"
#include "sim/core/columns.h"
#include "sim/core/text.h"

namespace rollrig::diagnosis {
namespace {

std::string join_names(const std::vector<std::string>& names) {
  return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

Json number_or_null(const std::optional<double>& value) {
  return value.has_value() && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json make_test_json(const CampaignTest& test) {
  return {{"id", test.id},
          {"test", test.test},
          {"hours", test.hours},
          {"hours_until_end", test.hours_until_end},
          {"soaked", test.is_soaked},
          {"by_hand", test.by_hand},
          {"runs", test.runs},
          {"shows", test.shows},
          {"visible", test.visible}};
}

Json make_visibility_json(const EffectVisibility& one) {
  return {{"effect", one.effect},
          {"visible", one.is_visible},
          {"detectability", one.detectability},
          {"share_percent", one.share_percent},
          {"size", one.size},
          {"unit", one.unit},
          {"usual", one.usual},
          {"smallest_visible", number_or_null(one.smallest)}};
}

}  // namespace

std::size_t count_visible(const PlannedCampaign& campaign) {
  return static_cast<std::size_t>(std::count_if(campaign.effects.begin(), campaign.effects.end(),
                                                [](const EffectVisibility& one) { return one.is_visible; }));
}

std::string name_machine(const measurements::MeasurementSet& set) {
  return set.rig.has_value() ? set.rig->name : set.vehicle->name;
}

Table make_test_table(const PlannedCampaign& campaign) {
  Table table{"Tests, in this order", {"until", "visible", "test", "makes visible"}, {}};
  for (const CampaignTest& test : campaign.ledger) {
    table.rows.push_back({fmt::format("{:.1f} h", test.hours_until_end), fmt::format("{}", test.visible),
                          fmt::format("{}: {}", test.id, test.test), join_names(test.shows)});
  }
  return table;
}

Table make_visibility_table(const PlannedCampaign& campaign) {
  Table table{"Effects", {"effect", "visible from", "usual", "unit", "visible of its prior", "d'"}, {}};
  for (const EffectVisibility& one : campaign.effects) {
    table.rows.push_back({one.effect + (one.is_visible ? "" : " (not visible)"),
                          one.smallest.has_value() ? fmt::format("{:.2g}", *one.smallest) : "-",
                          fmt::format("{:.2g}", one.usual), one.unit.empty() ? plain_name(one.size) : one.unit,
                          fmt::format("{:.0f} %", one.share_percent), fmt::format("{:.3g}", one.detectability)});
  }
  return table;
}

std::string format_campaign(const PlannedCampaign& campaign) {
  std::string text = fmt::format("Campaign on {} with tire {}: {:.1f} of {:g} h\n", name_machine(campaign.set),
                                 campaign.set.tire.name, campaign.hours, campaign.most_hours);
  text += wrap(fmt::format("{} of {} effects would be visible at their usual size (d' at least 5)",
                           count_visible(campaign), campaign.effects.size()),
               2);
  if (count_visible(campaign) == 0) {
    text += wrap("No effect of the catalog would be seen. More hours, or other sensors, may show more.", 2);
  }
  text += "\n" + format_table(make_test_table(campaign)) + "\n" + format_table(make_visibility_table(campaign));
  if (!campaign.left_out.empty()) {
    text += "\n" + wrap(fmt::format("Left out, since a measurement set has no place for what they read: {}",
                                    fmt::join(campaign.left_out, "; ")),
                        2);
  }
  return text;
}

Json make_campaign_json(const PlannedCampaign& campaign) {
  return {{"format", "rollrig-campaign/1"},
          {"machine", name_machine(campaign.set)},
          {"kind", campaign.set.kind->word},
          {"tire", campaign.set.tire.name},
          {"most_hours", campaign.most_hours},
          {"hours", campaign.hours},
          {"visible", count_visible(campaign)},
          {"tests", make_list(campaign.ledger, make_test_json)},
          {"effects", make_list(campaign.effects, make_visibility_json)},
          {"left_out", campaign.left_out}};
}

}  // namespace rollrig::diagnosis
