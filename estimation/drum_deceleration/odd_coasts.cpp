#include "estimation/drum_deceleration/odd_coasts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "estimation/run_checks/odd_runs.h"
#include "estimation/run_checks/robust_statistics.h"

namespace rollrig::estimation {
namespace {

/// Loaded runs that should repeat each other.
struct RepeatGroup {
  double pressure_Pa = 0.0;
  double load_N = 0.0;
  std::vector<const CoastCurve*> runs;
};

/// Runs that are not set aside, by kind.
struct SortedCoasts {
  std::vector<const CoastCurve*> lifted;
  std::vector<RepeatGroup> groups;
  CoastCurve drum_alone;
};

SortedCoasts sort_coasts(const CoastSet& set, const std::vector<CoastCurve>& curves,
                         const std::set<std::size_t>& without) {
  SortedCoasts sorted;
  for (const CoastCurve& curve : curves) {
    const CoastRun& run = set.runs[curve.run];
    if (without.count(curve.run) != 0) continue;
    if (run.state == CoastState::kLifted) {
      sorted.lifted.push_back(&curve);
      continue;
    }
    auto group = std::find_if(sorted.groups.begin(), sorted.groups.end(), [&run](const RepeatGroup& known) {
      return is_same_pressure(run.pressure_Pa, known.pressure_Pa) && is_same_load(run.load_N, known.load_N);
    });
    if (group == sorted.groups.end()) group = sorted.groups.insert(group, {run.pressure_Pa, run.load_N, {}});
    group->runs.push_back(&curve);
  }
  sorted.drum_alone = calc_median_curve(sorted.lifted);
  return sorted;
}

CoastCurve calc_median_of_others(const std::vector<const CoastCurve*>& runs, const CoastCurve* run) {
  std::vector<const CoastCurve*> others;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(others), [run](const CoastCurve* at) { return at != run; });
  return calc_median_curve(others);
}

/// What a curve exceeds a reference by, over the reference's own excess over a base (0 where there is none), from high
/// speed to low.
RunDeviation calc_deviation(const CoastCurve& curve, const CoastCurve& reference, const CoastCurve* base) {
  RunDeviation deviation;
  deviation.run = curve.run;
  for (std::size_t bin = curve.value_m_s2.size(); bin-- > 0;) {
    const double net = reference.at(bin) - (base == nullptr ? 0.0 : base->at(bin));
    const double relative = (curve.at(bin) - reference.at(bin)) / net;
    if (!std::isfinite(relative) || net <= 0.0) continue;
    deviation.speed_m_s.push_back(curve_speed_m_s(bin));
    deviation.relative.push_back(relative);
  }
  return deviation;
}

std::vector<RunDeviation> compare_with_others(const std::vector<const CoastCurve*>& runs, const CoastCurve* base) {
  std::vector<RunDeviation> deviations;
  for (const CoastCurve* run : runs) {
    deviations.push_back(calc_deviation(*run, calc_median_of_others(runs, run), base));
  }
  return deviations;
}

/// Net deceleration at a pressure by the groups at other pressures and the same load: a power law, bin by bin.
CoastCurve predict_net(const SortedCoasts& sorted, const RepeatGroup& wanted) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CoastCurve predicted;
  for (std::size_t bin = 0; bin < sorted.drum_alone.value_m_s2.size(); ++bin) {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const RepeatGroup& group : sorted.groups) {
      if (&group == &wanted || !is_same_load(group.load_N, wanted.load_N)) continue;
      const double net = calc_median_curve(group.runs).at(bin) - sorted.drum_alone.at(bin);
      if (!(net > 0.0)) continue;
      const double at = std::log(group.pressure_Pa / wanted.pressure_Pa);
      n += 1.0;
      x += at;
      y += std::log(net);
      xx += at * at;
      xy += at * std::log(net);
    }
    const double spread = xx - (n > 0.0 ? x * x / n : 0.0);
    const double slope = n > 1.5 && spread > 0.0 ? (xy - x * y / n) / spread : kNone;
    predicted.value_m_s2.push_back(std::exp((y - slope * x) / n));
  }
  return predicted;
}

