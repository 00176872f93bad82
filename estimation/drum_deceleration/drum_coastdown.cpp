#include "estimation/drum_deceleration/drum_coastdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "estimation/drum_deceleration/coast_doubts.h"
#include "estimation/drum_deceleration/coast_evaluation.h"
#include "sim/core/error.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

/// Drum coasts of one kind: lifted, loaded, or loaded at one pressure. A resonance may be the rig's, at one speed
/// whatever the tire, or one in which the tire is the spring, whose speed moves with pressure.
struct Kind {
  CoastState state = CoastState::kLifted;
  double pressure_Pa = 0.0;  // 0: any
  bool has(const CoastRun& run) const {
    if (run.state != state) return false;
    return pressure_Pa == 0.0 || is_same_pressure(run.pressure_Pa, pressure_Pa);
  }
};

std::vector<Kind> list_kinds(const CoastSet& set) {
  std::vector<Kind> kinds{{CoastState::kLifted, 0.0}, {CoastState::kLoaded, 0.0}};
  for (const CoastRun& run : set.runs) {
    if (run.state == CoastState::kLifted) continue;
    const bool known = std::any_of(kinds.begin() + 2, kinds.end(), [&run](const Kind& kind) { return kind.has(run); });
    if (!known) kinds.push_back({CoastState::kLoaded, run.pressure_Pa});
  }
  return kinds;
}

std::string describe(const FoundResonance& found) {
  const Resonance& resonance = found.resonance;
  const std::string which = found.state == CoastState::kLifted ? "with the tire lifted"
                            : found.pressure_Pa == 0.0
                                ? "with the tire loaded"
                                : fmt::format("with the tire loaded at {:.0f} kPa", found.pressure_Pa / 1e3);
  return fmt::format(
      "the rig resonates near {:.1f} km/h {}: {:.1f} +- {:.1f} % more deceleration than about it; {:.1f} to {:.1f} "
      "km/h are left out there",
      3.6 * resonance.peak_m_s, which, 100.0 * resonance.excess, 200.0 * resonance.sd, 3.6 * resonance.range.from_m_s,
      3.6 * resonance.range.to_m_s);
}

void find_left_out(const CoastSet& set, DrumCoastdownFit& fit) {
  for (CoastAnalysis& analysis : fit.analyses) {
    if (!set.leave_out_m_s.empty()) analysis.left_out.push_back({set.leave_out_m_s[0], set.leave_out_m_s[1]});
  }
  if (!set.find_resonance) return;
  for (const Kind& kind : list_kinds(set)) {
    std::vector<Coast> coasts;
    std::vector<SpeedRange> known;
    for (const CoastAnalysis& analysis : fit.analyses) {
      if (analysis.body != CoastBody::kDrum || !kind.has(set.runs[analysis.run])) continue;
      coasts.push_back(analysis.coast);
      known = analysis.left_out;
    }
    for (const Resonance& resonance : find_resonances(coasts)) {
      if (is_left_out(known, resonance.peak_m_s)) continue;
      fit.resonances.push_back({kind.state, kind.pressure_Pa, resonance});
      fit.warnings.push_back(describe(fit.resonances.back()));
      for (CoastAnalysis& analysis : fit.analyses) {
        if (kind.has(set.runs[analysis.run])) analysis.left_out.push_back(resonance.range);
      }
    }
  }
}

void fit_decelerations(const CoastSet& set, DrumCoastdownFit& fit) {
  for (CoastAnalysis& analysis : fit.analyses) {
    for (const double speed_m_s : set.speeds_m_s) {
      analysis.decelerations.push_back(
          fit_deceleration(analysis.coast, speed_m_s, set.half_band_m_s, analysis.left_out));
    }
  }
}

/// Speeds at which a run gives no deceleration though it passes them.
void warn_of_failed_fits(const CoastSet& set, DrumCoastdownFit& fit) {
  for (const CoastAnalysis& analysis : fit.analyses) {
    for (std::size_t i = 0; i < analysis.decelerations.size(); ++i) {
      const DecelerationFit& at = analysis.decelerations[i];
      const double speed_m_s = set.speeds_m_s[i];
      const bool passes = !analysis.coast.smooth_m_s.empty() && analysis.coast.smooth_m_s.front() > speed_m_s &&
                          analysis.coast.smooth_m_s.back() < speed_m_s;
      if (at.available || !passes) continue;
      fit.warnings.push_back(
          fmt::format("{}: no deceleration at {:.1f} km/h: {}", set.runs[analysis.run].id, 3.6 * speed_m_s, at.why));
    }
  }
}

