#include "estimation/road_load/reference_speeds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/math/distributions/students_t.hpp>

#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFewestPairs = 3;           // UN GTR 15 Annex 4, 4.3.1.4.2
constexpr double kPrecisionLimit = 0.03;  // likewise
constexpr std::size_t kFewestSpeeds = 4;  // one more than coefficients

InputError pairing_error(const std::string& what, const std::string& allowed) {
  return InputError({what, "", 0, "heading", "", allowed, ""});
}

/// Reference speeds that at least three runs of each heading have, falling.
std::vector<int> find_reference_speeds(const std::vector<ReferenceRun>& runs, const std::map<int, double>& speeds_m_s,
                                       const PairRule& rule) {
  std::map<int, std::pair<int, int>> counts;
  int ways[2] = {0, 0};
  for (const ReferenceRun& run : runs) {
    if (run.heading == 0) continue;
    ++ways[run.heading > 0 ? 0 : 1];
    for (const auto& [speed, value] : run.values) ++(run.heading > 0 ? counts[speed].first : counts[speed].second);
  }
  if (ways[0] == 0 || ways[1] == 0) {
    throw pairing_error(ways[0] + ways[1] == 0 ? "the headings of the runs are not known"
                                               : "all runs have the same heading: the procedure pairs opposite ones",
                        "a column heading with + and -, and runs of both");
  }
  std::vector<int> speeds;
  for (auto at = counts.rbegin(); at != counts.rend(); ++at) {
    if (std::min(at->second.first, at->second.second) >= kFewestPairs) speeds.push_back(at->first);
  }
  if (speeds.size() >= kFewestSpeeds) {
    for (int speed = speeds.back(); speed < speeds.front(); ++speed) {
      if (speeds_m_s.count(speed) == 0 || std::find(speeds.begin(), speeds.end(), speed) != speeds.end()) continue;
      throw pairing_error(
          fmt::format("fewer than {} pairs have {} at {:.4g} km/h, and other runs have speeds on both sides",
                      kFewestPairs, rule.quantity, 3.6 * speeds_m_s.at(speed)),
          "three runs of each heading at every reference speed; or a range by --speed-from and --speed-to");
    }
    return speeds;
  }
  int most = 0;
  for (const auto& [speed, count] : counts) most = std::max(most, std::min(count.first, count.second));
  if (most < kFewestPairs) {
    throw pairing_error(
        fmt::format("fewer than {} pairs of opposite headings: {} (runs that repeat another are not used)",
                    kFewestPairs, most),
        "at least three runs of each heading at each reference speed");
  }
  throw pairing_error(fmt::format("{} at {} only", rule.quantity, format_count(speeds.size(), "reference speed")),
                      fmt::format("at least {} reference speeds for f0, f1 and f2", kFewestSpeeds));
}

/// Runs that cover the same of the speeds.
struct SpeedPart {
  std::vector<int> speeds;
  std::vector<std::size_t> runs;
};

std::vector<SpeedPart> sort_parts(const std::vector<ReferenceRun>& runs, const std::vector<int>& speeds) {
  std::vector<SpeedPart> parts;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<int> covered;
    for (const int speed : speeds) {
      if (runs[i].values.count(speed) > 0) covered.push_back(speed);
    }
    if (covered.empty() || runs[i].heading == 0) continue;
    const auto same =
        std::find_if(parts.begin(), parts.end(), [&](const SpeedPart& part) { return part.speeds == covered; });
    if (same == parts.end()) {
      parts.push_back({covered, {i}});
    } else {
      same->runs.push_back(i);
    }
  }
  std::sort(parts.begin(), parts.end(), [](const SpeedPart& a, const SpeedPart& b) { return a.speeds > b.speeds; });
  return parts;
}

/// The n-th run of one heading and the n-th of the other, session by session.
std::vector<ReferencePair> pair_up(const std::vector<ReferenceRun>& runs, const SpeedPart& part, int number,
                                   std::vector<std::string>& warnings) {
  std::vector<std::string> sessions;
  for (const std::size_t run : part.runs) {
    if (std::find(sessions.begin(), sessions.end(), runs[run].session) == sessions.end()) {
      sessions.push_back(runs[run].session);
    }
  }
  std::vector<ReferencePair> pairs;
  std::vector<std::string> alone;
  for (const std::string& session : sessions) {
    std::vector<std::size_t> ways[2];
    for (const std::size_t run : part.runs) {
      if (runs[run].session == session) ways[runs[run].heading > 0 ? 0 : 1].push_back(run);
    }
    const std::size_t count = std::min(ways[0].size(), ways[1].size());
    for (std::size_t i = 0; i < count; ++i) pairs.push_back({ways[0][i], ways[1][i], number, ""});
    for (const auto& way : ways) {
      for (std::size_t i = count; i < way.size(); ++i) alone.push_back(runs[way[i]].name);
    }
  }
  if (!alone.empty()) {
    warnings.push_back(
        fmt::format("not used, since no run of the opposite heading in its session goes with it at the same reference "
                    "speeds ({} to {} km/h): {}",
                    part.speeds.back(), part.speeds.front(), fmt::join(alone, ", ")));
  }
  return pairs;
}