/// Mean over a stretch of speeds of what a curve's net deceleration is above a prediction, relative.
std::optional<double> calc_off(const CoastCurve& curve, const CoastCurve& drum_alone, const CoastCurve& predicted_net,
                               double high_m_s, double low_m_s) {
  double sum = 0.0, bins = 0.0;
  for (std::size_t bin = 0; bin < curve.value_m_s2.size(); ++bin) {
    const double speed_m_s = curve_speed_m_s(bin);
    if (speed_m_s > high_m_s || speed_m_s < low_m_s) continue;
    const double off = (curve.at(bin) - drum_alone.at(bin)) / predicted_net.at(bin) - 1.0;
    if (!std::isfinite(off)) continue;
    sum += off;
    bins += 1.0;
  }
  return bins > 0.0 ? std::optional<double>(sum / bins) : std::nullopt;
}

/// How far a run of a pair is from the other pressures over a stretch, less how far it is at its other speeds where
/// the stretch is a part.
std::optional<double> calc_distance(const CoastCurve& curve, const SortedCoasts& sorted, const CoastCurve& predicted,
                                    const OddRun& odd) {
  const auto within = calc_off(curve, sorted.drum_alone, predicted, odd.high_m_s, odd.low_m_s);
  if (!within.has_value() || odd.is_whole) return within;
  constexpr double kFastest = 1e3;
  const auto above = calc_off(curve, sorted.drum_alone, predicted, kFastest, odd.high_m_s + 0.1);
  const auto below = calc_off(curve, sorted.drum_alone, predicted, odd.low_m_s - 0.1, 0.0);
  if (above.has_value() && below.has_value()) return *within - 0.5 * (*above + *below);
  return *within - above.value_or(below.value_or(0.0));
}

RunDoubt describe_odd_coast(const CoastSet& set, const OddRun& odd, const char* others) {
  const CoastRun& run = set.runs[odd.run];
  const bool more = odd.relative > 0.0;
  RunDoubt doubt{DoubtKind::kOdd, {run.id}, more ? "braked" : "driven", odd.relative, ""};
  doubt.text = fmt::format("{} has {:.0f} % {} {} from {:.1f} to {:.1f} km/h, {:.0f} standard deviations: {}", run.id,
                           100.0 * std::abs(odd.relative), more ? "more" : "less", others,
                           3.6 * (odd.high_m_s + 0.5 * kCurveBin_m_s), 3.6 * (odd.low_m_s - 0.5 * kCurveBin_m_s),
                           std::abs(odd.sds),
                           more ? "was it braked, or is its pressure or load another one?"
                                : "was it driven, or is its pressure or load another one?");
  return doubt;
}

/// Of the members of a group, the odd ones; true where one was found.
bool find_odd_of_many(const CoastSet& set, const std::vector<const CoastCurve*>& runs, const CoastCurve* base,
                      const char* others, CoastDoubts& checked) {
  constexpr std::size_t kFewest = 3;
  if (runs.size() < kFewest) return false;
  const std::optional<OddRun> odd = find_odd_run(compare_with_others(runs, base));
  if (!odd.has_value()) return false;
  checked.doubts.push_back(describe_odd_coast(set, *odd, others));
  checked.set_aside.insert(odd->run);
  return true;
}

/// Differences within pairs, first over second, in the net deceleration; what the directions share is taken off.
std::vector<RunDeviation> compare_pairs(const CoastSet& set, const SortedCoasts& sorted) {
  std::vector<RunDeviation> deviations;
  std::vector<double> by_direction;
  std::vector<std::pair<std::size_t, double>> signs;  // of the pairs whose members go in different directions
  for (std::size_t i = 0; i < sorted.groups.size(); ++i) {
    const RepeatGroup& group = sorted.groups[i];
    if (group.runs.size() != 2) continue;
    RunDeviation deviation = calc_deviation(*group.runs[0], *group.runs[1], &sorted.drum_alone);
    if (deviation.relative.empty()) continue;
    deviation.run = i;  // the group
    const std::string& a = set.runs[group.runs[0]->run].direction;
    const std::string& b = set.runs[group.runs[1]->run].direction;
    if (a != b) {
      signs.emplace_back(deviations.size(), a < b ? 1.0 : -1.0);
      by_direction.push_back(signs.back().second * calc_median(deviation.relative));
    }
    deviations.push_back(std::move(deviation));
  }
  constexpr std::size_t kFewestForDirection = 4;
  const double shared = by_direction.size() >= kFewestForDirection ? calc_median(by_direction) : 0.0;
  for (const auto& [place, sign] : signs) {
    for (double& value : deviations[place].relative) value -= sign * shared;
  }
  return deviations;
}

