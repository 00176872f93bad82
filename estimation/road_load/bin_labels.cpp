#include "estimation/road_load/bin_labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "estimation/road_load/coastdown_repeats.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr double kMostDifference = 0.01;  // relative. Assumed

/// What labels and file say of one run.
struct LabeledRun {
  std::size_t run = 0;
  double time_s = 0.0;      // sum of the times through the bins
  double labels_m_s = 0.0;  // mean speed by the labels
  double file_m_s = 0.0;    // by distance and time
  double high_m_s = 0.0;
  double low_m_s = 0.0;
  double width_m_s = 0.0;  // of one bin
};

/// A mistake, and the mean speed that the labels would have without it.
struct Mistake {
  DoubtKind kind = DoubtKind::kLabels;
  std::string words;
  double prior = 1.0;
  double (*correct_m_s)(const LabeledRun&, double) = nullptr;
  double number = 0.0;
};

/// Mean speed of a bin over time: the middle speed, less what a deceleration that rises with speed does.
/// Equation  v - dv^2/12 a'/a
double calc_labels_speed_m_s(const CoastdownRun& run) {
  double way_m = 0.0, time_s = 0.0;
  double mean_v = 0.0, mean_a = 0.0, products = 0.0, squares = 0.0;
  const auto n = static_cast<double>(run.bins.size());
  for (const SpeedBin& bin : run.bins) {
    mean_v += 0.5 * (bin.high_m_s + bin.low_m_s) / n;
    mean_a += (bin.high_m_s - bin.low_m_s) / bin.duration_s / n;
  }
  for (const SpeedBin& bin : run.bins) {
    const double dv = 0.5 * (bin.high_m_s + bin.low_m_s) - mean_v;
    products += dv * ((bin.high_m_s - bin.low_m_s) / bin.duration_s - mean_a);
    squares += dv * dv;
  }
  const double slope_per_s = squares > 0.0 ? products / squares : 0.0;
  for (const SpeedBin& bin : run.bins) {
    const double width = bin.high_m_s - bin.low_m_s;
    const double middle = 0.5 * (bin.high_m_s + bin.low_m_s);
    way_m += bin.duration_s * middle - bin.duration_s * width * width / 12.0 * slope_per_s / mean_a;
    time_s += bin.duration_s;
  }
  return way_m / time_s;
}

double by_factor(const LabeledRun& run, double factor) { return run.labels_m_s * factor; }
double by_distance(const LabeledRun& run, double factor) { return run.labels_m_s / factor; }
double by_shift(const LabeledRun& run, double bins) { return run.labels_m_s + bins * run.width_m_s; }
double by_width_from_top(const LabeledRun& run, double width_km_h) {
  return run.high_m_s - (run.high_m_s - run.labels_m_s) * width_km_h / (3.6 * run.width_m_s);
}
double by_width_from_bottom(const LabeledRun& run, double width_km_h) {
  return run.low_m_s + (run.labels_m_s - run.low_m_s) * width_km_h / (3.6 * run.width_m_s);
}

