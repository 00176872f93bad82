#pragma once
/// Which reference speeds a test has: those with enough pairs, and why others are not used.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "estimation/road_load/reference_pairs.h"
#include "sim/core/error.h"

namespace rollrig::estimation {

constexpr std::size_t kFewestPairs = 3;   // at a reference speed: UN GTR 15 Annex 4, 4.3.1.4.2
constexpr std::size_t kFewestSpeeds = 4;  // one more than coefficients

/// An error of the column heading.
InputError pairing_error(const std::string& what, const std::string& allowed);

/// Reference speeds from the highest to the lowest with three pairs that are not rejected.
///
/// Ends of runs scatter, so that a speed above or below may have fewer: it is not used, which a warning says. A speed
/// between them must have three.
/// Source    UN GTR 15 Annex 4, 4.3.1.4.2 (three pairs)
/// Checked   tests/estimation/reference_speeds_test.cpp
class ReferenceChoice {
 public:
  /// `windy`: names of the runs whose pairs are rejected; `quantity`: what the runs have at a speed, in words.
  ReferenceChoice(const std::vector<ReferenceRun>& runs, const PairedRuns& paired,
                  const std::vector<std::string>& windy, std::string quantity);

  /// Falling.
  const std::vector<int>& speeds() const { return speeds_; }

  /// Throws InputError where fewer than four speeds have three pairs, or where one of the reference speeds of a test
  /// between them has fewer.
  void require_enough(const std::map<int, double>& speeds_m_s) const;

  /// Warnings of the speeds at both ends that are not used.
  std::vector<std::string> list_warnings() const;

 private:
  struct Count {
    std::size_t pairs = 0;
    std::size_t rejected = 0;
    std::size_t plus = 0;  // runs
    std::size_t minus = 0;
  };

  std::string describe(int speed) const;
  std::string describe_end(const std::vector<int>& speeds, int used, const char* option) const;
  std::string list_unused_runs() const;

  const std::vector<ReferenceRun>& runs_;
  const PairedRuns& paired_;
  const std::vector<std::string>& windy_;
  std::string quantity_;
  std::map<int, Count> counts_;
  std::vector<int> speeds_;
};

}  // namespace rollrig::estimation