/// Names the odd run of a pair, or both.
void judge_pair(const CoastSet& set, const SortedCoasts& sorted, const OddRun& difference, CoastDoubts& checked) {
  constexpr double kFarther = 1.5;
  const RepeatGroup& group = sorted.groups[difference.run];
  const CoastCurve predicted = predict_net(sorted, group);
  const auto first = calc_distance(*group.runs[0], sorted, predicted, difference);
  const auto second = calc_distance(*group.runs[1], sorted, predicted, difference);
  OddRun odd = difference;
  constexpr const char* kThanTheOthers = "net deceleration than the other runs say";
  for (const std::size_t member : {0U, 1U}) {
    odd.run = group.runs[member]->run;
    odd.relative = member == 0 ? difference.relative : 1.0 / (1.0 + difference.relative) - 1.0;
    const auto own = member == 0 ? first : second;
    const auto other = member == 0 ? second : first;
    if (!own.has_value() || !other.has_value() || std::abs(*own) < kFarther * std::abs(*other)) continue;
    checked.doubts.push_back(describe_odd_coast(set, odd, kThanTheOthers));
    checked.set_aside.insert(odd.run);
    return;
  }
  const CoastRun& a = set.runs[group.runs[0]->run];
  const CoastRun& b = set.runs[group.runs[1]->run];
  RunDoubt doubt{DoubtKind::kOdd, {a.id, b.id}, "one of them is wrong", difference.relative, ""};
  doubt.text = fmt::format(
      "{} and {} should repeat each other, but the net deceleration of the first is {:+.0f} % of that of the second, "
      "{:.0f} standard deviations: one of them is wrong, and the other runs do not tell which one",
      a.id, b.id, 100.0 * difference.relative, std::abs(difference.sds));
  checked.doubts.push_back(doubt);
}

/// Looks at the pairs once; true where an odd run was set aside.
bool find_odd_of_pairs(const CoastSet& set, const SortedCoasts& sorted, CoastDoubts& checked) {
  ScatterPrior prior;
  prior.run_sd *= std::sqrt(2.0);  // of a difference
  prior.fewest = 1;
  const std::size_t before = checked.set_aside.size();
  const std::optional<OddRun> odd = find_odd_run(compare_pairs(set, sorted), prior);
  if (odd.has_value()) judge_pair(set, sorted, *odd, checked);
  return checked.set_aside.size() > before;
}

/// A loaded run with the logarithm of its net deceleration over the median of all, and the group that it is in.
struct LeveledRun {
  std::size_t run = 0;
  std::size_t group = 0;
  double log_net = 0.0;
};

CoastCurve take_off(const CoastCurve& curve, const CoastCurve& base) {
  CoastCurve net;
  net.run = curve.run;
  for (std::size_t bin = 0; bin < curve.value_m_s2.size(); ++bin)
    net.value_m_s2.push_back(curve.at(bin) - base.at(bin));
  return net;
}

std::vector<LeveledRun> list_leveled_runs(const SortedCoasts& sorted) {
  std::vector<CoastCurve> nets;
  std::vector<LeveledRun> runs;
  for (std::size_t group = 0; group < sorted.groups.size(); ++group) {
    for (const CoastCurve* curve : sorted.groups[group].runs) {
      nets.push_back(take_off(*curve, sorted.drum_alone));
      runs.push_back({curve->run, group, 0.0});
    }
  }
  std::vector<const CoastCurve*> all;
  for (const CoastCurve& net : nets) all.push_back(&net);
  const CoastCurve middle = calc_median_curve(all);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].log_net = compare_curves(nets[i], middle).log;
  return runs;
}

