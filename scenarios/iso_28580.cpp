/// ISO 28580: the whole rolling-resistance test of one tire, as in §3.2.3.
#include <algorithm>
#include <cmath>

#include "models/tire/conversion_laws.h"
#include "models/tire/label_class.h"
#include "scenarios/common/drum_bench.h"
#include "scenarios/common/iso_method_budgets.h"
#include "scenarios/common/iso_methods.h"
#include "scenarios/common/iso_uncertainty.h"
#include "scenarios/common/readings.h"
#include "scenarios/common/settling.h"
#include "sim/core/limits.h"

namespace rollrig::scenarios::iso_28580 {

struct Settings : CycleSettings {
  int measurement_cycles = 0;
  double measurement_s = 0.0;
  IsoAccuracies accuracies;
  Choice method{kTorqueMethod, list_iso_methods()};
  double spindle_misalignment_rad = 0.0;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    CycleSettings::visit(p, visit);
    visit(Field{"measurement_cycles", between(0.0, 100.0), "Measurement cycles after the warm-up cycle (§3.2.1 item 8)",
                0.0},
          p.measurement_cycles);
    visit(Field{"measurement_min", between(1.0, 600.0), "Load of a measurement cycle; its skim is as the first", 10.0},
          p.measurement_s);
    IsoAccuracies::visit(p.accuracies, visit);
    visit(
        Field{"method", any_number(),
              "Method that gives F_r, skim loss and RRc of every cycle; the others are listed beside it, deceleration "
              "only when it is this one, since it adds coasts"},
        p.method);
    visit(Field{"spindle_misalignment_mrad", between(-20.0, 20.0),
                "Angle by which the force cell of the force method is off the right angle to the load", 0.0},
          p.spindle_misalignment_rad);
  }

  bool coasts() const { return method.value == kDecelerationMethod; }

  /// Speed and soak by class too, where they are not given.
  void complete(const RunSpec& spec) {
    CycleSettings::complete(spec);
    if (!spec.tire.iso_28580.has_value()) return;
    if (spec.settings.find("speed_km_h") == nullptr) conditions.speed_m_s = spec.tire.iso_28580->speed_m_s;
    if (spec.settings.find("soak_h") == nullptr) conditions.soak_s = spec.tire.iso_28580->soak_s;
  }
};

/// Assumed: more than tires of class C1 lack after the standard's warm-up.
constexpr double kTooShort = 0.02;

/// Between the highest and the lowest F_r of the methods. Assumed: three times what a coast of a tire that is still
/// warming differs by (docs/iso_28580.md).
constexpr double kMostBetweenMethods = 0.03;

struct Results {
  Cycle cycle;  // the measurement: the last cycle, which is the warm-up's own end when no measurement cycle follows
  std::optional<double> unsettled;  // how far its loss is above that in steady state; empty where it has settled
  std::string method;
  std::vector<MethodResult> methods;
  double corrected_rrc = 0.0;
  std::optional<RrcUncertainty> uncertainty;  // of the methods that use the torque sensor
  std::optional<std::string> label_class;
  std::optional<double> label_probability;
  std::optional<double> approval_stage;
  std::string tire_class;  // of a tire with a label class
  std::string why_no_label;
  double pressure_set_Pa = 0.0;
  double pressure_verified_Pa = 0.0;
  std::vector<Cycle> cycles;
  std::optional<double> mean_rrc;
  std::optional<double> rrc_sd;
  std::optional<double> tire_file_rrc;