void mark_left_out(const CoastSet& set, DrumCoastdownFit& fit) {
  for (const CoastAnalysis& analysis : fit.analyses) {
    const CoastRun& run = set.runs[analysis.run];
    for (SpeedPoint& point : fit.points) {
      if (!is_left_out(analysis.left_out, point.speed_m_s)) continue;
      for (PressureLevel& level : point.levels) {
        const Kind kind{CoastState::kLoaded, level.pressure_Pa};
        if (run.state == CoastState::kLifted || kind.has(run)) level.in_range_left_out = true;
      }
    }
  }
}

void warn_of_runs(const CoastSet& set, DrumCoastdownFit& fit) {
  constexpr double kRise_m_s = 0.3;
  for (const CoastAnalysis& analysis : fit.analyses) {
    if (analysis.coast.rise_m_s < kRise_m_s) continue;
    fit.warnings.push_back(fmt::format("{}: the {}'s speed rises again by {:.1f} km/h after the coast began",
                                       set.runs[analysis.run].id, analysis.body == CoastBody::kDrum ? "drum" : "wheel",
                                       3.6 * analysis.coast.rise_m_s));
  }
}

void warn_of_method(const CoastSet& set, const Tables& tables, DrumCoastdownFit& fit) {
  if (!set.calc_drum_mass_kg().has_value()) {
    fit.warnings.push_back("no inertia of the drum is given: net decelerations and ratios, no forces");
  }
  if (!set.is_mass_ratio_known()) {
    fit.warnings.push_back(
        "the wheel's share of the inertia is not given: its own bearing and air losses stay in the tire's");
  }
  if (tables.drum_alone.runs.size() < 2) {
    fit.warnings.push_back("one lifted run: the scatter from run to run is not known, intervals are too narrow");
  }
  const bool repeated = std::any_of(tables.levels.rows.begin(), tables.levels.rows.end(),
                                    [](const std::vector<Eigen::Index>& rows) { return rows.size() > 1; });
  if (!repeated) {
    fit.warnings.push_back(
        "no pressure was run twice: the scatter from run to run is not known, intervals are too narrow");
  }
  for (const SpeedPoint& point : fit.points) {
    if (point.levels.empty()) {
      fit.warnings.push_back(
          fmt::format("{:.1f} km/h: loaded and lifted runs do not both pass", 3.6 * point.speed_m_s));
    }
    if (point.is_exponent_by_law && point.lack_of_fit_p.has_value()) {
      fit.warnings.push_back(fmt::format(
          "{:.1f} km/h: pressures scatter about a power law by {:.1f} %, runs at one pressure "
          "by {:.1f} %: the law is not exact (p = {:.2g}); the exponent's interval holds that",
          3.6 * point.speed_m_s, 100.0 * *point.level_scatter, 100.0 * point.repeat_scatter, *point.lack_of_fit_p));
    }
  }
}

/// What is found to be impossible is an error, unless a run is in doubt, which may be why.
void refuse_units(const CoastSet& set, const std::string& what, const std::string& key, const std::string& allowed,
                  DrumCoastdownFit& fit) {
  if (fit.doubts.empty()) throw InputError({what, set.path, 0, key, "", allowed, ""});
  fit.warnings.push_back(what);
}

/// The unit in which a deceleration would be that of a drum; empty for none.
std::string guess_drum_time_unit(double deceleration_m_s2) {
  struct TimeUnit {
    double length_s;
    const char* name;
  };
  constexpr double kLeast_m_s2 = 1e-3, kMost_m_s2 = 0.1;  // Assumed: usual of drums alone at 20 to 110 km/h
  for (const TimeUnit& unit : {TimeUnit{60.0, "min"}, TimeUnit{3600.0, "h"}, TimeUnit{1e-3, "ms"}}) {
    const double in_s_m_s2 = deceleration_m_s2 / unit.length_s;
    if (in_s_m_s2 >= kLeast_m_s2 && in_s_m_s2 <= kMost_m_s2)
      return fmt::format(" It would be usual with times in {}.", unit.name);
  }
  return "";
}

