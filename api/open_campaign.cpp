#include "api/open_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "sim/core/assets.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace fs = std::filesystem;

namespace rollrig {

std::string OpenCampaign::path_of_definition() const { return (fs::path(folder.path) / kCampaignFileName).string(); }

std::vector<std::string> OpenCampaign::list_filled_files() const {
  const std::vector<std::string> files = folder.list_files();
  if (!files.empty()) return files;
  throw InputError({"the campaign has no results yet", folder.path, 0, "", "", "rollrig campaign run first", ""});
}

std::unique_ptr<CampaignItems> OpenCampaign::make_watched_items() const {
  require_same_program(definition, path_of_definition());
  std::unique_ptr<CampaignItems> watched = make_items(definition);
  watched->watch_files(definition.files);
  const fs::path assets = fs::path(find_assets_folder()).lexically_normal();
  const auto is_asset = [&assets](const CampaignFile& file) {  // <assets>/<kind>/<name>
    return fs::path(file.path).parent_path().parent_path() == assets;
  };
  watched->check_briefly(std::all_of(definition.files.begin(), definition.files.end(), is_asset));
  return watched;
}

OpenCampaign open_campaign(const std::string& folder) {
  const std::string path = (fs::path(folder) / kCampaignFileName).string();
  if (!is_there(path)) {
    throw InputError({fmt::format("'{}' is no folder of a campaign", folder), "command line", 0, "folder", folder,
                      fmt::format("a folder with a {}, which rollrig campaign new makes", kCampaignFileName), ""});
  }
  const std::string content = read_text_file(path);
  const CampaignDefinition definition = CampaignDefinition::read(content, path);
  try {
    return {definition, content, make_items(definition), {folder, calc_sha256(content), definition.seed()}};
  } catch (const InputError& error) {  // of a design that somebody has changed by hand
    InputProblem problem = error.problem();
    problem.file = path;
    throw InputError(problem);
  }
}

CampaignState make_state(const campaigns::Tally& tally, const std::string& of,
                         const std::vector<std::string>& running) {
  CampaignState state;
  state.items = tally.items;
  state.done = tally.done;
  state.failed = tally.failed;
  state.json = to_text(Json{{"format", "rollrig-campaign-state/1"},
                            {"items", tally.items},
                            {"done", tally.done},
                            {"failed", tally.failed},
                            {"processes", running.size()}});
  state.text = wrap(
      fmt::format("{}: {} of {} done{}{}", of, tally.done, format_count(tally.items, "item"),
                  tally.failed > 0 ? fmt::format(", {} of them failed", tally.failed) : "",
                  running.empty()
                      ? ""
                      : fmt::format(", {} running",
                                    running.size() == 1 ? "1 process" : fmt::format("{} processes", running.size()))),
      0);
  return state;
}

}  // namespace rollrig
