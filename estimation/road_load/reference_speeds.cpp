#include "estimation/road_load/reference_speeds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "estimation/road_load/reference_choice.h"
#include "estimation/road_load/road_load_checks.h"
#include "estimation/run_checks/pooled_scatter.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPrecisionLimit = 0.03;  // UN GTR 15 Annex 4, 4.3.1.4.2

void require_both_headings(const std::vector<ReferenceRun>& runs) {
  int ways[2] = {0, 0};
  for (const ReferenceRun& run : runs) {
    if (run.heading != 0) ++ways[run.heading > 0 ? 0 : 1];
  }
  if (ways[0] > 0 && ways[1] > 0) return;
  throw pairing_error(ways[0] + ways[1] == 0 ? "the headings of the runs are not known"
                                             : "all runs have the same heading: the procedure pairs opposite ones",
                      "a column heading with + and -, and runs of both");
}

/// Chance that groups of one mean differ as much: analysis of variance, one way. 1 where nothing tells.
double find_chance_of_groups(const std::map<std::string, std::vector<double>>& groups) {
  double n = 0.0, sum = 0.0, between = 0.0;
  PooledScatter within;
  for (const auto& [name, values] : groups) {
    n += static_cast<double>(values.size());
    sum += calc_mean(values) * static_cast<double>(values.size());
    within.add_group(values);
  }
  for (const auto& [name, values] : groups) {
    between += static_cast<double>(values.size()) * std::pow(calc_mean(values) - sum / n, 2);
  }
  const double between_freedom = static_cast<double>(groups.size()) - 1.0;
  if (between_freedom < 1.0 || within.degrees_of_freedom < 1.0 || !(within.squares > 0.0)) return 1.0;
  const boost::math::fisher_f distribution(between_freedom, within.degrees_of_freedom);
  const double F = between / between_freedom / within.variance();
  return boost::math::cdf(boost::math::complement(distribution, F));
}

/// The pairs, and what they say of each speed.
class PairTable {
 public:
  PairTable(const std::vector<ReferenceRun>& runs, const PairRule& rule, std::vector<ReferencePair>& pairs)
      : runs_(runs), rule_(rule), pairs_(pairs) {}

  double value(const ReferencePair& pair, int speed) const {
    return rule_.join(runs_[pair.plus].values.at(speed), runs_[pair.minus].values.at(speed));
  }
  double resistance(const ReferencePair& pair, int speed) const { return rule_.resistance(value(pair, speed)); }

  /// Pairs that count at a speed; those of one part if it is given.
  std::vector<const ReferencePair*> list(int speed, std::optional<int> part = std::nullopt) const {
    std::vector<const ReferencePair*> having;
    for (const ReferencePair& pair : pairs_) {
      if (pair.rejected.empty() && pair.has(speed) && pair.part == part.value_or(pair.part)) having.push_back(&pair);
    }
    return having;
  }
  std::vector<double> values(int speed) const {
    std::vector<double> values;
    for (const ReferencePair* pair : list(speed)) values.push_back(value(*pair, speed));
    return values;
  }
  const std::string& session_of(const ReferencePair& pair) const { return runs_[pair.plus].session; }

  /// Whether the pairs differ from session to session more than within them: analysis of variance of their mean
  /// relative deviations, p < 0.01. Rejected pairs are in it, but for windy ones and those of a session with no other
  /// pair.
  bool sessions_differ() const {
    constexpr double kUnlikely = 0.01;
    std::map<std::string, std::vector<double>> sessions;
    for (const ReferencePair& pair : pairs_) {
      if (pair.is_windy || !has_counted(session_of(pair))) continue;
      double sum = 0.0;
      for (const int speed : pair.speeds) sum += resistance(pair, speed) / mean_resistance(list(speed), speed) - 1.0;
      sessions[session_of(pair)].push_back(sum / static_cast<double>(pair.speeds.size()));
    }
    return find_chance_of_groups(sessions) < kUnlikely;
  }