/// Everything about pairs that the rejection looks at.
class PairTable {
 public:
  PairTable(const std::vector<ReferenceRun>& runs, const std::vector<int>& speeds, const PairRule& rule,
            std::vector<SpeedPart> parts, std::vector<ReferencePair>& pairs)
      : runs_(runs), speeds_(speeds), rule_(rule), parts_(std::move(parts)), pairs_(pairs) {}

  double value(const ReferencePair& pair, int speed) const {
    return rule_.join(runs_[pair.plus].values.at(speed), runs_[pair.minus].values.at(speed));
  }
  bool has(const ReferencePair& pair, int speed) const {
    const std::vector<int>& covered = parts_[static_cast<std::size_t>(pair.part)].speeds;
    return pair.rejected.empty() && std::find(covered.begin(), covered.end(), speed) != covered.end();
  }
  std::vector<double> values(int speed, int part = -1) const {
    std::vector<double> values;
    for (const ReferencePair& pair : pairs_) {
      if (has(pair, speed) && (part < 0 || pair.part == part)) values.push_back(value(pair, speed));
    }
    return values;
  }
  const std::vector<SpeedPart>& parts() const { return parts_; }

  /// Rejects pairs until each speed has its precision, as far as that is allowed.
  void reject() {
    const auto most = static_cast<int>(pairs_.size()) / 3;
    auto rejected = static_cast<int>(
        std::count_if(pairs_.begin(), pairs_.end(), [](const ReferencePair& pair) { return !pair.rejected.empty(); }));
    while (rejected < most) {
      ReferencePair* farthest = nullptr;
      double distance = 0.0;
      int at = 0;
      for (const int speed : speeds_) {
        const ReferencePrecision precision = calc_precision(values(speed));
        if (precision.precision <= kPrecisionLimit) continue;
        for (ReferencePair& pair : pairs_) {
          if (!has(pair, speed) || !is_spare(pair)) continue;
          const double deviation = std::abs(value(pair, speed) / precision.mean - 1.0);
          if (deviation <= distance) continue;
          distance = deviation;
          farthest = &pair;
          at = speed;
        }
      }
      if (farthest == nullptr) return;
      farthest->rejected = fmt::format("{:.1f} % from the mean at {} km/h", 100.0 * distance, at);
      ++rejected;
    }
  }

 private:
  bool is_spare(const ReferencePair& pair) const {
    const std::vector<int>& covered = parts_[static_cast<std::size_t>(pair.part)].speeds;
    return std::all_of(covered.begin(), covered.end(),
                       [this](int speed) { return values(speed).size() > static_cast<std::size_t>(kFewestPairs); });
  }

  const std::vector<ReferenceRun>& runs_;
  const std::vector<int>& speeds_;
  const PairRule& rule_;
  std::vector<SpeedPart> parts_;
  std::vector<ReferencePair>& pairs_;
};

void find_overlaps(const PairTable& pairs, const PairRule& rule, ReferenceResult& result) {
  const auto mean_resistance = [&](int speed, std::size_t part) {
    const std::vector<double> values = pairs.values(speed, static_cast<int>(part));
    double sum = 0.0;
    for (const double value : values) sum += rule.resistance(value);
    return sum / static_cast<double>(values.size());
  };
  for (std::size_t lower = 1; lower < pairs.parts().size(); ++lower) {
    for (const int speed : pairs.parts()[lower].speeds) {
      for (std::size_t upper = 0; upper < lower; ++upper) {
        const double difference = mean_resistance(speed, lower) - mean_resistance(speed, upper);
        const std::vector<int>& covered = pairs.parts()[upper].speeds;
        if (std::find(covered.begin(), covered.end(), speed) == covered.end() || !std::isfinite(difference)) continue;
        result.overlaps.push_back(speed);
        result.overlap_differences.push_back(difference);
      }
    }
  }
}

