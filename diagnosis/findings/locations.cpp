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
constexpr double kLeftOver = 1.1;  // Assumed: chi2/N from which stretches of constant size do not describe the gap

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

std::vector<PhaseOfSeries> cut_into_stretches(const PreparedSet& set) {
  std::vector<PhaseOfSeries> stretches;
  for (const Series& series : set.series()) add_stretches(set, series, stretches);
  return stretches;
}

/// Products of the templates of stretches, of the null's derivatives and of its residual at the priors' middles.
struct Products {
  Eigen::MatrixXd templates;   // T^T T
  Eigen::MatrixXd through;     // J^T T
  Eigen::MatrixXd null;        // J^T J
  Eigen::VectorXd along;       // T^T r
  Eigen::VectorXd along_null;  // J^T r
  double along_itself = 0.0;   // r^T r
  double count = 0.0;          // of residuals
};

Products calc_products(const LinearFit& null, const std::vector<PhaseOfSeries>& stretches) {
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
  const Eigen::VectorXd prior_residual = null.residual - null.jacobian * null.unknowns;
  const Eigen::Index count = to_index(stretches.size());
  Products products;
  products.templates = Eigen::MatrixXd::Zero(count, count);
  products.through.resize(null.jacobian.cols(), count);
  products.along.resize(count);
  products.null = null.jacobian.transpose() * null.jacobian;
  products.along_null = null.jacobian.transpose() * prior_residual;
  products.along_itself = prior_residual.squaredNorm();
  products.count = static_cast<double>(prior_residual.size());
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Series& series = *stretches[i].series;
    const Eigen::VectorXd one = series.rows_of(templates).col(column[i]);
    products.through.col(to_index(i)) = series.rows_of(null.jacobian).transpose() * one;
    products.along[to_index(i)] = one.dot(series.rows_of(prior_residual));
    for (std::size_t j = 0; j < stretches.size(); ++j) {
      if (stretches[j].series != stretches[i].series) continue;
      products.templates(to_index(i), to_index(j)) = one.dot(series.rows_of(templates).col(column[j]));
    }
  }
  return products;
}

/// Information matrix of the sizes of all stretches, and their score: size = information^-1 score; where what is left
/// has a variance of its own.
struct Scores {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  Eigen::VectorXd without_null;  // the information's diagonal, were base parameters and offsets known
  Eigen::VectorXd null;          // base parameters and offsets without stretches
  Eigen::MatrixXd null_steps;    // beside a stretch of size 1
};

Scores calc_scores(const Products& products, double variance) {
  const Eigen::Index n = products.null.rows();
  const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd::Identity(n, n) + products.null / variance);
  Scores scores;
  scores.null_steps = factor.solve(products.through) / variance;
  scores.null = -factor.solve(products.along_null) / variance;
  scores.information = (products.templates - products.through.transpose() * scores.null_steps) / variance;
  scores.score = (products.along + products.through.transpose() * scores.null) / variance;
  scores.without_null = products.templates.diagonal() / variance;
  return scores;
}

struct Sized {
  std::size_t stretch = 0;
  double size = 0.0;
  double z = 0.0;
};

/// Sizes of the selected beside each other.
std::vector<Sized> size_jointly(const Scores& scores, const std::vector<std::size_t>& selected) {
  std::vector<Sized> sized;
  const Eigen::Index n = to_index(selected.size());
  if (n == 0) return sized;
  const Eigen::MatrixXd information = scores.information(selected, selected);
  const Eigen::VectorXd score = scores.score(selected);
  const Eigen::MatrixXd covariance = information.llt().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd size = covariance * score;
  for (Eigen::Index i = 0; i < n; ++i) {
    sized.push_back({selected[static_cast<std::size_t>(i)], size[i], size[i] / std::sqrt(covariance(i, i))});
  }
  return sized;
}

/// Base parameters and offsets as they fit best beside these.
Eigen::VectorXd find_unknowns(const Scores& scores, const std::vector<Sized>& sized) {
  Eigen::VectorXd unknowns = scores.null;
  for (const Sized& one : sized) unknowns += scores.null_steps.col(to_index(one.stretch)) * one.size;
  return unknowns;
}

/// Mean square of what is left beside these, whitened, and at least the 1 that noise gives.
double calc_variance(const Products& products, const Scores& scores, const std::vector<Sized>& sized) {
  const Eigen::VectorXd u = find_unknowns(scores, sized);
  Eigen::VectorXd s = Eigen::VectorXd::Zero(products.along.size());
  for (const Sized& one : sized) s[to_index(one.stretch)] = one.size;
  const double sum = products.along_itself + u.dot(products.null * u) + s.dot(products.templates * s) +
                     2.0 * u.dot(products.along_null) - 2.0 * s.dot(products.along) - 2.0 * u.dot(products.through * s);
  return std::max(1.0, sum / products.count);
}

/// The variance with which a fit leaves that variance.
double settle_variance(const Products& products, const std::vector<std::size_t>& selected, double variance) {
  constexpr int kIterations = 5;  // Assumed: it settles to a percent or so
  for (int i = 0; i < kIterations; ++i) {
    const Scores scores = calc_scores(products, variance);
    variance = calc_variance(products, scores, size_jointly(scores, selected));
  }
  return variance;
}

