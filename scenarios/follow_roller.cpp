/// One wheel on its roller through rows that a file gives: speed, load, drive and brake force, air.
#include "scenarios/common/follow_bench.h"

namespace rollrig::scenarios::follow_roller {

struct FollowRollerConditions : RecordedInputs {
  Choice reads_force_at_standstill{"no", {"no", "yes"}};

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    visit(Field{"program", any_number(),
                "CSV: time_s, speed_km_h, load_N, longitudinal_force_N (positive when the wheel drives), ambient_degC, "
                "surface_temperature_degC where known, and hung_force_N; a load holds until the next row, all else "
                "goes straight "
                "from row to row. A run file of a dyno set will do: measured columns are not read"},
          p.program);
    visit_start(p, visit);
    visit(Field{"tire_state", any_number(),
                "warm: right after another run; effects that remember, such as flat_spot, start accordingly"},
          p.tire_state);
    visit(Field{"force_at_standstill", any_number(),
                "yes: with --write-set, the set says that the loss force read at standstill is the sensor's zero"},
          p.reads_force_at_standstill);
  }

  void complete(const RunSpec& spec) {
    RecordedInputs::complete(spec);
    run.force_at_standstill = reads_force_at_standstill.value == "yes";
  }
};

using Settings = OnlyConditions<FollowRollerConditions>;

struct Results {
  FollowedRows rows;
  double tire_J = 0.0;
  double slip_J = 0.0;
  double bearing_J = 0.0;
  double loss_force_end_N = 0.0;
  TireCourse tire;

  void visit(ResultSheet& visit) const {
    rows.visit(visit);
    visit(Result{"loss_energy_Wh", "Lost between hub and roller", ".1f", "by tire, slip and bearings, run-up included"},
          tire_J + slip_J + bearing_J);
    visit(Result{"rr_energy_Wh", "  by the tire", ".1f", "of it, by the tire"}, tire_J);
    visit(Result{"slip_energy_Wh", "  by slip", ".1f", "of it, by slip"}, slip_J);
    visit(Result{"loss_force_end_N", "Loss force at the end", ".2f", "loss force of the last row"}, loss_force_end_N);
    tire.visit(visit);
    visit(
        Summary{"The tire lost {rr_energy_Wh} over {distance_km}; with slip and bearings, {loss_energy_Wh} were lost "
                "between hub "
                "and roller."});
    visit(Headline{"Lost by the tire", "{rr_energy_Wh}", "{loss_energy_Wh} with slip and bearings"});
    visit(Headline{"Loss force at the end", "{loss_force_end_N}"});
    visit(Headline{"Highest liner temperature", "{liner_temperature_max_degC}"});
    visit(Headline{"Distance", "{distance_km}", "in {duration_s}"});
  }
};

Results evaluate(const Settings& settings, const RunSpec&, Outcome& outcome) {
  const sim::Recording<double>& recording = outcome.recording;
  const auto lost_J = [&](const char* term) { return -recording.audit.find_term_J(term); };
  return {measure_rows(settings.conditions.run),
          lost_J("tire_loss"),
          lost_J("slip_loss"),
          lost_J("bearing_loss"),
          recording.channel(quantities::kLossForce).back(),
          read_tire_course(recording, *settings.conditions.pressure_Pa)};
}

Scenario make() {
  return make_follow_scenario(
      {"follow_roller", "One wheel on its roller, through speed, load and force that a file gives, row by row",
       "Run-up to the first row's speed, then speed, load, longitudinal force and air as the file has them; its first "
       "row is 0 s. Quasi-static only. The steps are those of the diagnosis, which simulates a set that --write-set "
       "wrote to the same values. `rollrig diagnose --plan` writes such files for a dyno set.",
       "formats.md: a run of a measurement set", "wheel_program"},
      "dyno_1m2", &evaluate);
}

}  // namespace rollrig::scenarios::follow_roller
