#include "api/set_items.h"

#include <fmt/format.h>

#include <filesystem>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/fleet.h"
#include "include/rollrig/assets.h"
#include "measurements/measurement_set.h"
#include "sim/core/file_io.h"

namespace rollrig {

DiagnosisOptions make_diagnosis_options(const DiagnosisCampaignInput& input) {
  DiagnosisOptions options;
  options.only = input.only;
  options.without = input.without;
  options.smallest_effect_percent = input.smallest_effect_percent;
  options.threads = 1;  // several sets at the same time
  return options;
}

Json SetItems::describe(std::size_t item) const { return {{"set", input_.sets[item]}}; }

Json SetItems::carry_out(std::size_t item, std::uint64_t) const {
  const ReadRecorder recorder;
  try {
    Json result = diagnosis::diagnose_member(input_.sets[item], make_diagnosis_options(input_), input_.bad_rows);
    require_known(recorder.list_files());
    require_unchanged_files(recorder.list_files());
    return result;
  } catch (const campaigns::CampaignChanged&) {
    throw;
  } catch (const FileProblem& error) {
    if (knows(error.problem().file)) throw;  // it was there when the campaign was begun
    throw InputError(error.problem());
  } catch (const std::exception&) {
    require_unchanged_files(recorder.list_files());  // else it would count as a failure of the set
    throw;
  }
}

std::vector<std::string> SetItems::calc_values(std::size_t item) const {
  const std::filesystem::path folder(input_.sets[item]);
  return {folder.filename().string(), folder.string()};
}

CampaignItems::Check SetItems::check() const {
  const ReadRecorder recorder;
  Check found;
  for (const std::string& set : input_.sets) {
    try {
      measurements::read_measurement_set(set, input_.bad_rows);
    } catch (const InputError& error) {
      found.warnings.emplace_back(error.what());
      if (found.warnings.size() == count()) throw;
    }
  }
  // A diagnosis may ask whether another tire of the assets was measured (diagnosis/checks/tire_checks.cpp).
  for (const std::string& name : list_assets("tires")) read_text_file(find_asset("tires", name));
  for (const std::string& file : recorder.list_files()) {
    try {
      const std::vector<CampaignFile> hashed = hash_files({file});
      found.files.push_back(hashed.front());
    } catch (const FileProblem&) {  // of a set that fails, such as an empty file
    }
  }
  return found;
}

Json SetItems::flatten(const Json& result) const {
  diagnosis::Fleet one;
  diagnosis::add_member("", result, one);
  const FleetMember& member = one.members.front();
  const Findings& found = *member.findings;
  Json flat{{"machine", member.machine},
            {"tire", member.tire},
            {"verdict", diagnosis::name_of(found.verdict)},
            {"in_doubt", found.doubt.empty() ? 0 : 1},
            {"cause", ""},
            {"gap_before_floors", found.gap.recalibrated.before}};
  if (found.verdict == Verdict::kExplained && !found.causes.empty()) {
    flat["cause"] = fmt::format("{}", fmt::join(found.causes.front().effects, " + "));
    flat["probability"] = found.causes.front().probability;
    flat["gap_after_floors"] = found.gap.recalibrated.after;
  }
  return flat;
}

}  // namespace rollrig
