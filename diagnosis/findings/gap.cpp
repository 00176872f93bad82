#include "diagnosis/findings/gap.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/comparison/held_out.h"
#include "diagnosis/comparison/report_unit.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"

namespace rollrig::diagnosis {
namespace {

/// The offset that fits a series' differences best within its sensor's.
struct OffsetFit {
  double offset = 0.0;           // SI
  double offset_variance = 0.0;  // of what stays of it
};

OffsetFit fit_offset(const Series& series, const Eigen::VectorXd& difference) {
  std::vector<double> whitened(series.size());
  std::vector<double> ones(series.size(), 1.0);
  for (std::size_t k = 0; k < series.size(); ++k) whitened[k] = difference[to_index(series.first_residual + k)];
  series.whitener.apply(whitened.data(), 1);
  series.whitener.apply(ones.data(), 1);
  double along = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    along += ones[k] * whitened[k];
    square += ones[k] * ones[k];
  }
  const double prior = series.offset_sd > 0.0 ? 1.0 / (series.offset_sd * series.offset_sd) : 1e300;
  const double offset = along / (square + prior);
  return {offset, 1.0 / (square + prior)};
}

/// Sums of squares above the noise, in floors, by stretch: what a resample draws.
struct StretchSquares {
  double above = 0.0;
  double blocks = 0.0;

  void add(const StretchSquares& other) {
    above += other.above;
    blocks += other.blocks;
  }
  double gap() const { return blocks > 0.0 ? std::sqrt(std::max(0.0, above / blocks)) : 0.0; }
};

/// What is left of some runs.
struct Measure {
  std::map<std::pair<std::size_t, std::size_t>, StretchSquares> stretches;  // by run and phase
  std::vector<StretchSquares> channels;                                     // squares in SI
};

/// Adds the differences of one run (all series of it), its offsets taken off anew.
void add_run(const PreparedSet& set, std::size_t run, const Eigen::VectorXd& difference, Measure& measure) {
  measure.channels.resize(set.channels().size());
  for (const Series& series : set.series()) {
    if (series.run != run) continue;
    const OffsetFit fit = fit_offset(series, difference);
    for (std::size_t k = 0; k < series.size(); ++k) {
      const double d = difference[to_index(series.first_residual + k)] - fit.offset;
      const double sd = series.whitener.standard_deviation(k);
      const double above = d * d - std::max(0.0, sd * sd - fit.offset_variance);
      measure.stretches[{run, series.phase[k]}].add({above / (series.floor * series.floor), 1.0});
      measure.channels[series.channel].add({above, 1.0});
    }
  }
}

double gap_of(const Measure& measure) {
  StretchSquares sum;
  for (const auto& [where, stretch] : measure.stretches) sum.add(stretch);
  return sum.gap();
}

/// What the cause changes in a run, whitened, in squares.
double measure_change(const Study& study, const Candidate& cause, std::size_t run) {
  Eigen::VectorXd change = study.null.fit.residuals - cause.fit.residuals;
  study.discrepancy.whiten(cause.amplitudes, change);
  double sum = 0.0;
  for (const Series& series : study.set.series()) {
    if (series.run == run) sum += series.rows_of(change).squaredNorm();
  }
  return sum;
}

/// The candidate with its base parameters at the files' values: only its own parameters and offsets are fitted.
Measure measure_as_calibrated(const Study& study, const Candidate& candidate) {
  const PreparedSet& set = study.set;
  const Model model(set, {}, candidate.fit.hypothesis);
  constexpr int kMost = 6;
  RefitStart start{candidate.amplitudes, Eigen::VectorXd(to_index(model.unknown_count())), 1, kMost};
  const Eigen::Index own = to_index(model.own_count());
  const Eigen::Index offsets = to_index(set.offset_count());
  start.unknowns << candidate.fit.unknowns.head(own), candidate.fit.unknowns.tail(offsets);
  const Eigen::VectorXd simulated = refit(model, study.discrepancy, start).simulated;
  Measure measure;
  if (simulated.size() == 0) return measure;
  const Eigen::VectorXd difference = set.measured() - simulated;
  for (std::size_t run = 0; run < set.runs().size(); ++run) add_run(set, run, difference, measure);
  return measure;
}

struct Shrinkage {
  double percent = 0.0;
  std::array<double, 2> ci95_percent{};
  bool above_noise = false;
};

double shrink_percent(double before, double after) { return 100.0 * (1.0 - after / before); }

/// Resamples stretches, the same ones before and after.
Shrinkage resample(const Measure& before, const Measure& after) {
  constexpr int kResamples = 1000;
  std::vector<std::pair<StretchSquares, StretchSquares>> stretches;
  for (const auto& [where, stretch] : before.stretches) stretches.emplace_back(stretch, after.stretches.at(where));
  if (stretches.empty()) return {};  // no run could be simulated
  RandomStream random(1, "shrinkage");
  std::vector<double> percents;
  int not_above = 0;
  for (int i = 0; i < kResamples; ++i) {
    StretchSquares sum_before;
    StretchSquares sum_after;
    for (std::size_t k = 0; k < stretches.size(); ++k) {
      const auto drawn = static_cast<std::size_t>(random.uniform() * static_cast<double>(stretches.size()));
      sum_before.add(stretches[drawn].first);
      sum_after.add(stretches[drawn].second);
    }
    const double was = sum_before.gap();
    if (was > 0.0) {
      percents.push_back(shrink_percent(was, sum_after.gap()));
    } else {
      ++not_above;
    }
  }
  Shrinkage result;
  constexpr double kLow = 0.025;
  result.above_noise = not_above < kLow * kResamples;
  if (!result.above_noise) return result;
  std::sort(percents.begin(), percents.end());
  const auto quantile = [&](double p) {
    return percents[static_cast<std::size_t>(p * static_cast<double>(percents.size() - 1))];
  };
  result.percent = shrink_percent(gap_of(before), gap_of(after));
  result.ci95_percent = {quantile(kLow), quantile(1.0 - kLow)};
  return result;
}

/// What is left of every run by fits that did not see it.
struct HeldOut {
  Measure before;
  Measure after;
  Measure black_box;
  Measure certain_before;  // of runs of which the others say enough
  Measure certain_after;
  std::vector<std::string> runs;
  std::vector<std::string> certain_runs;
};

HeldOut measure_held_out(const Study& study, const Candidate* cause, const BlackBox& black_box) {
  const PreparedSet& set = study.set;
  const std::size_t runs = set.runs().size();
  const bool can_leave_out = runs > 1;
  std::vector<Prediction> before(runs);
  std::vector<Prediction> after(runs);
  const std::size_t hypotheses = cause != nullptr ? 2 : 1;
  parallel_for(
      runs * hypotheses, study.settings.threads,
      [&](std::size_t job) {
        const std::size_t run = job / hypotheses;
        const bool is_null = job % hypotheses == 0;
        const std::size_t held_out = can_leave_out ? run : runs;  // past the last: none
        (is_null ? before : after)[run] = predict_without(study, is_null ? study.null : *cause, held_out);
      },
      study.settings.advance());
  HeldOut all;
  for (std::size_t run = 0; run < runs; ++run) {
    const bool lost = before[run].simulated.size() == 0 || (cause != nullptr && after[run].simulated.size() == 0);
    if (lost) continue;  // no fit without it
    const auto of_run = [run](const Series& series) { return series.run == run; };
    if (std::none_of(set.series().begin(), set.series().end(), of_run)) continue;  // it measured nothing
    const Eigen::VectorXd difference = set.measured() - before[run].simulated;
    const Eigen::VectorXd with_cause = set.measured() - (cause != nullptr ? after : before)[run].simulated;
    add_run(set, run, difference, all.before);
    add_run(set, run, with_cause, all.after);
    if (!can_leave_out) continue;
    add_run(set, run, black_box(set, difference, run), all.black_box);
    all.runs.push_back(set.runs()[run].measured.id);
    if (cause == nullptr) continue;
    const double uncertainty = std::max(before[run].uncertainty, after[run].uncertainty);
    if (uncertainty > thresholds::kCertainHeldOut * measure_change(study, *cause, run)) continue;
    add_run(set, run, difference, all.certain_before);
    add_run(set, run, with_cause, all.certain_after);
    all.certain_runs.push_back(set.runs()[run].measured.id);
  }
  return all;
}

/// What the cause takes from the gap of the runs left out. Where that may be nothing, only runs of which the others say
/// enough are judged on: what a prediction is uncertain by is no evidence against the cause.
void judge_shrinkage(const HeldOut& left, Gap& gap) {
  gap.judged_on = left.runs;
  Shrinkage shrinkage = resample(left.before, left.after);
  if (!shrinkage.above_noise) return;
  const bool is_left_out = !left.runs.empty();
  if (is_left_out && shrinkage.ci95_percent[0] <= 0.0) {
    gap.judged_on = left.certain_runs;
    if (gap.judged_on.empty()) return;
    shrinkage = resample(left.certain_before, left.certain_after);
    if (!shrinkage.above_noise) return;
  }
  gap.shrink_percent = shrinkage.percent;
  gap.shrink_ci95_percent = shrinkage.ci95_percent;
}

std::vector<ChannelGap> list_channels(const PreparedSet& set, const Measure& before, const Measure& after) {
  std::vector<ChannelGap> channels;
  for (std::size_t c = 0; c < set.channels().size(); ++c) {
    const ReportUnit unit = find_report_unit(set, set.channels()[c]);
    const auto in_unit = [&](const Measure& measure) {
      if (measure.channels.empty()) return 0.0;  // no run could be simulated
      return unit.per_SI * measure.channels[c].gap();
    };
    channels.push_back({set.channels()[c].header(), unit.symbol, in_unit(before), in_unit(after)});
  }
  return channels;
}

}  // namespace

