/// A vehicle on the road through rows that a file gives: speed, height and air.
#include "scenarios/common/follow_bench.h"

namespace rollrig::scenarios::follow_road {

struct FollowRoadConditions : RecordedInputs {
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

using Settings = OnlyConditions<FollowRoadConditions>;

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

struct Results {
  FollowedRows rows;
  double wheel_J = 0.0;
  double tire_J = 0.0;
  double drag_J = 0.0;
  double climb_J = 0.0;
  double liner_end_K = 0.0;

  void visit(ResultSheet& visit) const {
    rows.visit(visit);
    visit(Result{"wheel_energy_Wh", "At the wheels, net", ".0f", "of all hubs, run-up included, less brakes"}, wheel_J);
    visit(Result{"rr_energy_Wh", "", ".0f", "of it, lost by the tires"}, tire_J);
    visit(Result{"drag_energy_Wh", "", ".0f", "of it, by drag"}, drag_J);
    visit(JointLine{"  lost by tires, by drag", "{rr_energy_Wh}, {drag_energy_Wh}"});
    visit(Result{"climb_energy_Wh", "  gone into height", ".0f", "of it, gone into height"}, climb_J);
    visit(Result{"liner_temperature_end_degC", "Liner at the end", ".1f", "mean of all tires at the end"}, liner_end_K);
    visit(Summary{
        "The wheels took {wheel_energy_Wh} over {distance_km}: the tires lost {rr_energy_Wh}, the drag of the air "
        "{drag_energy_Wh}."});
    visit(Headline{"Energy at the wheels", "{wheel_energy_Wh}", "net, less what the brakes took"});
    visit(Headline{"Lost by the tires", "{rr_energy_Wh}"});
    visit(Headline{"Lost by drag", "{drag_energy_Wh}"});
    visit(Headline{"Distance", "{distance_km}", "in {duration_s}"});
  }
};

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const sim::EnergyAudit& audit = outcome.recording.audit;
  warn_of_class_values(spec.tire, outcome);
  for (const rigs::VehicleAxle& axle : spec.vehicle->axles) {
    if (axle.tire.has_value()) warn_of_class_values(*axle.tire, outcome);
  }
  return {measure_rows(settings.conditions.run), audit.find_term_J(sim::kMotorWork),
          -audit.find_term_J("tire_loss"),       -audit.find_term_J("drag_loss"),
          -audit.find_term_J("gravity"),         outcome.recording.channel(quantities::kLinerTemperature).back()};
}

Scenario make() {
  return make_follow_scenario(
      {"follow_road", "A vehicle on the road, through speed, height and air that a file gives, row by row",
       "Run-up to the first row's speed, then speed, height and air as the file has them; its first row is 0 s. Each "
       "axle has its load share, tire and pressure; channels of a tire are means over all tires; air of 101.325 kPa; "
       "no rig. What the motor does not "
       "brake, friction brakes do: --write-set leaves the traction force empty there. Quasi-static only. The steps are "
       "those of the diagnosis, which simulates a set that --write-set wrote to the same values. `rollrig diagnose "
       "--plan` writes such files for a road set.",
       "formats.md: a run of a measurement set; (3.20)", "drive"},
      "", &evaluate);
}

}  // namespace rollrig::scenarios::follow_road