  bool has_counted(const std::string& session) const {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [&](const ReferencePair& pair) { return pair.rejected.empty() && session_of(pair) == session; });
  }

  /// A pair, and how far its value at a speed is from the mean there.
  struct Farthest {
    ReferencePair* pair = nullptr;
    double distance = 0.0;
    int speed = 0;
  };

  /// The pair that is farthest from the mean at the speeds where the precision is not met; null if all are met.
  /// `only_spare`: of those without which three pairs stay at each of their speeds.
  Farthest find_farthest(const std::vector<int>& speeds, bool only_spare) const {
    Farthest farthest;
    for (const int speed : speeds) {
      const ReferencePrecision precision = calc_precision(values(speed));
      if (precision.precision <= kPrecisionLimit) continue;
      for (ReferencePair& pair : pairs_) {
        if (!pair.rejected.empty() || !pair.has(speed) || (only_spare && !is_spare(pair))) continue;
        const double distance = std::abs(value(pair, speed) / precision.mean - 1.0);
        if (distance > farthest.distance) farthest = {&pair, distance, speed};
      }
    }
    return farthest;
  }

  double mean_resistance(const std::vector<const ReferencePair*>& pairs, int speed) const {
    double sum = 0.0;
    for (const ReferencePair* pair : pairs) sum += resistance(*pair, speed);
    return sum / static_cast<double>(pairs.size());
  }

  /// By how much the resistance of a run exceeds that of the other runs of the same heading and part whose pairs count,
  /// over the mean of both headings, so that a slope does not count; mean over the speeds of its pair. 0 if there is no
  /// such run.
  double deviation_of_run(const ReferencePair& pair, std::size_t ReferencePair::*run) const {
    std::vector<double> deviations;
    for (const int speed : pair.speeds) {
      std::vector<double> others;
      std::vector<const ReferencePair*> other_pairs;
      for (const ReferencePair* other : list(speed, pair.part)) {
        if (other == &pair) continue;
        others.push_back(rule_.resistance(runs_[other->*run].values.at(speed)));
        other_pairs.push_back(other);
      }
      if (others.empty()) continue;
      const double more = rule_.resistance(runs_[pair.*run].values.at(speed)) - calc_mean(others);
      deviations.push_back(more / mean_resistance(other_pairs, speed));
    }
    return deviations.empty() ? 0.0 : calc_mean(deviations);
  }

  /// Rejects pairs until each speed has its precision, as far as that is allowed; gives those that it rejects.
  std::vector<const ReferencePair*> reject(const std::vector<int>& speeds) {
    const std::size_t most = pairs_.size() / 3;
    auto rejected = static_cast<std::size_t>(
        std::count_if(pairs_.begin(), pairs_.end(), [](const ReferencePair& pair) { return !pair.rejected.empty(); }));
    std::vector<const ReferencePair*> now;
    for (; rejected < most; ++rejected) {
      const Farthest farthest = find_farthest(speeds, true);
      if (farthest.pair == nullptr) break;
      farthest.pair->rejected =
          fmt::format("{:.1f} % from the mean at {} km/h", 100.0 * farthest.distance, farthest.speed);
      now.push_back(farthest.pair);
    }
    return now;
  }

 private:
  bool is_spare(const ReferencePair& pair) const {
    return std::all_of(pair.speeds.begin(), pair.speeds.end(),
                       [this](int speed) { return list(speed).size() > kFewestPairs; });
  }

  const std::vector<ReferenceRun>& runs_;
  const PairRule& rule_;
  std::vector<ReferencePair>& pairs_;
};

void find_overlaps(const PairTable& table, ReferenceResult& result) {
  int parts = 0;
  for (const ReferencePair& pair : result.pairs) parts = std::max(parts, pair.part + 1);
  for (int lower = 1; lower < parts; ++lower) {
    for (const int speed : result.speeds) {
      for (int upper = 0; upper < lower; ++upper) {
        const auto below = table.list(speed, lower), above = table.list(speed, upper);
        if (below.empty() || above.empty()) continue;
        result.overlaps.push_back(speed);
        result.overlap_differences.push_back(table.mean_resistance(below, speed) - table.mean_resistance(above, speed));
      }
    }
  }
}