Gap find_gap(const Study& study, const Candidate* cause, const BlackBox& black_box) {
  Gap gap;
  HeldOut left = measure_held_out(study, cause, black_box);
  gap.held_out = left.runs;
  if (!left.certain_before.stretches.empty()) {
    const Shrinkage certain = resample(left.certain_before, left.certain_after);
    gap.worse_where_certain = certain.above_noise && certain.ci95_percent[1] < 0.0;
  }
  const Measure calibrated = measure_as_calibrated(study, study.null);
  const bool is_judged = !left.before.stretches.empty();
  if (!is_judged) left.before = left.after = calibrated;  // recalibration is not known to help
  gap.recalibrated = {gap_of(left.before), gap_of(left.after)};
  gap.as_calibrated.before = gap_of(calibrated);
  gap.as_calibrated.after = cause != nullptr ? gap_of(measure_as_calibrated(study, *cause)) : gap.as_calibrated.before;
  gap.channels = list_channels(study.set, left.before, left.after);
  if (!is_judged) return gap;
  if (gap.as_calibrated.before > 0.0) {
    gap.recalibration_percent = shrink_percent(gap.as_calibrated.before, gap.recalibrated.before);
  }
  if (cause != nullptr) judge_shrinkage(left, gap);
  const bool is_above_noise = resample(left.before, left.before).above_noise;
  if (is_above_noise && !left.runs.empty())
    gap.black_box_percent = shrink_percent(gap.recalibrated.before, gap_of(left.black_box));
  return gap;
}

}  // namespace rollrig::diagnosis