/// Refuses a drum alone that slows down as none does: the times are in another unit.
void require_drum_deceleration(const CoastSet& set, DrumCoastdownFit& fit) {
  constexpr double kLeast_m_s2 = 1e-4, kMost_m_s2 = 0.3;  // Assumed: far from those of drums
  const SpeedPoint& point = fit.points[find_reference_speed(set)];
  if (!point.drum_alone_m_s2.has_value()) return;
  const double found_m_s2 = point.drum_alone_m_s2->value;
  if (found_m_s2 > kLeast_m_s2 && found_m_s2 < kMost_m_s2) return;
  refuse_units(
      set,
      fmt::format("the drum alone slows down by {:.3g} m/s2 at {:.0f} km/h, as no drum does: are the times in s "
                  "and the speeds in km/h?{}",
                  found_m_s2, 3.6 * point.speed_m_s, guess_drum_time_unit(found_m_s2)),
      "time_s", fmt::format("a deceleration of {:g} to {:g} m/s2", kLeast_m_s2, kMost_m_s2), fit);
}

/// Least and most of the rolling radii that are not doubted.
struct UsualRadius {
  double least_m = 0.0, most_m = 0.0;
};

/// By the load, where it is that of trucks, else by the mass that the wheel has at the radius. 0, or infinity, where
/// they are not known.
UsualRadius find_usual_radius(double load_N, double wheel_kg) {
  constexpr double kTruckLoad_N = 12e3;  // Assumed: more than of any tire of cars and vans
  constexpr double kTruckWheel_kg = 20.0;  // Assumed: truck wheels have some 30 kg at the radius, those of cars 6 to 20
  constexpr UsualRadius kOfTrucks{0.33, 0.6};     // Assumed: truck tires have 0.37 to 0.55
  constexpr UsualRadius kOfHeavyWheel{0.25, 0.6};  // Assumed: a small wheel is light
  constexpr UsualRadius kOfLightWheel{0.2, 0.45};  // Assumed: from a trailer's and a scooter's to a large car's
  if (load_N > kTruckLoad_N) return kOfTrucks;
  if (std::isinf(wheel_kg)) return {kOfLightWheel.least_m, kOfTrucks.most_m};
  return wheel_kg >= kTruckWheel_kg ? kOfHeavyWheel : kOfLightWheel;
}

/// Doubts a rolling radius that looks like a diameter, or like half a radius.
void doubt_rolling_radius(const CoastSet& set, DrumCoastdownFit& fit) {
  if (!set.wheel_rolling_radius_m.has_value()) return;
  const double radius_m = *set.wheel_rolling_radius_m;
  const double wheel_kg =
      set.wheel_inertia_kg_m2.value_or(std::numeric_limits<double>::infinity()) / (radius_m * radius_m);
  double load_N = 0.0;
  for (const CoastRun& run : set.runs) load_N = std::max(load_N, run.load_N);
  const UsualRadius usual = find_usual_radius(load_N, wheel_kg);
  if (radius_m >= usual.least_m && radius_m <= usual.most_m) return;
  const std::string why = radius_m > usual.most_m
                              ? fmt::format("Is it the diameter? Half of it is {:g} m", 0.5 * radius_m)
                              : fmt::format("Is it that of the rim, or half of the radius? Twice it is {:g} m",
                                            2.0 * radius_m);
  fit.warnings.push_back(
      fmt::format("rolling_radius_m of [wheel] is {:g} m{}; tires of cars have 0.25 to 0.4 m, of trucks up to 0.55 m "
                  "(Assumed). {}",
                  radius_m, load_N > 0.0 ? fmt::format(", at a load of {:g} N", load_N) : "", why));
}

