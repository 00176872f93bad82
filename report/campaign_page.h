#pragma once
/// The page of `rollrig plan`.

#include "diagnosis/campaign/campaign.h"
#include "report/page.h"

namespace rollrig::report {

/// Which effects a campaign would show and from which size on, which it would not, and its tests hour by hour.
Page make_campaign_page(const diagnosis::PlannedCampaign& campaign);

}  // namespace rollrig::report