/// Least squares over the speeds, and what the scatter of the pairs makes of it.
void fit_coefficients(const PairTable& table, const std::map<int, double>& speeds_m_s, ReferenceResult& result) {
  const auto count = static_cast<Index>(result.speeds.size());
  MatrixXd X(count, 3);
  for (Index j = 0; j < count; ++j) {
    const double v = speeds_m_s.at(result.speeds[static_cast<std::size_t>(j)]);
    X.row(j) << 1.0, v, v * v;
  }
  const MatrixXd H = X.colPivHouseholderQr().solve(MatrixXd::Identity(count, count));
  struct Part {  // of a pair
    Eigen::Vector3d deviation = Eigen::Vector3d::Zero();
    Eigen::Vector3d share = Eigen::Vector3d::Zero();  // in the variance, as if all resistances scattered alike
  };
  std::map<const ReferencePair*, Part> of_pairs;
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  // as if so
  for (Index j = 0; j < count; ++j) {
    const int speed = result.speeds[static_cast<std::size_t>(j)];
    const std::vector<const ReferencePair*> pairs = table.list(speed);
    const auto n = static_cast<double>(pairs.size());  // three at least
    const double mean = table.mean_resistance(pairs, speed);
    result.resistances.push_back(mean);
    result.coefficients += H.col(j) * mean;
    const Eigen::Vector3d of_speed = H.col(j).array().square() / n;
    variance += of_speed;
    for (const ReferencePair* pair : pairs) {
      of_pairs[pair].deviation += H.col(j) * (table.resistance(*pair, speed) - mean) / std::sqrt(n * (n - 1.0));
      of_pairs[pair].share += of_speed / std::sqrt(n * (n - 1.0));
    }
  }
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  std::map<std::string, Eigen::Vector3d> of_sessions;
  for (const auto& [pair, part] : of_pairs) {
    result.covariance += part.deviation * part.deviation.transpose();
    squares += part.share.array().square().matrix();
    of_sessions.try_emplace(table.session_of(*pair), Eigen::Vector3d::Zero()).first->second += part.deviation;
  }
  result.freedom = variance.array().square() / squares.array();
  if (of_sessions.size() < 2 || !table.sessions_differ()) return;
  const auto pairs = static_cast<double>(of_pairs.size()), sessions = static_cast<double>(of_sessions.size());
  const double factor = (pairs - 1.0) / pairs * sessions / (sessions - 1.0);
  for (const auto& [session, sum] : of_sessions) result.covariance += factor * sum * sum.transpose();
  result.freedom.setConstant(sessions - 1.0);
  result.has_session_scatter = true;
  result.warnings.push_back(fmt::format(
      "the pairs differ more from session to session than within sessions: the intervals have a part for "
      "it, with {} of freedom{}",
      format_count(of_sessions.size() - 1, "degree"), of_sessions.size() == 2 ? ", so that they are wide" : ""));
}

/// Pairs with a run whose wind is above the limits.
void reject_windy(const std::vector<ReferenceRun>& runs, const std::vector<std::string>& windy,
                  std::vector<ReferencePair>& pairs) {
  for (ReferencePair& pair : pairs) {
    for (const std::size_t run : {pair.plus, pair.minus}) {
      const auto found = std::find(windy.begin(), windy.end(), runs[run].name);
      if (found == windy.end()) continue;
      pair.rejected = fmt::format("wind of run {}", runs[run].name);
      pair.is_windy = true;
    }
  }
}

/// Warns of runs without a partner.
void report_alone(const std::vector<ReferenceRun>& runs, const std::vector<std::size_t>& alone,
                  std::vector<std::string>& warnings) {
  if (alone.empty()) return;
  std::vector<std::string> texts;
  for (const std::size_t run : alone) {
    const std::map<int, double>& values = runs[run].values;
    texts.push_back(fmt::format("{} ({} to {} km/h)", runs[run].name, values.begin()->first, values.rbegin()->first));
  }
  warnings.push_back(
      fmt::format("not used, since no run of the opposite heading is left in its session that shares most of the "
                  "reference speeds with it: {}",
                  fmt::join(texts, ", ")));
}