std::vector<Mistake> list_mistakes(bool total_known) {
  constexpr double kMph = kMile_m / 1e3, kKnot = 1.852, kMps = 3.6, kFoot = 0.3048;
  std::vector<Mistake> mistakes{
      {DoubtKind::kLabels, "the labels are in mph", 1.0, &by_factor, kMph},
      {DoubtKind::kLabels, "the labels are in knots", 0.1, &by_factor, kKnot},
      {DoubtKind::kLabels, "the labels are in m/s", 0.3, &by_factor, kMps},
      {DoubtKind::kLabels, "the labels were converted from mph twice", 0.1, &by_factor, 1.0 / kMph},
      {DoubtKind::kDistance, "the distance is in feet", 0.2, &by_distance, kFoot},
      {DoubtKind::kDistance, "the distance is in km", 0.3, &by_distance, 1e3},
      {DoubtKind::kDistance, "the distance is in miles", 0.2, &by_distance, 1e3 * kMph}};
  for (const int bins : {1, 2, 3}) {
    const std::string count = bins == 1 ? "one bin" : fmt::format("{} bins", bins);
    const double prior = bins == 1 ? 1.0 : 0.3 / bins;
    mistakes.push_back({DoubtKind::kLabels, "the labels are shifted down by " + count, prior, &by_shift, 1.0 * bins});
    mistakes.push_back({DoubtKind::kLabels, "the labels are shifted up by " + count, prior, &by_shift, -1.0 * bins});
  }
  for (const double km_h : {1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.5, 8.0, 8.04672, 10.0, 15.0, 16.09344, 20.0}) {
    const std::string words = fmt::format("the bins are {:.3g} km/h wide", km_h);
    mistakes.push_back({DoubtKind::kLabels, words, 0.1, &by_width_from_top, km_h});
    mistakes.push_back({DoubtKind::kLabels, words + ", from the lowest label up", 0.03, &by_width_from_bottom, km_h});
  }
  if (!total_known) {
    mistakes.push_back({DoubtKind::kTimes, "the times are in ms", 0.3, &by_distance, 1e3});
    mistakes.push_back({DoubtKind::kTimes, "the times are in min", 0.1, &by_distance, 1.0 / 60.0});
  }
  return mistakes;
}

/// Of a mistake, how badly it explains runs: half the sum of squares, less the logarithm of its prior.
double judge_mistake(const Mistake& mistake, const std::vector<LabeledRun>& runs) {
  constexpr double kAccuracy = 0.002;  // of a mean speed by distance and time. Assumed
  double squares = 0.0;
  for (const LabeledRun& run : runs) {
    const double corrected = mistake.correct_m_s(run, mistake.number);
    const double off = (run.file_m_s / corrected - 1.0) / kAccuracy;
    squares += corrected > 0.0 ? off * off : 1e9;
  }
  return 0.5 * squares - std::log(mistake.prior);
}

/// The likely mistake in runs together; the second likely one too, where they can hardly be told apart.
std::optional<Mistake> find_mistake(const std::vector<LabeledRun>& runs, bool total_known) {
  constexpr double kBadFit = 8.0;  // per run: four standard deviations
  constexpr double kAlike = 0.7;   // twice as likely
  const std::vector<Mistake> mistakes = list_mistakes(total_known);
  const Mistake* best = nullptr;
  const Mistake* second = nullptr;
  for (const Mistake& mistake : mistakes) {
    const double score = judge_mistake(mistake, runs);
    if (best == nullptr || score < judge_mistake(*best, runs)) {
      second = best;
      best = &mistake;
    } else if (second == nullptr || score < judge_mistake(*second, runs)) {
      second = &mistake;
    }
  }
  if (judge_mistake(*best, runs) > kBadFit * static_cast<double>(runs.size()) + 4.0) return std::nullopt;
  Mistake found = *best;
  if (judge_mistake(*second, runs) - judge_mistake(*best, runs) < kAlike) found.words += ", or " + second->words;
  return found;
}

LabeledRun label_run(const CoastdownData& data, std::size_t index) {
  const CoastdownRun& run = data.runs[index];
  LabeledRun labeled;
  labeled.run = index;
  for (const SpeedBin& bin : run.bins) labeled.time_s += bin.duration_s;
  labeled.labels_m_s = calc_labels_speed_m_s(run);
  labeled.high_m_s = run.bins.front().high_m_s;
  labeled.low_m_s = run.bins.back().low_m_s;
  labeled.width_m_s = (labeled.high_m_s - labeled.low_m_s) / static_cast<double>(run.bins.size());
  if (run.distance_m.has_value()) labeled.file_m_s = *run.distance_m / run.total_s.value_or(labeled.time_s);
  return labeled;
}

