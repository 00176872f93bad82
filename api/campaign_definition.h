#pragma once
/// What a campaign is made of, as its campaign.json says it.

#include <string>
#include <vector>

#include "campaigns/design.h"
#include "rollrig/run_campaign.h"
#include "sim/core/json.h"

namespace rollrig {

/// A file that the runs of a campaign read.
struct CampaignFile {
  std::string path;
  std::string sha256;
};

struct CampaignDefinition {
  std::string version;  // of rollrig
  RunInput run;         // without what differs; paths are absolute
  std::vector<CampaignFile> files;
  campaigns::DesignInput design;

  /// The content of campaign.json (rollrig-campaign/1).
  std::string to_text() const;
  /// Throws InputError: `content` is not what to_text() writes. `path` is for messages.
  static CampaignDefinition read(const std::string& content, const std::string& path);
};

/// Everything that can be said before the first item is carried out: the first and the last item are read and
/// prepared. Throws InputError.
CampaignDefinition make_definition(const RunCampaignInput& input);

/// Throws InputError where a file or the version of rollrig has changed since.
void require_unchanged(const CampaignDefinition& definition, const std::string& path);

}  // namespace rollrig
