#pragma once
/// A campaign in its folder, as it is read.

#include <memory>
#include <string>
#include <vector>

#include "api/campaign_items.h"

namespace rollrig {

constexpr const char* kCampaignFileName = "campaign.json";

struct OpenCampaign {
  CampaignDefinition definition;
  std::string content;  // of campaign.json
  std::unique_ptr<CampaignItems> items;
  campaigns::CampaignFolder folder;

  std::string path_of_definition() const;
  /// All results files. Throws InputError where there is none.
  std::vector<std::string> list_filled_files() const;
  /// Items that can be carried out. Throws InputError where rollrig or a file has changed.
  std::unique_ptr<CampaignItems> make_watched_items() const;
};

/// Throws InputError: the folder holds no campaign.
OpenCampaign open_campaign(const std::string& folder);

/// How far a campaign or a part of it is, with `running`, the files that other processes write. `of` is its name.
CampaignState make_state(const campaigns::Tally& tally, const std::string& of,
                         const std::vector<std::string>& running = {});

}  // namespace rollrig