/// The clearest stretch beside those selected, above a `critical` |z|; -1 where there is none.
Eigen::Index find_clearest(const Scores& scores, const std::vector<std::size_t>& selected, double critical) {
  Eigen::MatrixXd information = scores.information;
  Eigen::VectorXd score = scores.score;
  for (const std::size_t one : selected) {
    const Eigen::Index at = to_index(one);
    const Eigen::VectorXd along = information.col(at) / information(at, at);
    score -= along * score[at];
    information -= along * information.row(at).eval();
    score[at] = information(at, at) = 0.0;
  }
  constexpr double kResolvable = 1e-6;  // of its information, were all else known
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
  return best;
}

struct Located {
  std::vector<Sized> sized;
  Eigen::VectorXd unknowns;  // of the null, beside them
  double variance = 1.0;     // calc_variance()
};

/// Puts stretches in one by one; then those that the others have made insignificant are taken out again, the faintest
/// first.
Located select_stretches(const Products& products, double critical) {
  std::vector<std::size_t> selected;
  double variance = settle_variance(products, selected, 1.0);
  while (true) {
    const Eigen::Index next = find_clearest(calc_scores(products, variance), selected, critical);
    if (next < 0) break;
    selected.push_back(static_cast<std::size_t>(next));
    variance = settle_variance(products, selected, variance);
  }
  while (true) {
    const Scores scores = calc_scores(products, variance);
    const std::vector<Sized> sized = size_jointly(scores, selected);
    const auto faintest = std::min_element(
        sized.begin(), sized.end(), [](const Sized& a, const Sized& b) { return std::abs(a.z) < std::abs(b.z); });
    if (faintest == sized.end() || std::abs(faintest->z) > critical)
      return {sized, find_unknowns(scores, sized), variance};
    selected.erase(selected.begin() + (faintest - sized.begin()));
    variance = settle_variance(products, selected, variance);
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

/// Measured minus simulated less offset, block means in SI units, of the baseline fitted beside the stretches.
Eigen::VectorXd calc_difference(const Study& study, const Eigen::VectorXd& unknowns) {
  const Fit& fit = study.null.fit;
  Eigen::VectorXd moved = fit.jacobian * (unknowns - fit.unknowns);
  for (const Series& series : study.set.series()) series.whitener.undo(moved.data() + series.first_residual, 1);
  return moved + study.make_model(fit.hypothesis).subtract_from_measured(fit.unknowns, fit.simulated);
}

/// The size of a stretch, if it is at most `kSeen` times its mean difference from the recalibrated baseline; else that
/// mean, z in proportion, or 0 where the mean has the other sign.
Sized limit_to_seen(const PhaseOfSeries& stretch, const Eigen::VectorXd& difference, const Sized& sized) {
  constexpr double kSeen = 2.0;  // Assumed
  double mean = 0.0;
  for (const std::size_t k : stretch.blocks) mean += difference[to_index(stretch.series->first_residual + k)];
  mean /= static_cast<double>(stretch.blocks.size());
  const double share = std::max(0.0, mean / sized.size);
  return kSeen * share >= 1.0 ? sized : Sized{sized.stretch, sized.size * share, sized.z * share};
}

LocationStretch describe_stretch(const PreparedSet& set, const PhaseOfSeries& stretch) {
  const Quantity& channel = set.channels()[stretch.series->channel];
  const PreparedRun& run = set.runs()[stretch.series->run];
  const ReportUnit unit = find_report_unit(set, channel, run.machine);
  return {channel.header(), run.measured.id, stretch.name,
          stretch.start_s,  stretch.end_s,   stretch.series->floor * unit.per_SI,
          unit.symbol};
}

Location describe_location(const PreparedSet& set, const PhaseOfSeries& stretch, const Sized& sized) {
  const LocationStretch place = describe_stretch(set, stretch);
  Location location;
  location.channel = place.channel;
  location.run = place.run;
  location.phase = place.phase;
  location.z = sized.z;
  location.start_s = place.start_s;
  location.end_s = place.end_s;
  const std::size_t machine = set.runs()[stretch.series->run].machine;
  location.size = sized.size * find_report_unit(set, set.channels()[stretch.series->channel], machine).per_SI;
  location.unit = place.unit;
  return location;
}

}  // namespace

std::vector<LocationStretch> list_location_stretches(const PreparedSet& set) {
  std::vector<LocationStretch> all;
  for (const PhaseOfSeries& stretch : cut_into_stretches(set)) all.push_back(describe_stretch(set, stretch));
  return all;
}

std::vector<Location> find_locations(const Study& study) {
  const PreparedSet& set = study.set;
  const std::vector<PhaseOfSeries> stretches = cut_into_stretches(set);
  const double tail = kFamilyWise / (2.0 * static_cast<double>(stretches.size()));
  const double critical = boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
  const LinearFit linear(study.discrepancy, study.null);
  const Located located = select_stretches(calc_products(linear, stretches), critical);
  std::vector<Sized> listed = located.sized;
  if (located.variance > kLeftOver) {
    const Eigen::VectorXd recalibrated = calc_difference(study, study.null.fit.unknowns);
    for (Sized& sized : listed) sized = limit_to_seen(stretches[sized.stretch], recalibrated, sized);
    listed.erase(std::remove_if(listed.begin(), listed.end(),
                                [critical](const Sized& sized) { return std::abs(sized.z) <= critical; }),
                 listed.end());
  }
  if (listed.empty()) return {};
  const Eigen::VectorXd difference = calc_difference(study, located.unknowns);
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
