#include "comparison/compare_tires.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "comparison/flat_values.h"
#include "comparison/input_differences.h"
#include "comparison/tire_document.h"
#include "estimation/uncertainty/budget.h"
#include "scenarios/common/tire_numbers.h"
#include "scenarios/run/flat_results.h"
#include "sim/core/parallel.h"
#include "sim/core/units.h"

namespace rollrig::comparison {
namespace {

using models::TireFile;
using scenarios::RunSpec;
using scenarios::TireNumbers;

/// A number of a tire file with its standard uncertainty, in the unit of its key.
struct TireNumber {
  double value = 0.0;
  double sd = 0.0;  // 0: none is given
};

std::vector<std::pair<std::string, TireNumber>> list_numbers(const TireFile& tire) {
  std::vector<std::pair<std::string, TireNumber>> numbers;
  const auto visit = [](const models::TireParameters<double>& values, auto&& add) {
    models::TireParameters<double>::visit_all(
        values, [&add](const std::string& table, const Field& field, const double& value) {
          add(table + "." + field.key, unit_of_key(field.key), value);
        });
  };
  visit(tire.values, [&numbers](const std::string& key, const Unit& unit, double value) {
    numbers.emplace_back(key, TireNumber{unit.from_si(value), 0.0});
  });
  std::size_t i = 0;
  visit(tire.standard_uncertainties, [&](const std::string& key, const Unit& unit, double sd) {
    if (i < numbers.size() && numbers[i].first == key) numbers[i].second.sd = sd / unit.factor;
    ++i;
  });
  return numbers;
}

/// Whether two files say the same of a tire but its name.
bool are_equal(const TireFile& a, const TireFile& b) {
  const auto numbers_a = list_numbers(a);
  const auto numbers_b = list_numbers(b);
  return numbers_a.size() == numbers_b.size() &&
         std::equal(numbers_a.begin(), numbers_a.end(), numbers_b.begin(), [](const auto& one, const auto& other) {
           return one.first == other.first && one.second.value == other.second.value &&
                  one.second.sd == other.second.sd;
         });
}

/// "a50 does not give", or "neither file gives": what one of two files lacks.
std::string find_missing(bool has_reference, bool has_other, std::size_t other, const Comparison& comparison) {
  if (has_reference) return comparison.names[other] + " does not give";
  return has_other ? comparison.names.front() + " does not give" : "neither file gives";
}

/// The interval of a difference whose two values have these standard uncertainties; why there is none, where one lacks.
void settle(std::optional<double> reference_sd, std::optional<double> other_sd, bool are_same, const std::string& why,
            Difference& difference) {
  if (are_same) {
    add_interval(0.0, 0.0, difference);
  } else if (reference_sd.has_value() && other_sd.has_value()) {
    add_interval(std::hypot(*reference_sd, *other_sd),
                 estimation::calc_coverage_factor(std::numeric_limits<double>::infinity()), difference);
  } else {
    add_reason(why, difference);
  }
}

void add_numbers(const std::vector<TireFile>& tires, Comparison& comparison) {
  std::vector<std::map<std::string, TireNumber>> all;
  std::vector<std::string> keys;
  for (const TireFile& tire : tires) {
    all.emplace_back();
    for (const auto& [key, number] : list_numbers(tire)) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
      all.back()[key] = number;
    }
  }
  for (const std::string& key : keys) {
    ComparedValue value;
    value.name = key;
    value.label = label_result(key);
    value.unit = unit_of_key(key.substr(key.rfind('.') + 1)).symbol;
    bool is_given = false;
    for (const auto& numbers : all) {
      const auto found = numbers.find(key);
      value.values.push_back(found != numbers.end() ? std::optional(found->second.value) : std::nullopt);
      is_given = is_given || (found != numbers.end() && found->second.value != 0.0);
    }
    if (!is_given) continue;  // of a table that no file has
    for (std::size_t i = 1; i < tires.size(); ++i) {
      Difference difference = subtract(value.values[i], value.values.front(), value.unit);
      const auto find_sd = [&key](std::map<std::string, TireNumber>& numbers) {
        return numbers[key].sd > 0.0 ? std::optional(numbers[key].sd) : std::nullopt;
      };
      const std::optional<double> a = find_sd(all.front()), b = find_sd(all[i]);
      settle(a, b, are_equal(tires.front(), tires[i]),
             find_missing(a.has_value(), b.has_value(), i, comparison) + " a standard uncertainty", difference);
      value.differences.push_back(difference);
    }
    comparison.values.push_back(std::move(value));
  }
}

/// How far a number is moved, in standard uncertainties: far enough to be seen, and not beyond what a tire can be.
constexpr double kMoveStep = 0.1;

/// A virtual test of one tire with its numbers as they are, then moved up and down along each direction.
struct TireTest {
  std::vector<Json> results;  // first as they are
  Json settings;
};

TireTest run_test(const RunSpec& spec, int threads, const std::function<void()>& advance) {
  const TireNumbers numbers = TireNumbers::of(spec.tire);
  const auto count = static_cast<Eigen::Index>(numbers.keys.size());
  TireTest test;
  test.results.resize(1 + 2 * numbers.keys.size());
  parallel_for(
      test.results.size(), threads,
      [&](std::size_t i) {
        RunSpec own = spec;
        if (i > 0) {
          Eigen::VectorXd z = Eigen::VectorXd::Zero(count);
          z(static_cast<Eigen::Index>((i - 1) / 2)) = i % 2 == 1 ? kMoveStep : -kMoveStep;
          numbers.move(z, own.tire);
        }
        scenarios::Outcome outcome = scenarios::run_scenario(own, {});
        test.results[i] = std::move(outcome.result);
        if (i == 0) test.settings = std::move(outcome.settings);
      },
      [&advance](double) { advance(); });
  test.results = scenarios::flatten_results(test.results);
  return test;
}

/// Standard uncertainty of a result by the numbers of the tire file; none where these have none.
std::optional<double> calc_result_sd(const TireTest& test, const std::string& key) {
  if (test.results.size() == 1) return std::nullopt;
  double variance = 0.0;
  for (std::size_t i = 1; i < test.results.size(); i += 2) {
    const std::optional<double> above = find_number(test.results[i], key);
    const std::optional<double> below = find_number(test.results[i + 1], key);
    if (!above.has_value() || !below.has_value()) return std::nullopt;
    variance += std::pow(0.5 * (*above - *below) / kMoveStep, 2);
  }
  return std::sqrt(variance);
}

void add_results(const std::vector<TireFile>& tires, const VirtualTest& test, const std::vector<TireTest>& done,
                 Comparison& comparison) {
  std::vector<Json> flat;
  for (const TireTest& one : done) flat.push_back(one.results.front());
  for (const std::string& key : list_keys(flat)) {
    ComparedValue value = make_value(key, flat, test.runs.front().scenario);
    value.place = test.scenario;
    for (std::size_t i = 1; i < done.size(); ++i) {
      const std::optional<double> a = calc_result_sd(done.front(), key), b = calc_result_sd(done[i], key);
      settle(a, b, are_equal(tires.front(), tires[i]),
             find_missing(a.has_value(), b.has_value(), i, comparison) + " a standard uncertainty of its numbers",
             value.differences[i - 1]);
    }
    comparison.values.push_back(std::move(value));
  }
}

const char* name_of_basis(models::TireBasis basis) {
  return basis == models::TireBasis::kMeasured ? "measured" : basis == models::TireBasis::kClass ? "class" : "not said";
}

/// RRc as ISO 28580 has it, else the first value.
std::size_t find_main_value(const std::vector<ComparedValue>& values) {
  const auto rrc =
      std::find_if(values.begin(), values.end(), [](const ComparedValue& value) { return value.name == kMainResult; });
  return rrc != values.end() ? static_cast<std::size_t>(rrc - values.begin()) : 0;
}

}  // namespace

