#pragma once
/// Scenarios from their parts: settings are read once, planned once, then carried out.

#include <memory>

#include "scenarios/run/settings.h"

namespace rollrig::scenarios {

/// Settings that are nothing but conditions.
template <class Conditions>
struct OnlyConditions {
  Conditions conditions;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    Conditions::visit(p.conditions, visit);
  }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

/// Settings (with a member `conditions`, and `complete` for what the tire and the rig decide) are read and completed,
/// `plan(settings, spec)` makes the program and throws InputError where it cannot, `carry_out(spec, settings, program,
/// progress, outcome)` runs it and returns the results.
template <class Settings, class Results, class Plan, class CarryOut>
Scenario make_scenario(ScenarioText text, Plan plan, CarryOut carry_out) {
  Scenario scenario;
  scenario.text = std::move(text);
  scenario.settings = list_settings<Settings>();
  const ResultSheet declared = ResultSheet::of(Results{});
  scenario.results = declared.infos;
  scenario.headlines = declared.headline_keys;
  scenario.prepare = [plan, carry_out](const RunSpec& spec) -> PreparedRun {
    const auto settings = std::make_shared<Settings>(read_settings<Settings>(spec));
    settings->complete(spec);
    using Program = decltype(plan(*settings, spec));
    const auto program = std::make_shared<const Program>(plan(*settings, spec));
    return [&spec, carry_out, settings, program](const sim::Progress& progress) {
      Outcome outcome;
      outcome.settings = settings_to_json(*settings);
      const Results results = carry_out(spec, *settings, *program, progress, outcome);
      outcome.sheet = ResultSheet::of(results);
      outcome.result = outcome.sheet.json;
      return outcome;
    };
  };
  return scenario;
}

/// A scenario that is one program on one rig, whichever the rig: `simulate` runs it, `evaluate` reads the results off
/// the recording; `check_tire` throws InputError when the tire lacks what the rig takes.
template <class Settings, class Results, class Program, class Simulate, class CheckTire>
Scenario make_rig_scenario(ScenarioText text, Program (*plan)(const Settings&, const RunSpec&),
                           Results (*evaluate)(const Settings&, const RunSpec&, Outcome&), Simulate simulate,
                           CheckTire check_tire) {
  const auto plan_checked = [plan, check_tire](const Settings& settings, const RunSpec& spec) {
    Program program = plan(settings, spec);
    check_tire(spec);
    return program;
  };
  const auto carry_out = [simulate, evaluate](const RunSpec& spec, const Settings& settings, const Program& program,
                                              const sim::Progress& progress, Outcome& outcome) {
    simulate(spec, settings.conditions, program, progress, outcome);
    return evaluate(settings, spec, outcome);
  };
  return make_scenario<Settings, Results>(std::move(text), plan_checked, carry_out);
}

}  // namespace rollrig::scenarios
