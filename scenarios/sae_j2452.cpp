/// SAE J2452: stepwise coastdown of a warm tire on the drum, at several loads and pressures.
#include <algorithm>

#include "estimation/rolling_law/rolling_output.h"
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/multipoint.h"
#include "scenarios/common/speed_trace.h"

namespace rollrig::scenarios::sae_j2452 {

struct Settings : MultipointSettings {
  std::vector<double> speeds_m_s;
  double step_s = 0.0;
  double ramp_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    MultipointSettings::visit(p, visit);
    visit(Field{"speed_km_h", between(5.0, 250.0), "Speed of the warm-up. Assumed", 80.0}, p.conditions.speed_m_s);
    visit(Field{"speeds_km_h", between(5.0, 250.0),
                "Speeds of the steps, falling. 115 to 15 km/h is the range of the practice. Assumed: steps of 20 km/h"},
          p.speeds_m_s);
    visit(Field{"step_s", between(20.0, 600.0), "Time at each speed. Assumed: 30 s", 30.0}, p.step_s);
    visit(Field{"ramp_s", between(1.0, 600.0), "From one speed to the next. Assumed: 5 s", 5.0}, p.ramp_s);
  }

  Settings() {
    for (const double km_h : {115.0, 95.0, 75.0, 55.0, 35.0, 15.0}) speeds_m_s.push_back(km_h / kKmhPerMs);
    loads = {0.3, 0.6, 0.9, 0.9};  // Assumed, with the pressures: the table of the practice could not be read
    pressures_Pa = {10e3, -40e3, 60e3, -40e3};
  }
};

struct Results {
  std::vector<RollingStep> steps;
  double maximum_load_N = 0.0;
  double base_pressure_Pa = 0.0;
  std::optional<estimation::J2452Fit> fit;
  std::optional<estimation::J2452Reference> reference;

  void visit(ResultSheet& visit) const {
    const auto of_fit = [this](auto member) { return fit ? std::optional<double>(member(*fit)) : std::nullopt; };
    const auto of_reference = [this](auto member) {
      return reference ? std::optional<double>(member(*reference)) : std::nullopt;
    };
    visit(ResultList{"steps", "Stepwise coastdown",
                     "every speed of every load and pressure, each with the skim test at its speed", kCycleWindows},
          steps);
    visit(Result{"maximum_load_N", "Maximum load", ".0f", "of which the loads are shares"}, maximum_load_N);
    visit(Result{"base_pressure_kPa", "Base pressure", ".0f", "to which the pressures refer, gauge"}, base_pressure_Pa);
    visit(Result{"pressure_exponent", "", ".4f", "alpha of the law of SAE J2452, over the pressure set"}.or_left_out(),
          of_fit([](const auto& f) { return f.law.alpha; }));
    visit(Result{"load_exponent", "", ".4f", "beta of the law of SAE J2452"}.or_left_out(),
          of_fit([](const auto& f) { return f.law.beta; }));
    visit(JointLine{"Exponents of pressure and load", "{pressure_exponent}, {load_exponent}"});
    visit(Result{"residual_sd_N", "Standard deviation of the residuals", ".3f", "of the steps about the law"}
              .or_left_out(),
          of_fit([](const auto& f) { return f.statistics.residual_sd_N; }));
    visit(Result{"reference_load_N", "", ".0f", "load of the standard reference condition"}.or_left_out(),
          of_reference([](const auto& r) { return r.condition.load_N; }));
    visit(Result{"reference_pressure_kPa", "", ".0f", "pressure of the standard reference condition"}.or_left_out(),
          of_reference([](const auto& r) { return r.condition.pressure_Pa; }));
    visit(JointLine{"Standard reference condition, 80 km/h", "{reference_load_N}, {reference_pressure_kPa}"});
    visit(Result{"reference_rolling_resistance_N", "", ".2f", "of the law, there"}.or_left_out(),
          of_reference([](const auto& r) { return r.force.value_N; }));
    visit(Result{"reference_rrc_N_per_kN", "", ".3f", "the same over load"}.or_left_out(),
          of_reference([](const auto& r) { return r.force.value_N / r.condition.load_N; }));
    visit(JointLine{"  rolling resistance there", "{reference_rolling_resistance_N}, RRc {reference_rrc_N_per_kN}"});
    visit(Result{"merf_urban_N", "  mean over UDDS", ".2f", "mean equivalent rolling force over the distance of UDDS"}
              .or_left_out(),
          of_reference([](const auto& r) { return r.urban.value_N; }));
    visit(Result{"merf_highway_N", "  mean over HWFET", ".2f", "the same of HWFET"}.or_left_out(),
          of_reference([](const auto& r) { return r.highway.value_N; }));
    visit(Result{"smerf_N", "  0.55 UDDS + 0.45 HWFET", ".2f", "standard mean equivalent rolling force (SMERF)"}
              .or_left_out(),
          of_reference([](const auto& r) { return r.combined.value_N; }));
    visit(Summary{
        "By the law of SAE J2452, RRc is {reference_rrc_N_per_kN} at the reference condition ({reference_load_N}, "
        "{reference_pressure_kPa}, 80 km/h). The mean equivalent rolling force is {smerf_N}."});
    visit(Summary{
        "By the law of SAE J2452, rolling resistance goes with pressure to the power {pressure_exponent} and with load "
        "to the power {load_exponent}."});
    visit(Headline{"RRc at the reference condition", "{reference_rrc_N_per_kN}",
                   "{reference_load_N}, {reference_pressure_kPa}, 80 km/h"});
    visit(Headline{"Mean equivalent rolling force", "{smerf_N}", "SMERF: 0.55 UDDS + 0.45 HWFET"});
    visit(Headline{"Pressure exponent", "{pressure_exponent}", "alpha of the law of SAE J2452"});
    visit(Headline{"Load exponent", "{load_exponent}", "beta of the law"});
  }
};

