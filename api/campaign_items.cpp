#include "api/campaign_items.h"

#include "api/run_items.h"
#include "api/set_items.h"
#include "sim/core/file_io.h"

namespace rollrig {

std::unique_ptr<CampaignItems> make_items(const CampaignDefinition& definition) {
  if (definition.diagnosis.has_value()) return std::make_unique<SetItems>(*definition.diagnosis);
  return std::make_unique<RunItems>(definition);
}

std::vector<CampaignFile> hash_files(const std::vector<std::string>& paths) {
  std::vector<CampaignFile> files;
  for (const std::string& path : paths) files.push_back({path, calc_sha256(read_binary_file(path))});
  return files;
}

}  // namespace rollrig