/// Refuses inertias that no drum and wheel have together, doubts those of an unusual wheel.
void doubt_inertias(const CoastSet& set, DrumCoastdownFit& fit) {
  constexpr double kMostMassRatio = 0.5;                        // Assumed: wheels have 0.01 to 0.1 of the drum's mass
  constexpr double kLeastWheel_kg = 1.5, kMostWheel_kg = 70.0;  // Assumed: from a bicycle's to a truck's, at its radius
  if (fit.mass_ratio > kMostMassRatio) {
    refuse_units(
        set,
        fmt::format("tire and wheel would have {:.3g} times the mass of the drum, both at the surface: are inertias, "
                    "diameter and radius in kg m2 and m?",
                    fit.mass_ratio),
        "[drum], [wheel]", "a drum that is much heavier than the wheel", fit);
  }
  doubt_rolling_radius(set, fit);
  if (!set.wheel_inertia_kg_m2.has_value() || !set.wheel_rolling_radius_m.has_value()) return;
  const double wheel_kg = *set.wheel_inertia_kg_m2 / std::pow(*set.wheel_rolling_radius_m, 2);
  if (wheel_kg >= kLeastWheel_kg && wheel_kg <= kMostWheel_kg) return;
  fit.warnings.push_back(fmt::format(
      "tire and wheel have the inertia of {:.3g} kg at their rolling radius; those of cars have 6 to 20 kg, "
      "of trucks up to 60 kg: are inertia_kg_m2 and rolling_radius_m of [wheel] right?",
      wheel_kg));
}

/// Of one pressure: refuses a force that is that of no tire, doubts an unusual one.
void doubt_level_force(const CoastSet& set, const PressureLevel& level, DrumCoastdownFit& fit) {
  constexpr double kLeast = 1.5e-3;      // Assumed: of the load; the best tires have 4 N/kN, of bicycles 2
  constexpr double kMost = 40e-3;        // Assumed: of a cold tire at low pressure
  constexpr double kLeastForce_N = 1.0;  // Assumed: a bicycle tire has 2 N
  constexpr double kLeastUsual_N = 10.0, kMostUsual_N = 150.0;  // Assumed: car tires have 20 to 100 N
  constexpr double kMostForce_N = 500.0;                        // Assumed: a truck tire has 250 N at most
  const double force_N = level.force_N->value;
  const double kPa = 1e-3 * level.pressure_Pa;
  const bool is_known = level.load_N > 0.0;
  const bool is_of_tire =
      is_known ? force_N > kLeast * level.load_N && force_N < kMost * level.load_N : force_N > kLeastForce_N;
  if (!is_of_tire) {
    refuse_units(
        set,
        fmt::format("the rolling resistance is that of no tire: {:.3g} N{} at {:.0f} kPa. Are inertias, diameter "
                    "and load in kg m2, m and N, and times in s?",
                    force_N, is_known ? fmt::format(", {:.3g} N/kN of the load,", 1e3 * force_N / level.load_N) : "",
                    kPa),
        is_known ? "load_N" : "[drum] inertia_kg_m2",
        is_known ? fmt::format("{:g} to {:g} N/kN of the load", 1e3 * kLeast, 1e3 * kMost)
                 : fmt::format("more than {:g} N", kLeastForce_N),
        fit);
  } else if (force_N > kMostForce_N) {
    fit.warnings.push_back(
        fmt::format("the rolling resistance at {:.0f} kPa is {:.4g} N, more than that of a truck "
                    "tire: are the units of inertia and diameter right?",
                    kPa, force_N));
  } else if (!is_known && (force_N < kLeastUsual_N || force_N > kMostUsual_N)) {
    fit.warnings.push_back(fmt::format(
        "the rolling resistance at {:.0f} kPa is {:.3g} N; car tires have about 20 to 100 N: are inertia and "
        "diameter of [drum] right (not the radius for the diameter)? load_N would tell",
        kPa, force_N));
  }
}

/// Throws InputError where decelerations, forces or inertias are those of no tire on a drum, unless a run is in doubt.
/// Doubts those that are unusual.
void doubt_units(const CoastSet& set, DrumCoastdownFit& fit) {
  constexpr double kLeastPressure_Pa = 100e3;  // Assumed: of a road tire
  require_drum_deceleration(set, fit);
  doubt_inertias(set, fit);
  const SpeedPoint& point = fit.points[find_reference_speed(set)];
  double highest_Pa = 0.0;
  bool is_load_missing = false;
  for (const PressureLevel& level : point.levels) {
    highest_Pa = std::max(highest_Pa, level.pressure_Pa);
    if (!level.force_N.has_value()) continue;
    is_load_missing = is_load_missing || level.load_N <= 0.0;
    doubt_level_force(set, level, fit);
  }
  if (is_load_missing) {
    fit.warnings.push_back("no load_N in the runs: whether the force is that of the tire cannot be judged by its load");
  }
  if (highest_Pa > 0.0 && highest_Pa < kLeastPressure_Pa) {
    fit.warnings.push_back(fmt::format(
        "the highest pressure is {:.0f} kPa, which is low for a road tire: is it in psi?", 1e-3 * highest_Pa));
  }
  if (point.exponent_by_repeats.has_value() && point.exponent_by_repeats->lower > 0.0) {
    fit.warnings.push_back(fmt::format(
        "the exponent of pressure is {:+.3g}: rolling resistance would rise with pressure, which no tire does "
        "on a hard surface. Are the pressures of the runs exchanged?",
        point.exponent_by_repeats->value));
  }
}

