#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <boost/algorithm/string/split.hpp>

#include "rollrig/sweep.h"
#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

InputError bad_axis(const std::string& text, const std::string& what = "is not understood",
                    const std::string& allowed = "key=a,b,c or key=from:to:step, with the keys of --set") {
  return InputError({fmt::format("--vary '{}' {}", text, what), "command line", 0, "--vary", text, allowed, ""});
}

}  // namespace

SweepAxis read_sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) throw bad_axis(text);
  SweepAxis axis{text.substr(0, equals), {}};
  const std::string values = text.substr(equals + 1);
  if (values.find(':') == std::string::npos) {
    boost::algorithm::split(axis.values, values, [](char c) { return c == ','; });
    if (std::any_of(axis.values.begin(), axis.values.end(), [](const std::string& value) { return value.empty(); })) {
      throw bad_axis(text, "has an empty value", "a value before and after each comma");
    }
    return axis;
  }
  std::vector<std::string> words;
  boost::algorithm::split(words, values, [](char c) { return c == ':'; });
  if (words.size() != 3) throw bad_axis(text);
  const std::optional<double> from = parse_number(words[0]);
  const std::optional<double> to = parse_number(words[1]);
  const std::optional<double> step = parse_number(words[2]);
  if (!from.has_value() || !to.has_value() || !step.has_value()) throw bad_axis(text);
  constexpr double kMostValues = 10000.0;
  const double intervals = (*to - *from) / *step;
  if (!std::isfinite(*from) || !std::isfinite(*to) || !std::isfinite(*step)) {
    throw bad_axis(text, "is not finite", "finite numbers");
  }
  if (*step == 0.0) throw bad_axis(text, "has a step of 0", "a step that leads from the first value to the last");
  if (intervals < 0.0) {
    throw bad_axis(text, "has a step that leads away from the last value",
                   fmt::format("a step of the other sign: {:.6g}", -*step));
  }
  if (intervals > kMostValues) {
    throw bad_axis(text, fmt::format("has {:.6g} values", std::floor(intervals) + 1.0),
                   fmt::format("at most {:.0f}", kMostValues + 1.0));
  }
  const int last = static_cast<int>(std::floor(intervals + 1e-9));
  for (int i = 0; i <= last; ++i) axis.values.push_back(fmt::format("{:.12g}", *from + i * *step));
  return axis;
}

}  // namespace rollrig
