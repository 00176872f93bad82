/// Coastdown of a vehicle on the road or on a dynamometer, both directions, and its A, B, C.
#include "estimation/road_load/road_load_uncertainty.h"
#include "scenarios/common/coastdown_evaluation.h"
#include "scenarios/common/vehicle_bench.h"

namespace rollrig::scenarios::coastdown {

struct Settings {
  VehicleConditions conditions;
  Coastdowns coastdowns;

  template <class Self, class Visit>
  static void visit(Self& p, Visit&& visit) {
    VehicleConditions::visit(p.conditions, visit);
    Coastdowns::visit(p.coastdowns, visit);
  }

  void complete(const RunSpec& spec) { conditions.complete(spec); }
};

struct ForcePoint {
  double speed_m_s = 0.0;
  double force_N = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"speed_km_h", "", ".0f", "speed"}, speed_m_s);
    visit(Result{"force_N", "", ".1f", "A + B v + C v^2"}, force_N);
  }
};

struct CoastdownTime {
  std::string name;
  double duration_s = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"name", "coastdown", "", "its phase"}, name);
    visit(Result{"duration_s", "", ".2f", "time that it takes"}, duration_s);
  }
};

/// How long the vehicle takes through a range of speeds, in the mean over the coastdowns of a direction.
struct SpeedBin {
  double high_m_s = 0.0;
  double low_m_s = 0.0;
  double first_s = 0.0;
  double second_s = 0.0;

  void visit(ResultSheet& visit) const {
    visit(Result{"from_km_h", "from", ".0f", "speed at its start"}, high_m_s);
    visit(Result{"to_km_h", "to", ".0f", "speed at its end"}, low_m_s);
    visit(Result{"first_direction_s", "direction +", ".2f", "time in the first direction, mean of its coastdowns"},
          first_s);
    visit(Result{"second_direction_s", "direction -", ".2f", "time in the second direction, likewise"}, second_s);
  }
};

struct Results {
  models::RoadLoad<double> load;
  std::array<double, 3> sd{};
  double force_at_80_N = 0.0;
  double force_at_80_sd_N = 0.0;
  std::vector<ForcePoint> forces;
  std::vector<CoastdownTime> coastdowns;
  std::vector<SpeedBin> bins;
  bool on_road = false;

  void visit(ResultSheet& visit) const {
    visit(Result{"A_N", "", ".2f", "force at standstill"}, load.A_N);
    visit(Result{"A_N_sd", "", ".2f", "its standard deviation"}, sd[0]);
    visit(Result{"B_N_per_km_h", "", ".4f", "rise with speed"}, load.B_N_s_per_m);
    visit(Result{"B_N_per_km_h_sd", "", ".4f", "its standard deviation"}, sd[1]);
    visit(Result{"C_N_per_km_h2", "", ".5f", "rise with the square of speed"}, load.C_N_s2_per_m2);
    visit(Result{"C_N_per_km_h2_sd", "", ".5f", "its standard deviation"}, sd[2]);
    visit(JointLine{"A", "{A_N} +- {A_N_sd}"});
    visit(JointLine{"B", "{B_N_per_km_h} +- {B_N_per_km_h_sd}"});
    visit(JointLine{"C", "{C_N_per_km_h2} +- {C_N_per_km_h2_sd}"});
    visit(ResultList{"force_N", on_road ? "Force at reference conditions" : "Force of rollers and vehicle, as tested",
                     "at speeds of 20 to 130 km/h"},
          forces);
    visit(ResultList{"coastdowns", "Coastdowns", "each coastdown"}, coastdowns);
    visit(ResultList{"bins", "Time through each bin of speed", "each 10 km/h that all coastdowns fall through"}, bins);
    visit(Result{"force_at_80_N", "", ".1f", "A + B v + C v^2 at 80 km/h"}, force_at_80_N);
    visit(Result{"force_at_80_N_sd", "", ".1f", "its standard deviation"}, force_at_80_sd_N);
    visit(JointLine{"Force at 80 km/h", "{force_at_80_N} +- {force_at_80_N_sd}"});
    visit(Summary{
        fmt::format("The road load at 80 km/h is {{force_at_80_N}} +- {{force_at_80_N_sd}} (one standard deviation) {}: A = "
                    "{{A_N}}, B = {{B_N_per_km_h}}, C = {{C_N_per_km_h2}}.",
                    on_road ? "at reference conditions" : "of rollers and vehicle as tested")});
    visit(Headline{"Road load at 80 km/h", "{force_at_80_N} +- {force_at_80_N_sd}",
                   on_road ? "at reference conditions; +- is one standard deviation, in all these tiles"
                           : "rollers and vehicle, as tested; +- is one standard deviation, in all these tiles"});
    visit(Headline{"A", "{A_N} +- {A_N_sd}", "force at standstill"});
    visit(Headline{"B", "{B_N_per_km_h} +- {B_N_per_km_h_sd}", "rise with speed"});
    visit(Headline{"C", "{C_N_per_km_h2} +- {C_N_per_km_h2_sd}", "rise with the square of speed"});
  }
};

