/// One wheel on its roller through rows that a file gives: speed, load, drive and brake force, air.
#include <algorithm>

#include "scenarios/common/wheel_bench.h"
#include "sim/core/file_io.h"

namespace rollrig::scenarios {
namespace {

struct WheelConditions : RecordedInputs {
  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"program", any_number(),
                "CSV: time_s, speed_km_h, load_N, longitudinal_force_N (positive when the wheel drives), ambient_degC, "
                "and surface_temperature_degC where known; a load holds until the next row, all else goes straight "
                "from row to row. A run file of a dyno set will do: measured columns are not read"},
          p.program);
    visit_start(p, visit);
    visit(Field{"tire_state", any_number(),
                "warm: right after another run; effects that remember, such as flat_spot, start accordingly"},
          p.tire_state);
  }
};

struct Settings {
  WheelConditions conditions;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    WheelConditions::visit(p.conditions, visit);
  }
};

void evaluate(const Settings& settings, const RunSpec&, Outcome& outcome) {
  const WheelConditions& conditions = settings.conditions;
  const sim::Recording<double>& recording = outcome.recording;
  constexpr double kWh_J = 3600.0;
  const std::vector<double>& liner_K = recording.channel("liner_temperature_degC");
  const double duration_s = conditions.run.time_s.back() - conditions.run.time_s.front();
  const double distance_km = calc_distance_m(conditions.run) / 1e3;
  const double hottest_degC = *std::max_element(liner_K.begin(), liner_K.end()) - kZeroCelsius_K;
  const double pressure_end_kPa = recording.channel("cavity_pressure_kPa").back() / 1e3;
  const double tire_Wh = -recording.audit.find_term_J("tire_loss") / kWh_J;
  const double slip_Wh = -recording.audit.find_term_J("slip_loss") / kWh_J;
  const double bearing_Wh = -recording.audit.find_term_J("bearing_loss") / kWh_J;
  outcome.settings["program_sha256"] = calc_sha256(read_text_file(conditions.program.path));
  outcome.result["duration_s"] = duration_s;
  outcome.result["distance_km"] = distance_km;
  outcome.result["loss_energy_Wh"] =
      -(recording.audit.find_term_J("tire_loss") + recording.audit.find_term_J("slip_loss") +
        recording.audit.find_term_J("bearing_loss")) /
      kWh_J;
  outcome.result["rr_energy_Wh"] = tire_Wh;
  outcome.result["slip_energy_Wh"] = slip_Wh;
  outcome.result["loss_force_end_N"] = recording.channel("loss_force_N").back();
  outcome.result["liner_temperature_max_degC"] = hottest_degC;
  outcome.result["liner_temperature_end_degC"] = liner_K.back() - kZeroCelsius_K;
  outcome.result["cavity_pressure_end_kPa"] = pressure_end_kPa;
  outcome.lines = {
      {"Program", conditions.run.id},
      {"Duration, distance", fmt::format("{:.1f} min, {:.2f} km", duration_s / 60.0, distance_km)},
      {"Lost by tire, slip, roller", fmt::format("{:.1f}, {:.1f}, {:.1f} Wh", tire_Wh, slip_Wh, bearing_Wh)},
      {"Highest liner temperature", fmt::format("{:.1f} degC", hottest_degC)},
      {"Pressure set / at the end",
       fmt::format("{:.1f} / {:.1f} kPa", *conditions.pressure_Pa / 1e3, pressure_end_kPa)}};
}

}  // namespace

const Scenario& scenario_wheel_program() {
  static const Scenario scenario = make_wheel_scenario<Settings>(
      {"wheel_program",
       "One wheel on its roller, through speed, load and force that a file gives, row by row",
       "Run-up to the first row's speed, then speed, load, longitudinal force and air as the file has them; its first "
       "row is 0 s. Quasi-static alone, by the steps with which the diagnosis replays a dyno set, so that the set that "
       "--write-set writes is replayed to what it says. `rollrig diagnose --plan` writes such files for a dyno set.",
       "formats.md: a run of a measurement set; baseline.md, \"Rig\"",
       {{"duration_s", "of the file's rows"},
        {"distance_km", "rolled in them"},
        {"loss_energy_Wh", "lost between hub and roller, run-up included: tire, slip, roller bearings"},
        {"rr_energy_Wh", "of it, by the tire"},
        {"slip_energy_Wh", "of it, by slip"},
        {"loss_force_end_N", "loss force of the last row"},
        {"liner_temperature_max_degC", "highest liner temperature"},
        {"liner_temperature_end_degC", "liner temperature at the end"},
        {"cavity_pressure_end_kPa", "pressure at the end"}}},
      measurements::SetKind::kDyno, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
