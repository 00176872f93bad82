#include "campaigns/design.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include <boost/random/sobol.hpp>

#include "sim/core/error.h"
#include "sim/core/random.h"

namespace rollrig::campaigns {
namespace {

InputError bad_design(const std::string& what, const char* option, const std::string& value,
                      const std::string& allowed) {
  return InputError({what, "command line", 0, option, value, allowed, ""});
}

/// The lower triangular root of the matrix of correlations; empty where all factors are independent.
Eigen::MatrixXd calc_root(const DesignInput& input) {
  if (input.correlated.empty()) return {};
  const auto factors = static_cast<Eigen::Index>(input.factors.size());
  Eigen::MatrixXd correlations = Eigen::MatrixXd::Identity(factors, factors);
  for (const FactorPair& pair : input.correlated) {
    const auto first = static_cast<Eigen::Index>(pair.first);
    const auto second = static_cast<Eigen::Index>(pair.second);
    correlations(first, second) = correlations(second, first) = pair.correlation;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(correlations);
  if (root.info() == Eigen::Success) return root.matrixL();
  throw bad_design("the correlations of the factors contradict each other", "--draw-sd", "",
                   "correlations that some numbers can have");
}

class Grid : public Design {
 public:
  explicit Grid(std::vector<Factor> factors) : factors_(std::move(factors)) {}

  std::size_t count_items() const override {
    std::size_t items = 1;
    for (const Factor& factor : factors_) items *= factor.values.size();
    return items;
  }

  std::vector<std::string> calc_values(std::size_t item) const override {
    std::vector<std::string> values(factors_.size());
    for (std::size_t f = factors_.size(); f-- > 0;) {
      const std::vector<std::string>& known = factors_[f].values;
      values[f] = known[item % known.size()];
      item /= known.size();
    }
    return values;
  }

 private:
  std::vector<Factor> factors_;
};

class List : public Design {
 public:
  explicit List(std::vector<Factor> factors) : factors_(std::move(factors)) {}

  std::size_t count_items() const override { return factors_.front().values.size(); }

  std::vector<std::string> calc_values(std::size_t item) const override {
    std::vector<std::string> values;
    for (const Factor& factor : factors_) values.push_back(factor.values[item]);
    return values;
  }

 private:
  std::vector<Factor> factors_;
};

/// A design whose items are points of the unit cube: a coordinate is the probability that the factor lies below.
class UnitCube : public Design {
 public:
  explicit UnitCube(const DesignInput& input) : input_(input), root_(calc_root(input)) {}

  std::vector<std::string> calc_values(std::size_t item) const override {
    std::vector<double> probabilities = calc_probabilities(item);
    constexpr double kLeast = 1e-15;  // 0 and 1 are infinitely far away in a normal distribution
    for (double& probability : probabilities) probability = std::clamp(probability, kLeast, 1.0 - kLeast);
    Eigen::VectorXd scores(root_.cols());
    for (Eigen::Index f = 0; f < scores.size(); ++f) scores(f) = calc_score(probabilities[static_cast<std::size_t>(f)]);
    if (scores.size() > 0) scores = root_ * scores;
    std::vector<std::string> values;
    for (std::size_t f = 0; f < probabilities.size(); ++f) {
      const Factor& factor = input_.factors[f];
      const bool is_correlated = scores.size() > 0 && factor.kind == Factor::Kind::kNormal;
      values.push_back(is_correlated ? calc_normal_value(factor, scores(static_cast<Eigen::Index>(f)))
                                     : factor.calc_value(probabilities[f]));
    }
    return values;
  }

 protected:
  virtual std::vector<double> calc_probabilities(std::size_t item) const = 0;

  std::size_t count_factors() const { return input_.factors.size(); }
  std::size_t count_points() const { return input_.points; }
  std::uint64_t seed() const { return input_.seed; }
  const std::string& key(std::size_t factor) const { return input_.factors[factor].key; }

 private:
  DesignInput input_;
  Eigen::MatrixXd root_;  // of the correlations, by which independent scores become correlated; empty without any
};

class MonteCarlo : public UnitCube {
 public:
  using UnitCube::UnitCube;

  std::size_t count_items() const override { return count_points(); }

 protected:
  std::vector<double> calc_probabilities(std::size_t item) const override {
    RandomStream random(seed(), fmt::format("draws of item {}", item));
    std::vector<double> probabilities(count_factors());
    for (double& probability : probabilities) probability = random.uniform();
    return probabilities;
  }
};

class LatinHypercube : public UnitCube {
 public:
  explicit LatinHypercube(const DesignInput& input) : UnitCube(input) {
    for (std::size_t f = 0; f < count_factors(); ++f) {
      std::vector<std::uint32_t> parts(count_points());
      std::iota(parts.begin(), parts.end(), 0U);
      RandomStream random(seed(), "order of " + key(f));
      for (std::size_t i = parts.size(); i > 1; --i) {
        std::swap(parts[i - 1], parts[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
      }
      parts_.push_back(std::move(parts));
    }
  }

  std::size_t count_items() const override { return count_points(); }

 protected:
  std::vector<double> calc_probabilities(std::size_t item) const override {
    RandomStream random(seed(), fmt::format("place of item {} in its parts", item));
    std::vector<double> probabilities;
    for (const std::vector<std::uint32_t>& parts : parts_) {
      probabilities.push_back((parts[item] + random.uniform()) / static_cast<double>(parts.size()));
    }
    return probabilities;
  }

 private:
  std::vector<std::vector<std::uint32_t>> parts_;  // of each factor, of each item
};

/// Points of a Sobol' sequence.
class SobolPoints {
 public:
  SobolPoints(std::uint64_t seed, std::size_t dimensions) {
    RandomStream random(seed, "shift of the Sobol' sequence");
    for (std::size_t d = 0; d < dimensions; ++d) {
      // Two draws of 32 bits, since a double has no 64.
      const auto high = static_cast<std::uint64_t>(random.uniform() * 0x1p32);
      const auto low = static_cast<std::uint64_t>(random.uniform() * 0x1p32);
      shift_.push_back((high << 32U) | low);
    }
  }

  std::vector<double> calc(std::size_t point) const {
    boost::random::sobol sequence(shift_.size());
    if (point > 0) sequence.seed(point - 1);  // Boost leaves the origin out, the sequence's first point
    std::vector<double> probabilities;
    for (const std::uint64_t shift : shift_) {
      const std::uint64_t coordinate = point > 0 ? sequence() : 0;
      probabilities.push_back(static_cast<double>((coordinate ^ shift) >> 11U) * 0x1p-53);
    }
    return probabilities;
  }

 private:
  std::vector<std::uint64_t> shift_;
};

class Sobol : public UnitCube {
 public:
  explicit Sobol(const DesignInput& input) : UnitCube(input), points_(seed(), count_factors()) {}

  std::size_t count_items() const override { return count_points(); }

 protected:
  std::vector<double> calc_probabilities(std::size_t item) const override { return points_.calc(item); }

 private:
  SobolPoints points_;
};

class SaltelliItems : public UnitCube {
 public:
  explicit SaltelliItems(const DesignInput& input) : UnitCube(input), points_(seed(), 2 * count_factors()) {}

  std::size_t count_items() const override { return count_points() * (count_factors() + 2); }

 protected:
  std::vector<double> calc_probabilities(std::size_t item) const override {
    const std::size_t factors = count_factors();
    const std::size_t matrix = item % (factors + 2);
    const std::vector<double> both = points_.calc(item / (factors + 2));
    const auto middle = both.begin() + static_cast<std::ptrdiff_t>(factors);
    if (matrix == 1) return {middle, both.end()};
    std::vector<double> probabilities(both.begin(), middle);
    if (matrix > 1) probabilities[matrix - 2] = both[factors + matrix - 2];
    return probabilities;
  }

 private:
  SobolPoints points_;
};

class Morris : public UnitCube {
 public:
  using UnitCube::UnitCube;

  std::size_t count_items() const override { return count_points() * (count_factors() + 1); }

 protected:
  std::vector<double> calc_probabilities(std::size_t item) const override {
    const std::size_t items = count_factors() + 1;
    const Trajectory trajectory = make_trajectory(seed(), item / items, count_factors());
    std::vector<double> probabilities = trajectory.start;
    for (std::size_t s = 0; s < item % items; ++s)
      probabilities[trajectory.order[s]] += kMorrisStep * trajectory.signs[s];
    return probabilities;
  }
};

void check(const DesignInput& input) {
  const std::vector<std::string> known = design_names();
  if (std::find(known.begin(), known.end(), input.name) == known.end()) {
    InputProblem problem = unknown_name("design", input.name, known);
    problem.file = "command line";
    problem.key = "--design";
    throw InputError(problem);
  }
  const bool has_values = input.name == kGrid || input.name == kList;  // and no distributions
  if (input.factors.empty()) {
    throw bad_design("nothing differs between the items", has_values ? "--vary" : "--draw", "",
                     has_values ? "--vary key=a,b,c; --list FILE"
                                : "--draw key=normal:MEAN:SD, --draw key=uniform:LOW:HIGH, --draw-sd");
  }
  if (input.factors.size() > kMostFactors) {
    throw bad_design("too many factors", "--draw", std::to_string(input.factors.size()),
                     fmt::format("at most {}", kMostFactors));
  }
  for (auto factor = input.factors.begin(); factor != input.factors.end(); ++factor) {
    const auto is_same = [&](const Factor& other) { return other.key == factor->key; };
    if (std::any_of(input.factors.begin(), factor, is_same)) {
      throw bad_design(fmt::format("'{}' is a factor twice", factor->key), "factors", factor->key, "each factor once");
    }
    if (factor->key.empty() || factor->key.find_first_of(" \t\n=") != std::string::npos) {
      throw bad_design(fmt::format("'{}' is no key of a setting", factor->key), "factors", factor->key,
                       "a key as --set has it");
    }
    const bool is_interval = factor->kind == Factor::Kind::kUniform && factor->first < factor->second;
    const bool is_spread = factor->kind == Factor::Kind::kNormal && factor->second > 0.0;
    const bool is_finite = std::isfinite(factor->first) && std::isfinite(factor->second);
    if (factor->kind != Factor::Kind::kValues && !(is_finite && (is_interval || is_spread))) {
      throw bad_design(fmt::format("the distribution of '{}' cannot be", factor->key), "--draw", factor->key,
                       "uniform with LOW < HIGH, or normal with SD > 0");
    }
    if (factor->kind == Factor::Kind::kValues && factor->values.empty()) {
      throw bad_design(fmt::format("'{}' has no values", factor->key), "--vary", factor->key, "at least one value");
    }
    if (has_values && factor->kind != Factor::Kind::kValues) {
      throw bad_design(fmt::format("a {} has values of '{}', and no distribution", input.name, factor->key), "--design",
                       input.name,
                       fmt::format("--vary, or one of {}", fmt::join(known.begin() + 2, known.end(), ", ")));
    }
    const std::size_t count = input.factors.front().values.size();
    if (input.name == kList && factor->values.size() != count) {
      throw bad_design(fmt::format("a list has as many values of '{}' as of '{}'", factor->key, input.factors[0].key),
                       "--vary", fmt::format("{} and {} values", factor->values.size(), count),
                       "the same number of values of each; or --design grid");
    }
  }
  const bool needs_independence = input.name == kSobolIndices || input.name == kMorris;
  if (needs_independence && !input.correlated.empty()) {
    const FactorPair& pair = input.correlated.front();
    throw bad_design(fmt::format("'{}' and '{}' are correlated, and design {} needs independent factors",
                                 input.factors[pair.first].key, input.factors[pair.second].key, input.name),
                     "--design", input.name, "--draw for factors that are independent; or another design");
  }
  if (has_values != (input.points == 0)) {
    throw bad_design(has_values ? fmt::format("the points of a {} follow from its values", input.name)
                                : "no number of points is given",
                     "--points", has_values ? std::to_string(input.points) : "",
                     has_values ? "no --points, or another --design" : "--points N");
  }
}

void require_few(const std::vector<std::size_t>& counts) {
  std::size_t items = 1;
  for (const std::size_t count : counts) {
    items *= count;  // no overflow: below, and a count is at most kMostItems
    if (count <= kMostItems && items <= kMostItems) continue;
    throw bad_design("too many items in a campaign", "--points", fmt::format("{}", fmt::join(counts, " x ")),
                     fmt::format("at most {} items", kMostItems));
  }
}

}  // namespace

std::vector<std::string> design_names() {
  return {kGrid, kList, kMonteCarlo, kLatinHypercube, kSobol, kSobolIndices, kMorris};
}

Trajectory make_trajectory(std::uint64_t seed, std::size_t trajectory, std::size_t factors) {
  RandomStream random(seed, fmt::format("trajectory {}", trajectory));
  Trajectory made;
  for (std::size_t f = 0; f < factors; ++f) {
    // One of the four levels, of which a step up or down leads to another.
    const double level = std::floor(4.0 * random.uniform());
    made.start.push_back((level + 0.5) / 4.0);
    made.order.push_back(f);
  }
  for (std::size_t i = factors; i > 1; --i) {
    std::swap(made.order[i - 1], made.order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
  }
  for (const std::size_t factor : made.order) made.signs.push_back(made.start[factor] < 0.5 ? 1.0 : -1.0);
  return made;
}

std::unique_ptr<Design> make_design(const DesignInput& input) {
  check(input);
  const std::size_t factors = input.factors.size();
  if (input.name == kGrid) {
    std::vector<std::size_t> counts;
    for (const Factor& factor : input.factors) counts.push_back(factor.values.size());
    require_few(counts);
    return std::make_unique<Grid>(input.factors);
  }
  if (input.name == kList) {
    require_few({input.factors.front().values.size()});
    return std::make_unique<List>(input.factors);
  }
  if (input.name == kSobolIndices) {
    require_few({input.points, factors + 2});
    return std::make_unique<SaltelliItems>(input);
  }
  if (input.name == kMorris) {
    require_few({input.points, factors + 1});
    return std::make_unique<Morris>(input);
  }
  require_few({input.points});
  if (input.name == kMonteCarlo) return std::make_unique<MonteCarlo>(input);
  if (input.name == kLatinHypercube) return std::make_unique<LatinHypercube>(input);
  return std::make_unique<Sobol>(input);
}

}  // namespace rollrig::campaigns
