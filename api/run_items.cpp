#include "api/run_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "api/data.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

constexpr std::size_t kMostChecked = 1000;  // Assumed: takes some seconds

/// The places of values that tell whether all of them are allowed: the least and the largest number, the first one that
/// is not whole, and each word once.
std::set<std::size_t> list_telling(const std::vector<std::string>& values) {
  std::map<std::string, std::size_t> words;
  std::optional<std::size_t> least, largest, fractional;
  const auto number_at = [&values](std::size_t place) { return parse_number(values[place]).value_or(0.0); };
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::optional<double> number = parse_number(values[i]);
    if (!number.has_value()) {
      words.emplace(values[i], i);
      continue;
    }
    if (!least.has_value() || *number < number_at(*least)) least = i;
    if (!largest.has_value() || *number > number_at(*largest)) largest = i;
    if (!fractional.has_value() && *number != std::floor(*number)) fractional = i;
  }
  std::set<std::size_t> places;
  for (const std::optional<std::size_t>& place : {least, largest, fractional}) {
    if (place.has_value()) places.insert(*place);
  }
  for (const auto& [word, place] : words) places.insert(place);
  return places;
}

}  // namespace

void carry_out_quickly(scenarios::RunSpec spec) {
  for (const scenarios::Fidelity fidelity : spec.scenario->fidelities) {
    if (fidelity == scenarios::Fidelity::kQuasiStatic) spec.fidelity = fidelity;
  }
  try {
    scenarios::run_scenario(spec, {});
  } catch (const RunFailure&) {
  }
}

void set_factor(const std::string& key, const std::string& value, RunInput& run) {
  if (key == kTireFactor) {
    run.tire = value;
  } else {
    run.settings.push_back(key + "=" + value);
  }
}

bool is_of_factor(const InputError& error, const std::string& key) {
  const InputProblem& problem = error.problem();
  if (problem.file == "command line") return key == kTireFactor && problem.key == kTireFactor;
  const std::string last = key.substr(key.rfind('.') + 1);
  const std::size_t place = problem.key.size() - std::min(problem.key.size(), last.size());
  return problem.file == "--set" && problem.key.substr(place) == last;  // "[settings] load_N"
}

void throw_of_option(const InputError& error, const char* option) {
  InputProblem problem = error.problem();
  problem.file = option;
  throw InputError(problem);
}

namespace {

/// Reports errors of headings of a list as errors of its file.
std::unique_ptr<campaigns::Design> make_design_of(const CampaignDefinition& definition) {
  try {
    return campaigns::make_design(definition.design);
  } catch (const InputError& error) {
    if (definition.list.empty()) throw;
    InputProblem problem = error.problem();
    problem.file = definition.list;
    problem.line = 1;
    problem.key.clear();
    throw InputError(problem);
  }
}

}  // namespace

RunItems::RunItems(const CampaignDefinition& definition)
    : run_(definition.run),
      factors_(definition.design.factors),
      is_list_(definition.design.name == campaigns::kList),
      list_(definition.list),
      design_(make_design_of(definition)) {}

std::vector<std::string> RunItems::list_keys() const {
  std::vector<std::string> keys;
  for (const campaigns::Factor& factor : factors_) keys.push_back(factor.key);
  return keys;
}

Json RunItems::describe(std::size_t item) const {
  const std::vector<std::string> values = calc_values(item);
  Json set = Json::object();
  for (std::size_t f = 0; f < values.size(); ++f) set[factors_[f].key] = values[f];
  return set;
}

Json RunItems::carry_out(std::size_t item, std::uint64_t seed) const {
  const ReadRecorder recorder;
  try {
    Json result = scenarios::run_scenario(read(calc_values(item), seed), {}).result;
    require_known(recorder.list_files());
    require_unchanged_files(recorder.list_files());
    return result;
  } catch (const campaigns::CampaignChanged&) {
    throw;
  } catch (const std::exception&) {
    require_unchanged_files(recorder.list_files());  // else it would count as a failure of the item
    throw;
  }
}

std::vector<std::string> RunItems::find_usual_values() const {
  if (is_list_) return calc_values(0);
  std::vector<std::string> medians;
  for (const campaigns::Factor& factor : factors_) medians.push_back(factor.calc_value(0.5));
  return medians;
}

void RunItems::check_briefly(bool has_same_assets) const {
  const std::vector<std::string> values = find_usual_values();
  check_at(values);
  if (has_same_assets) return;
  carry_out_quickly(read(values, 1));  // some files are read only then
  carry_out_words();
}

