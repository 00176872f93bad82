#include "estimation/alignment/line_mistake.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rollrig::estimation {
namespace {

constexpr double kClearLack = 0.005;
constexpr double kNoLack = 0.05;

struct LineValues {
  std::vector<double> x, y;
};

LineValues list_line_values(const LineFit& fit) {
  LineValues values;
  for (const LinePoint& point : fit.points) {
    values.x.push_back(point.x);
    values.y.push_back(point.y);
  }
  return values;
}

/// 0 where the points have no line, or one that falls: no line of two machines.
double calc_lack_of_fit_p(const LineValues& values, const RepeatScatter& repeats) {
  if (*std::min_element(values.x.begin(), values.x.end()) == *std::max_element(values.x.begin(), values.x.end())) {
    return 0.0;
  }
  const LineFit fit = fit_line(values.x, values.y, repeats);
  return fit.slope > 0.0 ? fit.lack_of_fit_p : 0.0;
}

/// The place of the only p above kNoLack. None where another one is not below kClearLack.
std::optional<std::size_t> find_only_explanation(const std::vector<double>& p_values) {
  const auto best = std::max_element(p_values.begin(), p_values.end());
  if (best == p_values.end() || *best <= kNoLack) return std::nullopt;
  const auto unclear = std::count_if(p_values.begin(), p_values.end(), [](double p) { return p >= kClearLack; });
  if (unclear > 1) return std::nullopt;
  return static_cast<std::size_t>(best - p_values.begin());
}

std::optional<LineOutlier> find_omission(const LineFit& fit, const RepeatScatter& repeats, double least_size) {
  constexpr std::size_t kLeastPoints = 5;  // of four, three are left: chance brings them onto a line too often
  if (fit.points.size() < kLeastPoints) return std::nullopt;
  std::vector<double> p_values;
  for (std::size_t i = 0; i < fit.points.size(); ++i) {
    LineValues others = list_line_values(fit);
    others.x.erase(others.x.begin() + static_cast<std::ptrdiff_t>(i));
    others.y.erase(others.y.begin() + static_cast<std::ptrdiff_t>(i));
    p_values.push_back(calc_lack_of_fit_p(others, repeats));
  }
  const auto place = find_only_explanation(p_values);
  if (!place.has_value()) return std::nullopt;
  const LinePoint& point = fit.points[*place];
  if (point.scaled_residual() <= least_size) return std::nullopt;
  return LineOutlier{*place, point.y - point.residual / (1.0 - point.leverage), fit.lack_of_fit_p};
}

std::optional<LineExchange> find_exchange(const LineFit& fit, const RepeatScatter& repeats, double least_size) {
  std::vector<LineExchange> exchanges;
  std::vector<double> p_values;
  for (std::size_t second = 1; second < fit.points.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      LineValues exchanged = list_line_values(fit);
      std::swap(exchanged.y[first], exchanged.y[second]);
      p_values.push_back(calc_lack_of_fit_p(exchanged, repeats));
      exchanges.push_back({first, second, p_values.back()});
    }
  }
  const auto place = find_only_explanation(p_values);
  if (!place.has_value()) return std::nullopt;
  const LineExchange& found = exchanges[*place];
  if (std::abs(fit.points[found.first].y - fit.points[found.second].y) <= least_size) return std::nullopt;
  return found;
}

}  // namespace

LineMistake find_line_mistake(const LineFit& fit, const RepeatScatter& repeats, double least_size) {
  LineMistake mistake;
  if (repeats.degrees_of_freedom > 0.0 && fit.lack_of_fit_p < kClearLack) {
    mistake.outlier = find_omission(fit, repeats, least_size);
    if (mistake.outlier.has_value()) return mistake;
    mistake.exchange = find_exchange(fit, repeats, least_size);
    if (mistake.exchange.has_value()) return mistake;
  }
  mistake.outlier = find_line_outlier(fit, least_size);
  return mistake;
}

}  // namespace rollrig::estimation
