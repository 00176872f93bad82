/// Speed sweep (§3.2.5): RRc at several speeds, each from a soaked tire, with repeated measurement cycles.
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/settling.h"

namespace rollrig::scenarios::speed_sweep {

struct Settings : SteadyCycleSettings {
  std::vector<double> speeds_m_s{40.0 / 3.6, 80.0 / 3.6, 120.0 / 3.6};  // §3.2.5
  double measurement_s = 0.0;
  int measurement_cycles = 0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    SteadyCycleSettings::visit(p, visit);
    visit(Field{"speeds_km_h", between(5.0, 250.0), "Speeds, each from a soaked tire"}, p.speeds_m_s);
    visit(Field{"measurement_min", between(1.0, 600.0),
                "Load of each measurement cycle (§3.2.1 item 8), after settle_min", 10.0},
          p.measurement_s);
    visit(Field{"measurement_cycles", between(1.0, 100.0), "Measurement cycles at each speed (§3.2.5)", 4.0},
          p.measurement_cycles);
  }

  void complete(const RunSpec& spec) {
    complete_as_on_vehicle(conditions, spec);
    SteadyCycleSettings::complete(spec);
  }
};

struct Results {
  std::vector<SteadyCycle> cycles;
  std::optional<double> rrc_rise;

  void visit(ResultSheet& visit) const {
    visit(ResultList{"cycles", "Speed sweep: means of the measurement cycles",
                     "for each speed the mean of its measurement cycles", kCycleWindows},
          cycles);
    visit(Result{"rrc_rise_percent", "RRc from first to last speed", "+.1f",
                 "RRc at the last speed above that at the first"}
              .or_left_out(),
          rrc_rise);
    visit(
        Summary{"RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.speed_km_h} and {cycles.last.rrc_N_per_kN} at "
                "{cycles.last.speed_km_h}: {rrc_rise_percent}."});
    visit(Summary{"RRc is {cycles.first.rrc_N_per_kN} at {cycles.first.speed_km_h}."});
    visit(Headline{"RRc at {cycles.first.speed_km_h}", "{cycles.first.rrc_N_per_kN}", "first speed"});
    visit(Headline{"RRc at {cycles.last.speed_km_h}", "{cycles.last.rrc_N_per_kN}", "last speed"});
    visit(Headline{"RRc from first to last speed", "{rrc_rise_percent}"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  for (const double speed_m_s : settings.speeds_m_s) {
    const std::string at = fmt::format("{:.6g} km/h", 3.6 * speed_m_s);
    program.begin_test(fmt::format("speed-{:.6g}", 3.6 * speed_m_s), {{}, speed_m_s, {}});
    program.roll("warm-up " + at, *settings.warm_up_s);
    program.skim("skim " + at, settings.skim_s);
    for (int i = 1; i <= settings.measurement_cycles; ++i) {
      program.roll(fmt::format("measurement {} {}", i, at), settings.settle_s + settings.measurement_s);
      program.skim(fmt::format("skim {} {}", i, at), settings.skim_s);
    }
    program.end_test();
  }
  return program;
}

/// Of each speed, how far the mean of its measurement cycles is above steady state.
void put_unsettled(const Settings& settings, const RunSpec& spec, std::vector<SteadyCycle>& cycles) {
  Settings held = settings;
  held.settle_s = kHeld_s;
  held.measurement_cycles = 1;
  const SettlingTest settling = simulate_settling(settings, held, spec, &plan);
  const auto count = static_cast<std::size_t>(settings.measurement_cycles);
  for (std::size_t speed = 0; speed < cycles.size(); ++speed) {
    cycles[speed].unsettled = 0.0;
    for (std::size_t i = 1; i <= count && cycles[speed].unsettled.has_value(); ++i) {
      const auto one = settling.find_unsettled(speed * (count + 1) + i, 2 * speed + 1);
      cycles[speed].unsettled = one.has_value() ? *cycles[speed].unsettled + *one / static_cast<double>(count) : one;
    }
  }
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> all = find_cycles(outcome.recording, spec, settings.conditions);
  const auto cycles_a_speed = static_cast<std::ptrdiff_t>(settings.measurement_cycles + 1);
  Results results;
  for (auto first = all.begin(); all.end() - first >= cycles_a_speed; first += cycles_a_speed) {
    results.cycles.push_back({average_cycles({first + 1, first + cycles_a_speed}), {}});  // without the warm-up cycle
  }
  if (results.cycles.size() > 1) {
    results.rrc_rise = results.cycles.back().cycle.rrc / results.cycles.front().cycle.rrc - 1.0;
  }
  put_unsettled(settings, spec, results.cycles);
  if (const auto warning = warn_of_unsettled(results.cycles)) outcome.warnings.push_back(*warning);
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"speed_sweep", "RRc at several speeds, one load, one cold pressure",
       "For each speed: soak, pressure, run-up, warm-up cycle (30 min and 3 min skim), then four measurement cycles "
       "(10 min and 3 min skim), run-down; the measurement cycles are averaged. Each measurement cycle is longer by "
       "settle_min: ten minutes after a skim test, the tire is not in steady state, and RRc is up to 3 % too high.",
       "Kolekar and Narasimhan (2024) §3.2.5, §4.1.5"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::speed_sweep