  void visit(ResultSheet& visit) const {
    cycle.visit(visit);
    visit(Result{"rrc_25degC_2m_N_per_kN", "", ".3f", "RRc corrected to 25 degC and the 2 m drum"}, corrected_rrc);
    visit_uncertainty(visit);
    visit(Result{"method", "Method", "", "the method that gave F_r, skim loss and RRc"}, method);
    visit(ResultList{"methods", "Methods of the standard", "F_r by each method"}, methods);
    visit_label(visit);
    visit(Result{"pressure_set_kPa", "", ".1f", "as set after the soak, gauge"}, pressure_set_Pa);
    visit(Result{"pressure_verified_kPa", "", ".1f", "at the end of the check, which the standard asks for, gauge"},
          pressure_verified_Pa);
    visit(Result{"tire_file.rrc_N_per_kN", "", ".3f", "RRc that the file of the tire states"}.or_left_out(),
          tire_file_rrc);
    visit(Result{"tire_file.difference_percent", "", "+.2f", "of rrc_25degC_2m_N_per_kN from it"}.or_left_out(),
          calc_difference_to_file());
    visit(ResultList{"cycles", "Cycles", "every cycle, when there are several", kCycleWindows, true}, cycles);
    visit(Result{"rrc_cycles_mean_N_per_kN", "", ".3f", "mean of RRc over the cycles after the first"}.or_left_out(),
          mean_rrc);
    visit(Result{"rrc_cycles_sd_N_per_kN", "", ".3f", "its sample standard deviation, of two cycles or more"}
              .or_left_out(),
          rrc_sd);
    visit(JointLine{"Load", "{load_N}"});
    visit(JointLine{"Speed", "{speed_km_h}"});
    visit(JointLine{"Pressure set / verified / warm",
                    "{pressure_set_kPa} / {pressure_verified_kPa} / {cavity_pressure_kPa}"});
    visit(JointLine{"Liner temperature", "{liner_temperature_degC}"});
    Cycle::visit_lines(visit);
    visit(JointLine{"Rolling resistance", "{rolling_resistance_N}"});
    visit(JointLine{"  by the force method", "{force_method_N}"});
    visit(JointLine{"RRc", "{rrc_N_per_kN}"});
    if (uncertainty.has_value()) {
      visit(JointLine{"RRc at 25 degC, 2 m drum",
                      "{rrc_25degC_2m_N_per_kN} +- {rrc_uncertainty_N_per_kN} (k = 2, torque sensor)"});
      visit(JointLine{"  zero error of the torque",
                      "+- {rrc_uncertainty_offset_kept_N_per_kN}, canceled by the skim test"});
    } else {
      visit(JointLine{"RRc at 25 degC, 2 m drum", "{rrc_25degC_2m_N_per_kN}"});
    }
    visit(JointLine{"  tire file says", "{tire_file.rrc_N_per_kN}, difference {tire_file.difference_percent}"});
    visit_label_lines(visit);
    if (mean_rrc.has_value()) {
      visit(JointLine{"RRc of cycles after the first",
                      rrc_sd.has_value() ? "{rrc_cycles_mean_N_per_kN} +- {rrc_cycles_sd_N_per_kN} (standard deviation)"
                                         : "{rrc_cycles_mean_N_per_kN}"});
    }
    visit_headlines(visit);
  }

 private:
  std::optional<double> calc_difference_to_file() const {
    return tire_file_rrc.has_value() ? std::optional(corrected_rrc / *tire_file_rrc - 1.0) : std::nullopt;
  }

  /// Of a tire that has not settled, how far its value is from that in steady state.
  std::string describe_unsettled() const {
    if (!unsettled.has_value() || std::abs(*unsettled) <= kTooShort) return "";
    return fmt::format(" The tire has not settled: RRc is {:.1f} % {} that in steady state.",
                       1e2 * std::abs(*unsettled), *unsettled > 0.0 ? "above" : "below");
  }

  void visit_headlines(ResultSheet& visit) const {
    visit(Summary{fmt::format(
        "The rolling resistance coefficient (RRc) is {{rrc_25degC_2m_N_per_kN}}{} at 25 degC on a 2 m drum{}. Rolling "
        "resistance is {{rolling_resistance_N}} at {{load_N}} and {{speed_km_h}}.{}",
        uncertainty.has_value() ? " +- {rrc_uncertainty_N_per_kN} (k = 2)" : "",
        label_class.has_value() ? ", EU label class {label_class}" : "", describe_unsettled())});
    const char* label = "RRc at 25 degC, 2 m drum";
    if (uncertainty.has_value()) {
      visit(Headline{label, "{rrc_25degC_2m_N_per_kN} +- {rrc_uncertainty_N_per_kN}",
                     "+- is the expanded uncertainty (k = 2) from the torque sensor"});
    } else {
      visit(Headline{label, "{rrc_25degC_2m_N_per_kN}", "by the {method} method"});
    }
    visit(Headline{"EU label class", "{label_class}",
                   "tire of class " + tire_class + (label_probability ? ", probability {label_probability}" : "")});
    if (!label_class.has_value()) {
      visit(Headline{"EU label class", "none",
                     why_no_label.empty() ? "the file of the tire has no service description, which names its class"
                                          : why_no_label});
    }
    visit(Headline{"Rolling resistance", "{rolling_resistance_N}", "at {load_N} and {speed_km_h}"});
    visit(Headline{"Parasitic loss (skim)", "{parasitic_N}", "at the surface; subtracted from the loss under load"});
    visit(Headline{"Liner temperature", "{liner_temperature_degC}", "mean of the measurement"});
  }

