#pragma once
/// Random numbers: seeded, and the same to the bit with every compiler.

#include <cstdint>
#include <string_view>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

namespace rollrig {

/// One stream of random numbers. Streams of one seed with different names are independent, so that
/// adding a channel or a run does not change the others.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// A draw from the normal distribution with mean 0 and standard deviation 1.
  double normal() { return normal_(engine_); }
  /// A draw from [0, 1).
  double uniform() { return uniform_(engine_); }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
  boost::random::uniform_01<double> uniform_;
};

}  // namespace rollrig
