#pragma once
/// What a campaign is made of, as its campaign.json says it.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "campaigns/design.h"
#include "rollrig/item_campaign.h"
#include "sim/core/json.h"

namespace rollrig {

/// A file that the items of a campaign read.
struct CampaignFile {
  std::string path;
  std::string sha256;
};

struct CampaignDefinition {
  std::string version;  // of rollrig
  std::string sources;  // as library_sources() says it; empty in a campaign of an older rollrig
  std::vector<CampaignFile> files;
  RunInput run;  // without what differs; paths are absolute
  campaigns::DesignInput design;
  std::optional<DiagnosisCampaignInput> diagnosis;  // instead of runs; paths are absolute
  std::string list;                                 // the file of a list as it was given, for messages; not stored

  std::uint64_t seed() const { return diagnosis.has_value() ? 1 : design.seed; }  // a diagnosis draws nothing by it

  /// The content of campaign.json (rollrig-item-campaign/1).
  std::string to_text() const;
  /// Throws InputError: `content` is not what to_text() writes. `path` is for messages.
  static CampaignDefinition read(const std::string& content, const std::string& path);
};

/// What `input` says, with its factors; without the files. Throws InputError.
CampaignDefinition make_definition(const RunCampaignInput& input);
CampaignDefinition make_definition(const DiagnosisCampaignInput& input);

/// Throws InputError where the program is of another version or has other sources. `path` is for messages.
void require_same_program(const CampaignDefinition& definition, const std::string& path);

/// Whether the files of a campaign are what they were.
class FileWatch {
 public:
  /// Throws InputError where a file has changed since the campaign was begun, or cannot be read.
  explicit FileWatch(const std::vector<CampaignFile>& files);

  /// The same, quickly: a file is read again only where its time or size has changed. Called from several threads.
  void require_unchanged() const;
  /// The same of some of the files.
  void require_unchanged(const std::vector<std::string>& paths) const;
  /// Throws CampaignChanged for a file that is none of them, such as a tire of the same name in another folder of
  /// assets.
  void require_known(const std::vector<std::string>& paths) const;
  bool knows(const std::string& path) const;

 private:
  struct Known {
    CampaignFile file;
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
  };

  static void require_unchanged(const Known& known);

  std::map<std::string, Known> known_;  // by path
};

}  // namespace rollrig