  void visit_uncertainty(ResultSheet& visit) const {
    const auto read = [this](double RrcUncertainty::*part) {
      return uncertainty.has_value() ? std::optional((*uncertainty).*part) : std::nullopt;
    };
    visit(Result{"rrc_uncertainty_N_per_kN", "", ".3f", "expanded (k = 2), from the torque sensor, offset canceled"}
              .or_left_out(),
          read(&RrcUncertainty::offset_canceled));
    visit(Result{"rrc_uncertainty_offset_kept_N_per_kN", "", ".3f", "the same from the offset alone, not canceled"}
              .or_left_out(),
          read(&RrcUncertainty::offset_kept));
  }

  void visit_label(ResultSheet& visit) const {
    visit(Result{"label_class", "", "", "class of the EU label, A to E, of a tire with [service_description]"}
              .or_left_out(),
          label_class);
    visit(Result{"why_no_label", "", "", "why a tire with [service_description] has no class: what is not standard"}
              .or_left_out(),
          why_no_label.empty() ? std::nullopt : std::optional(why_no_label));
    visit(Result{"label_probability", "", ".3f",
                 "probability that the RRc is in this class, by the uncertainty of the torque sensor"}
              .or_left_out(),
          label_probability);
    visit(Result{"approval_stage", "", ".0f",
                 "highest stage of UN R117 whose limit the RRc meets, of stages 1 and 2; 0: none"}
              .or_left_out(),
          approval_stage);
  }

  void visit_label_lines(ResultSheet& visit) const {
    if (label_class.has_value()) {
      visit(JointLine{"EU label class", "{label_class}"});
      if (label_probability.has_value()) visit(JointLine{"  its probability", "{label_probability}"});
    }
    visit(JointLine{"Stage of UN R117 that is met", "{approval_stage}"});
    visit(Remark{"EU label class"}, why_no_label.empty() ? "" : "none: " + why_no_label);
  }
};

DrumProgram plan(const Settings& settings, const RunSpec& spec) {
  DrumProgram program(settings.conditions, spec);
  program.begin_test("iso-28580");
  const double speed_m_s = settings.conditions.speed_m_s;
  const double band_m_s = find_coast_band_m_s(spec, settings.conditions);
  for (int i = 0; i <= settings.measurement_cycles; ++i) {
    program.roll(i == 0 ? "warm-up" : fmt::format("measurement {}", i),
                 i == 0 ? *settings.warm_up_s : settings.measurement_s);
    if (settings.coasts()) add_coast(program, {i, true}, speed_m_s, band_m_s);
    program.skim(i == 0 ? "skim" : fmt::format("skim {}", i), settings.skim_s);
    if (settings.coasts()) add_coast(program, {i, false}, speed_m_s, band_m_s);
  }
  return program;
}

/// Mean and sample standard deviation of RRc over the measurement cycles: all but the first, in which the tire is
/// warmer. The standard deviation takes two of them.
void put_repeatability(const std::vector<Cycle>& cycles, Results& results) {
  const auto count = static_cast<double>(cycles.size() - 1);
  double mean = 0.0, squares = 0.0;
  for (std::size_t i = 1; i < cycles.size(); ++i) mean += cycles[i].rrc / count;
  for (std::size_t i = 1; i < cycles.size(); ++i) squares += (cycles[i].rrc - mean) * (cycles[i].rrc - mean);
  results.mean_rrc = mean;
  if (count > 1.0) results.rrc_sd = std::sqrt(squares / (count - 1.0));
}

/// How far the loss of the measurement is above that in steady state, by the torque method, which adds no coasts.
std::optional<double> find_unsettled(Settings settings, const RunSpec& spec) {
  settings.method.value = kTorqueMethod;
  Settings held = settings;
  held.measurement_cycles = 0;
  held.warm_up_s = kHeld_s;
  const SettlingTest settling = simulate_settling(settings, held, spec, &plan);
  return settling.find_unsettled(static_cast<std::size_t>(settings.measurement_cycles), 0);
}

