#include "api/set_items.h"

#include <fmt/format.h>

#include <filesystem>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/fleet.h"
#include "include/rollrig/assets.h"
#include "measurements/measurement_set.h"
#include "sim/core/file_io.h"

namespace rollrig {

Json SetItems::describe(std::size_t item) const { return {{"set", input_.sets[item]}}; }

Json SetItems::carry_out(std::size_t item, std::uint64_t) const {
  const ReadRecorder recorder;
  DiagnosisOptions options;
  options.only = input_.only;
  options.without = input_.without;
  options.smallest_effect_percent = input_.smallest_effect_percent;
  options.threads = 1;
  try {
    Json result = diagnosis::diagnose_member(input_.sets[item], options, input_.bad_rows);
    require_known(recorder.list_files());
    return result;
  } catch (const FileProblem& error) {
    if (knows(error.problem().file)) throw;  // it was there when the campaign was begun
    throw InputError(error.problem());
  }
}

std::vector<std::string> SetItems::calc_values(std::size_t item) const {
  const std::filesystem::path folder(input_.sets[item]);
  return {folder.filename().string(), folder.string()};
}

std::vector<CampaignFile> SetItems::check() const {
  const ReadRecorder recorder;
  std::size_t failed = 0;
  for (const std::string& set : input_.sets) {
    try {
      measurements::read_measurement_set(set, input_.bad_rows);
    } catch (const InputError&) {  // a failure of this item
      if (++failed == count()) throw;
    }
  }
  // A diagnosis may ask whether another tire of the assets was measured (diagnosis/checks/tire_checks.cpp).
  for (const std::string& name : list_assets("tires")) read_text_file(find_asset("tires", name));
  return hash_files(recorder.list_files());
}

Json SetItems::flatten(const Json& result) const {
  const Findings found = diagnosis::read_diagnosis_json(result.at("diagnosis"));
  Json flat{{"machine", result.at("machine")},
            {"tire", result.at("tire")},
            {"verdict", diagnosis::name_of(found.verdict)},
            {"in_doubt", result.at("doubt").get<std::string>().empty() ? 0 : 1},
            {"cause", ""},
            {"gap_before_floors", found.gap.recalibrated.before}};
  if (found.verdict == Verdict::kExplained) {
    flat["cause"] = fmt::format("{}", fmt::join(found.causes.front().effects, " + "));
    flat["probability"] = found.causes.front().probability;
    flat["gap_after_floors"] = found.gap.recalibrated.after;
  }
  return flat;
}

}  // namespace rollrig
