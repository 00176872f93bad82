#pragma once
/// Random numbers of the generator: seeded, and the same to the bit on every machine.

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace rollrig::generator {

/// A distribution of which about two thirds lie between `low` and `high`, more where it is cut off close by.
struct Spread {
  enum class Form {
    kNormal,     // low and high one standard deviation from the mean
    kLogNormal,  // likewise of the logarithm
    kUniform,    // all between low and high
  };
  Form form = Form::kUniform;
  double low = 0.0;
  double high = 0.0;
  double least = 0.0;  // cut off below and above, by drawing again; both 0: not cut off
  double most = 0.0;
};

/// Mixes a seed and a name into a seed of its own.
std::uint64_t mix_seed(std::uint64_t seed, std::string_view name);

/// One stream of random numbers. Streams of one seed with different names are independent, so that an effect,
/// a run or a channel more does not change the others. A name stays as it is: validation sets that are published are
/// made again from their seeds.
class Draws {
 public:
  Draws(std::uint64_t seed, std::string_view name) : engine_(mix_seed(seed, name)) {}

  double normal() { return normal_(engine_); }
  double uniform() { return uniform_(engine_); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// A whole number from `low` to `high`, both among them.
  int whole(int low, int high);
  bool happens(double probability) { return uniform() < probability; }
  double from(const Spread& spread);
  template <class T>
  const T& pick(const std::vector<T>& among) {
    return among[static_cast<std::size_t>(whole(0, static_cast<int>(among.size()) - 1))];
  }
  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[static_cast<std::size_t>(whole(0, static_cast<int>(i) - 1))]);
    }
  }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
  boost::random::uniform_01<double> uniform_;
};

inline Spread uniform(double low, double high) { return {Spread::Form::kUniform, low, high, 0.0, 0.0}; }
inline Spread log_normal(double low, double high, double least, double most) {
  return {Spread::Form::kLogNormal, low, high, least, most};
}
inline Spread normal(double low, double high, double least, double most) {
  return {Spread::Form::kNormal, low, high, least, most};
}

}  // namespace rollrig::generator
