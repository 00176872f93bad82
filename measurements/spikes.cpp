#include "measurements/spikes.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>

#include "rigs/machine.h"

namespace rollrig::measurements {
namespace {

namespace quantities = models::quantities;

constexpr std::size_t kSide = 3;  // neighbors to each side

double take_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// The values about rows [i, i + length) of those that are there, in increasing order.
boost::container::static_vector<double, 2 * kSide> find_neighbors(const std::vector<double>& values, std::size_t i,
                                                                  std::size_t length) {
  boost::container::static_vector<double, 2 * kSide> found;
  for (std::size_t k = i > kSide ? i - kSide : 0; k < std::min(values.size(), i + length + kSide); ++k) {
    if (k < i || k >= i + length) found.insert(std::upper_bound(found.begin(), found.end(), values[k]), values[k]);
  }
  return found;
}

struct Departure {
  double size = 0.0;    // from the neighbors' median
  double beyond = 0.0;  // their range, towards it
  double range = 0.0;
};

Departure calc_departure(const std::vector<double>& values, std::size_t i, std::size_t length) {
  const auto neighbors = find_neighbors(values, i, length);
  const double low = neighbors.front(), high = neighbors.back();
  const double median = 0.5 * (neighbors[(neighbors.size() - 1) / 2] + neighbors[neighbors.size() / 2]);
  double weakest = std::numeric_limits<double>::infinity();
  double beyond = std::numeric_limits<double>::infinity();
  bool up = true, down = true;
  for (std::size_t k = i; k < i + length; ++k) {
    weakest = std::min(weakest, std::abs(values[k] - median));
    beyond = std::min(beyond, std::max(values[k] - high, low - values[k]));
    up = up && values[k] > high;
    down = down && values[k] < low;
  }
  return {weakest, up || down ? beyond : 0.0, high - low};
}

}  // namespace

std::vector<bool> find_steady_rows(const QuantityMap<std::vector<double>>& columns, std::size_t rows) {
  constexpr double kSpeed_m_s = 1.0 / 3.6;  // Assumed
  constexpr double kLoadShare = 0.05;       // Assumed: of the largest load
  constexpr std::size_t kAbout = 3;
  std::vector<bool> steady(rows, true);
  for (const Quantity& quantity : {quantities::kSpeed, quantities::kLoad, quantities::kLongitudinalForce}) {
    const auto found = columns.find(quantity);
    if (found == columns.end()) continue;
    const std::vector<double>& input = found->second;
    double largest = 0.0;
    for (const double value : input) largest = std::isnan(value) ? largest : std::max(largest, std::abs(value));
    const double limit = quantity == quantities::kSpeed ? kSpeed_m_s : kLoadShare * largest;
    for (std::size_t i = 0; i < input.size(); ++i) {
      const std::size_t last = std::min(input.size() - 1, i + kAbout);
      for (std::size_t k = i > kAbout ? i - kAbout : 0; k <= last; ++k) {
        if (!(std::abs(input[k] - input[i]) <= limit)) steady[i] = false;  // NaN is not steady
      }
    }
  }
  return steady;
}

bool carries_inertia(const Quantity& column) {
  return rigs::is_force(column) || column == quantities::kLongitudinalForce;
}

std::vector<std::size_t> find_spikes(const std::vector<double>& values, double threshold, double floor,
                                     const std::vector<bool>& is_judged) {
  std::vector<std::size_t> at;  // of the values that are there
  std::vector<double> there;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    at.push_back(i);
    there.push_back(values[i]);
  }
  std::vector<std::size_t> spikes;
  if (there.size() < 4 * kSide) return spikes;
  std::vector<Departure> alone;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < there.size(); ++i) {
    alone.push_back(calc_departure(there, i, 1));
    sizes.push_back(alone.back().size);
  }
  const double limit = threshold * std::max(1.4826 * take_median(sizes), floor);
  const auto stands_out = [limit](const Departure& departure) {
    return departure.size > limit && departure.beyond > std::max(limit, departure.range);
  };
  for (std::size_t i = 1; i + 1 < there.size(); ++i) {  // an end leaves, but nothing shows that it comes back
    std::size_t length = stands_out(alone[i]) ? 1 : 0;
    if (length == 0 && i + 2 < there.size() && stands_out(calc_departure(there, i, 2))) length = 2;
    for (std::size_t k = i; k < i + length; ++k) {
      if (is_judged[at[k]]) spikes.push_back(at[k]);
    }
    if (length == 2) ++i;
  }
  return spikes;
}

}  // namespace rollrig::measurements
