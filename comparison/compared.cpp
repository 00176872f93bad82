#include "comparison/compared.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/split.hpp>
#include <cctype>
#include <cmath>
#include <map>

#include "scenarios/run/scenario.h"
#include "sim/core/units.h"

namespace rollrig::comparison {

Difference subtract(const std::optional<double>& value, const std::optional<double>& reference,
                    const std::string& unit) {
  Difference difference;
  if (!value.has_value() || !reference.has_value()) return difference;
  difference.value = *value - *reference;
  if (unit != "degC" && unit != "%" && *reference != 0.0)
    difference.percent = 100.0 * *difference.value / std::abs(*reference);
  return difference;
}

namespace {

/// "ISO RRc true" of "iso rrc true".
std::string write_abbreviations(const std::string& text) {
  static const std::map<std::string, std::string> kWritten{
      {"rrc", "RRc"}, {"iso", "ISO"}, {"dc", "DC"}, {"ac", "AC"}, {"rr", "rolling resistance"}};
  std::vector<std::string> words;
  boost::algorithm::split(words, text, [](char c) { return c == ' '; });
  for (std::string& word : words) {
    if (const auto known = kWritten.find(word); known != kWritten.end()) word = known->second;
  }
  return boost::algorithm::join(words, " ");
}

}  // namespace

std::string label_result(const std::string& key) {
  const std::size_t last = key.rfind('.');
  std::string own = plain_name(last == std::string::npos ? key : key.substr(last + 1));
  constexpr const char* kDeviation = "_sd";
  if (key.size() > 3 && key.compare(key.size() - 3, 3, kDeviation) == 0) own += ", standard deviation";
  own = write_abbreviations(own);
  if (own == "RRc 25degC 2m") own = "RRc at 25 degC, 2 m drum";
  if (last == std::string::npos) return own;
  std::string record = key.substr(0, last);  // "force_N.1": without the unit of the list
  const std::size_t dot = record.find('.');
  if (dot != std::string::npos) record = plain_name(record.substr(0, dot)) + record.substr(dot);
  std::replace(record.begin(), record.end(), '.', ' ');
  std::replace(record.begin(), record.end(), '_', ' ');
  return fmt::format("{}: {}", record, own);
}

std::string label_input(const std::string& key) {
  const std::size_t last = key.rfind('.');
  const std::string own = last == std::string::npos ? key : key.substr(last + 1);
  const std::string unit = unit_of_key(own).symbol;
  std::string name = last == std::string::npos ? "" : key.substr(0, last) + ": ";
  std::replace(name.begin(), name.end(), '_', ' ');
  boost::algorithm::replace_all(name, ".", ", ");
  name += plain_name(own) + (unit.empty() ? "" : ", " + unit);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

std::string label_place(const std::string& place) {
  const scenarios::Scenario* scenario = scenarios::find_scenario_if_any(place);
  return scenario == nullptr ? place : scenario->text.summary.substr(0, scenario->text.summary.find_first_of(":,"));
}

void add_interval(double sd, double coverage_factor, Difference& difference) {
  if (!difference.value.has_value()) return;
  difference.sd = sd;
  difference.low_95 = *difference.value - coverage_factor * sd;
  difference.high_95 = *difference.value + coverage_factor * sd;
  difference.why_no_interval.clear();
}

void add_reason(const std::string& why, Difference& difference) {
  if (difference.value.has_value() && !difference.sd.has_value()) difference.why_no_interval = why;
}

bool shows_difference(const Difference& difference) {
  return !difference.sd.has_value() || *difference.low_95 > 0.0 || *difference.high_95 < 0.0;
}

namespace {

/// Decimals with which the largest of a difference and its limits has three digits; none where it needs an exponent.
std::optional<int> find_decimals(const Difference& difference) {
  constexpr int kDigits = 3, kMost = 6;
  double largest = std::abs(difference.value.value_or(0.0));
  if (difference.sd.has_value()) largest = std::max(std::abs(*difference.low_95), std::abs(*difference.high_95));
  if (!(largest > 0.0)) return 0;
  const int decimals = kDigits - 1 - static_cast<int>(std::floor(std::log10(largest)));
  if (decimals > kMost || decimals < -kMost) return std::nullopt;
  return std::max(0, decimals);
}

std::string show_like(double value, const Difference& difference, bool has_sign) {
  const std::optional<int> decimals = find_decimals(difference);
  if (!decimals.has_value()) return has_sign ? fmt::format("{:+.3g}", value) : fmt::format("{:.3g}", value);
  return has_sign ? fmt::format("{:+.{}f}", value, *decimals) : fmt::format("{:.{}f}", value, *decimals);
}

}  // namespace

std::string show_difference(const Difference& difference) {
  return difference.value.has_value() ? show_like(*difference.value, difference, true) : "-";
}

std::string show_interval(const Difference& difference) {
  if (!difference.sd.has_value()) return "-";
  return fmt::format("{} to {}", show_like(*difference.low_95, difference, false),
                     show_like(*difference.high_95, difference, false));
}

namespace {

std::string describe_difference(const Comparison& comparison, const ComparedValue& value, std::size_t other) {
  const Difference& difference = value.differences[other - 1];
  const std::string& name = comparison.names[other];
  const std::string what =
      value.place.empty() ? value.label : fmt::format("{} ({})", value.label, label_place(value.place));
  if (!difference.value.has_value()) return fmt::format("{}: {} has no value", what, name);
  const std::string unit = value.unit.empty() ? "" : " " + value.unit;
  const double size = *difference.value;
  std::string text = fmt::format("{} of {} is ", what, name);
  if (size == 0.0) {
    text += fmt::format("the same as that of {}", comparison.names.front());
  } else {
    text += fmt::format("{}{} {} than that of {}", show_like(std::abs(size), difference, false), unit,
                        size < 0.0 ? "lower" : "higher", comparison.names.front());
  }
  std::string more;
  if (difference.percent.has_value()) more += fmt::format("{:+.1f} %; ", *difference.percent);
  if (difference.sd.has_value()) {
    more += fmt::format("95 % interval {}{}", show_interval(difference), unit);
  } else {
    more += "no interval";
  }
  if (!shows_difference(difference) && size != 0.0) {
    return fmt::format("No difference in {} is shown: {} minus {} is {}{} ({}, which contains 0)", what, name,
                       comparison.names.front(), show_difference(difference), unit, more);
  }
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return fmt::format("{} ({})", text, more);
}

}  // namespace

void choose_main(std::size_t value, Compared& compared) {
  Comparison& comparison = compared.comparison;
  compared.main = value;
  comparison.message.clear();
  for (std::size_t i = 1; i < comparison.names.size(); ++i) {
    comparison.message += (i > 1 ? ". " : "") + describe_difference(comparison, comparison.values[value], i);
  }
}

}  // namespace rollrig::comparison
