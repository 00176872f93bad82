#include "report/sweep_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "report/blocks.h"
#include "report/list_pages.h"
#include "sim/core/text.h"
#include "sim/core/units.h"

namespace rollrig::report {
namespace {

/// Whether two results are the same but for a factor: their charts would be the same, too.
bool are_proportional(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSame = 1e-6;  // relative: what six digits show
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(std::abs(a[i] * b.front() - b[i] * a.front()) <= kSame * std::abs(a[i] * b.front()))) return false;
  }
  return true;
}

/// The step of an axis in which its sensitivity reads well: 10 kPa, 1 K, 10 km/h, 1 kN.
struct SensitivityStep {
  double size = 1.0;  // in the axis's unit
  std::string text;
};

SensitivityStep find_step(const std::string& axis) {
  const std::string unit = shown_unit(last_part(axis));
  if (unit == "kPa") return {10.0, "10 kPa"};
  if (unit == "°C") return {1.0, "K"};
  if (unit == "km/h") return {10.0, "10 km/h"};
  if (unit == "N") return {1000.0, "kN"};
  return {1.0, unit.empty() ? "unit of " + name_axis(axis) : unit};
}

/// Slope of a result over an axis in percent of its mean a step, by least squares over all points; the other axes are
/// run through alike at each of its values, so that they do not matter.
std::optional<double> calc_sensitivity_percent(const Json& sweep, const std::string& axis, const std::string& key) {
  double count = 0.0, mean_x = 0.0, mean_y = 0.0;
  for (const Json& point : sweep["points"]) {
    const double y = result_value(point, key);
    if (std::isnan(y)) return std::nullopt;  // the grid has a hole
    ++count;
    mean_x += axis_value(point, axis);
    mean_y += y;
  }
  mean_x /= count;
  mean_y /= count;
  double xx = 0.0, xy = 0.0;
  for (const Json& point : sweep["points"]) {
    const double x = axis_value(point, axis) - mean_x;
    xx += x * x;
    xy += x * (result_value(point, key) - mean_y);
  }
  if (!(xx > 0.0) || mean_y == 0.0) return std::nullopt;
  return 100.0 * find_step(axis).size * xy / xx / mean_y;
}

/// Slopes from each value of an axis to the next, of the means over the other axes, likewise in percent a step; empty
/// where the axis has two values.
std::vector<double> list_local_percents(const Json& sweep, const std::string& axis, const std::string& key) {
  std::map<double, std::pair<double, double>> sums;  // count and sum of the result by the axis's value
  double mean = 0.0;
  for (const Json& point : sweep["points"]) {
    auto& [count, sum] = sums[axis_value(point, axis)];
    ++count;
    sum += result_value(point, key);
    mean += result_value(point, key) / static_cast<double>(sweep["points"].size());
  }
  std::vector<double> percents;
  if (sums.size() < 3) return percents;
  for (auto at = sums.begin(); std::next(at) != sums.end(); ++at) {
    const auto& [x, from] = *at;
    const auto& [next_x, to] = *std::next(at);
    percents.push_back(100.0 * find_step(axis).size * (to.second / to.first - from.second / from.first) / (next_x - x) /
                       mean);
  }
  return percents;
}

}  // namespace

std::vector<std::string> list_sweep_axes(const Json& sweep) {
  std::vector<std::string> axes;
  for (const auto& [key, value] : sweep["points"].front()["set"].items()) axes.push_back(key);
  return axes;
}

bool is_numeric_axis(const Json& sweep, const std::string& axis) {
  return std::all_of(sweep["points"].begin(), sweep["points"].end(), [&axis](const Json& point) {
    return parse_number(point["set"][axis].get<std::string>()).has_value();
  });
}

std::string name_axis(const std::string& axis) { return plain_name(last_part(axis)); }

std::string axis_text(const Json& point, const std::string& axis) { return point["set"][axis].get<std::string>(); }

double axis_value(const Json& point, const std::string& axis) { return *parse_number(axis_text(point, axis)); }

double result_value(const Json& point, const std::string& key) {
  const Json value = point["result"].value(key, Json());
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> list_results(const Json& sweep, const std::string& key) {
  std::vector<double> values;
  for (const Json& point : sweep["points"]) values.push_back(result_value(point, key));
  return values;
}

std::vector<std::string> choose_drawn_results(const Json& sweep) {
  std::vector<std::vector<double>> seen;
  for (const std::string& axis : list_sweep_axes(sweep)) {
    if (!is_numeric_axis(sweep, axis)) continue;
    seen.emplace_back();
    for (const Json& point : sweep["points"]) seen.back().push_back(axis_value(point, axis));
  }
  std::vector<std::string> chosen;
  for (const std::string& key : choose_charts(sweep)) {
    const std::vector<double> values = list_results(sweep, key);
    const bool is_known =
        std::any_of(seen.begin(), seen.end(), [&values](const auto& one) { return are_proportional(values, one); });
    if (is_known) continue;
    chosen.push_back(key);
    seen.push_back(values);
  }
  return chosen;
}

Json list_sensitivities(const Json& sweep, const std::vector<std::string>& keys) {
  constexpr double kStraight = 0.5;  // Assumed: of the mean slope, by which a slope may differ from another
  Json sensitivities = Json::array();
  for (const std::string& key : keys) {
    for (const std::string& axis : list_sweep_axes(sweep)) {
      if (!is_numeric_axis(sweep, axis)) continue;
      const std::optional<double> percent = calc_sensitivity_percent(sweep, axis, key);
      if (!percent.has_value()) continue;
      Json sensitivity = {{"result", key}, {"varied", axis}, {"per", find_step(axis).text}, {"percent", *percent}};
      const std::vector<double> locals = list_local_percents(sweep, axis, key);
      if (!locals.empty()) {
        const auto [low, high] = std::minmax_element(locals.begin(), locals.end());
        sensitivity["lowest_percent"] = *low;
        sensitivity["highest_percent"] = *high;
        sensitivity["is_straight"] = *high - *low <= kStraight * std::abs(*percent);
      }
      sensitivities.push_back(std::move(sensitivity));
    }
  }
  return sensitivities;
}

}  // namespace rollrig::report
