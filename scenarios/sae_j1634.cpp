/// SAE J1634 multi-cycle test on a dynamometer, in the standard's order or the source's (§3.4.4).

#include "scenarios/common/energy_uncertainty.h"
#include "scenarios/common/iso_coefficient.h"
#include "scenarios/common/vehicle_bench.h"

namespace rollrig::scenarios::sae_j1634 {

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
                "standard: 40 CFR 600.116-12(a) and SAE J1634; source: Kolekar and Narasimhan (2024) §3.4.4, no key-on "
                "pauses, end at 80 km/h"},
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
  double calc_end_speed_m_s() const { return end_speed_m_s.value_or(is_source() ? 80.0 / 3.6 : mid_speed_m_s); }
  double calc_count_from_m_s() const { return count_from_m_s.value_or(is_source() ? 20.0 / 3.6 : 0.0); }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

/// One section, or all of them together: of one tire (the first that is simulated), and of the whole vehicle.
struct Section {
  std::string name;
  double distance_m = 0.0;
  double rr_J = 0.0;
  std::optional<double> rr_iso_J;
  std::optional<double> mean_rrc;
  double start_K = 0.0;
  double end_K = 0.0;
  double vehicle_rr_J = 0.0;
  double drive_J = 0.0;
  double recuperated_J = 0.0;
  double battery_J = 0.0;

  std::optional<double> calc_difference() const {
    if (!rr_iso_J.has_value() || *rr_iso_J <= 0.0) return std::nullopt;
    return rr_J / *rr_iso_J - 1.0;
  }

  void visit(ResultSheet& visit) const {
    visit(Result{"name", "section", "", "its phase", Column::kBoth}, name);
    visit(Result{"distance_km", "", ".2f", "driven in it"}, distance_m);
    visit(Result{"rr_energy_Wh", "model", ".1f",
                 "energy of rolling resistance of one tire (true loss), counted stretches"},
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
    visit(Result{"battery_energy_Wh", "battery", ".0f", "through the constant efficiency of the powertrain, both ways",
                 Column::kSecond},
          battery_J);
  }
};

struct Results {
  std::string wheels;
  double load_N = 0.0;
  double count_from_m_s = 0.0;
  std::optional<double> iso_rrc;
  std::vector<Section> sections;
  std::optional<Section> total;

  void visit(ResultSheet& visit) const {
    visit(Remark{"Wheels simulated"}, wheels);
    visit(Remark{"Load of the tire"}, show_number("load_N", ".0f", load_N));
    visit(Remark{"Counted above"}, show_number("speed_km_h", ".0f", count_from_m_s));
    visit(Result{"iso_rrc_true_N_per_kN", "ISO coefficient", ".3f",
                 "of the tire's file, with the loss that its skim test subtracted; null where it has none"},
          iso_rrc);
    visit(ResultList{"sections", "Rolling resistance of one tire, by model and by ISO coefficient; of all tires",
                     "each section", "Liner of that tire; energy of the whole vehicle, at its hubs and its battery"},
          sections, total);
  }
};

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  const SpeedTrace city = read_speed_trace("udds");
  const SpeedTrace highway = read_speed_trace("hwfet");
  const bool source = settings.is_source();
  const double pause_s = source ? 0.0 : settings.pause_s;
  const double constant_soak_s = source ? 0.0 : settings.constant_soak_s;
  VehicleProgram program(settings.conditions, spec.sample_interval_s, settings.calc_count_from_m_s());
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
  const std::string last = fmt::format("constant speed {:.0f} km/h", 3.6 * settings.calc_end_speed_m_s());
  program.drive_at(last + (settings.calc_end_speed_m_s() == settings.mid_speed_m_s ? ", end" : ""),
                   settings.calc_end_speed_m_s(), settings.end_s, settings.ramp_s);
  return program;
}

