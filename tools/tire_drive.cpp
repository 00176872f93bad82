#include "tools/tire_drive.h"

#include <algorithm>
#include <numeric>

#include "models/corner.h"
#include "scenarios/common/vehicle_bench.h"
#include "tools/virtual_run.h"

namespace rollrig::tools {
namespace {

using scenarios::VehicleConditions;

constexpr double kSourcePressure_Pa = 280e3;  // §3.4.1

VehicleConditions make_conditions(const scenarios::RunSpec& spec, double pressure_Pa = kSourcePressure_Pa) {
  VehicleConditions conditions;
  conditions.wheels = 1;
  conditions.pressure_Pa = pressure_Pa;
  conditions.complete(spec);
  return conditions;
}

TireDrive read_sections(const scenarios::RunSpec& spec, const rigs::VehicleLayout& layout,
                        const sim::Recording<double>& recording) {
  constexpr double kWh_J = 3600.0;
  const std::vector<double>& temperature_K =
      recording.channel(rigs::wheel_channel(models::quantities::kLinerTemperature, layout.wheels.front()));
  TireDrive sections;
  for (std::size_t phase = 0; phase < recording.phases.size(); ++phase) {
    const sim::PhaseSpan& span = recording.phases[phase];
    const scenarios::SectionReader reader(recording, layout, phase);
    DriveSection section;
    section.name = span.name;
    section.distance_km = reader.common(rigs::VehicleIntegral::kDistance) / 1e3;
    if (section.distance_km <= 0.0) continue;
    const double counted_m = reader.common(rigs::VehicleIntegral::kCountedDistance);
    section.counted_km = counted_m / 1e3;
    section.rr_Wh = reader.wheel(rigs::WheelIntegral::kCountedRollingEnergy, 0) / kWh_J;
    section.iso_Wh = spec.tire.iso_28580.value().rrc * layout.wheels.front().static_load_N * counted_m / kWh_J;
    for (std::size_t row = 0; row < recording.row_count(); ++row) {
      if (recording.phase[row] != phase) continue;
      section.time_s.push_back(recording.time_s[row] - span.start_s);
      section.temperature_degC.push_back(temperature_K[row] - kZeroCelsius_K);
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

double sum(const TireDrive& sections, double DriveSection::*member) {
  return std::accumulate(sections.begin(), sections.end(), 0.0,
                         [member](double all, const DriveSection& section) { return all + section.*member; });
}

double find_Wh_per_km(const TireDrive& sections) {
  return sum(sections, &DriveSection::rr_Wh) / sum(sections, &DriveSection::counted_km);
}

}  // namespace

double DriveSection::mean_degC() const {
  return std::accumulate(temperature_degC.begin(), temperature_degC.end(), 0.0) /
         static_cast<double>(temperature_degC.size());
}
double DriveSection::lowest_degC() const { return *std::min_element(temperature_degC.begin(), temperature_degC.end()); }
double DriveSection::highest_degC() const {
  return *std::max_element(temperature_degC.begin(), temperature_degC.end());
}
double DriveSection::at_degC(double after_s) const {
  const auto row = static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), after_s) - time_s.begin());
  return temperature_degC[std::min(row, temperature_degC.size() - 1)];
}

TireDrive drive_source_test(const std::string& tire) { return drive_source_test(make_source_drive(tire)); }

TireDrive drive_source_test(const scenarios::RunSpec& spec) {
  const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
  return read_sections(spec, make_conditions(spec).make_layout(spec), outcome.recording);
}

TireDrive drive_dyno_setting(const std::string& tire) {
  return drive_dyno_setting(make_source_drive(tire), kSourcePressure_Pa);
}

TireDrive drive_dyno_setting(const scenarios::RunSpec& spec, double pressure_Pa) {
  const VehicleConditions conditions = make_conditions(spec, pressure_Pa);
  constexpr double kTrustedFrom_m_s = 20.0 / 3.6;  // §4.2.1
  scenarios::VehicleProgram program(conditions, spec.sample_interval_s, kTrustedFrom_m_s);
  const scenarios::SpeedTrace highway = scenarios::read_speed_trace("hwfet");
  program.drive(highway, "highway 1");
  program.drive(highway, "highway 2");
  scenarios::Outcome outcome;
  scenarios::simulate_vehicle(spec, conditions, program, {}, outcome);
  return read_sections(spec, conditions.make_layout(spec), outcome.recording);
}

double calc_law_rrc_N_per_kN(const models::TireFile& tire, double speed_km_h, double tire_degC) {
  constexpr double kRollerDiameter_m = 1.2, kLoad_N = 5400.0;
  models::Context<double> context;
  context.tire = tire.values;
  context.surface_curvature_per_m = 2.0 / kRollerDiameter_m;
  const models::Corner<double> corner(context, {});
  return 1e3 / kLoad_N * corner.calc_law_N(speed_km_h / 3.6, kLoad_N, kSourcePressure_Pa, kZeroCelsius_K + tire_degC);
}

double find_mean_degC(const TireDrive& drive) {
  double sum = 0.0, weight = 0.0;
  for (const DriveSection& section : drive) {
    sum += section.mean_degC() * section.time_s.back();
    weight += section.time_s.back();
  }
  return sum / weight;
}

double find_range_K(const TireDrive& drive) {
  double low = 1e9, high = -1e9;
  for (const DriveSection& section : drive) {
    low = std::min(low, section.lowest_degC());
    high = std::max(high, section.highest_degC());
  }
  return high - low;
}

TireDrive select(const TireDrive& drive, const std::string& kind) {
  TireDrive chosen;
  std::copy_if(drive.begin(), drive.end(), std::back_inserter(chosen),
               [&kind](const DriveSection& section) { return section.name.rfind(kind, 0) == 0; });
  return chosen;
}

EnergyRow make_energy_row(const TireDrive& drive) {
  EnergyRow row;
  row.city = find_Wh_per_km(select(drive, "city"));
  row.highway = find_Wh_per_km(select(drive, "highway"));
  row.overall = 0.5 * (row.city + row.highway);
  row.iso = drive.front().iso_Wh / drive.front().counted_km;
  row.difference = (row.overall - row.iso) / row.overall;
  return row;
}

HighwayEnergy find_highway_energy(const TireDrive& dyno_setting) {
  constexpr double kTires = 2.0;
  return {kTires * sum(dyno_setting, &DriveSection::rr_Wh), kTires * sum(dyno_setting, &DriveSection::iso_Wh)};
}

}  // namespace rollrig::tools
