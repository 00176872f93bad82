#include "diagnosis/findings/verdict.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "diagnosis/comparison/base_moves.h"
#include "diagnosis/comparison/evidence.h"
#include "diagnosis/comparison/truncated_normal.h"
#include "diagnosis/findings/common_value.h"
#include "diagnosis/findings/lead.h"
#include "diagnosis/findings/partners.h"
#include "sim/core/units.h"

namespace rollrig::diagnosis {
namespace {

bool was_fitted(const Candidate& candidate) { return std::isfinite(candidate.fit.cost); }

/// How far a fitted parameter is from the value at which its term does nothing, in prior units.
double distance_from_off(const Model::OwnParameter& own, double u) {
  const PriorUnits value = own.value_at(u);
  const double off_SI = own.declared->off.value_or(0.0) * unit_of_key(own.declared->key).factor;
  return std::abs((value.value_SI - off_SI) / value.derivative_SI);
}

/// Where own parameters of a candidate lie after the measurement, in prior units, before their ranges cut them off.
struct OwnPosterior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Of own parameter i, given that all others which their range holds back are on its limit; of the others, what their
/// ranges allow is not followed further.
TruncatedNormal find_own_posterior(const Model& model, const Candidate& candidate, const OwnPosterior& posterior,
                                   std::size_t i) {
  const Eigen::VectorXd& u = candidate.fit.unknowns;
  const Eigen::Index at = to_index(i);
  std::vector<Eigen::Index> held;
  for (std::size_t k = 0; k < model.own_count(); ++k) {
    const PriorBounds bounds = model.own_parameters()[k].bounds();
    const double mean = posterior.mean[to_index(k)];
    if (k != i && (mean < bounds.lower || mean > bounds.upper)) held.push_back(to_index(k));
  }
  double mean = posterior.mean[at];
  double variance = posterior.covariance(at, at);
  if (!held.empty()) {
    const Eigen::MatrixXd among = posterior.covariance(held, held);
    const Eigen::VectorXd with = posterior.covariance(held, at);
    const Eigen::VectorXd back = u(held) - posterior.mean(held);
    const Eigen::VectorXd gain = among.llt().solve(with);
    mean += gain.dot(back);
    variance -= gain.dot(with);
  }
  const PriorBounds bounds = model.own_parameters()[i].bounds();
  const bool is_held = mean < bounds.lower || mean > bounds.upper;
  return {is_held ? mean : u[at], std::sqrt(variance), bounds.lower, bounds.upper};
}

OwnPosterior find_own_posterior(const Study& study, const Candidate& candidate, std::size_t own_count) {
  const Evidence::Solution solution = Evidence(study.discrepancy, candidate.fit).solve(candidate.amplitudes, true);
  const Eigen::Index own = to_index(own_count);
  return {candidate.fit.unknowns.head(own) + solution.step.head(own), solution.covariance.topLeftCorner(own, own)};
}

/// Which limit of its range holds a fitted parameter back.
RangeLimit find_limit(const TruncatedNormal& posterior, double u) {
  constexpr double kAt = 0.01;  // prior units
  if (posterior.mean > posterior.upper || u > posterior.upper - kAt) return RangeLimit::kUpper;
  if (posterior.mean < posterior.lower || u < posterior.lower + kAt) return RangeLimit::kLower;
  return RangeLimit::kNone;
}

/// Seen from the value and not from the unknown: a negative sign mirrors the two.
RangeLimit mirror(RangeLimit limit) {
  if (limit == RangeLimit::kNone) return limit;
  return limit == RangeLimit::kLower ? RangeLimit::kUpper : RangeLimit::kLower;
}

}  // namespace

std::vector<ParameterEstimate> estimate_parameters(const Study& study, const Candidate& candidate) {
  const Model model = study.make_model(candidate.fit.hypothesis);
  const OwnPosterior posterior = find_own_posterior(study, candidate, model.own_count());
  std::vector<ParameterEstimate> estimates;
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const Model::OwnParameter& own = model.own_parameters()[i];
    const Unit unit = unit_of_key(own.declared->key);
    const double u = candidate.fit.unknowns[to_index(i)];
    const double of_law_u = own.is_size() ? study.settings.model_error.size_share * distance_from_off(own, u) : 0.0;
    TruncatedNormal within = find_own_posterior(model, candidate, posterior, i);
    const RangeLimit limit = find_limit(within, u);
    within.sd = std::hypot(within.sd, of_law_u);
    const TruncatedSpread spread = find_spread(within);
    const auto value_at = [&](double at) { return own.value_at(at).value_SI / unit.factor; };
    const double derivative = own.value_at(u).derivative_SI / unit.factor;
    const auto [low, high] = std::minmax({value_at(spread.low_95), value_at(spread.high_95)});
    estimates.push_back({fmt::format("{}.{}", own.term->name(), own.declared->key), value_at(u),
                         std::abs(derivative) * spread.sd, low, high, unit.symbol,
                         derivative < 0.0 ? mirror(limit) : limit});
  }
  return estimates;
}

