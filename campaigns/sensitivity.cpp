#include "campaigns/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "campaigns/design.h"
#include "sim/core/error.h"
#include "sim/core/random.h"

namespace rollrig::campaigns {
namespace {

constexpr std::size_t kResamplings = 1000;  // Assumed: enough for limits of 95 %

InputError no_spread(const std::string& what) {
  return InputError({what, "command line", 0, "--result", "", "a result that depends on the factors", ""});
}

/// Results of one point or trajectory, in the order of its items.
using Row = std::vector<double>;

/// The rows without those that lack a result.
std::vector<Row> make_rows(const ItemResults& results, std::size_t items, std::size_t least, const char* what) {
  std::vector<Row> rows;
  for (std::size_t first = 0; first + items <= results.size(); first += items) {
    const auto begin = results.begin() + static_cast<std::ptrdiff_t>(first);
    const Row row(begin, begin + static_cast<std::ptrdiff_t>(items));
    if (std::all_of(row.begin(), row.end(), [](double value) { return std::isfinite(value); })) rows.push_back(row);
  }
  if (rows.size() >= least) return rows;
  throw InputError({fmt::format("too few {} to tell how sensitive the result is: {}", what, rows.size()),
                    "command line", 0, "--result", "",
                    fmt::format("at least {} of which all items have the result: rollrig campaign run "
                                "where items are left, else a new campaign with more --points",
                                least),
                    ""});
}

/// Estimates of all factors from rows, some of which may be there several times.
using Estimate = std::function<std::vector<double>(const std::vector<const Row*>&)>;

std::vector<Index> estimate_with_intervals(const std::vector<Row>& rows, std::uint64_t seed, const Estimate& estimate) {
  std::vector<const Row*> chosen;
  for (const Row& row : rows) chosen.push_back(&row);
  std::vector<Index> indices;
  for (const double value : estimate(chosen)) indices.push_back({value, 0.0, 0.0});
  RandomStream random(seed, "resampling of the points");
  std::vector<std::vector<double>> resampled(indices.size());
  for (std::size_t r = 0; r < kResamplings; ++r) {
    for (const Row*& row : chosen) {
      row = &rows[static_cast<std::size_t>(random.uniform() * static_cast<double>(rows.size()))];
    }
    const std::vector<double> values = estimate(chosen);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) continue;
    for (std::size_t j = 0; j < values.size(); ++j) resampled[j].push_back(values[j]);
  }
  for (std::size_t j = 0; j < indices.size(); ++j) {
    const std::size_t count = resampled[j].size();
    if (count < kResamplings / 2) throw no_spread("the result differs in too few items");
    std::sort(resampled[j].begin(), resampled[j].end());
    indices[j].low_95 = resampled[j][count / 40];
    indices[j].high_95 = resampled[j][count - 1 - count / 40];
  }
  return indices;
}

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

/// Of f(A) and f(B), the first two of each row.
Moments calc_moments(const std::vector<const Row*>& rows) {
  double sum = 0.0;
  for (const Row* row : rows) sum += (*row)[0] + (*row)[1];
  const double count = 2.0 * static_cast<double>(rows.size());
  Moments moments{sum / count, 0.0};
  for (const Row* row : rows) {
    moments.variance += (std::pow((*row)[0] - moments.mean, 2) + std::pow((*row)[1] - moments.mean, 2)) / count;
  }
  return moments;
}

}  // namespace

SobolIndices calc_sobol_indices(const ItemResults& results, std::size_t factors, std::uint64_t seed) {
  const std::vector<Row> rows = make_rows(results, factors + 2, 16, "points");
  const Estimate first = [factors](const std::vector<const Row*>& chosen) {
    const Moments moments = calc_moments(chosen);
    std::vector<double> indices(factors);
    for (std::size_t j = 0; j < factors; ++j) {
      double sum = 0.0;
      for (const Row* row : chosen) sum += ((*row)[1] - moments.mean) * ((*row)[2 + j] - (*row)[0]);
      indices[j] = sum / static_cast<double>(chosen.size()) / moments.variance;
    }
    return indices;
  };
  const Estimate total = [factors](const std::vector<const Row*>& chosen) {
    const Moments moments = calc_moments(chosen);
    std::vector<double> indices(factors);
    for (std::size_t j = 0; j < factors; ++j) {
      double sum = 0.0;
      for (const Row* row : chosen) sum += std::pow((*row)[0] - (*row)[2 + j], 2);
      indices[j] = sum / static_cast<double>(chosen.size()) / (2.0 * moments.variance);
    }
    return indices;
  };
  std::vector<const Row*> all;
  for (const Row& row : rows) all.push_back(&row);
  const Moments moments = calc_moments(all);
  if (!(moments.variance > 1e-20 * moments.mean * moments.mean)) {  // Assumed: below it, differences are of rounding
    throw no_spread("the result is the same in all items");
  }
  return {rows.size(), moments.mean, moments.variance, estimate_with_intervals(rows, seed, first),
          estimate_with_intervals(rows, seed, total)};
}

MorrisMeasures calc_morris_measures(const ItemResults& results, std::size_t factors, std::uint64_t seed) {
  const std::size_t items = factors + 1;
  ItemResults effects;  // of each trajectory, by factor
  for (std::size_t t = 0; (t + 1) * items <= results.size(); ++t) {
    const Trajectory trajectory = make_trajectory(seed, t, factors);
    Row own(factors);
    for (std::size_t s = 0; s < factors; ++s) {
      own[trajectory.order[s]] = (results[t * items + s + 1] - results[t * items + s]) * trajectory.signs[s];
    }
    effects.insert(effects.end(), own.begin(), own.end());
  }
  const std::vector<Row> rows = make_rows(effects, factors, 4, "trajectories");
  const auto is_zero = [](const Row& row) {
    return std::all_of(row.begin(), row.end(), [](double effect) { return effect == 0.0; });
  };
  if (std::all_of(rows.begin(), rows.end(), is_zero)) throw no_spread("the result is the same in all items");
  const Estimate mean_size = [factors](const std::vector<const Row*>& chosen) {
    std::vector<double> sizes(factors);
    for (const Row* row : chosen) {
      for (std::size_t j = 0; j < factors; ++j) sizes[j] += std::fabs((*row)[j]) / static_cast<double>(chosen.size());
    }
    return sizes;
  };
  MorrisMeasures measures{rows.size(), estimate_with_intervals(rows, seed, mean_size), {}, {}};
  const auto count = static_cast<double>(rows.size());
  for (std::size_t j = 0; j < factors; ++j) {
    double sum = 0.0;
    for (const Row& row : rows) sum += row[j];
    double squares = 0.0;
    for (const Row& row : rows) squares += std::pow(row[j] - sum / count, 2);
    measures.mean.push_back(sum / count);
    measures.deviation.push_back(std::sqrt(squares / (count - 1.0)));
  }
  return measures;
}

}  // namespace rollrig::campaigns
