/// Dynamometer setting: the force of the rollers with which the vehicle coasts down as on the road (§3.4.3).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rigs/rig_file.h"
#include "scenarios/common/coastdown_evaluation.h"
#include "scenarios/common/iso_coefficient.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/assets.h"

namespace rollrig::scenarios::dyno_setting {

using Load = models::RoadLoad<double>;

struct Settings {
  VehicleConditions conditions;
  Coastdowns coastdowns;
  std::optional<double> target_A_N;
  std::optional<double> target_B_N_s_per_m;
  std::optional<double> target_C_N_s2_per_m2;
  double criterion_N = 0.0;
  int iterations = 0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    VehicleConditions::visit(p.conditions, visit);
    Coastdowns::visit(p.coastdowns, visit);
    visit(Field{"target_A_N", any_number(),
                "Road load to be met; default: the vehicle's [road_load], else its coastdown on rig road"},
          p.target_A_N);
    visit(Field{"target_B_N_per_km_h", any_number(), "Likewise, all three or none"}, p.target_B_N_s_per_m);
    visit(Field{"target_C_N_per_km_h2", any_number(), "Likewise"}, p.target_C_N_s2_per_m2);
    visit(Field{"criterion_N", positive(), "Most that a force may be off at any speed (UN GTR 15 Annex 4: 10 N)", 10.0},
          p.criterion_N);
    visit(Field{"iterations", between(1.0, 50.0), "Most corrections of the set force", 12.0}, p.iterations);
  }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

struct Difference {
  double speed_m_s = 0.0;
  double target_N = 0.0;
  double found_N = 0.0;
  double set_N = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"speed_km_h", "", ".0f", "speed"}, speed_m_s);
    visit(Result{"target_N", "road", ".1f", "force on the road"}, target_N);
    visit(Result{"found_N", "rollers", ".1f", "force on the rollers"}, found_N);
    visit(Result{"difference_N", "off", "+.2f", "the second less the first"}, found_N - target_N);
    visit(Result{"set_N", "set", ".1f", "force of the rollers"}, set_N);
  }
};

struct Results {
  Load set{};
  Load target{};
  int corrections = 0;
  double largest_difference_N = 0.0;
  double criterion_N = 0.0;
  bool within_criterion = false;
  std::vector<Difference> differences;
  double highway_J = 0.0;
  std::optional<double> highway_iso_J;

  void visit(ResultSheet& visit) const {
    visit(Result{"set_A_N", "", ".2f", "force of the rollers at standstill"}, set.A_N);
    visit(Result{"set_B_N_per_km_h", "", ".4f", "its rise with speed"}, set.B_N_s_per_m);
    visit(Result{"set_C_N_per_km_h2", "", ".5f", "its rise with the square of speed"}, set.C_N_s2_per_m2);
    visit(Result{"target_A_N", "", ".2f", "road load at standstill"}, target.A_N);
    visit(Result{"target_B_N_per_km_h", "", ".4f", "its rise with speed"}, target.B_N_s_per_m);
    visit(Result{"target_C_N_per_km_h2", "", ".5f", "its rise with the square of speed"}, target.C_N_s2_per_m2);
    visit(JointLine{"Target", "{target_A_N}, {target_B_N_per_km_h}, {target_C_N_per_km_h2}"});
    visit(JointLine{"Set", "{set_A_N}, {set_B_N_per_km_h}, {set_C_N_per_km_h2}"});
    visit(Result{"iterations", "Corrections", "", "corrections of the set force"}, corrections);
    visit(Result{"largest_difference_N", "Largest difference", ".2f", "over the speeds of differences"},
          largest_difference_N);
    visit(Result{"within_criterion", "  within the criterion", "", "whether it is within criterion_N"},
          within_criterion);
    visit(ResultList{"differences", "Force at the wheels", "at speeds of 20 to 130 km/h"}, differences);
    visit(Result{"highway_rr_energy_Wh", "Rolling resistance on both highways", ".0f",
                 "of all tires that roll (true loss), over both highway cycles"},
          highway_J);
    visit(Result{"highway_rr_energy_iso_Wh", "  by the ISO coefficient alone", ".0f",
                 "the same by the tires' ISO coefficients, with the loss that their skim tests subtracted; null where "
                 "one has none"},
          highway_iso_J);
    visit(Summary{within_criterion
                      ? "The dynamometer is set: from 20 to 130 km/h the vehicle coasts down as on the road to within "
                        "{largest_difference_N}."
                      : "The dynamometer is not set: after {iterations} corrections, the force is up to "
                        "{largest_difference_N} off that of the road."});
    visit(Headline{"Within the criterion", "{within_criterion}",
                   fmt::format("at most {:g} N at any speed; after {{iterations}} corrections", criterion_N)});
    visit(Headline{"Largest difference to the road", "{largest_difference_N}", "over 20 to 130 km/h"});
    visit(Headline{"Set force at standstill", "{set_A_N}", "road load: {target_A_N}"});
    visit(Headline{"Set force, with speed squared", "{set_C_N_per_km_h2}", "road load: {target_C_N_per_km_h2}"});
  }
};

