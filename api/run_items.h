#pragma once
/// The runs of a campaign as items.

#include <memory>
#include <string>
#include <vector>

#include "api/campaign_items.h"
#include "scenarios/run/flat_results.h"
#include "scenarios/run/scenario.h"

namespace rollrig {

/// Runs a scenario in its quicker fidelity, where it has two, for the files that are read only then. That the run fails
/// does not matter.
void carry_out_quickly(scenarios::RunSpec spec);

/// The factor and axis whose values are tires, by name or path, and not numbers of a file.
constexpr const char* kTireFactor = "tire";
/// Sets a factor of a sweep or a campaign: the tire, or a setting.
void set_factor(const std::string& key, const std::string& value, RunInput& run);

/// Whether an error of a run is about the value of a factor, which set_factor() has set. The key of the error may have
/// a table in front of it: "[settings] load_N".
bool is_of_factor(const InputError& error, const std::string& key);
/// Throws the error as one of the option by which the factor was given.
[[noreturn]] void throw_of_option(const InputError& error, const char* option);

class RunItems : public CampaignItems {
 public:
  /// Throws InputError for a design that cannot be made.
  explicit RunItems(const CampaignDefinition& definition);

  std::size_t count() const override { return design_->count_items(); }
  Json describe(std::size_t item) const override;
  Json carry_out(std::size_t item, std::uint64_t seed) const override;
  /// Does nothing: carry_out() checks the files that the item has read. A list may have thousands of others.
  void require_unchanged() const override {}

  /// The keys of the factors.
  std::vector<std::string> list_keys() const override;
  /// The value of each factor.
  std::vector<std::string> calc_values(std::size_t item) const override { return design_->calc_values(item); }
  /// Reads and prepares items: of a grid or a list all, if they are at most 1000, else those with the least and the
  /// largest number of each factor, with a number that is not whole, and with each word; if any factor is drawn, the
  /// median of each factor alone. Then carries out that median or the first item, and one run for each word, in the
  /// quicker fidelity.
  Check check() const override;
  void check_briefly(bool has_same_assets) const override;
  void learn_names(const Json& result) override { flattener_.learn_names(result); }
  Json flatten(const Json& result) const override { return flattener_.flatten(result); }

 private:
  scenarios::RunSpec read(const std::vector<std::string>& values, std::uint64_t seed) const;
  /// Of a list its first item, else the median of each factor: of draws, an item itself may be one that fails.
  std::vector<std::string> find_usual_values() const;
  /// Reads and prepares a run.
  void prepare(const std::vector<std::string>& values) const;
  /// As prepare(); what is wrong with a factor is told of its option.
  void check_at(const std::vector<std::string>& values) const;
  /// A run for every value that is a word, such as the name of a tire or of a method: each may have a file read. Not
  /// for files that are watched already.
  void carry_out_words() const;
  /// Of a list, whose values belong together. What is wrong with a setting of a row is told with the row.
  void check_list() const;
  /// Throws InputError where a factor is drawn and its setting takes whole numbers alone.
  void check_draws() const;
  /// Of a design in which every value may meet every other.
  void check_combinations() const;

  RunInput run_;
  std::vector<campaigns::Factor> factors_;
  bool is_list_;
  std::string list_;  // its file, for messages; empty where the campaign was begun in another session
  std::unique_ptr<campaigns::Design> design_;
  scenarios::ResultFlattener flattener_;
};

}  // namespace rollrig