namespace {

/// Whether the size that each run by itself asks for is one: chi2 of the runs' shifts, in prior units, about their
/// mean. A run's shift is judged by its own residual along the size's derivative, everything else of the fit held,
/// where it alone says more than the prior and knows the size to within `allowed_u`.
bool differs_between_runs(const Study& study, const Candidate& candidate, std::size_t size_column, double allowed_u) {
  RowMatrix jacobian = candidate.fit.jacobian;
  Eigen::VectorXd residual = candidate.fit.residuals;
  study.discrepancy.whiten(candidate.amplitudes, jacobian);
  study.discrepancy.whiten(candidate.amplitudes, residual);
  // The size's direction once all other unknowns have taken what they can.
  const Eigen::Index n = jacobian.cols();
  const Eigen::VectorXd size = jacobian.col(to_index(size_column));
  RowMatrix others = jacobian;
  others.col(to_index(size_column)).setZero();
  const Eigen::LLT<Eigen::MatrixXd> curvature(others.transpose() * others + Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd direction = size - others * curvature.solve(others.transpose() * size);
  std::vector<Estimate> shifts;
  for (std::size_t run = 0; run < study.set.runs().size(); ++run) {
    double along = 0.0;
    double square = 0.0;
    for (const Series& series : study.set.series()) {
      if (series.run != run) continue;
      const auto d = series.rows_of(direction);
      along += d.dot(series.rows_of(residual));
      square += d.squaredNorm();
    }
    const bool is_witness = square > 1.0 && square > 1.0 / (allowed_u * allowed_u);  // no vaguer than what is allowed
    if (!is_witness) continue;
    shifts.push_back({-along / square, 1.0 / square + allowed_u * allowed_u});
  }
  return !shifts.empty() && find_common_value(shifts).chance < thresholds::kRunSizeChance;
}

/// Whether the measurement asks for a value clearly beyond the range.
bool lies_beyond_range(const Model& model, const Candidate& candidate, const OwnPosterior& posterior, std::size_t i) {
  const TruncatedNormal of = find_own_posterior(model, candidate, posterior, i);
  return std::max(of.mean - of.upper, of.lower - of.mean) > thresholds::kBeyondRange_sd * of.sd;
}

/// What speaks against a candidate.
struct Objection {
  std::string text;
  double kept = 1.0;              // share of truths among causes with it,
  double kept_confirmed = 1.0;    // and among those of them that data left out clearly confirm
  const Term* unusual = nullptr;  // term with a parameter far out in its prior
};

std::vector<Objection> find_objections(const Study& study, const Candidate& candidate) {
  std::vector<Objection> objections;
  if (candidate.discrepancy_probability > candidate.probability) {
    constexpr double kBeyondDoubt_nats = 50.0;
    const double gain_nats = candidate.log_discrepancy - candidate.log_evidence;
    const std::string by =
        gain_nats < kBeyondDoubt_nats ? fmt::format("{:.0f} nats likelier", gain_nats) : "likelier beyond all doubt";
    objections.push_back({"something else is missing: a free discrepancy on top of it is " + by,
                          thresholds::kKeptRemainder, thresholds::kKeptRemainder});
  }
  const Model model = study.make_model(candidate.fit.hypothesis);
  const OwnPosterior posterior = find_own_posterior(study, candidate, model.own_count());
  for (std::size_t i = 0; i < model.own_count(); ++i) {
    const Model::OwnParameter& own = model.own_parameters()[i];
    const char* key = own.declared->key;
    const double u = candidate.fit.unknowns[to_index(i)];
    if (std::abs(u) > thresholds::kTail_sd) {
      objections.push_back(
          {fmt::format("{} of {} would have to be {:.3g}, {:.1f} standard deviations from what is usual", key,
                       own.term->name(), own.value_at(u).value_SI / unit_of_key(key).factor, std::abs(u)),
           thresholds::kKeptUnusual, thresholds::kKeptConfirmed, own.term});
    }
    if (own.is_size() && lies_beyond_range(model, candidate, posterior, i)) {
      objections.push_back(
          {fmt::format("{} of {} would have to lie beyond its range ({}); the best within it is {:.3g}", key,
                       own.term->name(), own.declared->range.to_string(),
                       own.value_at(u).value_SI / unit_of_key(key).factor),
           thresholds::kKeptBeyondRange, thresholds::kKeptBeyondRange});
    }
    if (own.is_size() &&
        differs_between_runs(study, candidate, i, thresholds::kRunSizeShare * distance_from_off(own, u))) {
      objections.push_back({fmt::format("its size ({}) differs from run to run", key), thresholds::kKeptRunSize,
                            thresholds::kKeptRunSize});
    }
  }
  if (const std::string moved = describe_far_moves(study, candidate.fit); !moved.empty()) {
    objections.push_back({"with it, numbers of the files would have to be wrong: they move by " + moved,
                          thresholds::kKeptWrongFiles, thresholds::kKeptConfirmed});
  }
  return objections;
}

/// Of a pair the effect that is far out in its prior, where nothing else speaks against the pair: it is not named, the
/// other is. Else nullptr.
const Term* find_unusual_companion(const Candidate& pair, const std::vector<Objection>& objections) {
  if (pair.fit.hypothesis.terms.size() != 2 || objections.empty()) return nullptr;
  const Term* unusual = objections.front().unusual;
  const bool is_one = std::all_of(objections.begin(), objections.end(),
                                  [unusual](const Objection& objection) { return objection.unusual == unusual; });
  return is_one ? unusual : nullptr;
}

void put_objections(const Study& study, const Candidate& lead, Cause& cause) {
  const std::vector<Objection> objections = find_objections(study, lead);
  const Term* companion = find_unusual_companion(lead, objections);
  for (const Objection& objection : objections) {
    (companion != nullptr ? cause.companions : cause.objections).push_back(objection.text);
    cause.kept = std::min(cause.kept, objection.kept);
    cause.kept_confirmed = std::min(cause.kept_confirmed, objection.kept_confirmed);
  }
  if (companion == nullptr) return;
  const std::string& name = companion->name();
  cause.effects.erase(std::remove(cause.effects.begin(), cause.effects.end(), name), cause.effects.end());
  const auto is_of_companion = [&name](const ParameterEstimate& one) { return one.name.rfind(name + ".", 0) == 0; };
  cause.parameters.erase(std::remove_if(cause.parameters.begin(), cause.parameters.end(), is_of_companion),
                         cause.parameters.end());
}

/// Probability of what was not fitted and has all effects of one of these hypotheses.
double sum_on_top_of(const std::vector<const Candidate*>& hypotheses, const std::vector<Unfitted>& unfitted) {
  double sum = 0.0;
  for (const Unfitted& one : unfitted) {
    const bool is_on_top = std::any_of(hypotheses.begin(), hypotheses.end(), [&](const Candidate* candidate) {
      return contains_all(one.names, candidate->fit.hypothesis.names());
    });
    if (is_on_top) sum += one.probability;
  }
  return sum;
}

/// Probability of those of the hypotheses whose effects a cause names all.
double sum_named_whole(const std::vector<const Candidate*>& hypotheses, const Cause& cause) {
  std::vector<std::string> named = cause.effects;
  named.insert(named.end(), cause.indistinguishable_from.begin(), cause.indistinguishable_from.end());
  double sum = 0.0;
  for (const Candidate* candidate : hypotheses) {
    if (contains_all(named, candidate->fit.hypothesis.names())) sum += candidate->probability;
  }
  return sum;
}

/// Whether what was left out confirms a cause although the interval of what it shrinks holds 0, as it may where the gap
/// is hardly above the noise, or where few runs are judged.
bool is_confirmed_otherwise(const Gap& gap) {
  if (!(gap.left_out_nats.value_or(0.0) >= thresholds::kConfirmed_nats)) return false;
  if (gap.recalibrated.before < thresholds::kFaintGap_floors) return true;
  if (*gap.shrink_percent >= thresholds::kClearShrink_percent) return true;
  if (gap.judged_by != JudgedBy::kRuns || !gap.stretches.has_value()) return false;
  const Shrinkage& stretches = *gap.stretches;
  return stretches.percent.value_or(0.0) >= thresholds::kClearShrink_percent && stretches.ci95_percent[0] > 0.0;
}

/// Whether a cause takes a clear part of the gap of what was left out, and makes that likelier: it predicts new data,
/// whatever its law or the files have to look like for that.
bool is_clearly_confirmed(const Gap& gap) {
  return gap.left_out_nats.value_or(0.0) >= thresholds::kConfirmed_nats && gap.shrink_percent.has_value() &&
         gap.shrink_ci95_percent[0] >= thresholds::kClearShrink_percent;
}

/// The cause that comes first: the most probable one, unless it is a part of the first in the list, which belongs to
/// the likeliest hypothesis.
std::vector<Cause>::iterator find_first(std::vector<Cause>& causes) {
  const auto most = std::max_element(causes.begin(), causes.end(),
                                     [](const Cause& a, const Cause& b) { return a.probability < b.probability; });
  return contains_all(causes.front().effects, most->effects) ? causes.begin() : most;
}

}  // namespace

std::map<std::string, double> find_probabilities(const Study& study, const Comparison& comparison) {
  std::map<std::string, double> probability{{"none", study.null.probability},
                                            {"unknown", comparison.unknown_probability}};
  for (const Term* term : study.settings.terms) {
    double& sum = probability[term->name()];
    for (const Candidate& candidate : comparison.candidates) {
      if (candidate.fit.hypothesis.contains(*term)) sum += candidate.probability;
    }
    for (const Unfitted& unfitted : comparison.unfitted) {
      if (unfitted.contains(term->name())) sum += unfitted.probability;
    }
  }
  return probability;
}

std::vector<Cause> find_causes(const Study& study, const Comparison& comparison) {
  std::vector<const Candidate*> left;
  for (const Candidate& candidate : comparison.candidates) {
    if (was_fitted(candidate) && !candidate.fit.hypothesis.has_unknown()) left.push_back(&candidate);
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const Candidate* a, const Candidate* b) { return a->posterior() > b->posterior(); });
  std::vector<Cause> causes;
  std::vector<const Candidate*> leads;
  std::set<const Candidate*> taken;
  std::vector<const Candidate*> in_order = left;
  if (!left.empty()) in_order.insert(in_order.begin(), choose_lead(study, {left, comparison.unfitted}, *left.front()));
  for (const Candidate* lead : in_order) {
    if (taken.count(lead) > 0) continue;
    if (!causes.empty() && lead->posterior() < thresholds::kWorthNaming) break;
    Cause cause;
    cause.effects = lead->fit.hypothesis.names();
    std::map<std::string, double> beside;
    std::vector<const Candidate*> alike;
    for (const Candidate* other : left) {
      if (taken.count(other) > 0) continue;
      const bool is_larger = other->fit.hypothesis.terms.size() > lead->fit.hypothesis.terms.size() &&
                             contains_all(other->fit.hypothesis.names(), cause.effects);
      if (!is_larger && is_told_apart(study, *lead, *other)) continue;
      taken.insert(other);
      cause.probability += other->probability;
      if (other->fit.hypothesis.terms.size() > lead->fit.hypothesis.terms.size()) continue;  // the lead with one more
      alike.push_back(other);
      if (!is_open_beside(*lead, *other)) continue;
      for (const std::string& name : other->fit.hypothesis.names()) beside[name] += other->posterior();
    }
    cause.probability += sum_on_top_of(alike, comparison.unfitted);
    cause.indistinguishable_from = find_named_beside(cause.effects, lead->posterior(), std::move(beside));
    cause.complete = sum_named_whole(alike, cause);
    cause.parameters = estimate_parameters(study, *lead);
    causes.push_back(std::move(cause));
    leads.push_back(lead);
  }
  if (causes.empty()) return causes;
  const auto first = find_first(causes);
  const Candidate& lead = *leads[static_cast<std::size_t>(first - causes.begin())];
  find_partners(comparison, lead, *first);
  put_objections(study, lead, *first);
  first->adequate = first->objections.empty();
  std::rotate(causes.begin(), first, first + 1);
  sort_after_first(causes);
  return causes;
}