/// Whether the times of the bins are not those of the run; says so.
std::optional<RunDoubt> check_total(const CoastdownData& data, const LabeledRun& labeled) {
  const CoastdownRun& run = data.runs[labeled.run];
  if (!run.total_s.has_value()) return std::nullopt;
  const double rounding_s = 0.01 * static_cast<double>(run.bins.size());
  const double difference_s = *run.total_s - labeled.time_s;
  if (std::abs(difference_s) < std::max(kMostDifference * labeled.time_s, rounding_s)) return std::nullopt;
  RunDoubt doubt{DoubtKind::kTimes, {run.id}, "", labeled.time_s / *run.total_s - 1.0, ""};
  const double ratio = *run.total_s / labeled.time_s;
  constexpr double kNear = 0.02;
  if (std::abs(ratio / 1e-3 - 1.0) < kNear || std::abs(ratio / 1e3 - 1.0) < kNear) {
    doubt.likely = "one of them is in ms";
  } else if (difference_s > 0.0) {
    doubt.likely = fmt::format("bins of together {:.4g} s are missing", difference_s);
  } else {
    doubt.likely = "a time through a bin is wrong, or bins of another run are among them";
  }
  doubt.text = fmt::format("{}: its bins take {:.4g} s together, its total time is {:.4g} s: {}",
                           call_run(data, labeled.run), labeled.time_s, *run.total_s, doubt.likely);
  return doubt;
}

RunDoubt describe_contradiction(const CoastdownData& data, const LabeledRun& labeled,
                                const std::optional<Mistake>& mistake) {
  RunDoubt doubt{DoubtKind::kLabels, {data.runs[labeled.run].id}, "", labeled.labels_m_s / labeled.file_m_s - 1.0, ""};
  if (mistake.has_value()) {
    doubt.kind = mistake->kind;
    doubt.likely = mistake->words;
  }
  doubt.text = fmt::format(
      "{}: its bins have a mean speed of {:.4g} km/h, its distance and time one of {:.4g} km/h ({:+.1f} % for the "
      "bins): {}",
      call_run(data, labeled.run), 3.6 * labeled.labels_m_s, 3.6 * labeled.file_m_s, 100.0 * doubt.relative,
      mistake.has_value() ? "likely " + doubt.likely : "labels, times or distance are wrong");
  return doubt;
}

/// Runs that begin before the one before them in their session has ended.
void check_starts(const CoastdownData& data, std::vector<LabelDoubt>& doubts) {
  std::map<std::string, std::size_t> last;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const CoastdownRun& run = data.runs[i];
    if (!run.start_s.has_value() || run.bins.empty()) continue;
    const auto before = last.find(run.session);
    if (before != last.end() && *data.runs[before->second].start_s < *run.start_s) {
      const LabeledRun labeled = label_run(data, before->second);
      const double gap_s = *run.start_s - *data.runs[before->second].start_s;
      if (labeled.time_s > (1.0 + kMostDifference) * gap_s) {
        RunDoubt doubt{DoubtKind::kTimes,
                       {data.runs[before->second].id},
                       "its times or starts are wrong",
                       labeled.time_s / gap_s - 1.0,
                       ""};
        doubt.text = fmt::format("{}: its bins take {:.4g} s, but the next run starts {:.4g} s after it: {}",
                                 call_run(data, before->second), labeled.time_s, gap_s, doubt.likely);
        doubts.push_back({before->second, doubt});
      }
    }
    last[run.session] = i;
  }
}

}  // namespace

std::vector<LabelDoubt> check_bin_labels(const CoastdownData& data) {
  std::vector<LabelDoubt> doubts;
  std::vector<LabeledRun> contradicting;
  bool totals = true;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const CoastdownRun& run = data.runs[i];
    if (run.bins.empty()) continue;
    const LabeledRun labeled = label_run(data, i);
    if (const std::optional<RunDoubt> total = check_total(data, labeled)) {
      doubts.push_back({i, *total});
      continue;
    }
    if (!run.distance_m.has_value()) continue;
    totals = totals && run.total_s.has_value();
    if (std::abs(labeled.labels_m_s / labeled.file_m_s - 1.0) > kMostDifference) contradicting.push_back(labeled);
  }
  const std::optional<Mistake> common = contradicting.size() > 1 ? find_mistake(contradicting, totals) : std::nullopt;
  for (const LabeledRun& labeled : contradicting) {
    const std::optional<Mistake> mistake = common.has_value() ? common : find_mistake({labeled}, totals);
    doubts.push_back({labeled.run, describe_contradiction(data, labeled, mistake)});
  }
  check_starts(data, doubts);
  return doubts;
}

}  // namespace rollrig::estimation
