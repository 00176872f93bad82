/// SAE J1634 multi-cycle test on a dynamometer, in the standard's order or the source's (§3.4.4).

#include <fmt/format.h>

#include <cmath>

#include <boost/algorithm/string/predicate.hpp>

#include "scenarios/common/drive_sections.h"
#include "scenarios/common/energy_uncertainty.h"
#include "scenarios/common/multi_cycle_economy.h"

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
  double label_factor = 0.0;

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
    visit(Field{"label_factor", between(0.1, 1.0),
                "Range and MPGe on a label over those of the test. Second-hand: 0.7 without tests of all five cycles",
                0.7},
          p.label_factor);
  }

  bool is_source() const { return variant.value == "source"; }
  double calc_end_speed_m_s() const { return end_speed_m_s.value_or(is_source() ? 80.0 / 3.6 : mid_speed_m_s); }
  double calc_count_from_m_s() const { return count_from_m_s.value_or(is_source() ? 20.0 / 3.6 : 0.0); }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

struct Results {
  std::string wheels;
  double load_N = 0.0;
  double count_from_m_s = 0.0;
  std::optional<double> iso_rrc;
  std::vector<DriveSection> sections;
  std::optional<DriveSection> total;
  EconomyResults economy;

  void visit(ResultSheet& visit) const {
    visit(Remark{"Wheels simulated"}, wheels);
    visit(Result{"load_N", "Load of the tire", ".0f", "at rest, of the tire that the sections show"}, load_N);
    visit(Result{"counted_above_km_h", "Counted above", ".0f", "speed below which energies do not count"},
          count_from_m_s);
    visit(Result{"iso_rrc_true_N_per_kN", "ISO coefficient", ".3f",
                 "of the tire's file, with the loss that its skim test subtracted; empty where it has none"},
          iso_rrc);
    economy.visit(visit);
    visit(ResultList{"sections", "Rolling resistance of one tire, by model and by ISO coefficient; of all tires",
                     "each section", "Liner of that tire; energy of the whole vehicle, at its hubs and its battery"},
          sections, total);
    economy.visit_cycles(visit);
    const bool has_range = economy.is_range_of_battery();
    visit(Summary{has_range
                      ? "The vehicle takes {economy.last.dc_consumption_Wh_per_km} out of the battery "
                        "({economy.last.name}), for a range of {economy.last.range_km}. The first, cold city cycle "
                        "differs from later ones by {first_city_excess_percent}."
                      : "The vehicle takes {economy.last.dc_consumption_Wh_per_km} out of the battery "
                        "({economy.last.name}). The first, cold city cycle differs from later ones by "
                        "{first_city_excess_percent}. Its file has no battery, which a range would need."});
    visit(
        Summary{"The vehicle takes {economy.last.dc_consumption_Wh_per_km} out of the battery ({economy.last.name})."});
    visit(
        Headline{"Consumption", "{economy.last.dc_consumption_Wh_per_km}", "{economy.last.name}, out of the battery"});
    if (has_range) {
      visit(Headline{"Range", "{economy.last.range_km}",
                     "{economy.last.name}, as tested; {economy.last.label_range_mi} on a US label, adjusted"});
    }
    visit(
        Headline{"First city cycle above later ones", "{first_city_excess_percent}", "battery energy: the cold start"});
    visit(Headline{"Tires' share of the cold start", "{first_city_tire_share_percent}", "of the excess at the hubs"});
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
  return boost::starts_with(phase, "city") || boost::starts_with(phase, "highway") ||
         boost::starts_with(phase, "constant speed");
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  Results results;
  results.wheels = describe_wheels(settings.conditions, layout);
  results.load_N = layout.wheels.front().static_load_N;
  results.count_from_m_s = settings.calc_count_from_m_s();
  results.iso_rrc = find_shown_iso_rrc(spec, layout);
  for (std::size_t i = 0; i < outcome.recording.phases.size(); ++i) {
    if (!is_section(outcome.recording.phases[i].name)) continue;
    results.sections.push_back(evaluate_section(spec, layout, outcome.recording, i));
  }
  results.total = add_up(results.sections);
  if (!settings.is_source()) {
    results.economy = evaluate_economy(spec, layout, results.sections, settings.label_factor, outcome);
  }
  warn_of_map(spec, layout, outcome);
  warn_of_unused_tire(spec, outcome);
  std::vector<ReportedCycle> cycles;
  for (const CycleResult& cycle : results.economy.cycles) {
    const Json::json_pointer place = Json::json_pointer("/economy") / cycles.size();
    cycles.push_back({cycle.name, cycle.name + "_", place, "dc_consumption_Wh_per_km", true});
  }
  outcome.make_measurement_model = [&spec, used = outcome.settings, cycles] {
    return make_section_energy_model(spec, used, cycles);
  };
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
