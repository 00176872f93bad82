#include "rollrig/plan.h"

#include "api/data.h"
#include "api/option_range.h"
#include "diagnosis/campaign/campaign.h"
#include "diagnosis/campaign/campaign_files.h"
#include "report/campaign_page.h"
#include "rollrig/diagnose.h"

namespace rollrig {

Campaign plan_campaign(const CampaignInput& input) {
  require_comparable_effects(input.only, input.without);
  require_threads(input.threads);
  const auto planned = std::make_shared<const diagnosis::PlannedCampaign>(diagnosis::plan_campaign(input));
  Campaign campaign;
  campaign.machine = diagnosis::name_machine(planned->set);
  campaign.tire = planned->set.tire.name;
  campaign.most_hours = planned->most_hours;
  campaign.hours = planned->hours;
  campaign.tests = planned->ledger;
  campaign.effects = planned->effects;
  campaign.text = diagnosis::format_campaign(*planned);
  campaign.json = to_text(diagnosis::make_campaign_json(*planned));
  campaign.make_files = [planned] { return to_folder(diagnosis::write_campaign(*planned)); };
  campaign.make_page = [planned] { return report::make_html(report::make_campaign_page(*planned)); };
  return campaign;
}

}  // namespace rollrig
