#pragma once
/// The sets of `rollrig diagnose` of a folder as items. Their diagnoses stay in memory.

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "campaigns/items.h"
#include "diagnosis/output/fleet.h"
#include "measurements/measurement_set.h"

namespace rollrig {

class FleetItems : public campaigns::ItemList {
 public:
  /// Reads the sets. One that cannot be read is noted, and the others are diagnosed.
  /// Errors  InputError: no set can be read; an unknown effect in `options`
  FleetItems(const std::vector<std::string>& folders, DiagnosisOptions options, BadRows bad_rows);

  std::size_t count() const override { return members_.size(); }
  Json describe(std::size_t item) const override { return {{"set", members_[item].folder}}; }
  /// Diagnoses a set, and keeps what came out. A diagnosis that fails is noted, and the others go on.
  Json carry_out(std::size_t item, std::uint64_t seed) const override;

  /// All sets, as far as they are carried out.
  diagnosis::Fleet make_fleet() const;

 private:
  /// Tells how far all sets are together.
  void advance(std::size_t item, double share) const;

  DiagnosisOptions options_;
  std::vector<std::optional<measurements::MeasurementSet>> sets_;  // none where it cannot be read
  mutable std::vector<FleetMember> members_;
  mutable std::vector<double> shares_;  // of each set, what is done
  mutable std::mutex mutex_;            // of shares_
};

}  // namespace rollrig
