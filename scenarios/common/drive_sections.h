#pragma once
/// Sections of a drive: what each took, of one tire and of the whole vehicle.

#include <optional>
#include <string>
#include <vector>

#include "scenarios/common/vehicle_bench.h"

namespace rollrig::scenarios {

/// One section, or all of them together: of one tire (the first that is simulated), and of the whole vehicle.
struct DriveSection {
  std::string name;
  double distance_m = 0.0;
  double duration_s = 0.0;
  double rr_J = 0.0;
  std::optional<double> rr_iso_J;
  std::optional<double> mean_rrc;
  double start_K = 0.0;
  double end_K = 0.0;
  double vehicle_rr_J = 0.0;
  double drive_J = 0.0;
  double recuperated_J = 0.0;
  double battery_J = 0.0;

  std::optional<double> calc_difference() const;
  /// Energy of the battery over the distance; nothing where there is none.
  std::optional<double> calc_consumption_J_per_m() const;
  void visit(ResultSheet& visit) const;
};

/// Energy out of the battery for what the hubs gave out and took in, with that of other consumers.
/// Equation  E = D/eta - R eta_r + P_a t, or with a map the integral of P_b + P_a
/// Symbols   D energy given out at the driven hubs, R taken in there by the motor, eta and eta_r efficiencies, P_a
///           auxiliary power, t duration; P_b models/vehicle/powertrain_map.h
/// Validity  efficiencies that neither temperature nor state of charge changes
/// Source    definition of the efficiencies
/// Checked   tests/scenarios/vehicle_scenarios_test.cpp, tests/scenarios/multi_cycle_test.cpp
double calc_battery_J(const rigs::VehicleFile& vehicle, const SectionReader& reader, double duration_s);

/// The ISO coefficient of the tire that is shown, as a true loss like the energy of the model.
std::optional<double> find_shown_iso_rrc(const RunSpec& spec, const rigs::VehicleLayout& layout);

/// What the phase of this index came to.
DriveSection evaluate_section(const RunSpec& spec, const rigs::VehicleLayout& layout,
                              const sim::Recording<double>& recording, std::size_t phase);

/// The whole drive; without ISO energy where a section has none.
DriveSection add_up(const std::vector<DriveSection>& sections);

/// Which wheels are simulated, for a person.
std::string describe_wheels(const VehicleConditions& conditions, const rigs::VehicleLayout& layout);

/// Says where a drive left the map of the powertrain, by speed or by power, so that the nearest edge counted.
void warn_of_map(const RunSpec& spec, const rigs::VehicleLayout& layout, Outcome& outcome);

/// Warns that the model of the tire is not used if a measured road load stands for it (has_tire_loss()).
void warn_of_unused_tire(const RunSpec& spec, Outcome& outcome);

}  // namespace rollrig::scenarios