/// Corrections end when the difference is below this share of criterion_N.
// Assumed: a tenth, so that stopping adds little to it.
constexpr double kShareOfCriterion = 0.1;

Load sum(const Load& a, const Load& b, double factor) {
  return {a.A_N + factor * b.A_N, a.B_N_s_per_m + factor * b.B_N_s_per_m, a.C_N_s2_per_m2 + factor * b.C_N_s2_per_m2};
}

double find_largest_N(const Load& difference) {
  double largest_N = 0.0;
  for (const double speed_m_s : road_load_speeds_m_s()) {
    largest_N = std::max(largest_N, std::abs(models::calc_road_load_N(difference, speed_m_s)));
  }
  return largest_N;
}

void check_target(const RunSpec& spec) {
  const std::array<const char*, 3> keys{"target_A_N", "target_B_N_per_km_h", "target_C_N_per_km_h2"};
  const auto is_given = [&spec](const char* key) { return spec.settings.find(key) != nullptr; };
  const auto given = std::find_if(keys.begin(), keys.end(), is_given);
  if (given != keys.end() && !std::all_of(keys.begin(), keys.end(), is_given)) {
    throw InputError(setting_problem(spec, *given, "a target is given by all three of its coefficients",
                                     fmt::format("{}, or none of them", fmt::join(keys, ", "))));
  }
}

/// The scenario finds the force of the rollers: none can be given.
void check_nothing_set(const RunSpec& spec) {
  for (const char* key : {"set_A_N", "set_B_N_per_km_h", "set_C_N_per_km_h2"}) {
    if (spec.settings.find(key) == nullptr) continue;
    throw InputError(setting_problem(spec, key, "this scenario finds the force of the rollers itself",
                                     "target_A_N, target_B_N_per_km_h, target_C_N_per_km_h2"));
  }
}

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  rigs::make_vehicle_context(spec.tire, spec.rig, *spec.vehicle, spec.baseline);  // refuses a tire without its keys
  check_target(spec);
  check_nothing_set(spec);
  settings.coastdowns.check(spec);
  VehicleProgram program(settings.conditions, spec.sample_interval_s, 0.0);
  const SpeedTrace highway = read_speed_trace("hwfet");
  program.drive(highway, "highway 1");
  program.drive(highway, "highway 2");
  settings.coastdowns.append_coastdowns_to(program);
  return program;
}

/// The vehicle's coastdown on the road, from the same tires.
Load find_road_load(const RunSpec& spec, const Settings& settings, const sim::Progress& progress) {
  if (settings.target_A_N.has_value()) {
    return {*settings.target_A_N, *settings.target_B_N_s_per_m, *settings.target_C_N_s2_per_m2};
  }
  if (spec.vehicle->road_load.has_value()) return *spec.vehicle->road_load;
  RunSpec road = spec;
  road.scenario = &find_scenario("coastdown");
  road.rig = rigs::read_rig(read_config(find_asset("rigs", "road")));
  VehicleConditions conditions = settings.conditions;
  conditions.ambient_K = road.rig.environment.ambient_K;
  conditions.initial_tire_K = conditions.ambient_K;
  conditions.surface_K.reset();  // that of the rollers; a road has the air's
  VehicleProgram program(conditions, spec.sample_interval_s, 0.0);
  settings.coastdowns.append_to(program);
  Outcome outcome;
  simulate_vehicle(road, conditions, program, progress, outcome);
  return fit_coastdowns(outcome.recording, road, conditions, settings.coastdowns).load;
}

