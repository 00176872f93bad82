/// SAE J1634 multi-cycle test on a dynamometer, in the standard's order or the source's (§3.4.4).
#include <algorithm>

#include <boost/algorithm/string/replace.hpp>

#include "scenarios/common/vehicle_bench.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  VehicleConditions conditions;
  Choice variant{"standard", {"standard", "source"}};
  double pause_s = 0.0;
  double soak_s = 0.0;
  double constant_soak_s = 0.0;
  double mid_speed_m_s = 0.0;
  double mid_s = 0.0;
  std::optional<double> end_speed_m_s;
  double end_s = 0.0;
  double ramp_s = 0.0;
  std::optional<double> count_from_m_s;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    VehicleConditions::visit(p.conditions, visit);
    visit(Field{"variant", any_number(),
                "standard: 40 CFR 600.116-12(a) and SAE J1634; source: §3.4.4, no key-on pauses, end at 80 km/h"},
          p.variant);
    visit(Field{"pause_s", between(0.0, 600.0), "Key-on pause between city and highway, standard order", 15.0},
          p.pause_s);
    visit(Field{"soak_min", between(0.0, 600.0), "Soak after each highway section (§3.4.4; §4.4.3 says 5)", 10.0},
          p.soak_s);
    visit(Field{"constant_soak_min", between(0.0, 30.0),
                "Key-off soak before and after the first constant-speed section and before the second, standard order",
                0.0},
          p.constant_soak_s);
    visit(Field{"mid_speed_km_h", between(20.0, 200.0), "First constant speed. Source: 105 km/h", 105.0},
          p.mid_speed_m_s);
    visit(Field{"mid_min", between(5.0, 600.0), "First constant-speed section. Assumed: 60 min", 60.0}, p.mid_s);
    visit(Field{"end_speed_km_h", between(20.0, 200.0),
                "Second constant speed; default: the first (standard), 80 km/h (source)"},
          p.end_speed_m_s);
    visit(Field{"end_min", between(5.0, 600.0), "Second constant-speed section. Assumed: 40 min", 40.0}, p.end_s);
    visit(Field{"ramp_s", between(5.0, 120.0), "To and from a constant speed. Assumed: 30 s", 30.0}, p.ramp_s);
    visit(Field{"count_from_km_h", between(0.0, 100.0),
                "Energies of rolling resistance and RRc count above it; default: 0 (standard), 20 (source, §4.2.1)"},
          p.count_from_m_s);
  }

  bool is_source() const { return variant.value == "source"; }
  double end_speed() const { return end_speed_m_s.value_or(is_source() ? 80.0 / 3.6 : mid_speed_m_s); }
  double count_from() const { return count_from_m_s.value_or(is_source() ? 20.0 / 3.6 : 0.0); }
};

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  const SpeedTrace city = read_speed_trace("udds");
  const SpeedTrace highway = read_speed_trace("hwfet");
  const bool source = settings.is_source();
  const double pause_s = source ? 0.0 : settings.pause_s;
  const double constant_soak_s = source ? 0.0 : settings.constant_soak_s;
  VehicleProgram program(settings.conditions, spec.sample_interval_s, settings.count_from());
  const auto half = [&](int n) {
    program.drive(city, fmt::format("city {}", 2 * n - 1));
    program.rest(fmt::format("pause {}", n), pause_s);
    program.drive(highway, fmt::format("highway {}", n));
    program.rest(fmt::format("soak {}", n), settings.soak_s);
    program.drive(city, fmt::format("city {}", 2 * n));
    program.rest(fmt::format("soak before constant speed {}", n), constant_soak_s);
  };
  half(1);
  program.drive_at(fmt::format("constant speed {:.0f} km/h", 3.6 * settings.mid_speed_m_s), settings.mid_speed_m_s,
                   settings.mid_s, settings.ramp_s);
  program.rest("soak after constant speed 1", constant_soak_s);
  half(2);
  const std::string last = fmt::format("constant speed {:.0f} km/h", 3.6 * settings.end_speed());
  program.drive_at(last + (settings.end_speed() == settings.mid_speed_m_s ? ", end" : ""), settings.end_speed(),
                   settings.end_s, settings.ramp_s);
  return program;
}

bool is_section(const std::string& phase) {
  return phase.rfind("city", 0) == 0 || phase.rfind("highway", 0) == 0 || phase.rfind("constant speed", 0) == 0;
}

