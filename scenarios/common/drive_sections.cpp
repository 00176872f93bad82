#include "scenarios/common/drive_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenarios/common/iso_coefficient.h"
#include "scenarios/run/tire_validity.h"

namespace rollrig::scenarios {

std::optional<double> DriveSection::calc_difference() const {
  if (!rr_iso_J.has_value() || *rr_iso_J <= 0.0) return std::nullopt;
  return rr_J / *rr_iso_J - 1.0;
}

std::optional<double> DriveSection::calc_consumption_J_per_m() const {
  if (distance_m <= 0.0) return std::nullopt;
  return battery_J / distance_m;
}

void DriveSection::visit(ResultSheet& visit) const {
  visit(Result{"name", "section", "", "its phase", Column::kBoth}, name);
  visit(Result{"distance_km", "", ".2f", "driven in it"}, distance_m);
  visit(
      Result{"rr_energy_Wh", "model", ".1f", "energy of rolling resistance of one tire (true loss), counted stretches"},
      rr_J);
  visit(Result{"rr_energy_iso_Wh", "ISO", ".1f",
               "the same by iso_rrc_true_N_per_kN; null where the tire has no coefficient, or no loss of its own"},
        rr_iso_J);
  visit(Result{"difference_percent", "diff.", ".1f", "of the first from the second"}, calc_difference());
  visit(Result{"mean_rrc_N_per_kN", "RRc", ".2f", "mean over time of F_rr/Fz, counted stretches"}, mean_rrc);
  visit(Result{"temperature_start_degC", "start", ".1f", "of the liner", Column::kSecond}, start_K);
  visit(Result{"temperature_end_degC", "end", ".1f", "of the liner", Column::kSecond}, end_K);
  visit(Result{"vehicle_rr_energy_Wh", "tires", ".1f",
               "energy of rolling resistance of all tires that roll, counted stretches"},
        vehicle_rr_J);
  visit(Result{"wheel_energy_Wh", "hubs", ".0f", "given out at the driven hubs, whole vehicle", Column::kSecond},
        drive_J);
  visit(Result{"recuperated_Wh", "recup.", ".0f", "taken in by the motor while it brakes", Column::kSecond},
        recuperated_J);
  visit(Result{"battery_energy_Wh", "battery", ".0f",
               "out of the battery, by the efficiency or the map of [powertrain], with its auxiliary power",
               Column::kSecond},
        battery_J);
  visit(Result{"consumption_Wh_per_km", "", ".1f", "of it, per distance", Column::kSecond}, calc_consumption_J_per_m());
  const std::optional<double> consumption_J_per_m = calc_consumption_J_per_m();
  visit(Result{"consumption_mi_per_kWh", "", ".2f", "the same, as distance over energy", Column::kSecond},
        consumption_J_per_m.has_value() && *consumption_J_per_m > 0.0 ? std::optional(1.0 / *consumption_J_per_m)
                                                                      : std::nullopt);
}

double calc_battery_J(const rigs::VehicleFile& vehicle, const SectionReader& reader, double duration_s) {
  const rigs::VehiclePowertrain& powertrain = vehicle.powertrain;
  const double auxiliary_J = powertrain.auxiliary_power_W * duration_s;
  if (powertrain.map.has_value()) return reader.battery_J() + auxiliary_J;
  return reader.vehicle(rigs::VehicleIntegral::kDriveEnergy) / powertrain.efficiency -
         reader.vehicle(rigs::VehicleIntegral::kRecuperated) * powertrain.calc_regeneration_efficiency() + auxiliary_J;
}

std::optional<double> find_shown_iso_rrc(const RunSpec& spec, const rigs::VehicleLayout& layout) {
  return calc_true_iso_rrc(rigs::tire_of(spec.vehicle->axles[layout.wheels.front().axle], spec.tire), spec.baseline);
}

DriveSection evaluate_section(const RunSpec& spec, const rigs::VehicleLayout& layout,
                              const sim::Recording<double>& recording, std::size_t phase) {
  using rigs::VehicleIntegral;
  using rigs::WheelIntegral;
  const SectionReader reader(recording, layout, phase);
  const sim::PhaseSpan& span = recording.phases[phase];
  DriveSection section;
  section.name = span.name;
  section.distance_m = reader.common(VehicleIntegral::kDistance);
  section.duration_s = span.end_s - span.start_s;
  section.rr_J = reader.wheel(WheelIntegral::kCountedRollingEnergy, 0);
  const auto iso_rrc = find_shown_iso_rrc(spec, layout);
  if (iso_rrc.has_value() && has_tire_loss(spec)) {
    section.rr_iso_J =
        *iso_rrc * layout.wheels.front().static_load_N * reader.common(VehicleIntegral::kCountedDistance);
  }
  const double counted_s = reader.common(VehicleIntegral::kCountedTime);
  if (counted_s > 0.0) section.mean_rrc = reader.wheel(WheelIntegral::kCountedRrc, 0) / counted_s;
  const std::vector<double>& temperature_K =
      recording.channel(rigs::wheel_channel(quantities::kLinerTemperature, layout.wheels.front()));
  section.start_K = temperature_K[recording.row_at(span.start_s)];
  section.end_K = temperature_K[recording.row_at(span.end_s - spec.sample_interval_s)];
  for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
    section.vehicle_rr_J += reader.wheel(WheelIntegral::kCountedRollingEnergy, wheel) / layout.share;
  }
  section.drive_J = reader.vehicle(VehicleIntegral::kDriveEnergy);
  section.recuperated_J = reader.vehicle(VehicleIntegral::kRecuperated);
  section.battery_J = calc_battery_J(*spec.vehicle, reader, section.duration_s);
  return section;
}

