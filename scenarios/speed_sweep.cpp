/// Speed sweep (§3.2.5): RRc at several speeds, each from a soaked tire, with repeated measurement cycles.
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/sweep_evaluation.h"

namespace rollrig::scenarios {
namespace {

struct Settings {
  DrumConditions conditions;
  CycleTimes times;
  std::vector<double> speeds_m_s{40.0 / 3.6, 80.0 / 3.6, 120.0 / 3.6};  // §3.2.5
  double measurement_s = 0.0;
  int measurement_cycles = 0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    DrumConditions::visit(p.conditions, visit);
    CycleTimes::visit(p.times, visit);
    visit(Field{"speeds_km_h", between(5.0, 250.0), "Speeds, each from a soaked tire"}, p.speeds_m_s);
    visit(Field{"measurement_min", between(1.0, 600.0), "Load of each measurement cycle (§3.2.1 item 8)", 10.0},
          p.measurement_s);
    visit(Field{"measurement_cycles", between(1.0, 100.0), "Measurement cycles at each speed (§3.2.5)", 4.0},
          p.measurement_cycles);
  }

  Settings() {
    conditions.pressure_Pa = kVehiclePressure_Pa;
    conditions.load_N = kVehicleLoad_N;
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  const DrumConditions& conditions = settings.conditions;
  const double skim_N = spec.rig.skim.load_N;
  DrumProgram program(conditions, spec.rig, spec.sample_interval_s);
  for (const double speed_m_s : settings.speeds_m_s) {
    const std::string at = fmt::format("{:.6g} km/h", 3.6 * speed_m_s);
    program.begin_test(fmt::format("speed-{:.6g}", 3.6 * speed_m_s), *conditions.pressure_Pa, speed_m_s);
    program.mark_time_zero();
    program.roll("warm-up " + at, settings.times.warm_up_s, *conditions.load_N);
    program.roll("skim " + at, settings.times.skim_s, skim_N);
    for (int i = 1; i <= settings.measurement_cycles; ++i) {
      program.roll(fmt::format("measurement {} {}", i, at), settings.measurement_s, *conditions.load_N);
      program.roll(fmt::format("skim {} {}", i, at), settings.times.skim_s, skim_N);
    }
    program.end_test();
  }
  return program;
}

void evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> all = find_cycles(outcome.recording, spec, settings.conditions, 0.0);
  const auto cycles_a_speed = static_cast<std::ptrdiff_t>(settings.measurement_cycles + 1);
  std::vector<Cycle> points;
  for (auto first = all.begin(); all.end() - first >= cycles_a_speed; first += cycles_a_speed) {
    points.push_back(average_cycles({first + 1, first + cycles_a_speed}));  // without the warm-up cycle
  }
  add_cycles("Speed sweep: means of the measurement cycles", points, outcome);
  if (points.size() < 2) return;
  const double rise = points.back().rrc / points.front().rrc - 1.0;
  outcome.result["rrc_rise_percent"] = 100.0 * rise;
  outcome.lines = {{"RRc from first to last speed", fmt::format("{:+.1f} %", 100.0 * rise)}};
}

}  // namespace

const Scenario& scenario_speed_sweep() {
  static const Scenario scenario = make_drum_scenario<Settings>(
      {"speed_sweep",
       "RRc at several speeds, one load, one cold pressure",
       "For each speed: soak, pressure, run-up, warm-up cycle (30 min and 3 min skim), then four measurement cycles "
       "(10 min and 3 min skim), run-down; the measurement cycles are averaged.",
       "source §3.2.5, §4.1.5",
       {{"cycles", "for each speed the mean of its measurement cycles"},
        {"rrc_rise_percent", "RRc at the last speed above that at the first"}}},
      &plan, &evaluate);
  return scenario;
}

}  // namespace rollrig::scenarios
