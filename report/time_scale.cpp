#include "report/time_scale.h"

#include <algorithm>
#include <cmath>

#include "report/blocks.h"

namespace rollrig::report {

std::vector<bool> find_scale_rows(const std::vector<double>& time_s, const std::vector<double>& load_N,
                                  const std::vector<double>& speed_m_s) {
  constexpr double kLoaded = 0.5;        // of the largest load
  constexpr double kSteady_m_s2 = 0.02;  // of a change of speed
  constexpr std::size_t kSettled = 3;    // rows after a change
  double most_N = 0.0;
  for (const double load : load_N) most_N = std::isfinite(load) ? std::max(most_N, load) : most_N;
  std::vector<bool> counts(load_N.size(), false);
  std::size_t since = 0;
  for (std::size_t i = 1; i < load_N.size(); ++i) {
    const double change_m_s2 = std::abs(speed_m_s[i] - speed_m_s[i - 1]) / (time_s[i] - time_s[i - 1]);
    const bool is_loaded = load_N[i] > kLoaded * most_N;
    const bool is_changed = change_m_s2 > kSteady_m_s2 || is_loaded != (load_N[i - 1] > kLoaded * most_N);
    since = is_changed ? 0 : since + 1;
    counts[i] = since >= kSettled && std::abs(speed_m_s[i]) > 0.05;
  }
  return counts;
}

Json find_scale(const std::vector<ScaledLine>& lines) {
  constexpr double kBeyond = 1.25;  // times the scale: what is less far outside is simply shown
  double low = 1e300, high = -1e300, all_low = 1e300, all_high = -1e300;
  for (const auto& [values, counts] : lines) {
    for (std::size_t i = 0; i < values->size(); ++i) {
      const double value = (*values)[i];
      if (!std::isfinite(value)) continue;
      all_low = std::min(all_low, value);
      all_high = std::max(all_high, value);
      if (!(*counts)[i]) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (!(high > low) || all_high - all_low < kBeyond * (high - low)) return nullptr;
  return Json::array({rounded(low), rounded(high)});
}

}  // namespace rollrig::report