void RunItems::carry_out_words() const {
  if (!is_list_) {
    const std::vector<std::string> medians = find_usual_values();
    for (std::size_t f = 0; f < factors_.size(); ++f) {
      for (const std::string& value : factors_[f].values) {
        if (parse_number(value).has_value() || knows(value)) continue;
        std::vector<std::string> values = medians;
        values[f] = value;
        carry_out_quickly(read(values, 1));
      }
    }
    return;
  }
  std::set<std::string> words;
  for (std::size_t item = 0; item < count(); ++item) {
    const std::vector<std::string> values = calc_values(item);
    bool has_new_word = false;
    for (const std::string& value : values) {
      if (!parse_number(value).has_value() && !knows(value) && words.insert(value).second) has_new_word = true;
    }
    if (has_new_word) carry_out_quickly(read(values, 1));
  }
}

void RunItems::prepare(const std::vector<std::string>& values) const {
  const scenarios::RunSpec spec = read(values, 1);
  scenarios::prepare_run(spec);
}

void RunItems::check_at(const std::vector<std::string>& values) const {
  try {
    prepare(values);
  } catch (const InputError& error) {
    for (const campaigns::Factor& factor : factors_) {
      const char* option = factor.kind == campaigns::Factor::Kind::kValues ? "--vary" : "--draw";
      if (is_of_factor(error, factor.key)) throw_of_option(error, option);
    }
    throw;
  }
}

void RunItems::check_list() const {
  std::set<std::size_t> rows;
  if (count() <= kMostChecked) {
    for (std::size_t item = 0; item < count(); ++item) rows.insert(item);
  } else {
    for (const campaigns::Factor& factor : factors_) rows.merge(list_telling(factor.values));
  }
  for (const std::size_t item : rows) {
    try {
      prepare(calc_values(item));
    } catch (const InputError& error) {
      const auto has_key = [&error](const campaigns::Factor& factor) { return is_of_factor(error, factor.key); };
      if (list_.empty() || std::none_of(factors_.begin(), factors_.end(), has_key)) throw;
      InputProblem problem = error.problem();
      problem.file = list_;
      const bool is_heading = problem.what.rfind("unknown key", 0) == 0;
      problem.line = is_heading ? 1 : static_cast<int>(item) + 2;
      throw InputError(problem);
    }
  }
}

void RunItems::check_draws() const {
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    if (factors_[f].kind == campaigns::Factor::Kind::kValues) continue;
    const auto can_be = [&](double number) {
      std::vector<std::string> values = find_usual_values();
      values[f] = fmt::format("{}", number);
      try {
        prepare(values);
        return true;
      } catch (const InputError&) {
        return false;
      }
    };
    const auto is_refused_as_fraction = [&](double probability) {
      const double drawn = parse_number(factors_[f].calc_value(probability)).value_or(0.0);
      return !can_be(drawn) && can_be(std::round(drawn));
    };
    if (!is_refused_as_fraction(0.41) || !is_refused_as_fraction(0.57)) continue;
    throw InputError({fmt::format("'{}' takes whole numbers, and draws are others", factors_[f].key), "command line", 0,
                      "--draw", factors_[f].key,
                      fmt::format("--vary {}=1,2,3 (as needed), whose values are equally likely in a design that draws",
                                  factors_[f].key),
                      ""});
  }
}

void RunItems::check_combinations() const {
  const auto has_values = [](const campaigns::Factor& factor) {
    return factor.kind == campaigns::Factor::Kind::kValues;
  };
  if (!std::all_of(factors_.begin(), factors_.end(), has_values)) return;
  if (count() <= kMostChecked) {
    for (std::size_t item = 0; item < count(); ++item) check_at(calc_values(item));
    return;
  }
  check_at(calc_values(0));
  check_at(calc_values(count() - 1));
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    for (const std::size_t place : list_telling(factors_[f].values)) {
      std::vector<std::string> values = find_usual_values();
      values[f] = factors_[f].values[place];
      check_at(values);
    }
  }
}

CampaignItems::Check RunItems::check() const {
  const ReadRecorder recorder;
  if (is_list_) {
    check_list();
  } else {
    check_draws();
    check_combinations();
  }
  check_briefly(false);
  return {hash_files(recorder.list_files()), {}};
}

scenarios::RunSpec RunItems::read(const std::vector<std::string>& values, std::uint64_t seed) const {
  RunInput run = run_;
  for (std::size_t f = 0; f < values.size(); ++f) set_factor(factors_[f].key, values[f], run);
  run.seed = std::to_string(seed);
  return read_run(run);
}

}  // namespace rollrig