DriveSection add_up(const std::vector<DriveSection>& sections) {
  DriveSection total;
  total.name = "all sections";
  total.start_K = total.end_K = std::nan("");
  total.mean_rrc = std::nan("");
  total.rr_iso_J = 0.0;
  for (const DriveSection& section : sections) {
    total.distance_m += section.distance_m;
    total.duration_s += section.duration_s;
    total.rr_J += section.rr_J;
    total.rr_iso_J = total.rr_iso_J.has_value() && section.rr_iso_J.has_value()
                         ? std::optional(*total.rr_iso_J + *section.rr_iso_J)
                         : std::nullopt;
    total.vehicle_rr_J += section.vehicle_rr_J;
    total.drive_J += section.drive_J;
    total.recuperated_J += section.recuperated_J;
    total.battery_J += section.battery_J;
  }
  return total;
}

std::string describe_wheels(const VehicleConditions& conditions, const rigs::VehicleLayout& layout) {
  return conditions.wheels == 1 ? "one of axle " + conditions.wheel_of.value
                                : fmt::format("{}; the tire shown is the {}", layout.wheels.size(),
                                              plain_name(layout.wheels.front().position));
}

void warn_of_unused_tire(const RunSpec& spec, Outcome& outcome) {
  if (has_tire_loss(spec)) return;
  outcome.warnings.push_back(
      "the vehicle's [road_load] contains the losses of the tires, and stands for them on this rig: the model of the "
      "tire is not used, its energies in the sections are 0, and they are not compared with the ISO coefficient");
}

void warn_of_map(const RunSpec& spec, const rigs::VehicleLayout& layout, Outcome& outcome) {
  if (!layout.powertrain_map.has_value()) return;
  const models::PowertrainMap& map = *layout.powertrain_map;
  const sim::Recording<double>& recording = outcome.recording;
  const std::vector<double>& speed_m_s = recording.channel(quantities::kSpeed);
  const std::vector<double>& traction_N = recording.channel(quantities::kTractionForce);
  double fastest_m_s = 0.0;
  double largest_W = 0.0;
  for (std::size_t i = 0; i < speed_m_s.size(); ++i) {
    fastest_m_s = std::max(fastest_m_s, speed_m_s[i]);
    largest_W = std::max(largest_W, speed_m_s[i] * traction_N[i] / layout.share);
  }
  const auto warn = [&outcome](const std::string& what) {
    outcome.warnings.push_back(what + "; beyond the map of the powertrain, its nearest edge counts");
  };
  if (fastest_m_s > map.speeds_m_s.back()) {
    warn(fmt::format("vehicle '{}' drives at {:.1f} km/h, and [powertrain.map] ends at {:.1f} km/h", spec.vehicle->name,
                     kKmhPerMs * fastest_m_s, kKmhPerMs * map.speeds_m_s.back()));
  }
  if (largest_W > map.powers_W.back()) {
    warn(fmt::format("the hubs of vehicle '{}' give {:.1f} kW, and [powertrain.map] ends at {:.1f} kW",
                     spec.vehicle->name, 1e-3 * largest_W, 1e-3 * map.powers_W.back()));
  }
}

}  // namespace rollrig::scenarios