/// Means of the groups, and the scatter of their runs about them, pooled.
struct LevelScatter {
  std::vector<double> means;
  double sd = 0.0;
};

LevelScatter calc_level_scatter(const std::vector<LeveledRun>& runs, std::size_t groups) {
  LevelScatter scatter{std::vector<double>(groups, 0.0), 0.0};
  std::vector<double> counts(groups, 0.0);
  for (const LeveledRun& run : runs) counts[run.group] += 1.0;
  for (const LeveledRun& run : runs) scatter.means[run.group] += run.log_net / counts[run.group];
  double squares = 0.0;
  for (const LeveledRun& run : runs) squares += std::pow(run.log_net - scatter.means[run.group], 2);
  const double freedom = static_cast<double>(runs.size() - groups);
  scatter.sd = freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0;
  return scatter;
}

/// Two runs whose pressures look exchanged: with them the other way round, runs at one pressure repeat each other, and
/// the loss falls with pressure.
void find_exchanged_pressures(const CoastSet& set, const std::vector<CoastCurve>& curves, CoastDoubts& checked) {
  constexpr double kLeastScatter = 0.05;  // Assumed: runs at one pressure repeat within 1 to 2 %
  constexpr double kBetter = 0.25;        // Assumed
  const SortedCoasts sorted = sort_coasts(set, curves, checked.set_aside);
  std::vector<LeveledRun> runs = list_leveled_runs(sorted);
  if (runs.size() < sorted.groups.size() + 2) return;
  const double before = calc_level_scatter(runs, sorted.groups.size()).sd;
  if (!(before > kLeastScatter)) return;
  double best = kBetter * before;
  std::optional<std::pair<std::size_t, std::size_t>> exchanged;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const RepeatGroup& a = sorted.groups[runs[i].group];
      const RepeatGroup& b = sorted.groups[runs[k].group];
      if (runs[i].group == runs[k].group || !is_same_load(a.load_N, b.load_N)) continue;
      std::swap(runs[i].group, runs[k].group);
      const LevelScatter after = calc_level_scatter(runs, sorted.groups.size());
      std::swap(runs[i].group, runs[k].group);
      const double rise = after.means[runs[i].group] - after.means[runs[k].group];
      if (after.sd >= best || rise * (a.pressure_Pa - b.pressure_Pa) > 0.0) continue;
      best = after.sd;
      exchanged = {runs[k].run, runs[i].run};
    }
  }
  if (!exchanged.has_value()) return;
  const CoastRun& first = set.runs[exchanged->first];
  const CoastRun& second = set.runs[exchanged->second];
  RunDoubt doubt{DoubtKind::kOdd, {first.id, second.id}, "pressures exchanged", before, ""};
  doubt.text = fmt::format(
      "{} ({:.0f} kPa) and {} ({:.0f} kPa) look as if their pressures were exchanged: runs at one pressure differ by "
      "{:.0f} %, and by {:.1f} % with these two the other way round",
      first.id, 1e-3 * first.pressure_Pa, second.id, 1e-3 * second.pressure_Pa, 100.0 * before, 100.0 * best);
  checked.doubts.push_back(doubt);
  checked.set_aside.insert({exchanged->first, exchanged->second});
}

}  // namespace

void add_odd_coasts(const CoastSet& set, const std::vector<CoastCurve>& curves, CoastDoubts& checked) {
  find_exchanged_pressures(set, curves, checked);
  const std::size_t most = checked.set_aside.size() + curves.size() / 3;
  while (checked.set_aside.size() < most) {
    const SortedCoasts sorted = sort_coasts(set, curves, checked.set_aside);
    if (find_odd_of_many(set, sorted.lifted, nullptr, "deceleration than the other lifted runs", checked)) continue;
    bool found = false;
    for (const RepeatGroup& group : sorted.groups) {
      found = found || find_odd_of_many(set, group.runs, &sorted.drum_alone,
                                        "net deceleration than the other runs at its pressure", checked);
    }
    if (found) continue;
    if (!find_odd_of_pairs(set, sorted, checked)) return;
  }
}

}  // namespace rollrig::estimation
