#pragma once
/// Designs: which values the factors of a campaign take in each of its items.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "campaigns/distribution.h"

namespace rollrig::campaigns {

/// A design has points; an item is what is carried out at one of them. Any item can be asked for without those before
/// it, so that every division of a campaign into parts has the same items.
class Design {
 public:
  virtual ~Design() = default;

  virtual std::size_t count_items() const = 0;
  /// The value of each factor, as a setting takes it.
  virtual std::vector<std::string> calc_values(std::size_t item) const = 0;
};

/// Two factors with normal distributions that are not independent.
struct FactorPair {
  std::size_t first = 0;  // index of a factor
  std::size_t second = 0;
  double correlation = 0.0;
};

/// What a user asks for.
struct DesignInput {
  std::string name;  // one of design_names()
  std::vector<Factor> factors;
  std::size_t points = 0;  // 0 for a grid and a list
  std::uint64_t seed = 1;
  std::vector<FactorPair> correlated = {};  // not for kGrid, kList, kSobolIndices, kMorris
};

constexpr std::size_t kMostItems = 10'000'000;  // Assumed: each needs a bit of memory and a row of a file

constexpr std::size_t kMostFactors = 1000;  // Assumed; Boost's Sobol' sequence has 3667 dimensions

/// Every value with every other: the last factor changes first.
constexpr const char* kGrid = "grid";
/// The first value of each factor together, then the second of each, and so on.
constexpr const char* kList = "list";
/// Independent draws; item i has a stream of random numbers of its own.
constexpr const char* kMonteCarlo = "monte_carlo";
/// Each factor's range is divided into as many stretches of equal probability as there are points, and each stretch is
/// met once; of correlated factors, only by the first. Source: McKay, Beckman, Conover, Technometrics 21 (1979) 239.
constexpr const char* kLatinHypercube = "latin_hypercube";
/// Sobol' sequence with a random digital shift. Source: Sobol', USSR Comput. Math. Math. Phys. 7 (1967) 86; direction
/// numbers of Joe and Kuo, as boost/random/sobol.hpp has them.
constexpr const char* kSobol = "sobol";
/// For Sobol' indices: to each point n the matrices A, B and, for each factor j, A with column j of B, one after the
/// other: points x (factors + 2) items. Source: Saltelli et al., Comput. Phys. Commun. 181 (2010) 259.
constexpr const char* kSobolIndices = "sobol_indices";
/// For Morris' elementary effects: each point is a trajectory, which changes one factor after the other:
/// points x (factors + 1) items. Source: Morris, Technometrics 33 (1991) 161.
constexpr const char* kMorris = "morris";

std::vector<std::string> design_names();

/// Throws InputError: an unknown design, no factor, a factor twice, factors that the design cannot take, no points, too
/// many items, correlations that cannot be.
std::unique_ptr<Design> make_design(const DesignInput& input);

/// A trajectory of kMorris: `order[s]` is the factor that step s changes, `signs[s]` the sign of its change.
struct Trajectory {
  std::vector<double> start;
  std::vector<std::size_t> order;
  std::vector<double> signs;
};
Trajectory make_trajectory(std::uint64_t seed, std::size_t trajectory, std::size_t factors);

/// Morris' levels lie in the middle of four stretches of equal probability, and a step goes over two of them, so that a
/// normal distribution has no infinite level.
constexpr double kMorrisStep = 0.5;

}  // namespace rollrig::campaigns
