#pragma once
/// The ceiling of a bank: what an ideal observer makes of its sets.
///
/// The observer knows the generator's equations, the sensors' noise and the effect, but neither the base parameters,
/// nor the offsets of the sensors. All is linear in those.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "validation/generator/measurement_set.h"

namespace blind {

/// Equation  d'^2 = s^T C^-1 s,  C = N + U U^T
/// Symbols   s what the effects change, N noise, U offsets and base parameters by one prior standard deviation
struct Ceiling {
  double d_prime = 0.0;
  std::map<std::string, double> log_bayes_factors;  // expected, against each other effect that it could be

  /// Effects that the data do not tell from the truth.
  std::vector<std::string> twins() const;
};

/// Of a set with effects. Those outside of the catalog are compared with no others, a pair with all single effects,
/// an effect with all but itself. `detection_alone` leaves the comparison out, which is most of the work.
Ceiling find_ceiling(const SetOrder& order, bool detection_alone = false);

struct CeilingOrder {
  std::string bank;
  std::string out;                // empty: ceiling.json in the bank
  std::vector<std::string> sets;  // empty: all
  bool detection_alone = false;   // d' and not what can be told apart
  std::size_t threads = 0;        // 0: as many as there are cores
};

struct CeilingWritten {
  std::string file;
  std::size_t sets = 0;
};

/// Opens the seal and writes rollrig-blind-ceiling/1. What the file has of other sets of the same truth stays.
/// `progress` is told the number of sets done and in all.
/// Errors  InputError: as open_truth() and require_same_files(); no such set
CeilingWritten write_ceiling(const CeilingOrder& order, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace blind