Compared compare_tires(const std::vector<TireFile>& tires, const std::vector<VirtualTest>& tests,
                       const std::vector<std::string>& names, int threads, const std::function<void(double)>& advance) {
  Compared compared;
  Comparison& comparison = compared.comparison;
  comparison.kind = ComparedKind::kTires;
  comparison.names = names;
  std::size_t all = 0, made = 0;
  for (const VirtualTest& test : tests) {
    for (const RunSpec& run : test.runs) all += 1 + 2 * TireNumbers::of(run.tire).keys.size();
  }
  const auto count_run = [&] { advance(static_cast<double>(++made) / static_cast<double>(all)); };
  std::vector<Json> documents;
  for (const TireFile& tire : tires) {
    documents.push_back({{"designation", tire.designation},
                         {"model", id_of(tire.values.model())},
                         {"basis", name_of_basis(tire.basis)}});
  }
  std::vector<std::vector<TireTest>> done;
  for (const VirtualTest& test : tests) {
    done.emplace_back();
    for (std::size_t i = 0; i < tires.size(); ++i) {
      done.back().push_back(run_test(test.runs[i], threads, count_run));
      documents[i][test.scenario] = done.back().back().settings;
    }
    add_results(tires, test, done.back(), comparison);
  }
  add_numbers(tires, comparison);
  std::vector<const Json*> pointers;
  for (const Json& document : documents) pointers.push_back(&document);
  comparison.inputs = find_different_inputs(pointers, {});
  comparison.method = {
      "virtual tests are quasi-static where the scenario can be, without sensors, each tire at the conditions of its "
      "own file",
      "intervals of 95 % from the standard uncertainties (_sd) of the tire files and their correlation; the errors of "
      "two files are taken to be independent, and to be common where all numbers of both are equal. How well the law "
      "of the tire model describes a tire is not included"};
  if (!comparison.values.empty()) choose_main(find_main_value(comparison.values), compared);
  return compared;
}

}  // namespace rollrig::comparison