void move_probability(const Cause& cause, double moved, const std::string& to,
                      std::map<std::string, double>& probability) {
  probability[to] += moved;
  for (const auto* ids : {&cause.effects, &cause.indistinguishable_from}) {
    for (const std::string& id : *ids) probability[id] -= std::min(probability[id], moved);
  }
}

void weigh_objections(const Gap& gap, std::vector<Cause>& causes, std::map<std::string, double>& probability) {
  if (causes.empty()) return;
  Cause& first = causes.front();
  const char* parts = gap.judged_by == JudgedBy::kStretches ? "stretches" : "runs";
  if (is_clearly_confirmed(gap)) first.kept = first.kept_confirmed;
  if (gap.worse_where_certain) {
    first.objections.push_back(fmt::format("it makes the {} that were left out worse, not better", parts));
    first.kept = std::min(first.kept, thresholds::kKeptUnconfirmed);
  }
  const bool holds_0 = gap.shrink_percent.has_value() && gap.shrink_ci95_percent[0] <= 0.0;
  if (holds_0 && !is_confirmed_otherwise(gap)) {
    first.objections.push_back(
        fmt::format("the {} left out do not confirm it: the interval of what it shrinks holds 0 %", parts));
    first.kept = std::min(first.kept, thresholds::kKeptUnconfirmed);
  }
  if (gap.left_out_nats.has_value() && !(*gap.left_out_nats >= thresholds::kConfirmed_nats)) {
    first.objections.push_back(fmt::format(
        "what was left out is hardly likelier with it: {} and numbers of the files, each predicted from the rest",
        gap.held_out.empty() ? "stretches" : "runs"));
    first.kept = std::min(first.kept, thresholds::kKeptHardlyLikelier);
  }
  first.adequate = first.objections.empty();
  const double moved = (1.0 - first.kept) * first.probability;
  scale_probability(first.kept, first);
  move_probability(first, moved, "unknown", probability);
}

