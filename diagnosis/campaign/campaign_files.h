#pragma once
/// A campaign as files.

#include <map>
#include <string>

#include "diagnosis/campaign/campaign.h"

namespace rollrig::diagnosis {

/// Content by file name: run-<n>.toml (for `rollrig run`) and a CSV file of its inputs for each run of all tests, in
/// order; tire.toml; rig.toml, or on the road vehicle.toml; a set.toml for the measured files; plan.txt for a person.
/// Checked  tests/diagnosis/campaign_test.cpp
std::map<std::string, std::string> write_campaign(const PlannedCampaign& campaign);

}  // namespace rollrig::diagnosis
