/// SAE J1269 and ISO 18164: rolling resistance in steady state at several loads and pressures, at one speed.
#include "estimation/rolling_law/j1269_fit.h"
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/multipoint.h"
#include "scenarios/common/settling.h"

namespace rollrig::scenarios::sae_j1269 {

struct Settings : MultipointSettings {
  double skim_s = 0.0;
  double settle_s = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    MultipointSettings::visit(p, visit);
    visit(Field{"speed_km_h", between(5.0, 250.0), "Test speed", 80.0}, p.conditions.speed_m_s);
    visit(Field{"settle_min", between(0.0, 600.0), "Further load of each point, until the tire is in steady state",
                kDefaultSettle_min},
          p.settle_s);
    visit(Field{"skim_min", between(0.5, 600.0), "Skim test after each point", 3.0}, p.skim_s);
  }

  Settings() {
    loads = {0.9, 0.9, 0.5, 0.5, 0.7};  // Assumed, with the pressures: the table of the practice could not be read
    pressures_Pa = {-30e3, 70e3, -30e3, 70e3, 20e3};
  }
};

struct MultipointStep {
  RollingStep step;
  std::optional<double> unsettled;

  void visit(ResultSheet& visit) const {
    step.visit(visit);
    SteadyCycle::visit_unsettled(visit, unsettled);
  }
};

struct Results {
  std::vector<MultipointStep> steps;
  double maximum_load_N = 0.0;
  double base_pressure_Pa = 0.0;
  double mean_rrc = 0.0;
  std::optional<estimation::ForceEstimate> reference;
  estimation::ReferenceCondition condition;

  void visit(ResultSheet& visit) const {
    const auto at_reference = [this](double divisor) {
      return reference ? std::optional<double>(reference->value_N / divisor) : std::nullopt;
    };
    const auto of_condition = [this](double value) { return reference ? std::optional<double>(value) : std::nullopt; };
    visit(ResultList{"steps", "Points", "every load and pressure, with its skim test", kCycleWindows}, steps);
    visit(Result{"maximum_load_N", "Maximum load", ".0f", "of which the loads are shares"}, maximum_load_N);
    visit(Result{"base_pressure_kPa", "Base pressure", ".0f", "to which the pressures refer, gauge"}, base_pressure_Pa);
    visit(Result{"mean_rrc_N_per_kN", "RRc, mean of the points", ".3f", "mean of RRc over the points"}, mean_rrc);
    visit(Result{"reference_load_N", "", ".0f", "load of the standard reference condition"}.or_left_out(),
          of_condition(condition.load_N));
    visit(Result{"reference_pressure_kPa", "", ".0f", "pressure of the standard reference condition"}.or_left_out(),
          of_condition(condition.pressure_Pa));
    visit(JointLine{"Standard reference condition", "{reference_load_N}, {reference_pressure_kPa}"});
    visit(Result{"reference_rolling_resistance_N", "", ".2f", "of the law A0 + A1 Z + A2/P + A3 Z/P, there"}
              .or_left_out(),
          at_reference(1.0));
    visit(Result{"reference_rrc_N_per_kN", "", ".3f", "the same over load"}.or_left_out(),
          at_reference(condition.load_N));
    visit(JointLine{"  rolling resistance there", "{reference_rolling_resistance_N}, RRc {reference_rrc_N_per_kN}"});
    visit(
        Summary{"RRc is {reference_rrc_N_per_kN} at the reference condition ({reference_load_N}, "
                "{reference_pressure_kPa}), where "
                "rolling resistance is {reference_rolling_resistance_N}."});
    visit(Summary{"RRc is {mean_rrc_N_per_kN}, the mean of the points."});
    visit(Headline{"RRc at the reference condition", "{reference_rrc_N_per_kN}",
                   "{reference_load_N}, {reference_pressure_kPa}"});
    visit(Headline{"Rolling resistance there", "{reference_rolling_resistance_N}"});
    visit(Headline{"RRc, mean of the points", "{mean_rrc_N_per_kN}"});
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  const std::vector<TestPoint> points = settings.list_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    program.begin_test(fmt::format("j1269-{}", i + 1), {points[i].pressure_Pa, {}, {}});
    program.roll(fmt::format("load {}", i + 1), *settings.warm_up_s + settings.settle_s, points[i].load_N);
    program.skim(fmt::format("skim {}", i + 1), settings.skim_s);
    program.end_test();
  }
  return program;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  Results results;
  results.maximum_load_N = *settings.maximum_load_N;
  results.base_pressure_Pa = *settings.conditions.pressure_Pa;
  results.condition = settings.make_reference();
  const std::vector<TestPoint> points = settings.list_points();
  const std::vector<Cycle> cycles = find_cycles(outcome.recording, spec, settings.conditions);
  std::vector<SteadyCycle> steady;
  std::vector<estimation::RollingPoint> measured;
  Settings held = settings;
  held.settle_s = kHeld_s;
  const SettlingTest settling = simulate_settling(settings, held, spec, &plan);
  for (std::size_t i = 0; i < cycles.size() && i < points.size(); ++i) {
    steady.push_back({cycles[i], settling.find_unsettled(i, i)});
    results.steps.push_back({{cycles[i], points[i].pressure_Pa}, steady.back().unsettled});
    measured.push_back(results.steps.back().step.to_point());
    results.mean_rrc += cycles[i].rrc / static_cast<double>(points.size());
  }
  if (const auto warning = warn_of_unsettled(steady)) outcome.warnings.push_back(*warning);
  try {
    const auto fit = estimation::fit_multipoint(measured, estimation::MultipointForm::kBilinear);
    results.reference = fit.estimate_force(results.condition.load_N, results.condition.pressure_Pa);
  } catch (const InputError& error) {
    outcome.warnings.push_back(fmt::format("no law of load and pressure: {}", error.problem().what));
  } catch (const RunFailure& failure) {
    outcome.warnings.push_back(fmt::format("no law of load and pressure: {}", failure.what()));
  }
  return results;
}

Scenario make() {
  return make_drum_scenario(
      {"sae_j1269", "SAE J1269 and ISO 18164: rolling resistance in steady state at several loads and pressures",
       "For each load and pressure: soak, pressure set cold, run-up, load at 80 km/h until the tire is in steady state "
       "(30 min and settle_min), skim test. Rolling resistance at the standard reference condition follows from a law "
       "that is linear in load and in the reciprocal of pressure.",
       "SAE J1269, second-hand: TRB Special Report 286 Table A-1; the law from Tire Science and Technology 6 (1978) "
       "163"},
      &plan, &evaluate);
}

}  // namespace rollrig::scenarios::sae_j1269
