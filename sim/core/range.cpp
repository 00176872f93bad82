#include <fmt/format.h>

#include <boost/algorithm/string/join.hpp>
#include <cmath>

#include "sim/core/schema.h"

namespace rollrig {

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  const bool above = lower_open ? value > lower : value >= lower;
  const bool below = upper_open ? value < upper : value <= upper;
  return above && below;
}

std::string Range::to_string() const {
  std::vector<std::string> parts;
  if (std::isfinite(lower)) parts.push_back(fmt::format("{} {}", lower_open ? ">" : ">=", lower));
  if (std::isfinite(upper)) parts.push_back(fmt::format("{} {}", upper_open ? "<" : "<=", upper));
  return boost::algorithm::join(parts, " and ");
}

}  // namespace rollrig
