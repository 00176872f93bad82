#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "report/blocks.h"

namespace rollrig::report {
namespace {

/// Sums of doubles that were differences before are equal to a few of their last digits.
constexpr double kRounding = 1e-9;

void check_waterfall(const WaterfallBar& start, const std::vector<WaterfallBar>& steps, const WaterfallBar& end) {
  double reached = start.value;
  double size = std::abs(start.value) + std::abs(end.value);
  for (const WaterfallBar& step : steps) {
    reached += step.value;
    size += std::abs(step.value);
  }
  if (std::abs(reached - end.value) <= kRounding * size) return;  // false of a value that is not finite
  throw std::logic_error(
      fmt::format("the steps from '{}' lead to {:.9g}, but '{}' is {:.9g}", start.name, reached, end.name, end.value));
}

/// What is left of two equal sums is no change.
double drop_rounding(double change, double size) { return std::abs(change) <= kRounding * size ? 0.0 : change; }

Json make_bar(const WaterfallBar& bar) {
  Json json = {{"name", bar.name}, {"value", rounded(bar.value)}};
  if (bar.limits) json.update({{"low", rounded((*bar.limits)[0])}, {"high", rounded((*bar.limits)[1])}});
  return json;
}

}  // namespace

Block make_waterfall(const Axis& value, const WaterfallBar& start, const std::vector<WaterfallBar>& steps,
                     const WaterfallBar& end, const std::string& caption) {
  check_waterfall(start, steps, end);
  Block block = {{"type", "waterfall"},      {"label", value.label},   {"unit", value.unit},
                 {"start", make_bar(start)}, {"steps", Json::array()}, {"end", make_bar(end)}};
  const double size = std::abs(start.value) + std::abs(end.value);
  for (const WaterfallBar& step : steps) {
    block["steps"].push_back(make_bar({step.name, drop_rounding(step.value, size), step.limits}));
  }
  if (!caption.empty()) block["caption"] = caption;
  return block;
}

}  // namespace rollrig::report
