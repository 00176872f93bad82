#include "scenarios/common/multi_cycle_economy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <boost/algorithm/string/predicate.hpp>

namespace rollrig::scenarios {
namespace {

constexpr double kJ_per_kWh = 3.6e6;

std::vector<DriveSection> list_sections(const std::vector<DriveSection>& sections, const char* kind) {
  std::vector<DriveSection> of_kind;
  for (const DriveSection& section : sections) {
    if (boost::starts_with(section.name, kind)) of_kind.push_back(section);
  }
  return of_kind;
}

std::vector<EnergySection> list_energies(const std::vector<DriveSection>& sections) {
  std::vector<EnergySection> energies;
  for (const DriveSection& section : sections) energies.push_back({section.battery_J, section.distance_m});
  return energies;
}

double sum_battery_J(const std::vector<DriveSection>& sections) {
  return std::accumulate(sections.begin(), sections.end(), 0.0,
                         [](double sum_J, const DriveSection& section) { return sum_J + section.battery_J; });
}

/// Power of the battery late in the section, at its constant speed.
double find_steady_battery_W(const RunSpec& spec, const rigs::VehicleLayout& layout,
                             const sim::Recording<double>& recording, const std::string& section) {
  constexpr double kLate = 0.75;  // Assumed: of the section, when the tires are warm and the ramp has not begun
  const auto phase = std::find_if(recording.phases.begin(), recording.phases.end(),
                                  [&section](const sim::PhaseSpan& span) { return span.name == section; });
  const std::size_t row = recording.row_at(phase->start_s + kLate * (phase->end_s - phase->start_s));
  const double speed_m_s = recording.channel(quantities::kSpeed)[row];
  const double hubs_W = speed_m_s * recording.channel(quantities::kTractionForce)[row] / layout.share;
  const rigs::VehiclePowertrain& powertrain = spec.vehicle->powertrain;
  const double for_hubs_W = powertrain.map.has_value() ? models::calc_battery_W(*powertrain.map, speed_m_s, hubs_W)
                                                       : hubs_W / powertrain.efficiency;
  return for_hubs_W + powertrain.auxiliary_power_W;
}

/// Throws InputError where the battery does not last to the end section.
void require_large_battery(const rigs::VehicleFile& vehicle, double usable_J, double before_end_J) {
  if (usable_J > before_end_J) return;
  throw InputError(
      {fmt::format("the battery of vehicle '{}' is empty before the end section: the sections before it "
                   "take {:.2f} kWh",
                   vehicle.name, before_end_J / kJ_per_kWh),
       vehicle.path, 0, "usable_energy_kWh", fmt::format("{:g}", usable_J / kJ_per_kWh),
       fmt::format("more than {:.2f}, or a shorter first constant-speed section (mid_min)", before_end_J / kJ_per_kWh),
       ""});
}

void warn_of_end(double usable_J, double all_J, double needed_s, Outcome& outcome) {
  constexpr double kNoticeable = 0.02;  // Assumed: of the usable energy
  if (std::abs(all_J / usable_J - 1.0) <= kNoticeable) return;
  outcome.warnings.push_back(
      fmt::format("the sections take {:.2f} of the battery's {:.2f} kWh; with end_min={:.1f} it is empty at the end",
                  all_J / kJ_per_kWh, usable_J / kJ_per_kWh, needed_s / 60.0));
}

/// Where the recharge energy is from: a charge, or an assumption.
std::string describe_recharge(const rigs::VehicleBattery& battery) {
  if (battery.is_recharge_measured()) return "recharge_energy_kWh";
  return fmt::format("assumed: charging_efficiency = {:g}", battery.charging_efficiency);
}

ColdExcess find_cold_excess(const std::vector<DriveSection>& city) {
  std::vector<CycleLoss> cycles;
  for (const DriveSection& section : city) {
    cycles.push_back(
        {{section.battery_J, section.distance_m}, section.drive_J - section.recuperated_J, section.vehicle_rr_J});
  }
  return calc_cold_excess(cycles);
}

std::optional<double> invert(const std::optional<double>& value) {
  return value.has_value() ? std::optional(1.0 / *value) : std::nullopt;
}

}  // namespace

void CycleResult::visit(ResultSheet& visit) const {
  const std::optional<double> mpge =
      economy.ac_J_per_m.has_value() ? std::optional(calc_mpge(*economy.ac_J_per_m)) : std::nullopt;
  const std::optional<double> label_mpge = mpge.has_value() ? std::optional(label_factor * *mpge) : std::nullopt;
  visit(Result{"name", "cycle", "", "city (UDDS), highway (HFEDS), or both combined", Column::kBoth}, name);
  visit(Result{"dc_consumption_Wh_per_km", "DC", ".1f", "out of the battery, by phase scaling"}, economy.dc_J_per_m);
  visit(Result{"dc_mi_per_kWh", "DC", ".2f", "the same, as distance over energy"}, 1.0 / economy.dc_J_per_m);
  visit(Result{"range_km", "range", ".1f", "usable battery energy over consumption"}, economy.range_m);
  visit(Result{"range_mi", "range", ".1f", "the same in miles"}, economy.range_m);
  visit(Result{"ac_consumption_Wh_per_km", "AC", ".1f", "recharge energy over range; null without [battery]",
               Column::kSecond},
        economy.ac_J_per_m);
  visit(Result{"ac_mi_per_kWh", "AC", ".2f", "the same, as distance over energy", Column::kSecond},
        invert(economy.ac_J_per_m));
  visit(Result{"mpge", "MPGe", ".1f", "the same, as miles per gallon of gasoline with 33.7 kWh", Column::kSecond},
        mpge);
  visit(Result{"label_mpge", "label MPGe", ".0f", "times label_factor", Column::kSecond}, label_mpge);
  visit(Result{"label_range_mi", "label range", ".0f", "range times label_factor", Column::kSecond},
        label_factor * economy.range_m);
}

void EconomyResults::visit(ResultSheet& visit) const {
  visit(Result{"usable_energy_kWh", "Usable battery energy", ".3f",
               "direct current from full to empty (UBE); in the standard order alone, as all results below"}
            .or_left_out(),
        usable_J);
  visit(Result{"usable_energy_from", "  from", "",
               "battery: of the vehicle's file; sections: all sections together, as if the battery were empty then"}
            .or_left_out(),
        usable_from);
  visit(Result{"recharge_energy_kWh", "Recharge energy", ".3f", "alternating current for the charge after the test"}
            .or_left_out(),
        recharge_J);
  visit(Result{"recharge_energy_from", "  from", "",
               "recharge_energy_kWh of the vehicle's file, else charging_efficiency, which is assumed and no measured "
               "charge"}
            .or_left_out(),
        recharge_from);
  visit(Result{"end_needed_min", "End section to empty", ".1f", "its length with which the battery were empty; about"}
            .or_left_out(),
        end_needed_s);
  visit(Result{"first_city_weight_percent", "Weight of city 1", ".3f", "K of the first UDDS, its energy over UBE"}
            .or_left_out(),
        first_city_weight);
  const auto of_cold = [this](auto member) {
    return cold.has_value() ? std::optional<double>((*cold).*member) : std::nullopt;
  };
  visit(Result{"first_city_excess_percent", "City 1 over later ones", "+.2f",
               "battery energy of the first UDDS over that of the mean of the later ones, less 1"}
            .or_left_out(),
        cold.has_value() ? cold->battery_share : std::nullopt);
  visit(Result{"first_city_wheel_excess_Wh", "  at the hubs", "+.1f",
               "what the hubs gave in it beyond the later ones, recuperated energy subtracted"}
            .or_left_out(),
        of_cold(&ColdExcess::wheel_J));
  visit(
      Result{"first_city_tire_excess_Wh", "  of it by tires", "+.1f", "what all tires lost in it beyond the later ones"}
          .or_left_out(),
      of_cold(&ColdExcess::tire_J));
  visit(Result{"first_city_tire_share_percent", "  as a share", ".0f", "of the hubs' excess, by tires"}.or_left_out(),
        cold.has_value() ? cold->tire_share : std::nullopt);
}

void EconomyResults::visit_cycles(ResultSheet& visit) const {
  visit(ResultList{"economy", "Consumption and range by phase scaling, direct current", "city, highway, combined",
                   "Consumption with the charge, and what a label would show", true},
        cycles);
}

EconomyResults evaluate_economy(const RunSpec& spec, const rigs::VehicleLayout& layout,
                                const std::vector<DriveSection>& sections, double label_factor, Outcome& outcome) {
  const rigs::VehicleFile& vehicle = *spec.vehicle;
  const double all_J = sum_battery_J(sections);
  BatteryCharge charge{all_J, std::nullopt};
  EconomyResults results;
  if (vehicle.battery.has_value()) {
    const DriveSection& end = sections.back();
    charge = {vehicle.battery->usable_J, vehicle.battery->calc_recharge_J()};
    require_large_battery(vehicle, charge.usable_J, all_J - end.battery_J);
    results.end_needed_s =
        end.duration_s + (charge.usable_J - all_J) / find_steady_battery_W(spec, layout, outcome.recording, end.name);
    warn_of_end(charge.usable_J, all_J, *results.end_needed_s, outcome);
    if (const auto doubt = doubt_charge(charge.usable_J, *charge.recharge_J)) outcome.warnings.push_back(*doubt);
    results.recharge_from = describe_recharge(*vehicle.battery);
  } else {
    outcome.warnings.push_back(
        "the vehicle has no [battery]: range and label range take what the sections used as its usable energy, and so "
        "follow from their lengths (mid_min, end_min)");
  }
  const std::vector<DriveSection> city = list_sections(sections, "city");
  const MultiCycleEconomy economy =
      calc_multi_cycle_economy(list_energies(city), list_energies(list_sections(sections, "highway")), charge);
  if (const auto doubt = doubt_range(economy.combined.range_m, charge.usable_J)) outcome.warnings.push_back(*doubt);
  results.usable_J = charge.usable_J;
  results.usable_from = vehicle.battery.has_value() ? "battery" : "sections";
  results.recharge_J = charge.recharge_J;
  results.first_city_weight = economy.first_city_weight;
  results.cold = find_cold_excess(city);
  results.cycles = {{"city", economy.city, label_factor},
                    {"highway", economy.highway, label_factor},
                    {"combined", economy.combined, label_factor}};
  return results;
}

}  // namespace rollrig::scenarios
