#pragma once
/// A tire from a user's own warm-up data (`rollrig fit tire`).

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "estimation/tire_fit/at_speeds.h"
#include "estimation/tire_fit/two_step.h"
#include "include/rollrig/fit_options.h"
#include "include/rollrig/result.h"
#include "measurements/measurement_set.h"
#include "sim/core/json.h"

namespace rollrig::estimation {

/// What was known of a number before the fit, in the unit of its key.
struct EstimatePrior {
  double value = 0.0;
  double sd = 0.0;
  bool of_class = false;  // since the file gives no standard uncertainty (class_priors.h)
};

/// One fitted number, in the unit of its key.
struct Estimate {
  std::string key;
  double value = 0.0;
  double sd = 0.0;
  bool nuisance = false;                                    // not asked for, held by its prior
  double least = -std::numeric_limits<double>::infinity();  // limits of its range
  double most = std::numeric_limits<double>::infinity();
  std::optional<EstimatePrior> prior{};

  double lower_95() const { return std::max(least, value - 1.959963984540054 * sd); }
  double upper_95() const { return std::min(most, value + 1.959963984540054 * sd); }
};

/// How well one channel is met.
struct ChannelFit {
  Quantity channel;
  std::size_t samples = 0;
  double whitened_rms = 0.0;  // 1 when the noise is as the sensors say
};

struct TireFit {
  std::vector<Estimate> estimates;
  std::vector<std::vector<double>> correlation;  // of the estimates
  std::vector<ChannelFit> channels;
  std::vector<AtSpeed> at_speeds;
  SteadyTire steady;
  /// What the sensors read too much, by run and channel in SI; those that are fitted.
  std::map<std::pair<std::size_t, Quantity>, double> offsets_SI;
  double chi2_per_sample = 0.0;
  std::optional<TwoStepEstimate> two_step;   // of a law that has A0 to B1
  models::TireFile tire;                     // with the estimates and their uncertainties put in
  std::map<std::string, std::string> notes;  // for write_tire
  std::vector<std::string> warnings;
};

/// Maximum likelihood over all runs at once, by simulation: the numbers of the law (A0, A1, B0, B1, or those of another
/// law by their models::FitRole), z, f (and H) free. Of a set with one speed A1, B1 and f are not free. All other
/// numbers of the tire move within the uncertainty that the files give, or within that of the tire's class
/// (class_priors.h); parasitic loss within that of the rig. Standard deviations from the curvature at the optimum.
/// Bounds  ranges of the keys. An optimum that TireModelInfo::find_mistake refuses is not returned: the numbers of role
///         kFreeOverSpeedsWithinLaw are fixed, the fit is repeated, and a warning is added
/// Errors  InputError: not a drum set, a law without numbers to fit, no speed with loss and temperature, a load map
///         where it does not go with the law or of one speed; RunFailure: no convergence, data that leave a parameter
///         undecided, or an optimum where the law refuses the numbers
/// Checked tests/estimation/fit_tire_test.cpp, tests/estimation/fit_own_law_test.cpp,
///         tests/estimation/one_warm_up_test.cpp, tests/estimation/fit_coverage_test.cpp
TireFit fit_tire(const measurements::MeasurementSet& set, const TireFitOptions& options);

/// The fitted numbers by key of the tire file.
std::vector<ParameterEstimate> list_parameters(const TireFit& fit);

/// The two-step numbers, each by its symbol with its unit.
Json make_two_step_json(const TwoStepEstimate& two_step);

/// The fit as JSON, with both the maximum-likelihood and the two-step numbers.
Json make_fit_json(const measurements::MeasurementSet& set, const TireFit& fit);

}  // namespace rollrig::estimation
