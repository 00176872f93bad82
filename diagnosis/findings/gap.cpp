#include "diagnosis/findings/gap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "diagnosis/comparison/held_out.h"
#include "diagnosis/findings/gap_measure.h"
#include "diagnosis/findings/lone_conditions.h"
#include "sim/core/parallel.h"
#include "sim/core/random.h"

namespace rollrig::diagnosis {
namespace {

double shrink_percent(double before, double after) { return 100.0 * (1.0 - after / before); }

/// Resamples stretches, the same ones before and after. No percentage where the gap before is not above the noise.
Shrinkage resample(const Measure& before, const Measure& after) {
  constexpr int kResamples = 1000;
  Shrinkage result{{gap_of(before), gap_of(after)}, std::nullopt, {}, std::nullopt};
  std::vector<std::pair<StretchSquares, StretchSquares>> stretches;
  for (const auto& [where, stretch] : before.stretches) stretches.emplace_back(stretch, after.stretches.at(where));
  if (stretches.empty()) return result;  // no run could be simulated
  const std::optional<double> energy_before = find_energy_percent(before);
  const std::optional<double> energy_after = find_energy_percent(after);
  if (energy_before.has_value() && energy_after.has_value()) {
    result.energy_percent = GapView{*energy_before, *energy_after};
  }
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
  constexpr double kLow = 0.025;
  const bool is_above_noise = not_above < kLow * kResamples && result.gap.before > 0.0;
  if (!is_above_noise) return result;
  std::sort(percents.begin(), percents.end());
  const auto quantile = [&](double p) {
    return percents[static_cast<std::size_t>(p * static_cast<double>(percents.size() - 1))];
  };
  result.percent = shrink_percent(result.gap.before, result.gap.after);
  result.ci95_percent = {quantile(kLow), quantile(1.0 - kLow)};
  return result;
}

/// Differences of some data without the cause and with it.
struct BeforeAfter {
  Measure before;
  Measure after;

  bool is_empty() const { return before.stretches.empty(); }
};

/// The fits without the cause and with it, which can leave out parts; `with_cause` is empty if there is no cause.
struct Fits {
  LeaveOut null;
  std::optional<LeaveOut> with_cause;

