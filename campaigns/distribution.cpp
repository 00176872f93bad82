#include "campaigns/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <boost/algorithm/string/split.hpp>
#include <boost/math/distributions/normal.hpp>

#include "sim/core/error.h"
#include "sim/core/text.h"

namespace rollrig::campaigns {
namespace {

InputError bad_factor(const std::string& text, const std::string& what,
                      const std::string& allowed =
                          "key=uniform:LOW:HIGH or key=normal:MEAN:SD, with the keys of "
                          "--set") {
  return InputError({fmt::format("--draw '{}' {}", text, what), "command line", 0, "--draw", text, allowed, ""});
}

}  // namespace

std::string Factor::calc_value(double probability) const {
  if (kind == Kind::kValues) {
    const auto place = static_cast<std::size_t>(probability * static_cast<double>(values.size()));
    return values[std::min(place, values.size() - 1)];
  }
  if (kind == Kind::kNormal) return calc_normal_value(*this, calc_score(probability));
  return fmt::format("{:.12g}", first + probability * (second - first));
}

double calc_score(double probability) {
  return boost::math::quantile(boost::math::normal_distribution<double>(), probability);
}

std::string calc_normal_value(const Factor& factor, double score) {
  return fmt::format("{:.12g}", factor.first + score * factor.second);
}

Factor read_drawn_factor(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw bad_factor(text, "is not understood");
  std::vector<std::string> words;
  const std::string rest = text.substr(equals + 1);
  boost::algorithm::split(words, rest, [](char c) { return c == ':'; });
  Factor factor{text.substr(0, equals)};
  if (words.size() != 3) throw bad_factor(text, "is not understood");
  if (words[0] == "uniform") {
    factor.kind = Factor::Kind::kUniform;
  } else if (words[0] == "normal") {
    factor.kind = Factor::Kind::kNormal;
  } else {
    InputProblem problem = unknown_name("distribution", words[0], {"uniform", "normal"});
    problem.file = "command line";
    problem.key = "--draw";
    throw InputError(problem);
  }
  const std::optional<double> first = parse_number(words[1]);
  const std::optional<double> second = parse_number(words[2]);
  if (!first.has_value() || !second.has_value() || !std::isfinite(*first) || !std::isfinite(*second)) {
    throw bad_factor(text, "has no two finite numbers");
  }
  factor.first = *first;
  factor.second = *second;
  if (factor.kind == Factor::Kind::kUniform && !(factor.first < factor.second)) {
    throw bad_factor(text, "has no range", "LOW < HIGH");
  }
  if (factor.kind == Factor::Kind::kNormal && !(factor.second > 0.0)) {
    throw bad_factor(text, "has no standard deviation", "SD > 0");
  }
  return factor;
}

const char* name_of(Factor::Kind kind) {
  if (kind == Factor::Kind::kUniform) return "uniform";
  return kind == Factor::Kind::kNormal ? "normal" : "values";
}

}  // namespace rollrig::campaigns
