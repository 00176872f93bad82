#include "api/report_files.h"

#include "api/watched_items.h"

namespace rollrig {

std::vector<report::ReportFile> list_report_files(const ReadRecorder& recorder,
                                                  const std::function<std::string(const std::string&)>& find_role) {
  std::vector<report::ReportFile> files;
  for (const CampaignFile& file : hash_files(recorder.list_files())) {
    files.push_back({find_role(file.path), file.path, file.sha256});
  }
  return files;
}

}  // namespace rollrig
