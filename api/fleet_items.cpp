#include "api/fleet_items.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig {

FleetItems::FleetItems(const std::vector<std::string>& folders, DiagnosisOptions options, BadRows bad_rows)
    : options_(std::move(options)), shares_(folders.size()) {
  diagnosis::require_valid_options(options_);
  for (const std::string& folder : folders) {
    FleetMember& member = members_.emplace_back();
    member.folder = folder;
    try {
      sets_.emplace_back(measurements::read_measurement_set(folder, bad_rows));
      member.machine = diagnosis::machine_of(*sets_.back());
      member.tire = sets_.back()->tire.name;
    } catch (const InputError& error) {
      sets_.emplace_back();
      member.failure = error.what();
      member.problem = error.problem();
    }
  }
  const auto failed = [](const FleetMember& member) { return member.problem.has_value(); };
  if (!std::all_of(members_.begin(), members_.end(), failed)) return;
  throw InputError(*members_.front().problem);
}

void FleetItems::advance(std::size_t item, double share) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  shares_[item] = std::max(shares_[item], share);
  const double sum = std::accumulate(shares_.begin(), shares_.end(), 0.0);
  const auto sets = static_cast<double>(shares_.size());
  if (options_.progress) options_.progress(sum / sets, format_count(shares_.size(), "set"));
}

Json FleetItems::carry_out(std::size_t item, std::uint64_t) const {
  if (!sets_[item].has_value()) return {};
  DiagnosisOptions one = options_;
  one.threads = 1;
  one.progress = [this, item](double share, const std::string&) { advance(item, share); };
  FleetMember& member = members_[item];  // of this item alone
  try {
    member.findings = diagnosis::diagnose(*sets_[item], one);
  } catch (const RunFailure& failure) {
    member.failure = failure.what();
  } catch (const InputError& error) {  // what a diagnosis cannot do with: a sensor without noise, say
    member.failure = error.what();
    member.problem = error.problem();
  }
  return {};
}

diagnosis::Fleet FleetItems::make_fleet() const {
  diagnosis::Fleet fleet;
  fleet.members = members_;
  fleet.recurrences = diagnosis::find_recurrences(fleet.members);
  return fleet;
}

}  // namespace rollrig
