#include "api/run_items.h"

#include <algorithm>

#include "api/data.h"

namespace rollrig {

RunItems::RunItems(const CampaignDefinition& definition)
    : run_(definition.run), factors_(definition.design.factors), design_(campaigns::make_design(definition.design)) {}

Json RunItems::describe(std::size_t item) const {
  const std::vector<std::string> values = calc_values(item);
  Json set = Json::object();
  for (std::size_t f = 0; f < values.size(); ++f) set[factors_[f].key] = values[f];
  return set;
}

Json RunItems::carry_out(std::size_t item, std::uint64_t seed) const {
  return scenarios::run_scenario(read(calc_values(item), seed), {}).result;
}

void RunItems::check() const {
  const auto check_at = [this](const std::vector<std::string>& values) {
    const scenarios::RunSpec spec = read(values, 1);
    scenarios::prepare_run(spec);
  };
  const auto is_list = [](const campaigns::Factor& factor) { return factor.kind == campaigns::Factor::Kind::kValues; };
  if (std::all_of(factors_.begin(), factors_.end(), is_list)) {
    check_at(calc_values(0));
    check_at(calc_values(count() - 1));
    return;
  }
  std::vector<std::string> medians;
  for (const campaigns::Factor& factor : factors_) medians.push_back(factor.calc_value(0.5));
  check_at(medians);
}

scenarios::RunSpec RunItems::read(const std::vector<std::string>& values, std::uint64_t seed) const {
  RunInput run = run_;
  for (std::size_t f = 0; f < values.size(); ++f) run.settings.push_back(factors_[f].key + "=" + values[f]);
  run.seed = std::to_string(seed);
  return read_run(run);
}

}  // namespace rollrig