/// Energies of rolling resistance of all tires over the highway sections (Table 4.2).
void add_highway(const RunSpec& spec, const Settings& settings, const sim::Recording<double>& recording,
                 Results& results) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  double distance_m = 0.0;
  for (std::size_t i = 0; i < recording.phases.size(); ++i) {
    if (recording.phases[i].name.rfind("highway", 0) != 0) continue;
    const SectionReader section(recording, layout, i);
    for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
      results.highway_J += section.wheel(rigs::WheelIntegral::kRollingEnergy, wheel) / layout.share;
    }
    distance_m += section.common(rigs::VehicleIntegral::kDistance);
  }
  double iso_N = 0.0;
  for (const rigs::WheelPlace& wheel : layout.wheels) {
    const auto rrc = calc_true_iso_rrc(rigs::tire_of(spec.vehicle->axles[wheel.axle], spec.tire), spec.baseline);
    if (!rrc.has_value()) return;
    iso_N += *rrc * wheel.static_load_N;
  }
  results.highway_iso_J = iso_N / layout.share * distance_m;
}

Results run(const RunSpec& spec, Settings settings, const VehicleProgram& program, const sim::Progress& progress,
            Outcome& outcome) {
  // Every iteration is a whole test; progress runs towards one and stays below it.
  double done = 0.0;
  const auto part = [&](double share) -> sim::Progress {
    if (!progress) return {};
    return [&, share](double part_done) { progress(done + (1.0 - done) * share * part_done); };
  };
  Results results;
  results.target = find_road_load(spec, settings, part(0.2));
  done = 0.2;
  results.set = results.target;
  Load found{};
  while (true) {
    settings.conditions.set_A_N = results.set.A_N;
    settings.conditions.set_B_N_s_per_m = results.set.B_N_s_per_m;
    settings.conditions.set_C_N_s2_per_m2 = results.set.C_N_s2_per_m2;
    simulate_vehicle(spec, settings.conditions, program, part(0.4), outcome);
    found = fit_coastdowns(outcome.recording, spec, settings.conditions, settings.coastdowns).load;
    done += 0.4 * (1.0 - done);
    results.largest_difference_N = find_largest_N(sum(found, results.target, -1.0));
    if (results.largest_difference_N <= kShareOfCriterion * settings.criterion_N) break;
    if (results.corrections == settings.iterations) break;
    results.set = sum(results.set, sum(results.target, found, -1.0), 1.0);
    ++results.corrections;
  }
  outcome.settings = settings_to_json(settings);
  results.criterion_N = settings.criterion_N;
  results.within_criterion = results.largest_difference_N <= settings.criterion_N;
  for (const double speed_m_s : road_load_speeds_m_s()) {
    const auto force_N = [speed_m_s](const Load& load) { return models::calc_road_load_N(load, speed_m_s); };
    results.differences.push_back({speed_m_s, force_N(results.target), force_N(found), force_N(results.set)});
  }
  if (road_load_speeds_m_s().back() > settings.coastdowns.from_m_s * (1.0 + 1e-9)) {
    outcome.warnings.push_back(fmt::format(
        "the coastdowns begin at {:.0f} km/h: above that, set forces and the force on the rollers are extrapolated, up "
        "to {:.0f} km/h, and the criterion is not tested there",
        3.6 * settings.coastdowns.from_m_s, 3.6 * road_load_speeds_m_s().back()));
  }
  add_highway(spec, settings, outcome.recording, results);
  if (!results.within_criterion) {
    outcome.warnings.push_back(
        fmt::format("the vehicle on the rollers is off by up to {:.1f} N", results.largest_difference_N));
  }
  return results;
}

Scenario make() {
  Scenario made = make_scenario<Settings, Results>(
      {"dyno_setting", "Dynamometer setting: the rollers' force with which the vehicle coasts down as on the road",
       "Two highway cycles, then coastdowns from 130 km/h on the rollers; the force of the rollers is corrected by "
       "what the road load and the force found differ, and the whole is done again, until they agree. The road load "
       "is given, the vehicle's own, or found by coastdowns on rig road.",
       "Kolekar and Narasimhan (2024) §3.4.3; SAE J2264; UN GTR 15 Annex 4 for the criterion of 10 N"},
      &plan, &run);
  made.runs_on = &models::is_tied_down;
  made.default_rig = "dyno_1m2";
  made.has_vehicle = true;
  return made;
}

}  // namespace rollrig::scenarios::dyno_setting