std::vector<std::string> find_not_excluded(const Study& study, const Comparison& comparison,
                                           const std::vector<Cause>& causes) {
  const std::map<std::string, double> probability = find_probabilities(study, comparison);
  double likeliest = probability.at("none");
  for (const Cause& cause : causes) likeliest = std::max(likeliest, cause.probability);
  const auto is_named = [&causes](const std::string& name) {
    if (causes.empty()) return false;
    const auto& [effects, alike] = std::tie(causes.front().effects, causes.front().indistinguishable_from);
    return std::count(effects.begin(), effects.end(), name) + std::count(alike.begin(), alike.end(), name) > 0;
  };
  std::vector<std::string> hidden;
  for (const Term* term : study.settings.terms) {
    const bool is_open = probability.at(term->name()) >= std::exp(-thresholds::kToldApart_nats) * likeliest;
    const bool would_show = comparison.find_detectability(*term) >= thresholds::kDetectableEffect_sd;
    if ((!would_show || is_open) && !is_named(term->name())) hidden.push_back(term->name());
  }
  return hidden;
}

Verdict find_verdict(const std::map<std::string, double>& probability, const std::vector<Cause>& causes) {
  const double none = probability.at("none");
  const double unknown = probability.at("unknown");
  const double named = causes.empty() ? 0.0 : causes.front().probability;
  const bool is_long = !causes.empty() && causes.front().effects.size() + causes.front().indistinguishable_from.size() >
                                              thresholds::kLongSet;
  const bool beats_each =
      std::all_of(probability.begin(), probability.end(), [none](const auto& entry) { return none >= entry.second; });
  if (none >= unknown && (none >= named || (is_long && beats_each))) return Verdict::kNoGap;
  if (unknown >= named) return Verdict::kUnexplained;
  return Verdict::kExplained;
}

}  // namespace rollrig::diagnosis
