#include <algorithm>

#include "validation/scoring/score.h"

namespace rollrig::validation {
namespace {

using diagnosis::Verdict;
using Cases = std::vector<Case>;
using Is = std::function<bool(const Case&)>;

constexpr std::size_t kTop = 3;  // places of "top-3"
constexpr double kMedian = 0.5;
constexpr double kTenth = 0.1;

Cases only(const Cases& cases, const Is& wanted) {
  Cases some;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(some), wanted);
  return some;
}

/// The share of k in n.
Figure make_proportion(const char* id, const char* label, std::size_t k, std::size_t n) {
  Figure figure{id, label};
  figure.n = n;
  figure.k = k;
  if (figure.n > 0) {
    figure.value = static_cast<double>(figure.k) / static_cast<double>(figure.n);
    figure.interval = calc_wilson_95(figure.k, figure.n);
  } else {
    figure.note = "no such case";
  }
  return figure;
}

/// The share of the cases `of` that count.
Figure make_share(const char* id, const char* label, const Cases& of, const Is& counts) {
  return make_proportion(id, label, static_cast<std::size_t>(std::count_if(of.begin(), of.end(), counts)), of.size());
}

/// A number over `n` cases, of which less is better.
Figure make_number(const char* id, const char* label, std::optional<double> value, std::size_t n, Unit unit) {
  Figure figure{id, label, value};
  figure.n = n;
  figure.unit = unit;
  figure.more_is_better = false;
  if (!value.has_value()) figure.note = "no such case";
  return figure;
}

Figure at_least(double target, Figure figure, std::optional<double> floor = std::nullopt) {
  figure.target = target;
  figure.floor = floor;
  figure.more_is_better = true;
  return figure;
}

Figure at_most(double target, Figure figure, std::optional<double> floor = std::nullopt) {
  figure = at_least(target, std::move(figure), floor);
  figure.more_is_better = false;
  return figure;
}

std::optional<double> quantile(const std::vector<double>& values, double share) {
  if (values.empty()) return std::nullopt;
  return calc_quantile(values, share);
}

bool is_detectable(const Case& one, const ScoreOptions& options) {
  if (one.d_prime.has_value()) return *one.d_prime >= options.detectable_d_prime;
  return one.truth.signal_floors >= options.detectable_floors;
}

void add_names(const Cases& cases, const ScoreOptions& options, std::vector<Figure>& figures) {
  const auto is_named = [](const Case& one) { return one.is_named(); };
  const Cases singles = only(cases, [](const Case& one) { return one.is_single(); });
  const Cases detectable = only(singles, [&](const Case& one) { return is_detectable(one, options); });
  // Without any upper bound all count; with d' alone none is known to be.
  const Cases identifiable =
      only(detectable, [](const Case& one) { return one.identifiable.value_or(!one.d_prime.has_value()); });
  figures.push_back(at_least(
      0.99, make_share("detection", "detection, detectable singles", detectable,
                       [](const Case& one) { return one.answer.failure.empty() && !one.is(Verdict::kNoGap); })));
  figures.back().upper_bound = find_mean_chance(detectable, find_chance_of_detection);
  figures.push_back(at_most(
      0.01,
      make_share("false_alarms", "false alarms, no effect", only(cases, [](const Case& one) { return one.is_clean(); }),
                 [](const Case& one) { return !one.is(Verdict::kNoGap); }),
      0.02));
  figures.push_back(
      at_least(0.97, make_share("top1_set_aware", "top-1 set-aware, detectable", detectable, is_named), 0.92));
  figures.back().upper_bound = find_mean_chance(detectable, find_chance_of_small_set);
  figures.push_back(at_least(0.93, make_share("top1_strict", "  without a false companion", detectable,
                                              [](const Case& one) { return one.is_named_strictly(); })));
  figures.push_back(at_most(0.02, make_share("refused", "  unexplained", detectable,
                                             [](const Case& one) { return one.is(Verdict::kUnexplained); })));
  figures.push_back(at_least(0.95, make_share("top1_exact", "top-1 exact, identifiable", identifiable,
                                              [](const Case& one) { return one.is_exact(); })));
  figures.push_back(
      at_least(0.98,
               make_share("top3", "top-3, all singles", singles,
                          [](const Case& one) { return one.answer.failure.empty() && one.rank_of_truth() < kTop; }),
               0.95));
  const Cases pairs = only(cases, [](const Case& one) { return one.is_pair(); });
  figures.push_back(at_least(0.90, make_share("pairs", "pairs, both named", pairs, is_named)));
  figures.back().upper_bound =
      find_mean_chance(pairs, [&](const Case& one) { return find_chance_of_pair(one, options.detectable_d_prime); });
  // Only a computed bound tells that the second effect can be seen beside the first.
  const Cases identifiable_pairs = only(pairs, [&](const Case& one) {
    return one.d_prime.has_value() && is_detectable(one, options) && one.identifiable.value_or(false);
  });
  figures.push_back(
      at_least(0.90, make_share("pairs_identifiable", "  of those that can be told", identifiable_pairs, is_named)));
  const Cases of_ideal = only(pairs, [](const Case& one) { return is_pair_named_by_ideal(one).value_or(false); });
  figures.push_back(
      at_least(0.90, make_share("pairs_of_ideal", "  of those an ideal observer names", of_ideal, is_named)));
}

/// Of three effects at once: in how many cases all are named, and in how many of the answers all that is named acts.
void add_triples(const Cases& cases, std::vector<Figure>& figures) {
  const Cases triples = only(cases, [](const Case& one) { return one.is_triple(); });
  figures.push_back(
      make_share("triples", "triples, all named", triples, [](const Case& one) { return one.is_named(); }));
  const Cases answered = only(triples, [](const Case& one) { return one.stated_acts().has_value(); });
  figures.push_back(make_share("triples_acting", "  what is named acts", answered,
                               [](const Case& one) { return one.stated_acts()->right; }));
}

/// Of the effects that are said to act with more than 0.9, those that do not.
Figure find_false_claims(const Cases& cases) {
  Figure figure{"false_claims", "false claims above 0.9"};
  for (const Case& one : cases) {
    figure.n += one.claims_above(kConfident).size();
    figure.k += one.false_claims_above(kConfident).size();
  }
  if (figure.n == 0) {
    figure.note = "no such claim";
    return figure;
  }
  figure.value = static_cast<double>(figure.k) / static_cast<double>(figure.n);
  figure.interval = calc_wilson_95(figure.k, figure.n);
  return figure;
}

/// What is stated, by Case::stated_alone or Case::stated_acts, in the cases that state it.
std::vector<Stated> list_stated_by(std::optional<Stated> (Case::*stated_by)() const, const Cases& cases) {
  std::vector<Stated> all;
  for (const Case& one : cases) {
    if (const auto stated = (one.*stated_by)()) all.push_back(*stated);
  }
  return all;
}

std::optional<double> calc_ece_of(const Cases& cases) {
  const std::vector<Stated> stated = list_stated(cases);
  return stated.empty() ? std::nullopt : std::optional<double>(calc_ece(find_reliability(stated)));
}

void add_confidence(const Cases& cases, const ScoreOptions& options, std::vector<Figure>& figures) {
  const Cases inside = only(cases, [](const Case& one) { return one.is_inside(); });
  const Cases outside = only(cases, [](const Case& one) { return one.truth.outside; });
  const auto wrong = [](const Case& one) { return one.is_wrong_above(kConfident); };
  figures.push_back(
      at_most(0.01, make_share("wrong_above_inside", "wrong above 0.9, in the catalog", inside, wrong), 0.02));
  figures.push_back(make_share("wrong_above_half", "  with one of two named, alone", inside,
                               [&](const Case& one) { return wrong(one) && one.names_one_of_two(); }));
  figures.back().more_is_better = false;
  const Cases calls = only(inside, [&](const Case& one) { return wrong(one) || one.is_right_above(kConfident); });
  figures.push_back(at_most(0.01, make_share("wrong_above_of_calls", "  of what is stated above 0.9", calls, wrong)));
  figures.push_back(at_most(0.02, find_false_claims(inside)));
  figures.push_back(
      at_most(0.05, make_share("wrong_above_outside", "wrong above 0.9, outside of it", outside, wrong), 0.08));
  figures.push_back(at_least(0.90, make_share("abstention", "abstention, outside of it", outside, [](const Case& one) {
                               return one.answer.failure.empty() && !one.is(Verdict::kExplained);
                             })));
  const std::vector<Stated> stated = list_stated(cases);
  figures.push_back(
      at_most(0.02, make_number("ece", "calibration, ECE", calc_ece_of(cases), stated.size(), Unit::kNumber)));
  const auto floor_of = [](const std::vector<Stated>& all) {
    return all.empty() ? std::nullopt : std::optional<double>(calc_ece_noise_floor(all));
  };
  figures.push_back(make_number("ece_floor", "  its noise floor", floor_of(stated), stated.size(), Unit::kNumber));
  const auto add_part = [&](const char* id, const char* floor_id, const char* words, const std::vector<Stated>& part) {
    const auto ece = part.empty() ? std::nullopt : std::optional<double>(calc_ece(find_reliability(part)));
    figures.push_back(make_number(id, words, ece, part.size(), Unit::kNumber));
    figures.push_back(make_number(floor_id, "  its noise floor", floor_of(part), part.size(), Unit::kNumber));
  };
  add_part("ece_acts", "ece_acts_floor", "  of the cause acting", list_stated_by(&Case::stated_acts, cases));
  add_part("ece_alone", "ece_alone_floor", "  of the cause acting alone", list_stated_by(&Case::stated_alone, cases));
  const Cases visible = only(cases, [&](const Case& one) { return one.is_clean() || is_detectable(one, options); });
  figures.push_back(
      make_number("ece_visible", "  without what cannot be seen", calc_ece_of(visible), visible.size(), Unit::kNumber));
  const auto brier = stated.empty() ? std::nullopt : std::optional<double>(calc_brier(stated));
  figures.push_back(
      at_most(0.08, make_number("brier", "calibration, Brier score", brier, stated.size(), Unit::kNumber)));
}

void add_sizes(const Cases& cases, std::vector<Figure>& figures) {
  const Cases sized = only(cases, [](const Case& one) { return one.check_size().has_value(); });
  std::vector<double> errors;
  for (const Case& one : sized) errors.push_back(one.check_size()->error);
  figures.push_back(at_most(
      0.05, make_number("size_error", "size, median error", quantile(errors, kMedian), errors.size(), Unit::kPercent)));
  figures.push_back(make_share("size_coverage", "size, held by its 95 % interval", sized,
                               [](const Case& one) { return one.check_size()->covered; }));
}

void add_shrinkage(const Cases& cases, std::vector<Figure>& figures) {
  std::vector<double> ratios;
  for (const Case& one : cases) {
    if (!one.known_cause_shrink_percent.has_value() || *one.known_cause_shrink_percent <= 0.0) continue;
    if (!one.is_inside()) continue;
    ratios.push_back(one.answer.diagnosis.gap.shrink_percent.value_or(0.0) / *one.known_cause_shrink_percent);
  }
  figures.push_back(at_least(0.97, make_number("shrinkage_median", "shrinkage/known cause's, median",
                                               quantile(ratios, kMedian), ratios.size(), Unit::kNumber)));
  figures.push_back(at_least(0.8, make_number("shrinkage_tenth", "  10th percentile", quantile(ratios, kTenth),
                                              ratios.size(), Unit::kNumber)));
  if (ratios.empty()) {
    figures.end()[-1].note = figures.end()[-2].note = "not measured: rollrig_validation known-cause";
  }
}

/// Of the sets with an effect of the catalog whose next test was done: in how many it splits what was named.
void add_next_tests(const Cases& cases, std::vector<Figure>& figures) {
  const auto is_done = [](const Case& one, std::optional<FollowUp> Case::*test) {
    return one.is_inside() && (one.*test).has_value() && (one.*test)->answer.has_value();
  };
  const auto add = [&](const char* id, const char* label, std::optional<FollowUp> Case::*test, const char* how) {
    figures.push_back(make_share(id, label, only(cases, [&](const Case& one) { return is_done(one, test); }),
                                 [test](const Case& one) { return one.is_split_by(*(one.*test)); }));
    const bool any =
        std::any_of(cases.begin(), cases.end(), [test](const Case& one) { return (one.*test).has_value(); });
    if (!any) figures.back().note = how;
  };
  add("next_test", "next test splits the set", &Case::next_test, "not measured: rollrig_validation plan");
  figures.back().target = 0.90;
  const Cases promised = only(
      cases, [&](const Case& one) { return is_done(one, &Case::next_test) && one.next_test->is_promised(one.answer); });
  figures.push_back(make_share("promised_test", "  where it is said to", promised,
                               [](const Case& one) { return one.is_split_by(*one.next_test); }));
  if (promised.empty()) figures.back().note = figures.end()[-2].value ? "no such case" : figures.end()[-2].note;
  add("drawn_test", "  one drawn from the menu", &Case::drawn_test, "not measured: rollrig_validation plan --drawn");
}

/// Where the gap lies: the first location of each answer, and all that are named.
void add_locations(const Cases& cases, std::vector<Figure>& figures) {
  LocationTally tally;
  for (const Case& one : cases) tally.add(one);
  const bool is_known = std::any_of(cases.begin(), cases.end(), [](const Case& one) { return !one.places.empty(); });
  const auto add = [&](const char* id, const char* label, std::size_t k, std::size_t n) {
    Figure figure = make_proportion(id, label, k, n);
    if (!is_known) figure.note = "not measured: rollrig_validation locations";
    figures.push_back(at_least(0.90, std::move(figure)));
  };
  add("location", "location of the largest gap", tally.all_three, tally.answers);
  add("location_channel", "  its channel", tally.channel, tally.answers);
  add("location_run", "  its run", tally.run, tally.answers);
  add("location_phase", "  its phase", tally.phase, tally.answers);
  add("locations_named", "all locations that are named", tally.shifted, tally.named);
}

void add_the_rest(const Cases& cases, std::vector<Figure>& figures) {
  Tally all;
  std::vector<double> seconds;
  for (const Case& one : cases) {
    if (one.is_inside()) all.add(one);
    seconds.push_back(one.answer.cpu_seconds);
  }
  const std::size_t explained = all.named + all.named_wrong;
  add_next_tests(cases, figures);
  const auto mean = explained > 0 ? std::optional<double>(all.mean_named_set()) : std::nullopt;
  figures.push_back(
      at_most(1.3, make_number("named_set", "mean size of the named set", mean, explained, Unit::kNumber), 1.5));
  figures.push_back(make_number("time_median", "CPU time of a case, median", quantile(seconds, kMedian), seconds.size(),
                                Unit::kSeconds));
  figures.push_back(
      at_most(30.0, make_number("time_largest", "  largest", quantile(seconds, 1.0), seconds.size(), Unit::kSeconds)));
}

}  // namespace

std::vector<Stated> list_stated(const Cases& cases) {
  std::vector<Stated> stated;
  for (const Case& one : cases) {
    if (one.answer.failure.empty()) stated.push_back(one.stated());
  }
  return stated;
}

std::vector<Figure> find_figures(const std::vector<Case>& cases, const ScoreOptions& options) {
  std::vector<Figure> figures;
  add_names(cases, options, figures);
  add_triples(cases, figures);
  add_confidence(cases, options, figures);
  add_sizes(cases, figures);
  add_shrinkage(cases, figures);
  add_locations(cases, figures);
  add_the_rest(cases, figures);
  return figures;
}

}  // namespace rollrig::validation