/// Least squares over the speeds, and what the scatter of the pairs makes of it.
void fit_coefficients(const PairTable& pairs, const std::map<int, double>& speeds_m_s, const PairRule& rule,
                      ReferenceResult& result) {
  const auto count = static_cast<Index>(result.speeds.size());
  MatrixXd X(count, 3);
  VectorXd resistance = VectorXd::Zero(count);
  for (Index j = 0; j < count; ++j) {
    const double v = speeds_m_s.at(result.speeds[static_cast<std::size_t>(j)]);
    X.row(j) << 1.0, v, v * v;
  }
  const MatrixXd H = X.colPivHouseholderQr().solve(MatrixXd::Identity(count, count));
  Eigen::Vector3d squares_over_freedom = Eigen::Vector3d::Zero();
  for (std::size_t part = 0; part < pairs.parts().size(); ++part) {
    std::vector<const ReferencePair*> valid;
    for (const ReferencePair& pair : result.pairs) {
      if (pair.rejected.empty() && pair.part == static_cast<int>(part)) valid.push_back(&pair);
    }
    const std::vector<int>& speeds = pairs.parts()[part].speeds;
    const auto n = static_cast<double>(valid.size());
    MatrixXd values(static_cast<Index>(valid.size()), static_cast<Index>(speeds.size()));
    MatrixXd G(3, values.cols());
    for (Index k = 0; k < values.cols(); ++k) {
      const int speed = speeds[static_cast<std::size_t>(k)];
      const Index j = std::find(result.speeds.begin(), result.speeds.end(), speed) - result.speeds.begin();
      for (Index i = 0; i < values.rows(); ++i) {
        values(i, k) = rule.resistance(pairs.value(*valid[static_cast<std::size_t>(i)], speed));
      }
      const double share = n / static_cast<double>(pairs.values(speed).size());
      G.col(k) = share * H.col(j);
      if (n > 0.0) resistance(j) += share * values.col(k).mean();
    }
    if (valid.size() < 2) continue;  // as make_pair_table() has it, only where all others were rejected
    const MatrixXd centered = values.rowwise() - values.colwise().mean();
    const MatrixXd spread = G * (centered.transpose() * centered) * G.transpose() / ((n - 1.0) * n);
    result.covariance += spread;
    for (Index i = 0; i < 3; ++i) squares_over_freedom(i) += spread(i, i) * spread(i, i) / (n - 1.0);
  }
  result.coefficients = H * resistance;
  for (Index i = 0; i < 3; ++i) {
    const double variance = result.covariance(i, i);
    result.freedom(i) = squares_over_freedom(i) > 0.0 ? variance * variance / squares_over_freedom(i)
                                                      : std::numeric_limits<double>::infinity();
  }
  result.resistances.assign(resistance.data(), resistance.data() + count);
}

/// PairTable of all parts with two or more.
PairTable make_pair_table(const std::vector<ReferenceRun>& runs, const PairRule& rule,
                          const std::vector<std::string>& rejected_runs, ReferenceResult& result) {
  std::vector<SpeedPart> parts;
  for (SpeedPart& part : sort_parts(runs, result.speeds)) {
    const std::vector<ReferencePair> pairs = pair_up(runs, part, static_cast<int>(parts.size()), result.warnings);
    if (pairs.size() < 2) {
      for (const ReferencePair& pair : pairs) {
        result.warnings.push_back(fmt::format("the runs {} and {} are not used: no other pair covers the same speeds",
                                              runs[pair.plus].name, runs[pair.minus].name));
      }
      continue;
    }
    parts.push_back(std::move(part));
    result.pairs.insert(result.pairs.end(), pairs.begin(), pairs.end());
  }
  for (ReferencePair& pair : result.pairs) {
    for (const std::size_t run : {pair.plus, pair.minus}) {
      const auto found = std::find(rejected_runs.begin(), rejected_runs.end(), runs[run].name);
      if (found != rejected_runs.end()) pair.rejected = fmt::format("wind of run {}", runs[run].name);
    }
  }
  return PairTable(runs, result.speeds, rule, std::move(parts), result.pairs);
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
                                        const PairRule& rule, const std::vector<std::string>& rejected_runs) {
  ReferenceResult result;
  result.speeds = find_reference_speeds(runs, speeds_m_s, rule);
  PairTable pairs = make_pair_table(runs, rule, rejected_runs, result);
  for (const int speed : result.speeds) {
    const std::size_t count = pairs.values(speed).size();
    if (count >= static_cast<std::size_t>(kFewestPairs)) continue;
    const std::string of_wind = rejected_runs.empty() ? std::string()
                                                      : fmt::format("; rejected for their wind: {}. Is it in m/s?",
                                                                    fmt::join(rejected_runs, ", "));
    throw pairing_error(fmt::format("fewer than {} pairs at {:.4g} km/h: {}{}", kFewestPairs,
                                    3.6 * speeds_m_s.at(speed), count, of_wind),
                        "at least three pairs within the limits of the procedure");
  }
  pairs.reject();
  for (const ReferencePair& pair : result.pairs) {
    if (pair.rejected.empty()) continue;
    result.warnings.push_back(fmt::format("the pair of runs {} and {} is rejected: {}", runs[pair.plus].name,
                                          runs[pair.minus].name, pair.rejected));
  }
  for (const int speed : result.speeds) result.precisions.push_back(calc_precision(pairs.values(speed)));
  find_overlaps(pairs, rule, result);
  fit_coefficients(pairs, speeds_m_s, rule, result);
  return result;
}

}  // namespace rollrig::estimation