/// One section: of one tire (the first that is simulated), and of the whole vehicle at its wheels.
Json evaluate_section(const RunSpec& spec, const rigs::VehicleLayout& layout, const sim::Recording<double>& recording,
                      std::size_t phase) {
  using rigs::VehicleIntegral;
  using rigs::WheelIntegral;
  const SectionReader section(recording, layout, phase);
  const sim::PhaseSpan& span = recording.phases[phase];
  const double counted_s = section.common(VehicleIntegral::kCountedTime);
  const double rr_J = section.wheel(WheelIntegral::kCountedRollingEnergy, 0);
  const std::vector<double>& temperature_K =
      recording.channel(rigs::wheel_channel("liner_temperature_degC", layout.wheels.front()));
  const double drive_J = section.vehicle(VehicleIntegral::kDriveEnergy);
  const double recuperated_J = section.vehicle(VehicleIntegral::kRecuperated);
  const double efficiency = spec.vehicle->powertrain.efficiency;
  constexpr double kWh_J = 3600.0;
  Json json = {{"name", span.name},
               {"distance_km", section.common(VehicleIntegral::kDistance) / 1e3},
               {"rr_energy_Wh", rr_J / kWh_J}};
  const bool tires_lose = spec.rig.kind == rigs::RigKind::kDyno || !spec.vehicle->road_load.has_value();
  if (spec.tire.iso_28580.has_value() && tires_lose) {
    const double iso_J = spec.tire.iso_28580->rrc * layout.wheels.front().static_load_N *
                         section.common(VehicleIntegral::kCountedDistance);
    json["rr_energy_iso_Wh"] = iso_J / kWh_J;
    json["difference_percent"] = iso_J > 0.0 ? Json(100.0 * (rr_J / iso_J - 1.0)) : Json();
  } else {
    json["rr_energy_iso_Wh"] = json["difference_percent"] = Json();
  }
  json["mean_rrc_N_per_kN"] =
      counted_s > 0.0 ? Json(1e3 * (section.wheel(WheelIntegral::kCountedRrc, 0) / counted_s)) : Json();
  json["temperature_start_degC"] = temperature_K[recording.row_at(span.start_s)] - kZeroCelsius_K;
  json["temperature_end_degC"] = temperature_K[recording.row_at(span.end_s - spec.sample_interval_s)] - kZeroCelsius_K;
  double all_tires_J = 0.0;
  for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
    all_tires_J += section.wheel(WheelIntegral::kCountedRollingEnergy, wheel) / layout.share;
  }
  json["vehicle_rr_energy_Wh"] = all_tires_J / kWh_J;
  json["wheel_energy_Wh"] = drive_J / kWh_J;
  json["recuperated_Wh"] = recuperated_J / kWh_J;
  json["battery_energy_Wh"] = (drive_J / efficiency - recuperated_J * efficiency) / kWh_J;
  return json;
}

std::string show(const Json& value, int digits) {
  return value.is_number() ? fmt::format("{:.{}f}", value.get<double>(), digits) : "-";
}

/// "constant 105 km/h", so that a line holds.
std::string shorten(const std::string& section) {
  return boost::algorithm::replace_first_copy(section, "constant speed", "constant");
}

/// The sum over all sections; null where one of them has none.
Json add_up(const Json& sections, const char* key) {
  double sum = 0.0;
  for (const Json& section : sections) {
    if (!section[key].is_number()) return {};
    sum += section[key].get<double>();
  }
  return sum;
}

struct SectionColumn {
  const char* heading;
  const char* key;  // of a section's result
  int digits;
  std::optional<Json> total = {};  // of the whole test; none: an empty field
};

/// A row a section, the whole test last.
ResultTable make_section_table(const std::string& title, const std::vector<SectionColumn>& columns,
                               const Json& sections) {
  ResultTable table{title, {"section"}, {}};
  std::vector<std::string> totals{"all sections"};
  for (const SectionColumn& column : columns) {
    table.columns.push_back(column.heading);
    totals.push_back(column.total.has_value() ? show(*column.total, column.digits) : "");
  }
  for (const Json& section : sections) {
    std::vector<std::string> row{shorten(section["name"].get<std::string>())};
    for (const SectionColumn& column : columns) row.push_back(show(section[column.key], column.digits));
    table.rows.push_back(std::move(row));
  }
  table.rows.push_back(std::move(totals));
  return table;
}

