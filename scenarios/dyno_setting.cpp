/// Dynamometer setting: the force of the rollers with which the vehicle coasts down as on the road (§3.4.3).
#include <algorithm>
#include <array>
#include <cmath>

#include "rigs/rig_file.h"
#include "scenarios/common/coastdown_evaluation.h"
#include "scenarios/common/vehicle_bench.h"
#include "sim/core/assets.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

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
                "Road load to be met; default: the vehicle's [road_load], else its coastdown on rig flat"},
          p.target_A_N);
    visit(Field{"target_B_N_per_km_h", any_number(), "Likewise, all three or none"}, p.target_B_N_s_per_m);
    visit(Field{"target_C_N_per_km_h2", any_number(), "Likewise"}, p.target_C_N_s2_per_m2);
    visit(Field{"criterion_N", positive(), "Most that a force may be off at any speed (UN GTR 15 Annex 4: 10 N)", 10.0},
          p.criterion_N);
    visit(Field{"iterations", between(1.0, 50.0), "Most corrections of the set force", 12.0}, p.iterations);
  }
};

/// What is left between vehicle on the rollers and target is found to a tenth of the criterion.
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

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  check_target(spec);
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
  road.rig = rigs::read_rig(read_config(find_asset("rigs", "flat")));
  VehicleConditions conditions = settings.conditions;
  conditions.ambient_K = road.rig.environment.ambient_K;
  conditions.initial_tire_K = conditions.ambient_K;
  VehicleProgram program(conditions, spec.sample_interval_s, 0.0);
  settings.coastdowns.append_to(program);
  Outcome outcome;
  simulate_vehicle(road, conditions, program, progress, outcome);
  return fit_vehicle_coastdowns(collect_coastdowns(outcome.recording, road, conditions, settings.coastdowns), road)
      .load;
}

/// What vehicle and rollers resist together.
Load measure(const RunSpec& spec, const Settings& settings, const VehicleProgram& program,
             const sim::Progress& progress, Outcome& outcome) {
  simulate_vehicle(spec, settings.conditions, program, progress, outcome);
  return fit_vehicle_coastdowns(collect_coastdowns(outcome.recording, spec, settings.conditions, settings.coastdowns),
                                spec)
      .load;
}

/// Energies of rolling resistance of all tires over the highway sections (Table 4.2).
void put_highway(const RunSpec& spec, const Settings& settings, Outcome& outcome) {
  const rigs::VehicleLayout layout = settings.conditions.make_layout(spec);
  double model_J = 0.0;
  double distance_m = 0.0;
  for (std::size_t i = 0; i < outcome.recording.phases.size(); ++i) {
    if (outcome.recording.phases[i].name.rfind("highway", 0) != 0) continue;
    const SectionReader section(outcome.recording, layout, i);
    for (std::size_t wheel = 0; wheel < layout.wheels.size(); ++wheel) {
      model_J += section.wheel(rigs::WheelIntegral::kRollingEnergy, wheel) / layout.share;
    }
    distance_m += section.common(rigs::VehicleIntegral::kDistance);
  }
  outcome.result["highway_rr_energy_Wh"] = model_J / 3600.0;
  outcome.result["highway_rr_energy_iso_Wh"] =
      spec.tire.iso_28580.has_value()
          ? Json(spec.tire.iso_28580->rrc * layout.rolling_load_N / layout.share * distance_m / 3600.0)
          : Json();
}