std::string name_step(const char* what, std::size_t point, double speed_m_s) {
  return fmt::format("{} {}: {:.6g} km/h", what, point + 1, kKmhPerMs * speed_m_s);
}

/// Down the steps at the load of the program, after a change to the first speed.
void coast_down(const Settings& settings, std::size_t point, const char* what, double load_N, DrumProgram& program) {
  for (std::size_t i = 0; i < settings.speeds_m_s.size(); ++i) {
    const double speed_m_s = settings.speeds_m_s[i];
    const std::string name = name_step(what, point, speed_m_s);
    program.change_speed("to " + name, i == 0 ? settings.conditions.run_up_s : settings.ramp_s, speed_m_s, load_N);
    program.roll(name, settings.step_s, load_N);
  }
}

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  if (!std::is_sorted(settings.speeds_m_s.rbegin(), settings.speeds_m_s.rend(), std::less_equal<>())) {
    throw InputError(setting_problem(spec, "speeds_km_h", "the speeds of a coastdown fall from step to step",
                                     "different speeds, the highest first"));
  }
  DrumProgram program(settings.conditions, spec);
  const std::vector<TestPoint> points = settings.list_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    program.begin_test(fmt::format("j2452-{}", i + 1), {points[i].pressure_Pa, {}, {}});
    program.roll(fmt::format("warm-up {}", i + 1), *settings.warm_up_s, points[i].load_N);
    coast_down(settings, i, "load", points[i].load_N, program);
    coast_down(settings, i, "skim", spec.rig.skim.load_N, program);
    program.end_test();
  }
  return program;
}

std::vector<RollingStep> read_steps(const Settings& settings, const RunSpec& spec, const Outcome& outcome) {
  const auto read = [&](const char* what, std::size_t point, double speed_m_s) {
    const sim::PhaseSpan& phase = outcome.recording.phase_named(name_step(what, point, speed_m_s));
    const LoadRange range{true, 0.0, phase.start_s, phase.end_s};
    return take_reading(outcome.recording, spec,
                        find_last_window(range, settings.conditions.window_s, settings.conditions.margin_s));
  };
  const std::vector<TestPoint> points = settings.list_points();
  std::vector<RollingStep> steps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const double speed_m_s : settings.speeds_m_s) {
      steps.push_back(
          {evaluate_cycle(read("load", i, speed_m_s), read("skim", i, speed_m_s), spec), points[i].pressure_Pa});
    }
  }
  return steps;
}

/// The law and what follows from it, where the points decide it.
void put_law(const Settings& settings, Results& results, Outcome& outcome) {
  std::vector<estimation::RollingPoint> points;
  for (const RollingStep& step : results.steps) points.push_back(step.to_point());
  const auto cycle = [](const char* name) {
    const SpeedTrace trace = read_speed_trace(name);
    return estimation::calc_speed_moments(trace.time_s, trace.speed_m_s);
  };
  try {
    results.fit = estimation::fit_j2452(points);
    results.reference = estimation::evaluate_reference(*results.fit, settings.make_reference(),
                                                       {"udds", "hwfet", cycle("udds"), cycle("hwfet")});
  } catch (const InputError& error) {
    outcome.warnings.push_back(fmt::format("no law of SAE J2452: {}", error.problem().what));
  } catch (const RunFailure& failure) {
    outcome.warnings.push_back(fmt::format("no law of SAE J2452: {}", failure.what()));
  }
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  Results results;
  results.steps = read_steps(settings, spec, outcome);
  results.maximum_load_N = *settings.maximum_load_N;
  results.base_pressure_Pa = *settings.conditions.pressure_Pa;
  put_law(settings, results, outcome);
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"sae_j2452", "SAE J2452: stepwise coastdown from 115 to 15 km/h at several loads and pressures",
       "For each load and pressure: soak, pressure set cold, run-up, warm-up under load (30 min), then steps of "
       "constant speed from 115 down to 15 km/h under load, and the same steps at skim load, which give the parasitic "
       "loss at each speed; the end of every step is averaged. The tire stays as warm as it was: the steps are short. "
       "The law F = P^alpha Z^beta (a + b v + c v^2) is fitted to the steps, P being the pressure that was set.",
       "SAE J2452, second-hand: 40 CFR 1037.528(h)(6), TRB Special Report 286 Table A-1, and "
       "tnlab.org and grokipedia.com on SAE J2452"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::sae_j2452