/// The pressure after the check, against what was set: the standard asks to verify it.
double find_verified_pressure_Pa(const sim::Recording<double>& recording) {
  const double end_s = recording.phase_named("pressure check").end_s;
  return recording.channel(quantities::kCavityPressure)[recording.row_at(end_s)];
}

/// F_r of the last cycle at another speed and pressure, quasi-static and without sensors.
double simulate_resistance_N(Settings settings, RunSpec spec, double speed_m_s, double pressure_Pa) {
  settings.conditions.speed_m_s = speed_m_s;
  settings.conditions.pressure_Pa = pressure_Pa;
  spec.fidelity = Fidelity::kQuasiStatic;
  spec.sensors.reset();
  Outcome outcome;
  simulate_on_drum(spec, settings.conditions, plan(settings, spec), {}, outcome);
  return find_cycles(outcome.recording, spec, settings.conditions).back().rolling_resistance_N;
}

/// What a method reads in a cycle, with the angle of the force cell as set.
MethodReadings read_cycle(const std::string& method, const Settings& settings, const RunSpec& spec,
                          const sim::Recording<double>& recording, const CycleOfTest& at) {
  MethodReadings readings = read_method(method, recording, spec, at, find_coast_band_m_s(spec, settings.conditions));
  readings.misalignment_rad = settings.spindle_misalignment_rad;
  return readings;
}

/// F_r of a cycle by every method that the run allows, the torque method first.
std::vector<MethodResult> evaluate_methods(const Settings& settings, const RunSpec& spec,
                                           const sim::Recording<double>& recording, const CycleOfTest& at) {
  std::vector<MethodResult> methods;
  for (const char* name : {kTorqueMethod, kForceMethod, kPowerMethod, kDecelerationMethod}) {
    if (name == std::string(kDecelerationMethod) && !settings.coasts()) continue;
    const Cycle cycle = evaluate_by_method(at.cycle, read_cycle(name, settings, spec, recording, at), spec);
    methods.push_back({name, cycle.parasitic_N, cycle.rolling_resistance_N, cycle.rrc,
                       correct_rrc(cycle.rrc, cycle.loaded.ambient_K, spec)});
    methods.back().difference = cycle.rolling_resistance_N / methods.front().rolling_resistance_N - 1.0;
  }
  return methods;
}

/// The cycles of the test, with F_r, skim loss and RRc by the method that is asked for.
std::vector<Cycle> find_test_cycles(const Settings& settings, const RunSpec& spec,
                                    const sim::Recording<double>& recording) {
  std::vector<Cycle> cycles = find_cycles(recording, spec, settings.conditions);
  cycles.resize(std::min(cycles.size(), static_cast<std::size_t>(settings.measurement_cycles) + 1));
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const CycleOfTest at{cycles[i], static_cast<int>(i)};
    const auto evaluate_by = [&](const std::string& method) {
      return evaluate_by_method(at.cycle, read_cycle(method, settings, spec, recording, at), spec);
    };
    const double force_method_N = evaluate_by(kForceMethod).rolling_resistance_N;
    cycles[i] = evaluate_by(settings.method.value);
    cycles[i].force_method_N = force_method_N;
  }
  return cycles;
}