void report(const Settings& settings, const Load& target, const Load& set, const Load& found, int iterations,
            Outcome& outcome) {
  const Load difference = sum(found, target, -1.0);
  const double largest_N = find_largest_N(difference);
  put_road_load(set, "set_", outcome.result);
  put_road_load(target, "target_", outcome.result);
  outcome.result["iterations"] = iterations;
  outcome.result["largest_difference_N"] = largest_N;
  outcome.result["within_criterion"] = largest_N <= settings.criterion_N;
  outcome.result["differences"] = Json::array();
  ResultTable table{"Force at the wheels", {"km/h", "road N", "rollers N", "off N", "set N"}, {}};
  for (const double speed_m_s : road_load_speeds_m_s()) {
    const double speed_km_h = unit_of_key("speed_km_h").from_si(speed_m_s);
    const double road_N = models::calc_road_load_N(target, speed_m_s);
    const double found_N = models::calc_road_load_N(found, speed_m_s);
    outcome.result["differences"].push_back(
        {{"speed_km_h", speed_km_h}, {"target_N", road_N}, {"found_N", found_N}, {"difference_N", found_N - road_N}});
    table.rows.push_back({fmt::format("{:.0f}", speed_km_h), fmt::format("{:.1f}", road_N),
                          fmt::format("{:.1f}", found_N), fmt::format("{:+.2f}", found_N - road_N),
                          fmt::format("{:.1f}", models::calc_road_load_N(set, speed_m_s))});
  }
  outcome.tables.push_back(std::move(table));
  outcome.lines.push_back({"Target", fmt::format("{}", fmt::join(write_road_load(target), ", "))});
  outcome.lines.push_back({"Set", fmt::format("{}", fmt::join(write_road_load(set), ", "))});
  outcome.lines.push_back({"Corrections", fmt::format("{}", iterations)});
  outcome.lines.push_back(
      {"Largest difference", fmt::format("{:.2f} N (criterion {:g} N)", largest_N, settings.criterion_N)});
  if (largest_N > settings.criterion_N) {
    outcome.warnings.push_back(fmt::format("the vehicle on the rollers is off by up to {:.1f} N", largest_N));
  }
}

void run(const RunSpec& spec, Settings settings, const VehicleProgram& program, const sim::Progress& progress,
         Outcome& outcome) {
  // Every iteration is a whole test; progress runs towards one and stays below it.
  double done = 0.0;
  const auto part = [&](double share) -> sim::Progress {
    if (!progress) return {};
    return [&, share](double part_done) { progress(done + (1.0 - done) * share * part_done); };
  };
  const Load target = find_road_load(spec, settings, part(0.2));
  done = 0.2;
  Load set = target;
  Load found{};
  int iteration = 0;
  while (true) {
    settings.conditions.set_A_N = set.A_N;
    settings.conditions.set_B_N_s_per_m = set.B_N_s_per_m;
    settings.conditions.set_C_N_s2_per_m2 = set.C_N_s2_per_m2;
    found = measure(spec, settings, program, part(0.4), outcome);
    done += 0.4 * (1.0 - done);
    if (find_largest_N(sum(found, target, -1.0)) <= kShareOfCriterion * settings.criterion_N ||
        iteration == settings.iterations) {
      break;
    }
    set = sum(set, sum(target, found, -1.0), 1.0);
    ++iteration;
  }
  outcome.settings = settings_to_json(settings);
  report(settings, target, set, found, iteration, outcome);
  put_highway(spec, settings, outcome);
}

}  // namespace

const Scenario& scenario_dyno_setting() {
  static const Scenario scenario = [] {
    ScenarioText text = {
        "dyno_setting",
        "Dynamometer setting: the rollers' force with which the vehicle coasts down as on the road",
        "Two highway cycles, then coastdowns from 130 km/h on the rollers; the force of the rollers is "
        "corrected by what the road load and the force found differ, and the whole is done again, until they "
        "agree. The road load is given, the vehicle's own, or found by coastdowns on rig flat.",
        "source §3.4.3; SAE J2264; UN GTR 15 Annex 4 for the criterion of 10 N",
        {{"set_A_N", "of the rollers; with set_B_N_per_km_h, set_C_N_per_km_h2"},
         {"target_A_N", "of the road; with target_B_N_per_km_h, target_C_N_per_km_h2"},
         {"differences", "per speed: speed_km_h, target_N, found_N, difference_N"},
         {"largest_difference_N", "over those speeds"},
         {"within_criterion", "whether it is within criterion_N"},
         {"iterations", "corrections of the set force"},
         {"highway_rr_energy_Wh", "of all tires that roll, over both highway cycles"},
         {"highway_rr_energy_iso_Wh", "the same by the tire's ISO coefficient; null where it has none"}}};
    Scenario made = make_scenario<Settings>(std::move(text), &plan, &run);
    made.rig_kinds = {rigs::RigKind::kDyno};
    made.default_rig = "dyno_1m2";
    made.has_vehicle = true;
    return made;
  }();
  return scenario;
}

}  // namespace rollrig::scenarios