/// Warns where a run has many of the used speeds for nothing, since its partner does not have them.
void report_unshared(const std::vector<ReferenceRun>& runs, const ReferencePair& pair, const std::vector<int>& used,
                     std::vector<std::string>& warnings) {
  constexpr std::size_t kUsual = 2;  // Assumed: one at each end, where runs begin and end by chance
  for (const auto& [run, partner] : {std::pair(pair.plus, pair.minus), std::pair(pair.minus, pair.plus)}) {
    std::vector<int> unshared;
    for (const int speed : used) {
      if (runs[run].values.count(speed) > 0 && !pair.has(speed)) unshared.push_back(speed);
    }
    if (unshared.size() <= kUsual) continue;
    warnings.push_back(fmt::format("run {} is not used at {} km/h, which run {}, its partner, does not have",
                                   runs[run].name, fmt::join(unshared, ", "), runs[partner].name));
  }
}

/// The pairs with those of their speeds that are used. Warns of what that leaves out.
std::vector<ReferencePair> keep_used_speeds(const std::vector<ReferenceRun>& runs, std::vector<ReferencePair> pairs,
                                            const std::vector<int>& used, std::vector<std::string>& warnings) {
  const auto is_unused = [&used](int speed) { return std::find(used.begin(), used.end(), speed) == used.end(); };
  std::vector<ReferencePair> kept;
  for (ReferencePair& pair : pairs) {
    pair.speeds.erase(std::remove_if(pair.speeds.begin(), pair.speeds.end(), is_unused), pair.speeds.end());
    report_unshared(runs, pair, used, warnings);
    if (!pair.speeds.empty()) {
      kept.push_back(std::move(pair));
      continue;
    }
    warnings.push_back(fmt::format("the pair of runs {} and {} has none of the reference speeds that are used",
                                   runs[pair.plus].name, runs[pair.minus].name));
  }
  return kept;
}

/// Text that names the run of a pair that deviates by 3 % at least and three times as much as its partner; empty if
/// neither does.
std::string describe_deviating_run(const std::vector<ReferenceRun>& runs, const PairTable& table,
                                   const ReferencePair& pair) {
  constexpr double kClearly = 3.0, kLeast = 0.03;  // Assumed
  const double plus = table.deviation_of_run(pair, &ReferencePair::plus);
  const double minus = table.deviation_of_run(pair, &ReferencePair::minus);
  const bool is_plus = std::abs(plus) > kClearly * std::abs(minus);
  if (!is_plus && !(std::abs(minus) > kClearly * std::abs(plus))) return "";
  const double odd = is_plus ? plus : minus;
  if (std::abs(odd) < kLeast) return "";
  return fmt::format("; run {} has {:.0f} % {} resistance than the others of its heading",
                     runs[is_plus ? pair.plus : pair.minus].name, 100.0 * std::abs(odd), odd > 0.0 ? "more" : "less");
}