/// Where a test differs from the one that the label is defined by; empty where it does not. A load index of 0 is one
/// that is not known.
/// Source  UN R117 Annex 6: drum of 1.7 m at least, its surface as warm as the air, air of 20 to 30 degC, skim load;
///         second-hand. The last minute is averaged: §3.2.7
std::string find_other_condition(const Settings& settings, const RunSpec& spec, const models::IsoTestOfClass& asked) {
  constexpr double kSame = 0.01;  // Assumed: files round load, pressure and speed, such as 33350 N for 33343 N
  constexpr double kLeastDiameter_m = 1.7;
  constexpr double kSurfaceTolerance_K = 5.0;  // Assumed: changes RRc by some 1 %
  constexpr double kLongestWindow_s = 60.0;
  if (!models::is_drum(spec.rig.kind->traits)) return "machine";
  if (!is_at_least(spec.rig.drum.diameter_m, kLeastDiameter_m)) return "drum's diameter";
  const auto differs = [](double is, double wanted) { return !is_at_most(std::abs(is / wanted - 1.0), kSame); };
  const DrumConditions& conditions = settings.conditions;
  if (spec.tire.service->load_index != 0 && differs(*conditions.load_N, asked.load_N)) return "load";
  if (asked.pressure_Pa.has_value() && differs(*conditions.pressure_Pa, *asked.pressure_Pa)) return "pressure";
  if (differs(conditions.speed_m_s, asked.speed_m_s)) return "speed";
  if (!models::is_ambient_correction_valid(*conditions.ambient_K)) return "ambient temperature";
  if (conditions.surface_K.has_value() &&
      !is_at_most(std::abs(*conditions.surface_K - *conditions.ambient_K), kSurfaceTolerance_K)) {
    return "drum's surface temperature";
  }
  if (!is_at_most(conditions.window_s, kLongestWindow_s)) return "averaging window (window_s)";
  if (!is_at_least(conditions.soak_s, asked.soak_s)) return "soak";
  if (!is_at_least(*settings.warm_up_s, asked.warm_up_s)) return "warm-up";
  // The last cycle is the measurement, and the tire has cooled down in the skim test before it.
  const bool is_short = settings.measurement_cycles > 0 && !is_at_least(settings.measurement_s, asked.warm_up_s);
  if (is_short) return "duration of the measurement cycles";
  if (!is_at_most(spec.rig.skim.load_N, asked.highest_skim_load_N)) return "skim load";
  const double used_per_K = find_ambient_coefficient_per_K(spec), asked_per_K = asked.ambient_coefficient_per_K;
  const bool is_asked = is_at_least(used_per_K, asked_per_K) && is_at_most(used_per_K, asked_per_K);
  return is_asked ? "" : "coefficient of the correction to 25 degC (K_t)";
}

/// A warning where more of the tire's own loss is in the skim reading than the test allows.
std::optional<std::string> doubt_skim_load(const RunSpec& spec) {
  if (!spec.tire.service.has_value()) return std::nullopt;
  const models::ServiceDescription& service = *spec.tire.service;
  const double highest_N =
      models::find_iso_test(service, spec.tire.values.geometry.rim_diameter_m).highest_skim_load_N;
  if (is_at_most(spec.rig.skim.load_N, highest_N)) return std::nullopt;
  return fmt::format(
      "the skim load of {:g} N is above the {:g} N that the standard allows for class {}: the skim reading has more of "
      "the tire's own loss, and RRc is too low",
      spec.rig.skim.load_N, highest_N, name_of(service.tire_class));
}

/// A warning where one method has an error of the machine that the others do not have.
std::optional<std::string> doubt_methods(const std::vector<MethodResult>& methods) {
  const auto [low, high] = std::minmax_element(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    return a.rolling_resistance_N < b.rolling_resistance_N;
  });
  const double between_N = high->rolling_resistance_N - low->rolling_resistance_N;
  if (is_at_most(between_N, kMostBetweenMethods * std::abs(high->rolling_resistance_N))) return std::nullopt;
  return fmt::format(
      "the methods differ by more than {:.0f} %: F_r is {:.2f} N by {} and {:.2f} N by {}. Is the scale of the torque, "
      "the angle of the force cell or the inertia of the drum wrong?",
      1e2 * kMostBetweenMethods, low->rolling_resistance_N, low->name, high->rolling_resistance_N, high->name);
}

void add_label(const Settings& settings, const RunSpec& spec, Results& results) {
  if (!spec.tire.service.has_value()) return;
  const models::ServiceDescription& service = *spec.tire.service;
  const std::string other =
      find_other_condition(settings, spec, models::find_iso_test(service, spec.tire.values.geometry.rim_diameter_m));
  if (!other.empty()) {
    results.why_no_label =
        fmt::format("the {} is not that of the standard for class {}", other, name_of(service.tire_class));
    return;
  }
  const double rrc = results.corrected_rrc;
  const std::size_t place = models::find_label_class(service.tire_class, rrc);
  results.label_class = models::kLabelClasses[place];
  results.tire_class = name_of(service.tire_class);
  if (results.uncertainty.has_value()) {
    constexpr double kCoverage = 2.0;
    const double sd = results.uncertainty->offset_canceled / kCoverage;
    results.label_probability = models::calc_label_probabilities(service.tire_class, rrc, sd)[place];
  }
  int stage = 0;
  for (const models::RrcLimit& limit : models::list_rrc_limits(service.tire_class, service.is_severe_snow)) {
    if (models::round_declared_rrc(rrc) <= limit.rrc + 1e-9) stage = std::max(stage, limit.stage);
  }
  results.approval_stage = stage;
}