VehicleProgram plan(const Settings& settings, const RunSpec& spec) {
  VehicleProgram program(settings.conditions, spec.sample_interval_s, 0.0);
  settings.coastdowns.check(spec);
  settings.coastdowns.append_to(program);
  return program;
}

/// When a coastdown falls through a speed, linear between its rows; nothing where it does not.
std::optional<double> find_passing_s(const estimation::CoastdownRun& run, double at_m_s) {
  for (std::size_t i = 1; i < run.speed_m_s.size(); ++i) {
    const double before_m_s = run.speed_m_s[i - 1], after_m_s = run.speed_m_s[i];
    if (before_m_s < at_m_s || after_m_s >= at_m_s) continue;
    const double share = (before_m_s - at_m_s) / (before_m_s - after_m_s);
    return run.time_s[i - 1] + share * (run.time_s[i] - run.time_s[i - 1]);
  }
  return std::nullopt;
}

/// Mean time between two speeds of the coastdowns of a direction; nothing where one of them lacks a speed.
std::optional<double> calc_mean_time_s(const std::vector<estimation::CoastdownRun>& runs, int heading, double high_m_s,
                                       double low_m_s) {
  double sum_s = 0.0;
  int count = 0;
  for (const estimation::CoastdownRun& run : runs) {
    if (run.heading != heading) continue;
    const std::optional<double> from_s = find_passing_s(run, high_m_s), to_s = find_passing_s(run, low_m_s);
    if (!from_s.has_value() || !to_s.has_value()) return std::nullopt;
    sum_s += *to_s - *from_s;
    ++count;
  }
  return sum_s / count;
}

std::vector<SpeedBin> make_bins(const std::vector<estimation::CoastdownRun>& runs, double from_m_s) {
  constexpr double kBin_m_s = 10.0 / 3.6;
  constexpr double kRounding = 1e-9;  // 130 km/h may be 13 bins less its last bits
  std::vector<SpeedBin> bins;
  for (int bin = static_cast<int>(from_m_s / kBin_m_s + kRounding); bin > 0; --bin) {
    const double high_m_s = bin * kBin_m_s, low_m_s = high_m_s - kBin_m_s;
    const std::optional<double> first_s = calc_mean_time_s(runs, +1, high_m_s, low_m_s);
    const std::optional<double> second_s = calc_mean_time_s(runs, -1, high_m_s, low_m_s);
    if (first_s.has_value() && second_s.has_value()) bins.push_back({high_m_s, low_m_s, *first_s, *second_s});
  }
  return bins;
}

Results evaluate(const Settings& settings, const RunSpec& spec, Outcome& outcome) {
  const CoastdownInputs inputs = take_coastdowns(outcome.recording, spec, settings.conditions, settings.coastdowns);
  const estimation::RoadLoadFit fit = estimation::fit_road_load(inputs.data, inputs.options);
  Results results;
  results.load = fit.load;
  results.sd = {fit.sd(0), fit.sd(1), fit.sd(2)};
  for (const double speed_m_s : road_load_speeds_m_s()) results.forces.push_back({speed_m_s, fit.force_N(speed_m_s)});
  for (const sim::PhaseSpan& phase : outcome.recording.phases) {
    if (is_coastdown(phase.name)) results.coastdowns.push_back({phase.name, phase.end_s - phase.start_s});
  }
  results.bins = make_bins(inputs.data.runs, settings.coastdowns.from_m_s);
  constexpr double kShown_m_s = 80.0 / 3.6;
  results.force_at_80_N = fit.force_N(kShown_m_s);
  results.force_at_80_sd_N = fit.force_sd_N(kShown_m_s);
  results.on_road = is_on_road(spec.rig.kind->traits);
  outcome.warnings.insert(outcome.warnings.end(), fit.warnings.begin(), fit.warnings.end());
  constexpr double kLowest_K = kZeroCelsius_K + 5.0;  // SAE J2263: air temperature during a test
  constexpr double kHighest_K = kZeroCelsius_K + 35.0;
  const double ambient_K = *settings.conditions.ambient_K;
  if (ambient_K < kLowest_K || ambient_K > kHighest_K) {
    outcome.warnings.push_back(fmt::format(
        "A and B are corrected from air of {:.4g} degC to 20 degC: SAE J2263 tests at 5 to 35 degC only, and the loss "
        "of a tire in colder or warmer air does not follow its correction",
        ambient_K - kZeroCelsius_K));
  }
  outcome.make_measurement_model = [inputs, fit] {
    return estimation::make_road_load_model(inputs.data, inputs.options, fit);
  };
  return results;
}

Scenario make() {
  Scenario scenario = make_vehicle_scenario(
      {"coastdown", "Coastdowns of a vehicle on the road or on a dynamometer, and A, B, C from them",
       "Warm-up at constant speed, then pairs of coastdowns in both directions in neutral from 130 km/h to standstill. "
       "Slope and wind of the road, where given, turn round with the direction. A, B, C by generalized least squares "
       "on force against speed, at reference conditions (20 degC, 98.21 kPa, still air).",
       "Kolekar and Narasimhan (2024) §3.4.1, §3.4.3, (3.20); SAE J2263"},
      "road", &plan, &evaluate);
  scenario.has_uncertainty = true;
  return scenario;
}

}  // namespace rollrig::scenarios::coastdown
