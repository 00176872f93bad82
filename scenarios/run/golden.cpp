#include "scenarios/run/golden.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "sim/core/csv.h"

namespace rollrig::scenarios {
namespace {

// Assumed: what another compiler or machine may change through the integrator's choice of steps.
constexpr double kAbsoluteTolerance = 1e-4;  // in the unit of the quantity
constexpr double kRelativeTolerance = 2e-5;
constexpr std::size_t kSamplesAChannel = 30;

using Key = std::pair<std::string, double>;

Key key_of(const GoldenValue& value) {
  return {value.quantity, std::isnan(value.time_s) ? -std::numeric_limits<double>::infinity() : value.time_s};
}

std::map<Key, GoldenValue> index_values(const std::vector<GoldenValue>& values) {
  std::map<Key, GoldenValue> index;
  for (const GoldenValue& value : values) index[key_of(value)] = value;
  return index;
}

GoldenValue make_value(const std::string& quantity, double time_s, double value) {
  return {quantity, time_s, value, kAbsoluteTolerance, kRelativeTolerance};
}

void add_numbers(const std::string& name, const Json& json, std::vector<GoldenValue>& golden) {
  if (json.is_number()) {
    golden.push_back(make_value(name, std::nan(""), json.get<double>()));
  } else if (json.is_object()) {
    for (const auto& [key, value] : json.items()) add_numbers(name + "." + key, value, golden);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) add_numbers(fmt::format("{}.{}", name, i), json[i], golden);
  }
}

std::string describe(const GoldenValue& value) {
  return std::isnan(value.time_s) ? value.quantity : fmt::format("{} at {} s", value.quantity, value.time_s);
}

}  // namespace

double GoldenValue::tolerance() const { return absolute_tolerance + relative_tolerance * std::abs(value); }

std::vector<GoldenValue> make_golden(const Outcome& outcome) {
  std::vector<GoldenValue> golden;
  add_numbers("result", outcome.result, golden);
  const sim::Recording<double>& recording = outcome.recording;
  const std::size_t stride = std::max<std::size_t>(1, recording.row_count() / kSamplesAChannel);
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    const std::string name = recording.channels[i].quantity.header();
    for (std::size_t row = 0; row < recording.row_count(); row += stride) {
      golden.push_back(make_value(name, recording.time_s[row], unit_of_key(name).from_si(recording.values[i][row])));
    }
  }
  return golden;
}

void keep_tolerances(const std::vector<GoldenValue>& former, std::vector<GoldenValue>& golden) {
  const std::map<Key, GoldenValue> index = index_values(former);
  for (GoldenValue& value : golden) {
    const auto it = index.find(key_of(value));
    if (it == index.end()) continue;
    value.absolute_tolerance = it->second.absolute_tolerance;
    value.relative_tolerance = it->second.relative_tolerance;
  }
}

GoldenComparison compare_with_golden(const std::vector<GoldenValue>& golden, const std::vector<GoldenValue>& now) {
  GoldenComparison comparison;
  std::map<Key, GoldenValue> index = index_values(now);
  for (const GoldenValue& expected : golden) {
    const auto it = index.find(key_of(expected));
    if (it == index.end()) {
      comparison.problems.push_back(describe(expected) + " is missing");
      continue;
    }
    ++comparison.compared;
    const double difference = std::abs(it->second.value - expected.value);
    const double share = difference == 0.0 ? 0.0 : difference / expected.tolerance();  // the tolerance may be 0
    if (!(share <= comparison.worst_share) || comparison.worst_quantity.empty()) {
      comparison.worst_share = share;
      comparison.worst_quantity = describe(expected);
    }
    if (!(share <= 1.0)) {
      comparison.problems.push_back(fmt::format("{}: {:.9g}, golden {:.9g}, tolerance {:.3g}", describe(expected),
                                                it->second.value, expected.value, expected.tolerance()));
    }
    index.erase(it);
  }
  for (const auto& [key, value] : index) comparison.problems.push_back(describe(value) + " is new");
  return comparison;
}

std::vector<GoldenValue> read_golden(const std::string& path) {
  const CsvTable csv = CsvTable::read(path);
  csv.require_known({"quantity", "time_s", "value", "absolute_tolerance", "relative_tolerance"});
  const std::vector<std::string> quantity = csv.text("quantity");
  const std::vector<double> time_s = csv.numbers({"time_s", any_number(), ""}, true);
  const std::vector<double> value = csv.numbers({"value", any_number(), ""});
  const std::vector<double> absolute = csv.numbers({"absolute_tolerance", non_negative(), ""});
  const std::vector<double> relative = csv.numbers({"relative_tolerance", non_negative(), ""});
  std::vector<GoldenValue> golden;
  for (std::size_t i = 0; i < quantity.size(); ++i) {
    golden.push_back({quantity[i], time_s[i], value[i], absolute[i], relative[i]});
  }
  return golden;
}

std::string write_golden(const std::vector<GoldenValue>& golden) {
  CsvWriter csv({"quantity", "time_s", "value", "absolute_tolerance", "relative_tolerance"});
  for (const GoldenValue& value : golden) {
    csv.add_row(value.quantity, value.time_s, CsvWriter::Rounded{value.value, 10}, value.absolute_tolerance,
                value.relative_tolerance);
  }
  return csv.take();
}

}  // namespace rollrig::scenarios