/// A question where a tire of the class hardly has this RRc.
std::optional<std::string> doubt_rrc(const RunSpec& spec, const Results& results) {
  if (!spec.tire.service.has_value()) return std::nullopt;
  return models::doubt_class_by_rrc(spec.tire.service->tire_class, results.corrected_rrc,
                                    spec.tire.service->is_severe_snow);
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const std::vector<Cycle> cycles = find_test_cycles(settings, spec, outcome.recording);
  const CycleOfTest last{cycles.back(), static_cast<int>(cycles.size()) - 1};
  Results results;
  results.cycle = cycles.back();
  const double ambient_K = results.cycle.loaded.ambient_K;
  results.method = settings.method.value;
  results.methods = evaluate_methods(settings, spec, outcome.recording, last);
  results.corrected_rrc = correct_rrc(results.cycle.rrc, ambient_K, spec);
  if (results.method == kTorqueMethod) results.uncertainty = calc_rrc_uncertainty(results.cycle, spec);
  add_label(settings, spec, results);
  results.pressure_set_Pa = *settings.conditions.pressure_Pa;
  results.pressure_verified_Pa = find_verified_pressure_Pa(outcome.recording);
  if (cycles.size() > 1) {
    put_repeatability(cycles, results);
    results.cycles = cycles;
  }
  if (spec.tire.iso_28580.has_value()) results.tire_file_rrc = spec.tire.iso_28580->rrc;
  if (!is_shown_to_settle(outcome.recording, spec, results.cycle, kTooShort)) {
    results.unsettled = find_unsettled(settings, spec);
    const char* const too_short = settings.measurement_cycles > 0
                                      ? "the measurement (measurement_min) is too short for this tire"
                                      : "the warm-up (warm_up_min) is too short for this tire";
    if (const auto warning = warn_of_unsettled({results.unsettled}, kTooShort, too_short)) {
      outcome.warnings.push_back(*warning);
    }
  }
  for (const std::string& doubt : spec.tire.list_class_doubts()) outcome.warnings.push_back(doubt);
  for (const auto& doubt : {doubt_skim_load(spec), doubt_methods(results.methods), doubt_rrc(spec, results)}) {
    if (doubt.has_value()) outcome.warnings.push_back(*doubt);
  }
  if (!models::is_ambient_correction_valid(ambient_K)) {
    outcome.warnings.push_back("the correction to 25 degC holds from 20 to 30 degC only");
  }
  const MethodReadings readings = read_cycle(settings.method.value, settings, spec, outcome.recording, last);
  outcome.make_measurement_model = [&spec, settings, cycles, readings] {
    const auto simulate = [&](double speed_m_s, double pressure_Pa) {
      return simulate_resistance_N(settings, spec, speed_m_s, pressure_Pa);
    };
    return make_iso_model(spec, cycles, readings, *settings.conditions.pressure_Pa, settings.accuracies, simulate);
  };
  return results;
}

Scenario make() {
  Scenario scenario = make_drum_scenario(
      {"iso_28580", "Whole ISO 28580 test: soak, pressure, run-up, warm-up, measurement, skim",
       "3 h soak at test temperature; pressure set and verified after 10 min; run-up at skim load; 30 min under "
       "load at 80 km/h, of which the last minute is the measurement; 3 min at skim load, of which the last "
       "minute gives the parasitic loss. With measurement_cycles, further cycles of 10 min load and 3 min skim "
       "follow, and the last of them is the measurement. Ranges are found from the load signal. With "
       "[service_description] of the tire, load, pressure, speed, soak, warm-up and temperature coefficient are those "
       "of its class. With method=deceleration, each cycle has a coast under load and one at skim load.",
       "ISO 28580:2009 as in Kolekar and Narasimhan (2024) §3.2.1, §3.2.3, B.2; classes and methods: UN R117, Annex 6"},
      &plan, &evaluate);
  scenario.has_uncertainty = true;
  return scenario;
}

}  // namespace rollrig::scenarios::iso_28580
