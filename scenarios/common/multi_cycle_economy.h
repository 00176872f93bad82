#pragma once
/// Results of a multi-cycle test that follow from the energies of its sections.

#include <string>
#include <vector>

#include "scenarios/common/drive_sections.h"
#include "scenarios/common/multi_cycle_energy.h"

namespace rollrig::scenarios {

/// City, highway, or both combined, as the test gives them and as a label would show them.
struct CycleResult {
  std::string name;
  CycleEconomy economy;
  double label_factor = 0.0;

  void visit(ResultSheet& visit) const;
};

/// Absent, all of it, in a test of another order than that of SAE J1634.
struct EconomyResults {
  std::optional<double> usable_J;
  std::optional<std::string> usable_from;  // "battery" or "sections"
  std::optional<double> recharge_J;
  std::optional<std::string> recharge_from;  // "recharge_energy_kWh", or the charging efficiency
  std::optional<double> first_city_weight;
  std::optional<double> end_needed_s;  // end section that would empty the battery
  std::optional<ColdExcess> cold;
  std::vector<CycleResult> cycles;

  /// Whether a range follows from a battery; else from the lengths of the sections, which a test sets.
  bool is_range_of_battery() const { return usable_from == "battery"; }
  /// All but the list of the cycles.
  void visit(ResultSheet& visit) const;
  void visit_cycles(ResultSheet& visit) const;
};

/// Phase scaling, ranges and the excess of the first city section. The usable energy is that of the vehicle's battery,
/// or what all sections took. Warns where the battery is not empty at the end, or there is none, and of a charge that
/// loses much. Throws InputError where the battery is
/// empty before the last section.
EconomyResults evaluate_economy(const RunSpec& spec, const rigs::VehicleLayout& layout,
                                const std::vector<DriveSection>& sections, double label_factor, Outcome& outcome);

}  // namespace rollrig::scenarios
