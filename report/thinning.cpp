#include "report/blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rollrig::report {
namespace {

constexpr std::size_t kExtremes = 5;      // first, last, least, greatest, a gap
constexpr std::size_t kSidesOfSteps = 4;  // both sides of the two greatest steps

/// Adds what a stretch of rows [first, last) keeps.
void keep_of_stretch(const std::vector<double>& values, std::size_t first, std::size_t last, bool keeps_steps,
                     std::vector<std::size_t>& kept) {
  std::vector<std::size_t> own{first, last - 1};
  std::size_t least = last;
  std::size_t greatest = last;
  std::size_t gap = last;
  std::size_t step = last;  // the row after the greatest step
  std::size_t second = last;
  double greatest_step = 0.0;
  double second_step = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    if (!std::isfinite(values[i])) {
      if (gap == last) gap = i;
      continue;
    }
    const double size = i > 0 ? std::abs(values[i] - values[i - 1]) : 0.0;
    if (size > greatest_step) {
      second = step;
      second_step = greatest_step;
      step = i;
      greatest_step = size;
    } else if (size > second_step) {
      second = i;
      second_step = size;
    }
    if (least == last || values[i] < values[least]) least = i;
    if (greatest == last || values[i] > values[greatest]) greatest = i;
  }
  for (const std::size_t i : {least, greatest, gap}) {
    if (i != last) own.push_back(i);
  }
  for (const std::size_t i : {step, second}) {
    if (keeps_steps && i != last) own.insert(own.end(), {i - 1, i});
  }
  std::sort(own.begin(), own.end());
  own.erase(std::unique(own.begin(), own.end()), own.end());
  kept.insert(kept.end(), own.begin(), own.end());
}

std::vector<std::size_t> keep_extremes(const std::vector<double>& values, std::size_t most) {
  const std::size_t count = values.size();
  std::vector<std::size_t> kept;
  if (count <= most) {
    kept.resize(count);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const bool keeps_steps = most >= 2 + kExtremes + kSidesOfSteps;
  const std::size_t stretches = (most - 2) / (kExtremes + (keeps_steps ? kSidesOfSteps : 0));
  const std::size_t inner = count - 2;
  kept.push_back(0);
  for (std::size_t s = 0; s < stretches; ++s) {
    keep_of_stretch(values, 1 + s * inner / stretches, 1 + (s + 1) * inner / stretches, keeps_steps, kept);
  }
  kept.push_back(count - 1);
  return kept;
}

/// Rows of a series that are kept so far.
struct Kept {
  const std::vector<double>& time_s;
  const std::vector<double>& values;
  std::vector<std::size_t> rows;

  /// Whether all rows between two lie on their straight line.
  bool are_on_line(std::size_t from, std::size_t to, double tolerance) const {
    const double start = values[rows[from]];
    const double span_s = time_s[rows[to]] - time_s[rows[from]];
    for (std::size_t k = from + 1; k < to; ++k) {
      const double share = span_s > 0.0 ? (time_s[rows[k]] - time_s[rows[from]]) / span_s : 0.0;
      const double line = start + share * (values[rows[to]] - start);
      if (!(std::abs(values[rows[k]] - line) <= tolerance)) return false;  // not finite: not on it
    }
    return true;
  }
};

std::vector<std::size_t> drop_collinear(const Kept& kept, double tolerance) {
  constexpr std::size_t kLongest = 400;  // rows that one line stands for; bounds the work
  if (kept.rows.size() < 3) return kept.rows;
  std::vector<std::size_t> fewer{kept.rows.front()};
  std::size_t from = 0;
  for (std::size_t k = 1; k + 1 < kept.rows.size(); ++k) {
    if (k + 1 - from < kLongest && kept.are_on_line(from, k + 1, tolerance)) continue;
    fewer.push_back(kept.rows[k]);
    from = k;
  }
  fewer.push_back(kept.rows.back());
  return fewer;
}

}  // namespace

DrawnRows hold_to_jumps(const std::vector<double>& time_s, const std::vector<double>& values) {
  constexpr double kShorter = 3.0;  // times: samples of another interval
  constexpr double kJump = 3.0;     // times the change before
  DrawnRows rows;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (i >= 2 && i + 1 < time_s.size()) {
      const double before_s = time_s[i] - time_s[i - 1];
      const double after_s = time_s[i + 1] - time_s[i];
      const bool is_jump = std::abs(values[i] - values[i - 1]) > kJump * std::abs(values[i - 1] - values[i - 2]);
      if (before_s > kShorter * after_s && is_jump) {
        rows.time_s.push_back(time_s[i] - after_s);
        rows.held_s.push_back(rows.time_s.back());
        rows.values.push_back(values[i - 1]);
      }
    }
    rows.time_s.push_back(time_s[i]);
    rows.values.push_back(values[i]);
  }
  return rows;
}

std::vector<std::size_t> thin(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t most,
                              double tolerance) {
  return drop_collinear({time_s, values, keep_extremes(values, std::max<std::size_t>(most, 8))}, tolerance);
}

}  // namespace rollrig::report
