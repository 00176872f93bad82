#pragma once
/// What the uncertainty of a result is made from: input quantities with their standard uncertainties, and the
/// evaluation that makes results of them.

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace rollrig::estimation {

/// How a standard uncertainty was found: from repeated observations (A), or by other means (B). Source: GUM 4.2, 4.3.
enum class Evaluation { kTypeA, kTypeB };

/// What is known of an input quantity. A rectangular distribution has the half-width sqrt(3) u. Student's t is that of
/// the degrees of freedom, scaled by u, as GUM Supplement 1, 6.4.9 has it for a mean of repeated observations. The
/// multivariate t is that of several errors with one estimated standard deviation; the input that has it is drawn as
/// their scale factor sqrt(nu/chi2_nu) (make_scatter_inputs).
enum class Distribution { kNormal, kRectangular, kStudentT, kMultivariateT };

/// An input quantity of a measurement. Values are SI; the suffix of `key` is the unit in which they are shown.
struct UncertainInput {
  std::string name;  // for people: "load cell"
  std::string key;   // "load_N"
  double value = 0.0;
  double standard_uncertainty = 0.0;  // of a temperature a difference
  Distribution distribution = Distribution::kNormal;
  Evaluation evaluation = Evaluation::kTypeB;
  double degrees_freedom = std::numeric_limits<double>::infinity();
  std::string source = {};      // where the uncertainty is from, as a sentence
  std::string pool = {};        // inputs of one pool have their standard deviations from one estimate; empty: the name
  bool is_from_limits = false;  // it is assumed, or the accuracy that a standard asks for: not known of this instrument
};

/// A result of the measurement. Its value is SI; `key` is that of the result in JSON.
struct Measurand {
  std::string name;
  std::string key;
};

/// A measurement as the GUM has it: Y_i = f_i(X_1, ..., X_N), the inputs independent of each other. Inputs that are
/// correlated enter as independent ones of mean 0 and standard deviation 1 with one name; the budget shows inputs of
/// one name as one line.
struct MeasurementModel {
  std::vector<Measurand> measurands;
  std::vector<UncertainInput> inputs;
  /// One value for each measurand (SI), from one for each input. Called from several threads. Throws RunFailure.
  std::function<std::vector<double>(const std::vector<double>& inputs)> evaluate;
  std::vector<std::string> left_out;  // sources of uncertainty without a figure, which no line of the budget has
};

/// What is asked of an uncertainty.
struct UncertaintyRequest {
  int trials = 0;  // of the Monte Carlo method; 0 for none
  std::uint64_t seed = 1;
  int threads = 0;  // 0: as many as the machine has
};

constexpr int kFewestTrials = 100;       // Assumed: with fewer, an interval of 95 % has two or three trials outside
constexpr int kMostTrials = 10'000'000;  // Assumed: takes 240 MB for three results
constexpr double kCoverage = 0.95;       // probability of every interval

}  // namespace rollrig::estimation
