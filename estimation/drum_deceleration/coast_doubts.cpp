#include "estimation/drum_deceleration/coast_doubts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "estimation/drum_deceleration/coast_curves.h"
#include "estimation/drum_deceleration/odd_coasts.h"
#include "estimation/run_checks/odd_runs.h"
#include "estimation/run_checks/robust_statistics.h"

namespace rollrig::estimation {
namespace {

std::vector<const CoastCurve*> select_state(const CoastSet& set, const std::vector<CoastCurve>& curves,
                                            CoastState state, const std::set<std::size_t>& without) {
  std::vector<const CoastCurve*> selected;
  for (const CoastCurve& curve : curves) {
    if (set.runs[curve.run].state == state && without.count(curve.run) == 0) selected.push_back(&curve);
  }
  return selected;
}

/// Time that the wheel coasts over that of the drum; none where the wheel was not recorded.
std::optional<double> find_wheel_share(const std::vector<CoastAnalysis>& analyses, std::size_t run) {
  double drum_s = 0.0, wheel_s = 0.0;
  for (const CoastAnalysis& analysis : analyses) {
    if (analysis.run != run) continue;
    (analysis.body == CoastBody::kDrum ? drum_s : wheel_s) = analysis.coast.time_s.back() - analysis.coast.start_s;
  }
  if (drum_s <= 0.0 || wheel_s <= 0.0) return std::nullopt;
  return wheel_s / drum_s;
}

/// A tire on the drum turns as long as the drum does; a lifted wheel comes to rest by itself.
bool does_wheel_object(const std::vector<CoastAnalysis>& analyses, std::size_t run, CoastState true_state) {
  constexpr double kFree = 0.5, kCoupled = 0.9;
  const std::optional<double> share = find_wheel_share(analyses, run);
  if (!share.has_value()) return false;
  return true_state == CoastState::kLoaded ? *share < kFree : *share > kCoupled;
}

const char* call_state(CoastState state) { return state == CoastState::kLoaded ? "loaded" : "lifted"; }

/// A run whose deceleration is that of the other state.
std::optional<RunDoubt> check_state(const CoastSet& set, const std::vector<CoastCurve>& curves, const CoastCurve& curve,
                                    const std::vector<CoastAnalysis>& analyses) {
  constexpr double kLeastSeparation = 0.2;  // of ln(deceleration) between the states
  constexpr double kNearer = 0.5;
  constexpr double kLeastOff = 0.15;
  const CoastRun& run = set.runs[curve.run];
  const CoastState other = run.state == CoastState::kLoaded ? CoastState::kLifted : CoastState::kLoaded;
  const auto own_runs = select_state(set, curves, run.state, {curve.run});
  const auto other_runs = select_state(set, curves, other, {});
  if (own_runs.empty() || other_runs.empty()) return std::nullopt;
  const CoastCurve own = calc_median_curve(own_runs);
  const CoastCurve opposite = calc_median_curve(other_runs);
  const double from_own = compare_curves(curve, own).log;
  const double from_other = compare_curves(curve, opposite).log;
  const double separation = compare_curves(opposite, own).log;
  const bool apart = (run.state == CoastState::kLoaded ? -separation : separation) > kLeastSeparation;
  const bool nearer = std::abs(from_other) < kNearer * std::abs(from_own);
  if (!apart || !nearer || std::abs(from_own) < kLeastOff) return std::nullopt;
  if (does_wheel_object(analyses, curve.run, other)) return std::nullopt;
  RunDoubt doubt{DoubtKind::kState, {run.id}, std::string("it is ") + call_state(other), std::expm1(from_own), ""};
  doubt.text = fmt::format(
      "{} is said to be {}, but its deceleration is that of the {} runs ({:+.0f} %) and not that of the other {} ones "
      "({:+.0f} %): is its state '{}'?",
      run.id, call_state(run.state), call_state(other), 100.0 * std::expm1(from_other), call_state(run.state),
      100.0 * std::expm1(from_own), call_state(other));
  return doubt;
}

/// Loads that differ at one pressure.
void check_loads(const CoastSet& set, CoastDoubts& checked) {
  std::map<long, std::vector<const CoastRun*>> by_pressure;
  std::vector<double> pressures_Pa;
  for (const CoastRun& run : set.runs) {
    if (run.state != CoastState::kLoaded) continue;
    auto known = std::find_if(pressures_Pa.begin(), pressures_Pa.end(),
                              [&run](double level_Pa) { return is_same_pressure(run.pressure_Pa, level_Pa); });
    if (known == pressures_Pa.end()) known = pressures_Pa.insert(known, run.pressure_Pa);
    by_pressure[known - pressures_Pa.begin()].push_back(&run);
  }
  for (const auto& [level, runs] : by_pressure) {
    const double first_N = runs.front()->load_N;
    const bool differ =
        std::any_of(runs.begin(), runs.end(), [&](const CoastRun* run) { return !is_same_load(run->load_N, first_N); });
    if (!differ) continue;
    RunDoubt doubt{DoubtKind::kLoad, {}, "different loads", 0.0, ""};
    std::string loads;
    for (const CoastRun* run : runs) {
      doubt.runs.push_back(run->id);
      loads += fmt::format("{}{:g} N in {}", loads.empty() ? "" : ", ", run->load_N, run->id);
    }
    doubt.text = fmt::format(
        "the loads at {:.0f} kPa differ ({}): runs at another load are no repeats, they have results "
        "of their own",
        runs.front()->pressure_Pa / 1e3, loads);
    checked.doubts.push_back(doubt);
  }
}

/// Mean deceleration from a speed to a lower one; the coast passes both.
double calc_mean_deceleration(const Coast& coast, double high_m_s, double low_m_s) {
  const auto find = [&coast](double speed_m_s) {
    const auto at = std::find_if(coast.smooth_m_s.begin(), coast.smooth_m_s.end(),
                                 [speed_m_s](double smooth_m_s) { return smooth_m_s <= speed_m_s; });
    return static_cast<std::size_t>(at - coast.smooth_m_s.begin());
  };
  const std::size_t first = find(high_m_s), last = std::min(find(low_m_s), coast.time_s.size() - 1);
  return (coast.smooth_m_s[first] - coast.smooth_m_s[last]) / (coast.time_s[last] - coast.time_s[first]);
}

/// Mean decelerations of the runs of the lifted wheel over the speeds that all of them pass; empty where none are.
std::map<std::size_t, double> find_wheel_decelerations(const CoastSet& set, const std::vector<CoastAnalysis>& analyses,
                                                       const std::set<std::size_t>& without) {
  constexpr double kLeastFall_m_s = 2.0;  // Assumed
  std::vector<const CoastAnalysis*> wheels;
  double high_m_s = 1e9, low_m_s = 0.0;
  for (const CoastAnalysis& analysis : analyses) {
    const bool is_lifted = set.runs[analysis.run].state == CoastState::kLifted && without.count(analysis.run) == 0;
    if (analysis.body != CoastBody::kWheel || !is_lifted || analysis.coast.smooth_m_s.size() < 2) continue;
    wheels.push_back(&analysis);
    high_m_s = std::min(high_m_s, analysis.coast.smooth_m_s.front());
    low_m_s = std::max(low_m_s, analysis.coast.smooth_m_s.back());
  }
  std::map<std::size_t, double> decelerations;
  if (high_m_s - low_m_s < kLeastFall_m_s) return decelerations;
  for (const CoastAnalysis* wheel : wheels) {
    const double found = calc_mean_deceleration(wheel->coast, high_m_s, low_m_s);
    if (found > 0.0) decelerations[wheel->run] = found;
  }
  return decelerations;
}

constexpr std::size_t kFewestWheels = 3;  // of which one is the odd one

/// The run of the lifted wheel that slows down otherwise than the others, or the second of two; relative: of the
/// logarithm.
std::optional<OddRun> find_odd_wheel(const std::map<std::size_t, double>& decelerations) {
  constexpr double kAnySpeed_m_s = 1.0;  // a mean over speeds has none
  ScatterPrior prior;
  prior.run_sd = 0.03;  // Assumed: more than of drums, as the bearings of a wheel warm up
  prior.fewest = 1;
  std::vector<RunDeviation> deviations;
  if (decelerations.size() < kFewestWheels) {
    prior.run_sd *= std::sqrt(2.0);  // of a difference
    const double log = std::log(decelerations.rbegin()->second / decelerations.begin()->second);
    deviations.push_back({decelerations.rbegin()->first, 0, {kAnySpeed_m_s}, {log}});
    return find_odd_run(deviations, prior);
  }
  for (const auto& [index, deceleration] : decelerations) {
    std::vector<double> others;
    for (const auto& [other, value] : decelerations) {
      if (other != index) others.push_back(value);
    }
    deviations.push_back({index, 0, {kAnySpeed_m_s}, {std::log(deceleration / calc_median(others))}});
  }
  return find_odd_run(deviations, prior);
}

/// `first`: the other run, of two.
RunDoubt describe_odd_wheel(const CoastRun& run, double ratio, const CoastRun* first) {
  constexpr double kMostFactor = 2.0;  // Assumed: friction of cold bearings is less than twice that of warm ones
  const bool is_other_body = ratio > kMostFactor || ratio < 1.0 / kMostFactor;
  RunDoubt doubt{DoubtKind::kOdd, {run.id}, is_other_body ? "another body" : "", ratio - 1.0, ""};
  const char* why = is_other_body ? "is its body 'wheel', and was it free?"
                                  : "was it free, and were its bearings as warm?";
  if (first == nullptr) {
    doubt.text = fmt::format(
        "{}: the wheel slows down {:.3g} times as fast as in the other runs of the lifted wheel: {}", run.id, ratio,
        why);
    return doubt;
  }
  doubt.runs.insert(doubt.runs.begin(), first->id);
  doubt.text = fmt::format(
      "{} and {} should repeat each other, but the lifted wheel slows down {:.3g} times as fast in the second. Nothing "
      "tells which one is wrong; the results have the mean of both, with a wide interval. Of each: {}",
      first->id, run.id, ratio, why);
  return doubt;
}

/// Runs of the lifted wheel that slow down otherwise than the others of it.
void check_lifted_wheels(const CoastSet& set, const std::vector<CoastAnalysis>& analyses, CoastDoubts& checked) {
  std::map<std::size_t, double> decelerations = find_wheel_decelerations(set, analyses, checked.set_aside);
  const std::size_t most = decelerations.size() / 2;
  for (std::size_t found = 0; found < most && decelerations.size() > 1; ++found) {
    const std::optional<OddRun> odd = find_odd_wheel(decelerations);
    if (!odd.has_value()) return;
    const bool is_pair = decelerations.size() < kFewestWheels;
    checked.doubts.push_back(describe_odd_wheel(set.runs[odd->run], std::exp(odd->relative),
                                                is_pair ? &set.runs[decelerations.begin()->first] : nullptr));
    if (is_pair) return;
    if (!set.runs[odd->run].drum.has_value()) checked.set_aside.insert(odd->run);
    decelerations.erase(odd->run);
  }
}

}  // namespace

CoastDoubts check_coasts(const CoastSet& set, const std::vector<CoastAnalysis>& analyses) {
  CoastDoubts checked;
  const std::vector<CoastCurve> curves = make_coast_curves(analyses);
  for (const CoastCurve& curve : curves) {
    if (const auto doubt = check_state(set, curves, curve, analyses)) {
      checked.doubts.push_back(*doubt);
      checked.set_aside.insert(curve.run);
    }
  }
  check_loads(set, checked);
  check_lifted_wheels(set, analyses, checked);
  add_odd_coasts(set, curves, checked);
  return checked;
}

}  // namespace rollrig::estimation
