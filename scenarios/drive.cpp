/// A vehicle on the road through rows that a file gives: speed, height and air.
#include "scenarios/common/wheel_bench.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

struct DriveConditions : RecordedInputs {
  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"program", any_number(),
                "CSV: time_s, speed_km_h, elevation_m, ambient_degC, straight lines from row to row. A run file of a "
                "road set will do: measured columns are not read"},
          p.program);
    visit_start(p, visit);
    visit(Field{"tire_state", any_number(),
                "warm: right after another run; the tires begin as warm as steady driving at 80 km/h makes them, and "
                "effects that remember start accordingly"},
          p.tire_state);
  }
};

struct Settings {
  DriveConditions conditions;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DriveConditions::visit(p.conditions, visit);
  }
};

/// Says where numbers of a class of tires stand in for those of the file.
void warn_of_class_values(const models::TireFile& tire, Outcome& outcome) {
  std::vector<std::string> absent;
  if (!tire.has_stiffness) absent.emplace_back("[stiffness]");
  if (!tire.has_rolling_resistance) absent.emplace_back("[rolling_resistance]");
  if (!tire.has_thermal) absent.emplace_back("[thermal]");
  if (absent.empty()) return;
  outcome.warnings.push_back(fmt::format("tire '{}' has no {}: values of a passenger car's tire stand in", tire.name,
                                         fmt::join(absent, ", ")));
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const DriveConditions& conditions = settings.conditions;
  const sim::Recording<double>& recording = outcome.recording;
  constexpr double kWh_J = 3600.0;
  const auto energy_Wh = [&](const char* term) { return recording.audit.find_term_J(term) / kWh_J; };
  const double duration_s = conditions.run.time_s.back() - conditions.run.time_s.front();
  const double distance_km = calc_distance_m(conditions.run) / 1e3;
  const double liner_degC = recording.channel("liner_temperature_degC").back() - kZeroCelsius_K;
  outcome.settings["program_sha256"] = calc_sha256(read_text_file(conditions.program.path));
  outcome.result["duration_s"] = duration_s;
  outcome.result["distance_km"] = distance_km;
  outcome.result["wheel_energy_Wh"] = energy_Wh(sim::kMotorWork);
  outcome.result["rr_energy_Wh"] = -energy_Wh("tire_loss");
  outcome.result["drag_energy_Wh"] = -energy_Wh("drag_loss");
  outcome.result["climb_energy_Wh"] = -energy_Wh("gravity");
  outcome.result["liner_temperature_end_degC"] = liner_degC;
  outcome.lines = {
      {"Drive", conditions.run.id},
      {"Duration, distance", fmt::format("{:.1f} min, {:.2f} km", duration_s / 60.0, distance_km)},
      {"At the wheels, net", fmt::format("{:.0f} Wh", energy_Wh(sim::kMotorWork))},
      {"Lost by tires, air", fmt::format("{:.0f}, {:.0f} Wh", -energy_Wh("tire_loss"), -energy_Wh("drag_loss"))},
      {"Liner at the end", fmt::format("{:.1f} degC", liner_degC)}};
  warn_of_class_values(spec.tire, outcome);
}

}  // namespace

const Scenario& scenario_drive() {
  static const Scenario scenario = make_wheel_scenario<Settings>(
      {"drive",
       "A vehicle on the road, through speed, height and air that a file gives, row by row",
       "Run-up to the first row's speed, then speed, height and air as the file has them; its first row is 0 s. All "
       "tires alike, each under its share of the weight; air of 101.325 kPa; no rig. What the motor does not brake, "
       "friction brakes do: --write-set leaves the traction force empty there. Quasi-static alone, by the steps with "
       "which the diagnosis replays a road set, so that the set that --write-set writes is replayed to what it says. "
       "`rollrig diagnose --plan` writes such files for a road set.",
       "formats.md: a run of a measurement set; (3.20)",
       {{"duration_s", "of the file's rows"},
        {"distance_km", "driven in them"},
        {"wheel_energy_Wh", "work of all hubs, brakes deducted, run-up included"},
        {"rr_energy_Wh", "of it, lost by the tires"},
        {"drag_energy_Wh", "of it, by drag"},
        {"climb_energy_Wh", "of it, gone into height"},
        {"liner_temperature_end_degC", "of a tire at the end"}}},
      measurements::SetKind::kRoad, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
