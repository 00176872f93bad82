#pragma once
/// What is asked about the uncertainty of results: docs/reports.md.

#include <cstdint>

#pragma GCC visibility push(default)
namespace rollrig {

/// What is asked about the uncertainty of results.
struct UncertaintyOptions {
  bool budget = false;         // by the GUM
  bool budget_if_any = false;  // as budget, but no error where the settings allow none
  int monte_carlo_trials = 0;  // 0: none; else 100 to 10,000,000, with the budget
  std::uint64_t seed = 1;      // of the trials; a run takes its own seed
  int threads = 0;             // for the trials; 0: as many as the machine has. The result is the same for any number
};

}  // namespace rollrig
#pragma GCC visibility pop