/// Warns of rejected pairs. `imprecise` are those that reject() rejected, in its order: where they are all pairs of
/// a session, it is the session that differs.
void report_rejected(const std::vector<ReferenceRun>& runs, const PairTable& table,
                     const std::vector<ReferencePair>& pairs, const std::vector<const ReferencePair*>& imprecise,
                     std::vector<std::string>& warnings) {
  const auto is_imprecise = [&imprecise](const ReferencePair& pair) {
    return std::find(imprecise.begin(), imprecise.end(), &pair) != imprecise.end();
  };
  const auto count_of = [&](const std::string& session, bool all) {
    return std::count_if(pairs.begin(), pairs.end(), [&](const ReferencePair& pair) {
      return runs[pair.plus].session == session && (is_imprecise(pair) || (all && pair.rejected.empty()));
    });
  };
  std::set<std::string> said;
  for (const ReferencePair& pair : pairs) {
    if (pair.rejected.empty()) continue;
    std::string text = fmt::format("the pair of runs {} and {} is rejected: {}", runs[pair.plus].name,
                                   runs[pair.minus].name, pair.rejected);
    if (is_imprecise(pair)) text += describe_deviating_run(runs, table, pair);
    const std::string& session = runs[pair.plus].session;
    const auto rejected = count_of(session, false);
    if (is_imprecise(pair) && rejected > 1 && rejected == count_of(session, true) && said.insert(session).second) {
      text += fmt::format(
          "; all {} pairs of session '{}' are rejected: were its conditions and its calibration those "
          "of the other sessions?",
          rejected, session);
    }
    warnings.push_back(std::move(text));
  }
}

}  // namespace

double PairRule::join(double plus, double minus) const {
  return harmonic ? 2.0 / (1.0 / plus + 1.0 / minus) : 0.5 * (plus + minus);
}

std::vector<std::size_t> ReferenceResult::list_used_runs() const {
  std::set<std::size_t> used;
  for (const ReferencePair& pair : pairs) {
    if (pair.rejected.empty()) used.insert({pair.plus, pair.minus});
  }
  return {used.begin(), used.end()};
}

double calc_precision_coefficient(int pairs) {
  // Where the table of 70/220/EEC Annex III is not the rounded quantile: t is 2.447 for 7 pairs and 2.145 for 15.
  if (pairs == 7) return 2.5;
  if (pairs == 15) return 2.2;
  const boost::math::students_t student(pairs - 1.0);
  return 0.1 * std::round(10.0 * boost::math::quantile(student, 0.975));
}

ReferencePrecision calc_precision(const std::vector<double>& values) {
  ReferencePrecision precision;
  precision.pairs = static_cast<int>(values.size());
  if (values.size() < 2) return precision;
  const auto n = static_cast<double>(values.size());
  const Eigen::Map<const VectorXd> at(values.data(), static_cast<Index>(values.size()));
  precision.mean = at.mean();
  precision.sd = std::sqrt((at.array() - precision.mean).square().sum() / (n - 1.0));
  precision.precision =
      calc_precision_coefficient(precision.pairs) * precision.sd / (std::sqrt(n) * std::abs(precision.mean));
  return precision;
}

ReferenceResult evaluate_reference_runs(const std::vector<ReferenceRun>& runs, const std::map<int, double>& speeds_m_s,
                                        const PairRule& rule, const std::vector<std::string>& windy) {
  require_both_headings(runs);
  PairedRuns paired = pair_runs(runs);
  reject_windy(runs, windy, paired.pairs);
  const ReferenceChoice choice(runs, paired, windy, rule.quantity);
  choice.require_enough(speeds_m_s);
  ReferenceResult result;
  result.speeds = choice.speeds();
  result.warnings = choice.list_warnings();
  report_alone(runs, paired.alone, result.warnings);
  result.pairs = keep_used_speeds(runs, paired.pairs, result.speeds, result.warnings);
  PairTable table(runs, rule, result.pairs);
  const std::vector<const ReferencePair*> imprecise = table.reject(result.speeds);
  report_rejected(runs, table, result.pairs, imprecise, result.warnings);
  if (const ReferencePair* kept = table.find_farthest(result.speeds, false).pair) {
    const std::string run = describe_deviating_run(runs, table, *kept);
    if (!run.empty()) {
      result.warnings.push_back(
          fmt::format("the pair of runs {} and {} is far off, but stays, since three pairs are needed and a third may "
                      "be rejected{}",
                      runs[kept->plus].name, runs[kept->minus].name, run));
    }
  }
  for (const int speed : result.speeds) result.precisions.push_back(calc_precision(table.values(speed)));
  find_overlaps(table, result);
  fit_coefficients(table, speeds_m_s, result);
  return result;
}

}  // namespace rollrig::estimation
