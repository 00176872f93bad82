#include "diagnosis/findings/locations.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "diagnosis/comparison/linear_fit.h"
#include "diagnosis/comparison/report_unit.h"

namespace rollrig::diagnosis {
namespace {

constexpr double kLong_s = 900.0;  // Assumed: above it a warm-up shows within a phase
constexpr double kBegin_s = 600.0;
constexpr double kFamilyWise = 0.01;

struct PhaseOfSeries {
  const Series* series = nullptr;
  std::string name;
  double start_s = 0.0;
  double end_s = 0.0;
  std::vector<std::size_t> blocks;
};

void add_stretches(const PreparedSet& set, const Series& series, std::vector<PhaseOfSeries>& all) {
  const PreparedRun& run = set.runs()[series.run];
  const std::vector<double>& time_s = run.measured.time_s;
  const auto add = [&](std::size_t phase, const std::string& name, double start_s, double end_s) {
    PhaseOfSeries stretch{&series, name, start_s, end_s, {}};
    for (std::size_t k = 0; k < series.size(); ++k) {
      const bool ends_before = series.time_s[k] >= end_s && end_s < time_s[run.phases[phase].last - 1];
      if (series.phase[k] == phase && series.time_s[k] >= start_s && !ends_before) stretch.blocks.push_back(k);
    }
    if (!stretch.blocks.empty()) all.push_back(std::move(stretch));
  };
  for (std::size_t p = 0; p < run.phases.size(); ++p) {
    const RunPhase& phase = run.phases[p];
    const double start_s = time_s[phase.first];
    const double end_s = time_s[phase.last - 1];
    if (end_s - start_s <= kLong_s) {
      add(p, phase.name, start_s, end_s);
    } else {
      const double cut_s = start_s + kBegin_s;
      add(p, phase.name + ", first 10 min", start_s, cut_s);
      add(p, phase.name + ", rest", cut_s, end_s);
    }
  }
}

/// Information matrix of the sizes of all stretches, and their score: size = information^-1 score.
struct Scores {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  Eigen::VectorXd without_null;  // the information's diagonal, were base parameters and offsets known
  Eigen::MatrixXd null_steps;    // of base parameters and offsets beside a stretch of size 1
};

Scores calc_scores(const LinearFit& null, const std::vector<PhaseOfSeries>& stretches) {
  // A stretch's template is 0 outside its series: templates of different series share a column.
  std::vector<Eigen::Index> column;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const bool same = i > 0 && stretches[i].series == stretches[i - 1].series;
    column.push_back(same ? column.back() + 1 : 0);
  }
  const Eigen::Index width = 1 + *std::max_element(column.begin(), column.end());
  RowMatrix templates = RowMatrix::Zero(null.jacobian.rows(), width);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (const std::size_t k : stretches[i].blocks)
      templates(to_index(stretches[i].series->first_residual + k), column[i]) = 1;
  }
  null.whiten(templates);
  const Eigen::Index count = to_index(stretches.size());
  const auto rows_of = [&](std::size_t i, const auto& matrix) {
    return matrix.middleRows(to_index(stretches[i].series->first_residual), to_index(stretches[i].series->size()));
  };
  Scores scores{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd(count), Eigen::VectorXd(count), {}};
  Eigen::MatrixXd through_null(null.jacobian.cols(), count);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Eigen::VectorXd one = rows_of(i, templates).col(column[i]);
    through_null.col(to_index(i)) = rows_of(i, null.jacobian).transpose() * one;
    scores.score[to_index(i)] = one.dot(rows_of(i, null.residual));
    scores.without_null[to_index(i)] = one.squaredNorm();
    for (std::size_t j = 0; j < stretches.size(); ++j) {
      if (stretches[j].series != stretches[i].series) continue;
      scores.information(to_index(i), to_index(j)) = one.dot(rows_of(j, templates).col(column[j]));
    }
  }
  scores.null_steps = null.factor.solve(through_null);
  scores.information -= through_null.transpose() * scores.null_steps;
  return scores;
}

/// Stretches put in one by one; `critical` of |z|.
std::vector<std::size_t> select_forward(const Scores& scores, double critical) {
  Eigen::MatrixXd information = scores.information;
  Eigen::VectorXd score = scores.score;
  constexpr double kResolvable = 1e-6;  // of its information, were all else known
  std::vector<std::size_t> selected;
  while (true) {
    Eigen::Index best = -1;
    double best_z = critical;
    for (Eigen::Index i = 0; i < score.size(); ++i) {
      if (!(information(i, i) > kResolvable * scores.without_null[i])) continue;
      const double z = std::abs(score[i]) / std::sqrt(information(i, i));
      if (z > best_z) {
        best = i;
        best_z = z;
      }
    }
    if (best < 0) return selected;
    selected.push_back(static_cast<std::size_t>(best));
    const Eigen::VectorXd along = information.col(best) / information(best, best);
    score -= along * score[best];
    information -= along * information.row(best).eval();
    score[best] = information(best, best) = 0.0;
  }
}

