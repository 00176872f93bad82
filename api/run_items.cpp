#include "api/run_items.h"

#include <algorithm>
#include <set>

#include "api/data.h"
#include "sim/core/file_io.h"
#include "sim/core/text.h"

namespace rollrig {
namespace {

constexpr std::size_t kMostChecked = 1000;  // Assumed: takes some seconds

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

RunItems::RunItems(const CampaignDefinition& definition)
    : run_(definition.run),
      factors_(definition.design.factors),
      is_list_(definition.design.name == campaigns::kList),
      design_(campaigns::make_design(definition.design)) {}

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
  Json result = scenarios::run_scenario(read(calc_values(item), seed), {}).result;
  require_known(recorder.list_files());
  return result;
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
        if (parse_number(value).has_value()) continue;
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
      if (!parse_number(value).has_value() && words.insert(value).second) has_new_word = true;
    }
    if (has_new_word) carry_out_quickly(read(values, 1));
  }
}

void RunItems::check_at(const std::vector<std::string>& values) const {
  const scenarios::RunSpec spec = read(values, 1);
  scenarios::prepare_run(spec);
}

void RunItems::check_list() const {
  for (std::size_t item = 0; item < count(); ++item) {
    if (count() <= kMostChecked || item == 0 || item + 1 == count()) check_at(calc_values(item));
  }
}

void RunItems::check_combinations() const {
  const auto has_values = [](const campaigns::Factor& factor) {
    return factor.kind == campaigns::Factor::Kind::kValues;
  };
  if (std::all_of(factors_.begin(), factors_.end(), has_values)) {
    for (std::size_t item = 0; count() <= kMostChecked && item < count(); ++item) check_at(calc_values(item));
    check_at(calc_values(0));
    check_at(calc_values(count() - 1));
  }
}

CampaignItems::Check RunItems::check() const {
  const ReadRecorder recorder;
  if (is_list_) {
    check_list();
  } else {
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