/// Runs of one kind: their highest and lowest speeds.
struct KindOfRuns {
  const char* name;
  CoastState state;
  CoastBody body;
  std::size_t runs = 0;
  double high_m_s = 0.0, low_m_s = std::numeric_limits<double>::infinity();
  bool passes_any = false;  // a speed that is asked for
};

std::vector<KindOfRuns> list_kinds_of_runs(const CoastSet& set, const DrumCoastdownFit& fit) {
  std::vector<KindOfRuns> kinds{{"loaded", CoastState::kLoaded, CoastBody::kDrum},
                                {"lifted", CoastState::kLifted, CoastBody::kDrum},
                                {"lifted wheel", CoastState::kLifted, CoastBody::kWheel}};
  for (KindOfRuns& kind : kinds) {
    for (const CoastAnalysis& analysis : fit.analyses) {
      const std::vector<double>& speeds_m_s = analysis.coast.smooth_m_s;
      if (analysis.body != kind.body || set.runs[analysis.run].state != kind.state || speeds_m_s.empty()) continue;
      ++kind.runs;
      kind.high_m_s = std::max(kind.high_m_s, speeds_m_s.front());
      kind.low_m_s = std::min(kind.low_m_s, speeds_m_s.back());
    }
    kind.passes_any = std::any_of(set.speeds_m_s.begin(), set.speeds_m_s.end(), [&kind](double asked_m_s) {
      return asked_m_s < kind.high_m_s && asked_m_s > kind.low_m_s;
    });
  }
  return kinds;
}

/// Whether speeds of a kind would reach those asked for if they were in m/s, as high as those of kinds that do.
bool looks_like_m_s(const KindOfRuns& kind, const std::vector<KindOfRuns>& kinds, double lowest_m_s) {
  constexpr double kMostOff = 0.3;  // Assumed: of the highest speeds of two kinds of runs
  const double high_m_s = kKmhPerMs * kind.high_m_s;
  if (kind.high_m_s >= lowest_m_s || high_m_s <= lowest_m_s) return false;
  double others_m_s = 0.0;
  for (const KindOfRuns& other : kinds) {
    if (other.passes_any) others_m_s = std::max(others_m_s, other.high_m_s);
  }
  return others_m_s <= 0.0 || std::abs(high_m_s / others_m_s - 1.0) < kMostOff;
}

/// The runs of a kind that pass none of the speeds that are asked for, and whether they look like m/s; empty for none.
std::string explain_missed_speeds(const CoastSet& set, const DrumCoastdownFit& fit) {
  const auto [lowest, highest] = std::minmax_element(set.speeds_m_s.begin(), set.speeds_m_s.end());
  std::string text;
  const std::vector<KindOfRuns> kinds = list_kinds_of_runs(set, fit);
  for (const KindOfRuns& kind : kinds) {
    const bool is_needed = kind.body == CoastBody::kDrum || fit.mass_ratio > 0.0;
    if (!is_needed || kind.runs == 0 || kind.passes_any) continue;
    text += fmt::format(". The speeds of the {} run{} are {:.1f} to {:.1f} km/h, those asked for {:g} to {:g} km/h",
                        kind.name, kind.runs == 1 ? "" : "s", kKmhPerMs * kind.high_m_s, kKmhPerMs * kind.low_m_s,
                        kKmhPerMs * *lowest, kKmhPerMs * *highest);
    if (!looks_like_m_s(kind, kinds, *lowest)) continue;
    text += fmt::format(": is their speed_km_h in m/s? It would be up to {:.1f} km/h",
                        kKmhPerMs * kKmhPerMs * kind.high_m_s);
  }
  return text.empty() ? "" : text + ". Else: speeds_km_h of [analysis]";
}