struct Sized {
  std::size_t stretch = 0;
  double size = 0.0;
  double z = 0.0;
};

/// Sizes beside each other; those that the others have made insignificant are taken out again, the faintest first.
std::vector<Sized> size_jointly(const Scores& scores, std::vector<std::size_t> selected, double critical) {
  while (true) {
    std::vector<Sized> sized;
    const Eigen::Index n = to_index(selected.size());
    const Eigen::MatrixXd information = scores.information(selected, selected);
    const Eigen::VectorXd score = scores.score(selected);
    const Eigen::MatrixXd covariance = information.llt().solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::VectorXd size = covariance * score;
    for (Eigen::Index i = 0; i < n; ++i) {
      sized.push_back({selected[static_cast<std::size_t>(i)], size[i], size[i] / std::sqrt(covariance(i, i))});
    }
    const auto faintest = std::min_element(
        sized.begin(), sized.end(), [](const Sized& a, const Sized& b) { return std::abs(a.z) < std::abs(b.z); });
    if (faintest == sized.end() || std::abs(faintest->z) > critical) return sized;
    selected.erase(selected.begin() + (faintest - sized.begin()));
  }
}

/// Sum of squares above the noise, in noise floors; below 0 where there happens to be less.
double calc_excess(const PhaseOfSeries& stretch, const Eigen::VectorXd& difference) {
  const Series& series = *stretch.series;
  double sum = 0.0;
  for (const std::size_t k : stretch.blocks) {
    const double noise_sd = series.whitener.standard_deviation(k);
    const double d = difference[to_index(series.first_residual + k)];
    sum += (d * d - noise_sd * noise_sd) / (series.floor * series.floor);
  }
  return sum;
}

/// Measured less simulated less offset, block means in SI units, of the baseline fitted beside the stretches.
Eigen::VectorXd calc_difference(const Study& study, const Eigen::VectorXd& unknowns) {
  const Fit& fit = study.null.fit;
  Eigen::VectorXd moved = fit.jacobian * (unknowns - fit.unknowns);
  for (const Series& series : study.set.series()) series.whitener.undo(moved.data() + series.first_residual, 1);
  return moved + study.make_model(fit.hypothesis).subtract_from_measured(fit.unknowns, fit.simulated);
}

Location describe_location(const PreparedSet& set, const PhaseOfSeries& stretch, const Sized& sized) {
  Location location;
  const Quantity& channel = set.channels()[stretch.series->channel];
  location.channel = channel.header();
  location.run = set.runs()[stretch.series->run].measured.id;
  location.phase = stretch.name;
  location.z = sized.z;
  location.start_s = stretch.start_s;
  location.end_s = stretch.end_s;
  const ReportUnit unit = find_report_unit(set, channel);
  location.size = sized.size * unit.per_SI;
  location.unit = unit.symbol;
  return location;
}

}  // namespace

std::vector<Location> find_locations(const Study& study) {
  const PreparedSet& set = study.set;
  std::vector<PhaseOfSeries> stretches;
  for (const Series& series : set.series()) add_stretches(set, series, stretches);
  const double tail = kFamilyWise / (2.0 * static_cast<double>(stretches.size()));
  const double critical = boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
  const LinearFit linear(study.discrepancy, study.null);
  const Scores scores = calc_scores(linear, stretches);
  const std::vector<Sized> listed = size_jointly(scores, select_forward(scores, critical), critical);
  if (listed.empty()) return {};

  Eigen::VectorXd unknowns = linear.unknowns;
  for (const Sized& sized : listed) unknowns += scores.null_steps.col(to_index(sized.stretch)) * sized.size;
  const Eigen::VectorXd difference = calc_difference(study, unknowns);
  std::vector<Location> locations;
  double of_listed = 0.0;
  double of_others = 0.0;
  for (const PhaseOfSeries& stretch : stretches) of_others += calc_excess(stretch, difference);
  for (const Sized& sized : listed) {
    const double excess = calc_excess(stretches[sized.stretch], difference);
    of_others -= excess;
    of_listed += std::max(0.0, excess);
    locations.push_back(describe_location(set, stretches[sized.stretch], sized));
    locations.back().share_percent = 100.0 * std::max(0.0, excess);
  }
  const double whole = of_listed + std::max(0.0, of_others);
  for (Location& location : locations) location.share_percent /= whole > 0.0 ? whole : 1.0;
  std::stable_sort(locations.begin(), locations.end(), [](const Location& a, const Location& b) {
    return std::pair(a.share_percent, std::abs(a.z)) > std::pair(b.share_percent, std::abs(b.z));
  });
  return locations;
}

}  // namespace rollrig::diagnosis
