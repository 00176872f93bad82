#include "estimation/run_checks/recording_repeats.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "estimation/run_checks/robust_statistics.h"
#include "sim/core/units.h"

namespace rollrig::estimation {
namespace {

constexpr std::size_t kAnchorStep = 10;  // rows between places at which a repeat is looked for
constexpr std::size_t kFewestAlike = 12;

/// A series with what the search needs.
struct SearchedSeries {
  const RecordedSeries* rows = nullptr;
  double time_step_s = 0.0;  // resolution
  double speed_step_m_s = 0.0;
  double interval_s = 0.0;  // median between rows
  double noise_m_s = 0.0;
  std::vector<std::size_t> by_speed;
};

/// Scatter of the rows about the line between their neighbors.
double calc_row_noise(const RecordedSeries& rows) {
  constexpr double kOfThree = 1.2247;  // standard deviation of v_i - (v_(i-1) + v_(i+1))/2 over that of a row
  std::vector<double> rest;
  for (std::size_t i = 1; i + 1 < rows.time_s.size(); ++i) {
    const double share = (rows.time_s[i] - rows.time_s[i - 1]) / (rows.time_s[i + 1] - rows.time_s[i - 1]);
    rest.push_back(rows.speed_m_s[i] - (1.0 - share) * rows.speed_m_s[i - 1] - share * rows.speed_m_s[i + 1]);
  }
  return calc_mad_sd(rest) / kOfThree;
}

SearchedSeries prepare(const RecordedSeries& rows) {
  constexpr double kKmh = 1.0 / 3.6;
  SearchedSeries searched;
  searched.rows = &rows;
  searched.time_step_s = find_resolution(rows.time_s, {1.0});
  searched.speed_step_m_s = find_resolution(rows.speed_m_s, {1.0, kKmh, kMph_m_s});
  std::vector<double> intervals;
  for (std::size_t i = 1; i < rows.time_s.size(); ++i) intervals.push_back(rows.time_s[i] - rows.time_s[i - 1]);
  searched.interval_s = calc_median(intervals);
  searched.noise_m_s = calc_row_noise(rows);
  searched.by_speed.resize(rows.speed_m_s.size());
  std::iota(searched.by_speed.begin(), searched.by_speed.end(), std::size_t{0});
  std::sort(searched.by_speed.begin(), searched.by_speed.end(),
            [&rows](std::size_t a, std::size_t b) { return rows.speed_m_s[a] < rows.speed_m_s[b]; });
  return searched;
}

/// How far apart a number may be that was written in two steps.
double allow(double step_1, double step_2) {
  const bool same = std::abs(step_1 - step_2) < 1e-6 * step_1;
  return same ? 0.02 * step_1 + 1e-9 : 0.505 * (step_1 + step_2);
}

/// One series laid over another.
class Overlay {
 public:
  Overlay(const SearchedSeries& of, const SearchedSeries& over)
      : of_(of), over_(over), speed_m_s_(allow(of.speed_step_m_s, over.speed_step_m_s)) {
    const double most_s = 0.4 * std::min(of.interval_s, over.interval_s);
    time_s_ = std::min(2.0 * allow(of.time_step_s, over.time_step_s), most_s);
  }

  double speed_tolerance_m_s() const { return speed_m_s_; }
  void shift(double by_s) { shift_s_ = by_s; }

  bool agrees(std::size_t row) const {
    const std::vector<double>& times = over_.rows->time_s;
    const double time_s = of_.rows->time_s[row] + shift_s_;
    auto at = std::lower_bound(times.begin(), times.end(), time_s - time_s_);
    for (; at != times.end() && *at <= time_s + time_s_; ++at) {
      const auto other = static_cast<std::size_t>(at - times.begin());
      if (std::abs(over_.rows->speed_m_s[other] - of_.rows->speed_m_s[row]) <= speed_m_s_) return true;
    }
    return false;
  }

