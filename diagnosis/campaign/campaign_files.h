#pragma once
/// A campaign as files.

#include <map>
#include <string>

#include "diagnosis/campaign/campaign.h"

namespace rollrig::diagnosis {

/// By file name: run-<n>.toml (as `rollrig run` takes it) and a CSV of its inputs for each run of all tests, in order,
/// tire.toml and rig.toml (of the road: vehicle.toml), set.toml for what is measured, plan.txt for a person.
/// Checked  tests/diagnosis/campaign_test.cpp
std::map<std::string, std::string> write_campaign(const PlannedCampaign& campaign);

}  // namespace rollrig::diagnosis