/// Loss of one tire by the model and by the ISO coefficient.
ResultTable make_tire_table(const Json& sections) {
  const Json model_Wh = add_up(sections, "rr_energy_Wh");
  const Json iso_Wh = add_up(sections, "rr_energy_iso_Wh");
  const bool has_iso = iso_Wh.is_number() && iso_Wh.get<double>() > 0.0;
  const Json difference = has_iso ? Json(100.0 * (model_Wh.get<double>() / iso_Wh.get<double>() - 1.0)) : Json();
  return make_section_table("Rolling resistance of one tire: by the model, and by its ISO coefficient alone",
                            {{"km", "distance_km", 2, add_up(sections, "distance_km")},
                             {"model Wh", "rr_energy_Wh", 1, model_Wh},
                             {"ISO Wh", "rr_energy_iso_Wh", 1, iso_Wh},
                             {"difference %", "difference_percent", 1, difference},
                             {"mean RRc N/kN", "mean_rrc_N_per_kN", 2}},
                            sections);
}

/// Temperatures of that tire and energies of the vehicle.
ResultTable make_vehicle_table(const Json& sections) {
  return make_section_table("Liner of that tire; energy of the whole vehicle, at its hubs and its battery",
                            {{"start degC", "temperature_start_degC", 1},
                             {"end degC", "temperature_end_degC", 1},
                             {"hubs Wh", "wheel_energy_Wh", 0, add_up(sections, "wheel_energy_Wh")},
                             {"recuperated Wh", "recuperated_Wh", 0, add_up(sections, "recuperated_Wh")},
                             {"battery Wh", "battery_energy_Wh", 0, add_up(sections, "battery_energy_Wh")}},
                            sections);
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  Json sections = Json::array();
  for (std::size_t i = 0; i < outcome.recording.phases.size(); ++i) {
    if (!is_section(outcome.recording.phases[i].name)) continue;
    sections.push_back(evaluate_section(spec, layout, outcome.recording, i));
  }
  outcome.tables = {make_tire_table(sections), make_vehicle_table(sections)};
  outcome.result["sections"] = std::move(sections);
  outcome.lines.push_back({"Wheels simulated", settings.conditions.wheels == 4
                                                   ? "4; the tire shown is the front left"
                                                   : fmt::format("a quarter, {}", settings.conditions.quarter.value)});
  outcome.lines.push_back({"Load of the tire", fmt::format("{:.0f} N", layout.wheels.front().static_load_N)});
  outcome.lines.push_back({"Counted above", fmt::format("{:.0f} km/h", 3.6 * settings.count_from())});
}

}  // namespace

const Scenario& scenario_sae_j1634() {
  static const Scenario scenario = make_vehicle_scenario<Settings>(
      {"sae_j1634",
       "SAE J1634 multi-cycle test: city, highway and constant-speed sections with their pauses and soaks",
       "Standard: UDDS 1, 15 s, HFEDS 1, 10 min soak, UDDS 2, constant speed, UDDS 3, 15 s, HFEDS 2, 10 min soak, "
       "UDDS 4, constant speed. Source: the same without pauses, soaks of 10 min after the highway sections, "
       "constant speeds 105 and 80 km/h. Of each section, for one tire: energy of rolling resistance by the model "
       "and by the constant ISO coefficient, temperatures, mean coefficient; for the vehicle: energy at the wheels. On "
       "rig flat a vehicle with [road_load] needs exactly that at the wheels, and its tires nothing of their own.",
       "SAE J1634 as fixed by 40 CFR 600.116-12(a); source §3.4.4, §3.4.5, Tables 4.4 and 4.5",
       {{"sections", "a list; of each: name, distance_km"},
        {"sections[].rr_energy_Wh", "energy of rolling resistance of one tire, counted stretches"},
        {"sections[].rr_energy_iso_Wh",
         "the same by the tire's ISO coefficient; null where it has none, or no loss of its own"},
        {"sections[].difference_percent", "of the first from the second"},
        {"sections[].mean_rrc_N_per_kN", "mean over time of F_rr/Fz, counted stretches"},
        {"sections[].temperature_start_degC", "of the liner"},
        {"sections[].temperature_end_degC", "of the liner"},
        {"sections[].vehicle_rr_energy_Wh", "energy of rolling resistance of all tires that roll, counted stretches"},
        {"sections[].wheel_energy_Wh", "given out at the driven hubs, whole vehicle"},
        {"sections[].recuperated_Wh", "taken in by the motor while it brakes"},
        {"sections[].battery_energy_Wh", "through the constant efficiency of the powertrain, both ways"}}},
      {rigs::RigKind::kDyno, rigs::RigKind::kFlat}, "dyno_1m2", &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
