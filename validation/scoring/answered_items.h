#pragma once
/// Items of a campaign whose results are answers, each in a file of its own: <folder>/<number>.json.

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "campaigns/items.h"

namespace rollrig::validation {

/// Cases to be answered. carry_out() gives the answer, where "failure" says why a case could not be diagnosed, or is
/// null.
class AnsweredItems : public campaigns::ItemList {
 public:
  virtual std::string number_of(std::size_t item) const = 0;
  /// The answer from before, or its "failure" alone, where it still holds: of the same files, by this program, with the
  /// same comparison.
  virtual std::optional<Json> find_before(std::size_t item) const = 0;
  /// A diagnosis draws nothing.
  std::uint64_t calc_seed(std::size_t, std::uint64_t) const override { return 0; }
};

struct AnswerTally {
  std::size_t kept = 0;                         // answered before
  std::size_t made = 0;                         // answered now
  std::map<std::string, std::string> failures;  // by number, why a case could not be diagnosed
  bool interrupted = false;
};

/// Carries out the items that have no answer yet. Each answer is written as soon as it is there, so that a run that was
/// interrupted goes on where it stopped. `progress` is called after each item.
/// Errors   InputError: the folder of the answers cannot be written to
AnswerTally carry_out_answers(const AnsweredItems& items, const std::string& folder, int threads,
                              const std::function<void(std::size_t done, std::size_t of)>& progress);

}  // namespace rollrig::validation
