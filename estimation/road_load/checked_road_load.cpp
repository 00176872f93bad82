#include "estimation/road_load/checked_road_load.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "estimation/road_load/bin_labels.h"
#include "estimation/road_load/coastdown_problem.h"
#include "estimation/road_load/coastdown_repeats.h"
#include "estimation/road_load/coastdown_units.h"
#include "estimation/road_load/recorded_wind.h"
#include "estimation/road_load/road_force_reference.h"
#include "estimation/road_load/road_load_doubts.h"
#include "estimation/road_load/session_headings.h"
#include "estimation/road_load/session_units.h"
#include "sim/core/error.h"

namespace rollrig::estimation {
namespace {

RunDoubt describe_odd_run(const CoastdownData& data, std::size_t run, const OddRun& odd) {
  const bool more = odd.relative > 0.0;
  const char* cause = more ? "was it braked, driven against a wind or up a slope, or is its mass another one?"
                           : "was it driven, or did it go with a wind or down a slope, or is its mass another one?";
  RunDoubt doubt{DoubtKind::kOdd, {data.runs[run].id}, more ? "braked" : "driven", odd.relative, ""};
  doubt.text = fmt::format(
      "{} has {:.0f} % {} force than the other runs say from {:.0f} to {:.0f} km/h, {:.0f} "
      "standard deviations of their scatter: {}",
      call_run(data, run), 100.0 * std::abs(odd.relative), more ? "more" : "less", 3.6 * odd.high_m_s,
      3.6 * odd.low_m_s, std::abs(odd.sds), cause);
  return doubt;
}

/// Mean of the deviation over a stretch.
double calc_stretch(const RunDeviation& deviation, const OddRun& odd) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < deviation.relative.size(); ++i) {
    if (deviation.speed_m_s[i] > odd.high_m_s || deviation.speed_m_s[i] < odd.low_m_s) continue;
    sum += deviation.relative[i];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : odd.relative;
}

/// Sets the oddest run aside, and looks again, until what is left agrees.
void find_odd_coastdowns(const CoastdownData& data, const RoadLoadFitOptions& options, CheckedCoastdowns& checked) {
  constexpr double kMostShare = 1.0 / 3.0;  // of the runs: beyond, nothing tells which ones are the odd ones
  const double mass_kg = options.mass_kg.value_or(1.0) + options.rotating_mass_kg.value_or(0.0);
  const std::vector<FitRun> runs = make_fit_runs(data, options, mass_kg);
  std::vector<bool> used;
  for (const FitRun& run : runs) used.push_back(checked.set_aside.count(run.index) == 0);
  const auto most = static_cast<std::size_t>(kMostShare * static_cast<double>(runs.size()));
  std::vector<OddRun> odd_runs;
  while (odd_runs.size() < most) {
    const RoadForceReference reference(data, runs, used, mass_kg);
    std::vector<RunDeviation> deviations;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (used[i]) deviations.push_back(reference.deviation_of(runs[i], i));
    }
    const std::optional<OddRun> odd = find_odd_run(deviations);
    if (!odd.has_value()) break;
    used[odd->run] = false;
    odd_runs.push_back(*odd);
  }
  const RoadForceReference reference(data, runs, used, mass_kg);
  for (OddRun& odd : odd_runs) {
    odd.relative = calc_stretch(reference.deviation_of(runs[odd.run], odd.run), odd);
    const std::size_t run = runs[odd.run].index;
    checked.doubts.push_back(describe_odd_run(data, run, odd));
    checked.set_aside.insert(run);
  }
}

/// The data without some runs; an index of a point is that in the whole data.
std::optional<RoadLoadFit> fit_without(const CoastdownData& data, const std::set<std::size_t>& without,
                                       const RoadLoadFitOptions& options) {
  CoastdownData part;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    if (without.count(i) != 0) continue;
    part.runs.push_back(data.runs[i]);
    places.push_back(i);
  }
  try {
    RoadLoadFit fit = fit_road_load(part, options);
    for (RoadLoadPoint& point : fit.points) point.run = places[point.run];
    return fit;
  } catch (const RunFailure&) {
    return std::nullopt;
  } catch (const InputError&) {  // too few bins are left
    return std::nullopt;
  }
}

/// The runs without which the others have a fit, where the whole has none.
std::vector<std::size_t> find_disturbing_runs(const CoastdownData& data, const RoadLoadFitOptions& options) {
  std::vector<std::size_t> disturbing;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    if (fit_without(data, {i}, options).has_value()) disturbing.push_back(i);
  }
  return disturbing;
}

std::string list_names(const CoastdownData& data, const std::vector<std::size_t>& runs) {
  constexpr std::size_t kMost = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, runs.size()); ++i) names += (i > 0 ? ", " : "") + call_run(data, runs[i]);
  return runs.size() > kMost ? names + " and others" : names;
}