/// Why no speed gives a result: what is doubted, and what the fits of single runs say.
std::string explain_no_speed(const CoastSet& set, const DrumCoastdownFit& fit) {
  const std::string text = "at none of the speeds asked for do loaded and lifted runs both pass";
  if (!fit.doubts.empty()) return text + ". In doubt: " + fit.doubts.front().text;
  if (const std::string missed = explain_missed_speeds(set, fit); !missed.empty()) return text + missed;
  for (const CoastAnalysis& analysis : fit.analyses) {
    if (analysis.decelerations.empty()) continue;
    const DecelerationFit& at = analysis.decelerations[analysis.decelerations.size() / 2];
    if (!at.available) return text + fmt::format(". Of {}: {}", set.runs[analysis.run].id, at.why);
  }
  return text;
}

/// Results at every speed from the decelerations of the runs.
void evaluate_runs(const CoastSet& set, DrumCoastdownFit& fit) {
  const Tables tables = make_tables(set, fit);
  for (std::size_t i = 0; i < set.speeds_m_s.size(); ++i) fit.points.push_back(evaluate_speed(set, tables, fit, i));
  if (std::all_of(fit.points.begin(), fit.points.end(), [](const SpeedPoint& point) { return point.levels.empty(); })) {
    throw RunFailure(explain_no_speed(set, fit));
  }
  add_ratios(set, tables, fit);
  mark_left_out(set, fit);
}

/// The same from the runs that are not in doubt; none where they give no result.
std::shared_ptr<const DrumCoastdownFit> evaluate_others(const CoastSet& set, const DrumCoastdownFit& fit,
                                                        const std::set<std::size_t>& set_aside) {
  const auto others = std::make_shared<DrumCoastdownFit>();
  others->mass_ratio = fit.mass_ratio;
  others->directions = fit.directions;
  for (const CoastAnalysis& analysis : fit.analyses) {
    if (set_aside.count(analysis.run) == 0) others->analyses.push_back(analysis);
  }
  try {
    evaluate_runs(set, *others);
  } catch (const RunFailure&) {
    return nullptr;
  }
  return others;
}

}  // namespace

std::vector<CoastAnalysis> find_coasts(const CoastSet& set) {
  std::vector<CoastAnalysis> analyses;
  for (std::size_t i = 0; i < set.runs.size(); ++i) {
    const CoastRun& run = set.runs[i];
    if (run.drum.has_value()) {
      analyses.push_back({i, CoastBody::kDrum, find_coast(*run.drum, set.drum_pulse_length_m, run), {}, {}});
    }
    if (run.wheel.has_value()) {
      analyses.push_back({i, CoastBody::kWheel, find_coast(*run.wheel, set.wheel_pulse_length_m, run), {}, {}});
    }
  }
  return analyses;
}

DrumCoastdownFit fit_drum_coastdown(const CoastSet& set) {
  DrumCoastdownFit fit;
  fit.mass_ratio = set.calc_mass_ratio();
  fit.analyses = find_coasts(set);
  fit.doubts = leave_out_repeated_coasts(set, fit.analyses);
  warn_of_runs(set, fit);
  find_left_out(set, fit);
  fit_decelerations(set, fit);
  std::set<std::string> directions;
  for (const CoastRun& run : set.runs) {
    if (run.state == CoastState::kLoaded && !run.direction.empty()) directions.insert(run.direction);
  }
  fit.directions.assign(directions.begin(), directions.end());
  const CoastDoubts checked = check_coasts(set, fit.analyses);
  fit.doubts.insert(fit.doubts.end(), checked.doubts.begin(), checked.doubts.end());
  evaluate_runs(set, fit);
  doubt_units(set, fit);
  if (!checked.set_aside.empty()) fit.others = evaluate_others(set, fit, checked.set_aside);
  warn_of_failed_fits(set, fit);
  warn_of_method(set, make_tables(set, fit), fit);
  std::vector<std::string> doubts;
  for (const RunDoubt& doubt : fit.doubts) doubts.push_back(doubt.text);
  fit.warnings.insert(fit.warnings.begin(), doubts.begin(), doubts.end());
  return fit;
}

}  // namespace rollrig::estimation