  Fits(const Study& study, const Candidate* cause) : null(study, study.null) {
    if (cause != nullptr) with_cause.emplace(study, *cause);
  }
};

/// Whether a cause is judged on a part that was left out.
enum class Judged {
  kYes,
  kUncertain,  // the other parts do not determine the two predictions well enough to tell them apart
  kUnchanged   // noise hides what the cause changes
};
/// `change` is the difference of the two predictions. What was measured in the part does not count here.
Judged find_judged(const Fits& fits, const LeftOutPart& part, const Prediction& before, const Prediction& after,
                   const Eigen::VectorXd& change) {
  const double changed = fits.with_cause->measure(part, change);
  if (changed < thresholds::kShownHeldOut_sd * thresholds::kShownHeldOut_sd) return Judged::kUnchanged;
  const bool is_certain = std::max(before.uncertainty, after.uncertainty) <= thresholds::kCertainHeldOut * changed;
  return is_certain ? Judged::kYes : Judged::kUncertain;
}

/// Differences of every run from fits that did not see it.
struct RunsLeftOut {
  BeforeAfter all;
  BeforeAfter certain;  // of the runs on which the cause is judged
  Measure black_box;
  std::vector<std::string> runs;
  std::vector<std::string> certain_runs;
  std::vector<UnjudgedRun> not_judged;  // those that are Judged::kUncertain
};

/// A single run is not left out: its differences are those from the fit to it.
RunsLeftOut measure_runs_left_out(const Study& study, const Scale& scale, const Fits& fits, const BlackBox& black_box) {
  const PreparedSet& set = study.set;
  const std::size_t runs = set.runs().size();
  const bool can_leave_out = runs > 1;
  const bool has_cause = fits.with_cause.has_value();
  std::vector<Prediction> before(runs);
  std::vector<Prediction> after(runs);
  const std::size_t hypotheses = has_cause ? 2 : 1;
  parallel_for(
      runs * hypotheses, study.settings.threads,
      [&](std::size_t job) {
        const std::size_t run = job / hypotheses;
        const bool is_null = job % hypotheses == 0;
        const LeftOutPart part{can_leave_out ? run : runs};
        (is_null ? before : after)[run] = (is_null ? fits.null : *fits.with_cause).predict_without(part);
      },
      study.settings.advance());
  RunsLeftOut left;
  for (std::size_t run = 0; run < runs; ++run) {
    const bool lost = before[run].simulated.size() == 0 || (has_cause && after[run].simulated.size() == 0);
    if (lost) continue;  // no fit without it
    const auto of_run = [run](const Series& series) { return series.run == run; };
    if (std::none_of(set.series().begin(), set.series().end(), of_run)) continue;  // it measured nothing
    const Eigen::VectorXd difference = set.measured() - before[run].simulated;
    const Eigen::VectorXd with_cause = set.measured() - (has_cause ? after : before)[run].simulated;
    add_run(scale, run, difference, left.all.before);
    add_run(scale, run, with_cause, left.all.after);
    if (!can_leave_out) continue;
    add_run(scale, run, black_box(set, difference, run), left.black_box);
    const std::string& id = set.runs()[run].measured.id;
    left.runs.push_back(id);
    if (!has_cause) continue;
    const Judged judged = find_judged(fits, {run}, before[run], after[run], with_cause - difference);
    if (judged == Judged::kUncertain) left.not_judged.push_back({id, find_lone_conditions(set, run)});
    if (judged != Judged::kYes) continue;
    add_run(scale, run, difference, left.certain.before);
    add_run(scale, run, with_cause, left.certain.after);
    left.certain_runs.push_back(id);
  }
  return left;
}

/// Differences of a run from fits that did not see one of its phases, without the cause and with it. Offsets are those
/// of these fits.
struct StretchPrediction {
  std::size_t run = 0;
  std::size_t phase = 0;
  Eigen::VectorXd before;
  Eigen::VectorXd after;
  bool is_judged = false;
};

/// Run and phase of every stretch with a reading.
std::set<std::pair<std::size_t, std::size_t>> list_stretches(const PreparedSet& set) {
  std::set<std::pair<std::size_t, std::size_t>> stretches;
  for (const Series& series : set.series()) {
    for (const std::size_t phase : series.phase) stretches.emplace(series.run, phase);
  }
  return stretches;
}

std::vector<StretchPrediction> predict_stretches(const Study& study, const Fits& fits, const Candidate& cause) {
  std::vector<StretchPrediction> stretches;
  for (const auto& [run, phase] : list_stretches(study.set)) stretches.push_back({run, phase, {}, {}, false});
  const Model null_model = study.make_model({});
  const Model cause_model = study.make_model(cause.fit.hypothesis);
  parallel_for(stretches.size(), study.settings.threads, [&](std::size_t i) {
    StretchPrediction& at = stretches[i];
    const LeftOutPart part{at.run, at.phase};
    const Prediction before = fits.null.predict_without(part, LeaveOut::Simulated::kOfPart);
    const Prediction after = fits.with_cause->predict_without(part, LeaveOut::Simulated::kOfPart);
    if (before.simulated.size() == 0 || after.simulated.size() == 0) return;
    at.before = null_model.subtract_from_measured(before.unknowns, before.simulated);
    at.after = cause_model.subtract_from_measured(after.unknowns, after.simulated);
    at.is_judged = find_judged(fits, part, before, after, at.after - at.before) == Judged::kYes;
  });
  return stretches;
}

/// Differences of the phases on which the cause is judged, each from fits that did not see it. The offset of a run is
/// estimated from all of its phases, of which the others have the differences from the fit to all data.
BeforeAfter measure_stretches_left_out(const Study& study, const Scale& scale, const Fits& fits,
                                       const Candidate& cause) {
  const PreparedSet& set = study.set;
  const auto subtract = [&study](const Fit& fit) {
    return study.make_model(fit.hypothesis).subtract_from_measured(fit.unknowns, fit.simulated);
  };
  Eigen::VectorXd before = subtract(study.null.fit);
  Eigen::VectorXd after = subtract(cause.fit);
  std::map<std::size_t, std::set<std::size_t>> counted;  // phases by run
  for (const StretchPrediction& at : predict_stretches(study, fits, cause)) {
    if (!at.is_judged) continue;
    counted[at.run].insert(at.phase);
    for (const Series& series : set.series()) {
      if (series.run != at.run) continue;
      for (std::size_t k = 0; k < series.size(); ++k) {
        if (series.phase[k] != at.phase) continue;
        const auto row = to_index(series.first_residual + k);
        before[row] = at.before[row];
        after[row] = at.after[row];
      }
    }
  }
  BeforeAfter left;
  for (const auto& [run, phases] : counted) {
    add_run(scale, run, before, left.before, &phases);
    add_run(scale, run, after, left.after, &phases);
  }
  return left;
}

BeforeAfter measure_fitted(const Study& study, const Scale& scale, const Candidate& cause) {
  return {measure_runs(scale, study.null.fit.simulated), measure_runs(scale, cause.fit.simulated)};
}

/// Sum over all that can be left out, one at a time: by how much the cause makes it likelier, in nats. These are the
/// runs, or with a single run its stretches; and, taken together, the numbers of the files that the runs determine
/// better.
double calc_left_out_nats(const Study& study, const Fits& fits) {
  const bool by_runs = study.set.runs().size() > 1;
  std::vector<LeftOutPart> parts;
  for (const auto& [run, phase] : list_stretches(study.set)) {
    if (!by_runs) parts.push_back({run, phase});
    if (by_runs && (parts.empty() || parts.back().run != run)) parts.push_back({run});
  }
  std::vector<double> ratios(parts.size());
  parallel_for(parts.size(), study.settings.threads, [&](std::size_t i) {
    ratios[i] = fits.with_cause->calc_log_likelihood(parts[i]) - fits.null.calc_log_likelihood(parts[i]);
  });
  const std::vector<std::size_t> of_null = fits.null.list_determined();
  const std::vector<std::size_t> of_cause = fits.with_cause->list_determined();
  std::vector<std::size_t> base;
  std::set_intersection(of_null.begin(), of_null.end(), of_cause.begin(), of_cause.end(), std::back_inserter(base));
  const double of_files =
      fits.with_cause->calc_log_likelihood_of_files(base) - fits.null.calc_log_likelihood_of_files(base);
  return std::accumulate(ratios.begin(), ratios.end(), of_files);
}

/// By what the cause is judged: the runs that count. If there are none, or no gap above the noise in them, the
/// stretches that count; also if the runs do not decide about a single effect (their interval holds 0 %) and the
/// stretches confirm it. nullptr if there are none either.
const BeforeAfter* choose_judge(const Gap& gap, bool is_single, const RunsLeftOut& runs, const BeforeAfter& stretches) {
  const bool by_runs = gap.runs.has_value() && gap.runs->percent.has_value();
  const bool by_stretches = gap.stretches.has_value() && gap.stretches->percent.has_value();
  const bool is_open = by_runs && gap.runs->ci95_percent[0] <= 0.0 && gap.runs->ci95_percent[1] > 0.0;
  const bool is_confirmed = by_stretches && gap.stretches->ci95_percent[0] > 0.0;
  if (by_runs && !(is_single && is_open && is_confirmed)) return &runs.certain;
  if (by_stretches) return &stretches;
  if (gap.runs.has_value()) return &runs.certain;
  return gap.stretches.has_value() ? &stretches : nullptr;
}

std::vector<ChannelGap> list_channels(const PreparedSet& set, const Measure& before, const Measure& after) {
  const std::vector<ChannelRms> was = list_channel_rms(set, before);
  const std::vector<ChannelRms> is = list_channel_rms(set, after);
  std::vector<ChannelGap> channels;
  for (std::size_t c = 0; c < was.size(); ++c) channels.push_back({was[c].channel, was[c].unit, was[c].rms, is[c].rms});
  return channels;
}

}  // namespace

Gap find_gap(const Study& study, const Candidate* cause, const BlackBox& black_box) {
  Gap gap;
  const Scale scale{study.set, EnergyScale(study.set)};
  const Fits fits(study, cause);
  const RunsLeftOut left = measure_runs_left_out(study, scale, fits, black_box);
  gap.held_out = left.runs;
  gap.not_judged = left.not_judged;
  const BeforeAfter calibrated{measure_as_calibrated(study, scale, study.null), {}};
  gap.as_calibrated.before = gap_of(calibrated.before);
  gap.as_calibrated.after =
      cause != nullptr ? gap_of(measure_as_calibrated(study, scale, *cause)) : gap.as_calibrated.before;
  if (left.all.is_empty()) {  // recalibration is not known to help
    gap.recalibrated = {gap.as_calibrated.before, gap.as_calibrated.before};
    gap.channels = list_channels(study.set, calibrated.before, calibrated.before);
    return gap;
  }
  const Shrinkage recalibrated = resample(left.all.before, left.all.before);
  if (gap.as_calibrated.before > 0.0) {
    gap.recalibration_percent = shrink_percent(gap.as_calibrated.before, recalibrated.gap.before);
  }
  if (recalibrated.percent.has_value() && !left.runs.empty())
    gap.black_box_percent = shrink_percent(recalibrated.gap.before, gap_of(left.black_box));
  const BeforeAfter* shown = &left.all;
  BeforeAfter fitted;
  BeforeAfter stretches;
  if (cause != nullptr) {
    fitted = measure_fitted(study, scale, *cause);
    stretches = measure_stretches_left_out(study, scale, fits, *cause);
    gap.fitted = resample(fitted.before, fitted.after);
    if (!stretches.is_empty()) gap.stretches = resample(stretches.before, stretches.after);
    if (!left.certain.is_empty()) gap.runs = resample(left.certain.before, left.certain.after);
    gap.left_out_nats = calc_left_out_nats(study, fits);
    const bool is_single = cause->fit.hypothesis.terms.size() == 1;
    const BeforeAfter* judge = choose_judge(gap, is_single, left, stretches);
    shown = judge != nullptr ? judge : &fitted;
    if (judge != nullptr) {
      const bool is_by_runs = judge == &left.certain;
      const Shrinkage& by = is_by_runs ? *gap.runs : *gap.stretches;
      gap.judged_by = is_by_runs ? JudgedBy::kRuns : JudgedBy::kStretches;
      gap.shrink_percent = by.percent;
      gap.shrink_ci95_percent = by.ci95_percent;
      gap.worse_where_certain = by.percent.has_value() && by.ci95_percent[1] < 0.0;
    }
    gap.judged_on = left.certain_runs;
  }
  gap.recalibrated = {gap_of(shown->before), gap_of(shown->after)};
  gap.channels = list_channels(study.set, shown->before, shown->after);
  return gap;
}

}  // namespace rollrig::diagnosis