bool is_section(const std::string& phase) {
  return phase.rfind("city", 0) == 0 || phase.rfind("highway", 0) == 0 || phase.rfind("constant speed", 0) == 0;
}

/// The ISO coefficient of the tire that is shown, as a true loss like the energy of the model.
std::optional<double> find_iso_rrc(const RunSpec& spec, const rigs::VehicleLayout& layout) {
  return calc_true_iso_rrc(rigs::tire_of(spec.vehicle->axles[layout.wheels.front().axle], spec.tire), spec.baseline);
}

Section evaluate_section(const RunSpec& spec, const rigs::VehicleLayout& layout,
                         const sim::Recording<double>& recording, std::size_t phase) {
  using rigs::VehicleIntegral;
  using rigs::WheelIntegral;
  const SectionReader reader(recording, layout, phase);
  const sim::PhaseSpan& span = recording.phases[phase];
  Section section;
  section.name = span.name;
  section.distance_m = reader.common(VehicleIntegral::kDistance);
  section.rr_J = reader.wheel(WheelIntegral::kCountedRollingEnergy, 0);
  const bool tires_lose = is_indoors(spec.rig.kind->traits) || !spec.vehicle->road_load.has_value();
  const auto iso_rrc = find_iso_rrc(spec, layout);
  if (iso_rrc.has_value() && tires_lose) {
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
  const double efficiency = spec.vehicle->powertrain.efficiency;
  section.battery_J = section.drive_J / efficiency - section.recuperated_J * efficiency;
  return section;
}

/// The whole test; without ISO energy where a section has none.
Section add_up(const std::vector<Section>& sections) {
  Section total;
  total.name = "all sections";
  total.start_K = total.end_K = std::nan("");
  total.mean_rrc = std::nan("");
  total.rr_iso_J = 0.0;
  for (const Section& section : sections) {
    total.distance_m += section.distance_m;
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

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  Results results;
  results.wheels = settings.conditions.wheels == 1 ? "one of axle " + settings.conditions.wheel_of.value
                                                   : fmt::format("{}; the tire shown is the {}", layout.wheels.size(),
                                                                 plain_name(layout.wheels.front().position));
  results.load_N = layout.wheels.front().static_load_N;
  results.count_from_m_s = settings.calc_count_from_m_s();
  results.iso_rrc = find_iso_rrc(spec, layout);
  for (std::size_t i = 0; i < outcome.recording.phases.size(); ++i) {
    if (!is_section(outcome.recording.phases[i].name)) continue;
    results.sections.push_back(evaluate_section(spec, layout, outcome.recording, i));
  }
  results.total = add_up(results.sections);
  outcome.make_measurement_model = [&spec, used = outcome.settings] { return make_section_energy_model(spec, used); };
  return results;
}

Scenario make() {
  Scenario scenario = make_vehicle_scenario(
      {"sae_j1634", "SAE J1634 multi-cycle test: city, highway and constant-speed sections with their pauses and soaks",
       "Standard: UDDS 1, 15 s, HFEDS 1, 10 min soak, UDDS 2, constant speed, UDDS 3, 15 s, HFEDS 2, 10 min soak, "
       "UDDS 4, constant speed. Source: the same without pauses, soaks of 10 min after the highway sections, "
       "constant speeds 105 and 80 km/h. Of each section, for one tire: energy of rolling resistance by the model "
       "and by the constant ISO coefficient, temperatures, mean coefficient; for the vehicle: energy at the wheels. On "
       "rig road a vehicle with [road_load] needs exactly that at the wheels, and its tires nothing of their own.",
       "SAE J1634 as fixed by 40 CFR 600.116-12(a); Kolekar and Narasimhan (2024) §3.4.4, §3.4.5, Tables 4.4 and 4.5"},
      "dyno_1m2", &plan, &evaluate);
  scenario.has_uncertainty = true;
  return scenario;
}

}  // namespace rollrig::scenarios::sae_j1634
