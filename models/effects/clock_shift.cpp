/// Two loggers whose clocks differ.
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/effect.h"

namespace rollrig::models::clock_shift {

/// A channel of which the means over one cell a row are known, read at other times.
///
/// A cell is what a row is the mean over: from half-way to the row before to half-way to the next, unless the rows say
/// otherwise; the first begins and the last ends at its row. In a cell the channel is the parabola that has the cell's
/// mean and, at both edges, what the straight line between the neighboring cells' means has there. So means are kept,
/// the channel is continuous, its integral has a continuous slope, and all is linear in the means. Before the first row
/// the channel is what it is there (a tire waits in its state); after the last it goes on with the slope of the last
/// two cells. Error     smooth channel, cells h wide: of third order in h. Beside a kink: jump of the slope times h/16.
/// Beside a
///           step: means overshoot by up to 8 % of it, and where in its cell it lies is not known (22 %). Where rows
///           stand farther apart than they average over: h^2/24 times the second derivative more
/// Checked   tests/models/effects/trace_effects_test.cpp
template <class S>
class MeanChannel {
 public:
  /// At least two rows; no gaps.
  MeanChannel(const TracePort<S>& port, std::vector<S> means) : means_(std::move(means)) {
    const std::size_t last = means_.size() - 1;
    for (std::size_t k = 0; k <= last + 1; ++k) edge_s_.push_back(port.find_mean_start_s(k));
    edges_.push_back(means_[0] - S(share_of(0, 1)) * (means_[1] - means_[0]));
    for (std::size_t k = 1; k <= last; ++k) {
      edges_.push_back(means_[k - 1] + S(share_of(k - 1, k)) * (means_[k] - means_[k - 1]));
    }
    edges_.push_back(means_[last] + S(share_of(last, last - 1)) * (means_[last] - means_[last - 1]));
  }

  /// The means of all cells, had they been read `later_s` later. A sum to the means, so that 0 changes no bit.
  std::vector<S> calc_means(const S& later_s) const {
    std::vector<S> shifted;
    S at_left = integrate(0, later_s);
    for (std::size_t cell = 0; cell < means_.size(); ++cell) {
      S at_right = integrate(cell + 1, later_s);
      shifted.push_back(means_[cell] + (at_right - at_left) / width_s(cell));
      at_left = std::move(at_right);
    }
    return shifted;
  }

 private:
  S width_s(std::size_t cell) const { return quantity<S>(edge_s_[cell + 1] - edge_s_[cell], dimension::kTime); }
  /// Of the way from the middle of a cell to that of its neighbor, what lies in the cell.
  double share_of(std::size_t cell, std::size_t neighbor) const {
    const double own_s = edge_s_[cell + 1] - edge_s_[cell];
    return own_s / (own_s + edge_s_[neighbor + 1] - edge_s_[neighbor]);
  }

  /// The integral from one edge of a cell over a share of its width, towards the other edge.
  S integrate_part(std::size_t cell, const S& from, const S& to, const S& share) const {
    const S bulge = S(6.0) * means_[cell] - S(3.0) * (from + to);
    const S mean = from + share * (S(0.5) * (to - from) + bulge * (S(0.5) - share / S(3.0)));
    return width_s(cell) * share * mean;
  }

  /// Over a time after the last edge.
  S integrate_end(const S& duration_s) const {
    const std::size_t last = means_.size() - 1;
    const S between_s = S(0.5) * (width_s(last - 1) + width_s(last));
    const S slope = (means_[last] - means_[last - 1]) / between_s;
    return duration_s * (edges_.back() + S(0.5) * slope * duration_s);
  }

  /// The integral from an edge to `later_s` after it.
  S integrate(std::size_t edge, const S& later_s) const {
    const bool forward = value_of(later_s) >= 0.0;
    const S direction = S(forward ? 1.0 : -1.0);
    S left_s = direction * later_s;
    S sum = zero<S>();
    while (forward ? edge < means_.size() : edge > 0) {
      const std::size_t next = forward ? edge + 1 : edge - 1;
      const std::size_t cell = std::min(edge, next);
      const S width = width_s(cell);
      if (left_s < width) {
        return direction * (sum + integrate_part(cell, edges_[edge], edges_[next], left_s / width));
      }
      sum += width * means_[cell];
      left_s -= width;
      edge = next;
    }
    return direction * (sum + (forward ? integrate_end(left_s) : S(edges_.front() * left_s)));
  }

  std::vector<S> means_;
  std::vector<double> edge_s_;  // one more than cells
  std::vector<S> edges_;        // the channel there
};

template <class S>
bool is_missing(const S& value) {
  return std::isnan(value_of(value));
}

/// Missing rows on the straight line between their neighbors in time, or like the nearest at both ends.
template <class S>
std::vector<S> fill_gaps(const std::vector<double>& time_s, std::vector<S> values) {
  std::size_t before = values.size();  // the row before that is not missing; none yet
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (is_missing(values[row])) continue;
    const bool is_first = before == values.size();
    for (std::size_t k = is_first ? 0 : before + 1; k < row; ++k) {
      const double share = is_first ? 1.0 : (time_s[k] - time_s[before]) / (time_s[row] - time_s[before]);
      values[k] = is_first ? values[row] : S(values[before] + S(share) * (values[row] - values[before]));
    }
    before = row;
  }
  for (std::size_t k = before + 1; before < values.size() && k < values.size(); ++k) values[k] = values[before];
  return values;
}

struct ClockShift {
  enum Parameter { kShift };

  static EffectInfo info() {
    EffectInfo info;
    info.id = "clock_shift";
    info.summary =
        "The logger of temperature and pressure has another clock than that of the torque: what it writes at a time "
        "was so some seconds before, or after";
    info.equation =
        "T(t) <- T(t - d), p(t) <- p(t - d), as means over the same samples; rows without a sample stay so, and are "
        "bridged by straight lines";
    info.source =
        "Kolekar and Narasimhan (2024) B.1: torque and temperature are logged apart and synchronized afterwards. "
        "Assumed: 0.5 to 10 s; a constant shift, the same for temperature and pressure";
    info.parameters = {{"shift_s",
                        between(-600.0, 600.0),
                        {0.5, 10.0, Prior::Scale::kLog, true},
                        "d, by which temperature and pressure are late in the record",
                        0.0}};
    info.acts_on = &is_indoors;
    info.visible_in = {quantities::kLinerTemperature, quantities::kCavityPressure};
    info.clean_in = {quantities::kMachineForce};
    info.confused_with = {"tread_liner_lag"};
    info.splitting_tests = {"speed step with a common electrical pulse on both loggers",
                            "steps up and down: a clock shifts both alike"};
    return info;
  }

  template <class S>
  static void trace(const EffectView<S>& self, TracePort<S>& port) {
    for (const Quantity& quantity : {quantities::kLinerTemperature, quantities::kCavityPressure}) {
      std::vector<S>* values = port.find(quantity);
      if (values == nullptr || values->size() < 2) continue;
      const MeanChannel<S> channel(port, fill_gaps(port.time_s, *values));
      const std::vector<S> shifted = channel.calc_means(-self.parameter(kShift));
      for (std::size_t row = 0; row < values->size(); ++row) {
        if (!is_missing((*values)[row])) (*values)[row] = shifted[row];
      }
    }
  }
};

const Effect& effect() { return make_effect<ClockShift>(); }

}  // namespace rollrig::models::clock_shift