/// The fit of all runs has failed: that of the others, or the failure with the runs that may cause it.
RoadLoadFit replace_failed(const CoastdownData& data, const RoadLoadFitOptions& options,
                           const CheckedCoastdowns& checked, const RunFailure& failure) {
  std::vector<std::size_t> out(checked.set_aside.begin(), checked.set_aside.end());
  std::optional<RoadLoadFit> others = out.empty() ? std::nullopt : fit_without(data, checked.set_aside, options);
  if (others.has_value()) {
    others->warnings.push_back(fmt::format("the fit of all runs fails: {}. A, B and C are those without {}",
                                           failure.what(), list_names(data, out)));
    return *others;
  }
  const std::vector<std::size_t> disturbing = find_disturbing_runs(data, options);
  if (disturbing.empty()) {
    if (checked.doubts.empty()) throw;
    throw RunFailure(fmt::format("{}. In doubt: {}", failure.what(), checked.doubts.front().text));
  }
  if (2 * disturbing.size() > data.runs.size()) {
    throw RunFailure(
        fmt::format("{}. Without any one of most runs there is a fit: no single run is the cause", failure.what()));
  }
  throw RunFailure(fmt::format("{}. There is a fit without {}: look at {}, or leave {} out (--leave-out)",
                               failure.what(), list_names(data, disturbing), disturbing.size() == 1 ? "it" : "them",
                               disturbing.size() == 1 ? "it" : "one of them"));
}

void warn_of_signs(RoadLoadFit& fit) {
  constexpr const char* kNames[] = {"A", "B", "C"};
  constexpr const char* kMeaning[] = {"the force at standstill", "", "the drag"};
  for (const int i : {0, 2}) {
    const double value = fit.values()[static_cast<std::size_t>(i)];
    if (value >= 0.0) continue;
    const bool certain = fit.interval_95(i)[1] < 0.0;
    fit.warnings.push_back(
        fmt::format("{} is below 0{}: {} of a vehicle is not negative. A run that was braked over a part of its "
                    "speeds, a wind that "
                    "changed or too few speeds can cause it",
                    kNames[i], certain ? ", beyond its interval" : ", within its interval", kMeaning[i]));
  }
}

/// Wind and slope as recorded against what the headings show; sessions with exchanged headings or in another unit.
void doubt_records(const CoastdownData& data, const RoadLoadFitOptions& options, RoadLoadFit& fit) {
  std::vector<RunResistance> runs;
  for (const RoadLoadPoint& point : fit.points) {
    if (runs.empty() || runs.back().run != point.run) runs.push_back({point.run, {}, {}});
    runs.back().speed_m_s.push_back(point.speed_m_s);
    runs.back().force_N.push_back(point.force_N);
  }
  const double mass_kg = find_test_mass_kg(options, fit.effective_mass_kg);
  const double drag = given_drag(options).value_or(fit.as_tested.C_N_s2_per_m2);
  for (auto& doubts :
       {doubt_winds(list_winds_by_force(data, runs, drag), "the headings show a wind of", "wind_m_s"),
        doubt_slopes(list_slopes_by_force(data, runs, mass_kg, SlopeForce::kIncluded)), doubt_session_units(data)}) {
    fit.warnings.insert(fit.warnings.end(), doubts.begin(), doubts.end());
  }
  if (has_recorded_slopes(data)) return;  // compared above
  if (auto doubt = doubt_session_headings(data, runs, mass_kg)) fit.warnings.push_back(std::move(*doubt));
}

}  // namespace

CheckedCoastdowns check_coastdowns(CoastdownData& data, const RoadLoadFitOptions& options) {
  CheckedCoastdowns checked;
  checked.doubts = leave_out_repeats(data);
  for (const LabelDoubt& label : check_bin_labels(data)) {
    checked.doubts.push_back(label.doubt);
    checked.set_aside.insert(label.run);
  }
  find_odd_coastdowns(data, options, checked);
  return checked;
}

RoadLoadFit fit_checked_road_load(CoastdownFile& file, const RoadLoadFitOptions& options) {
  const CheckedCoastdowns checked = check_coastdowns(file.data, options);
  RoadLoadFit fit;
  try {
    fit = fit_road_load(file.data, options);
    const bool some_left = checked.set_aside.size() < file.data.runs.size();
    if (!checked.set_aside.empty() && some_left) {
      if (auto others = fit_without(file.data, checked.set_aside, options)) {
        fit.others = std::make_shared<const RoadLoadFit>(std::move(*others));
      }
    }
  } catch (const RunFailure& failure) {
    fit = replace_failed(file.data, options, checked, failure);
  }
  fit.doubts = checked.doubts;
  warn_of_signs(fit);
  doubt_records(file.data, options, fit);
  if (options.mass_kg.has_value()) {
    for (std::string& doubt : doubt_masses(*options.mass_kg, options.rotating_mass_kg, std::nullopt)) {
      fit.warnings.push_back(std::move(doubt));
    }
  }
  std::vector<std::string> texts;
  for (const RunDoubt& doubt : fit.doubts) texts.push_back(doubt.text);
  fit.warnings.insert(fit.warnings.begin(), texts.begin(), texts.end());
  put_speed_unit_doubt(file.data, fit.warnings);
  return fit;
}

}  // namespace rollrig::estimation