 private:
  const SearchedSeries& of_;
  const SearchedSeries& over_;
  double speed_m_s_;
  double time_s_ = 0.0;
  double shift_s_ = 0.0;
};

struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t alike = 0;
};

/// Rows about an anchor that agree, up to three in a row that do not.
Stretch grow(const Overlay& overlay, std::size_t anchor, std::size_t rows) {
  constexpr int kMostMisses = 3;
  constexpr std::size_t kSoon = 8;  // of this many rows after the anchor, all but one must agree
  Stretch stretch{anchor, anchor + 1, 1};
  int misses = 0;
  for (std::size_t row = anchor + 1; row < rows && misses < kMostMisses; ++row) {
    const bool same = overlay.agrees(row);
    misses = same ? 0 : misses + 1;
    if (same) {
      ++stretch.alike;
      stretch.end = row + 1;
    }
    if (row - anchor <= kSoon && stretch.alike + 1 < row - anchor + 1) return stretch;
  }
  misses = 0;
  for (std::size_t row = anchor; row-- > 0 && misses < kMostMisses;) {
    const bool same = overlay.agrees(row);
    misses = same ? 0 : misses + 1;
    if (!same) continue;
    ++stretch.alike;
    stretch.begin = row;
  }
  return stretch;
}

/// Whether chance does not make so many rows agree.
bool is_repeat(const Stretch& stretch, const SearchedSeries& of, const SearchedSeries& over, double tolerance_m_s) {
  constexpr double kMostChance = 1e-3;
  constexpr double kLeastFall = 0.1;     // of the top: where a clock's step hides the noise, short stretches are alike
  constexpr double kMostShare = 0.9;     // of the rows of the shorter one, without noise
  constexpr double kLeastDetail = 1e-4;  // of the fall: no two coasts are so alike
  constexpr double kDensity = 0.39894;   // of the normal distribution at its middle
  const double fall = of.rows->speed_m_s[stretch.begin] - of.rows->speed_m_s[stretch.end - 1];
  const double top = of.rows->speed_m_s[of.by_speed.back()];
  if (stretch.alike < kFewestAlike || fall < kLeastFall * top) return false;
  const double noise = std::hypot(of.noise_m_s, over.noise_m_s);
  const double step = std::max({2.0 * tolerance_m_s, of.speed_step_m_s, over.speed_step_m_s});
  const double chance = noise > 0.0 ? std::min(1.0, kDensity * step / noise) : 1.0;
  const auto rows_of = static_cast<double>(of.by_speed.size());
  const auto rows_over = static_cast<double>(over.by_speed.size());
  const double tries = std::log(rows_of) + std::log(rows_over);
  if (tries + static_cast<double>(stretch.alike) * std::log(chance) < std::log(kMostChance)) return true;
  return static_cast<double>(stretch.alike) > kMostShare * std::min(rows_of, rows_over) && step < kLeastDetail * fall;
}

/// The longest repeat in `of` of rows of `over`.
std::optional<Stretch> find_longest(const SearchedSeries& of, const SearchedSeries& over) {
  Overlay overlay(of, over);
  const double tolerance_m_s = overlay.speed_tolerance_m_s();
  const std::size_t rows = of.by_speed.size();
  std::optional<Stretch> longest;
  for (std::size_t anchor = kAnchorStep / 2; anchor < rows; anchor += kAnchorStep) {
    if (longest.has_value() && anchor >= longest->begin && anchor < longest->end) continue;
    const double speed_m_s = of.rows->speed_m_s[anchor];
    const auto slower = [&over](std::size_t row, double speed) { return over.rows->speed_m_s[row] < speed; };
    auto at = std::lower_bound(over.by_speed.begin(), over.by_speed.end(), speed_m_s - tolerance_m_s, slower);
    for (; at != over.by_speed.end() && over.rows->speed_m_s[*at] <= speed_m_s + tolerance_m_s; ++at) {
      overlay.shift(over.rows->time_s[*at] - of.rows->time_s[anchor]);
      const Stretch stretch = grow(overlay, anchor, rows);
      if (longest.has_value() && stretch.alike <= longest->alike) continue;
      if (is_repeat(stretch, of, over, tolerance_m_s)) longest = stretch;
    }
  }
  return longest;
}

/// Rows of the second between two times of the first: where the first was recorded more sparsely.
std::optional<Stretch> find_mirrored(const SearchedSeries& second, const SearchedSeries& first) {
  const std::optional<Stretch> in_first = find_longest(first, second);
  if (!in_first.has_value()) return std::nullopt;
  const auto row_near = [&](double speed_m_s) {
    const std::vector<double>& speeds = second.rows->speed_m_s;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (std::abs(speeds[i] - speed_m_s) < std::abs(speeds[nearest] - speed_m_s)) nearest = i;
    }
    return nearest;
  };
  const std::size_t begin = row_near(first.rows->speed_m_s[in_first->begin]);
  const std::size_t end = row_near(first.rows->speed_m_s[in_first->end - 1]);
  if (end <= begin) return std::nullopt;
  return Stretch{begin, end + 1, in_first->alike};
}

}  // namespace

double find_resolution(const std::vector<double>& values, const std::vector<double>& units) {
  constexpr double kNear = 0.01;        // of a step
  constexpr double kFinest = 1e-6;      // of a unit
  constexpr std::size_t kLooked = 100;  // values, spread over all
  const std::size_t stride = 1 + values.size() / kLooked;
  const auto is_multiple = [&](double step) {
    for (std::size_t i = 0; i < values.size(); i += stride) {
      const double steps = values[i] / step;
      if (std::abs(steps - std::round(steps)) > kNear) return false;
    }
    return true;
  };
  for (double decade = 1.0; decade > kFinest; decade /= 10.0) {
    for (const double part : {1.0, 0.5, 0.2}) {
      for (const double unit : units) {
        if (is_multiple(unit * decade * part)) return unit * decade * part;
      }
    }
  }
  return kFinest;
}

std::vector<SeriesRepeat> find_series_repeats(const std::vector<RecordedSeries>& series) {
  std::vector<SearchedSeries> searched;
  for (const RecordedSeries& rows : series) searched.push_back(prepare(rows));
  std::vector<SeriesRepeat> repeats;
  for (std::size_t second = 1; second < series.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      if (series[first].time_s.size() < kFewestAlike || series[second].time_s.size() < kFewestAlike) continue;
      std::optional<Stretch> found = find_longest(searched[second], searched[first]);
      if (!found.has_value()) found = find_mirrored(searched[second], searched[first]);
      if (found.has_value()) repeats.push_back({first, second, found->begin, found->end});
    }
  }
  return repeats;
}

}  // namespace rollrig::estimation
