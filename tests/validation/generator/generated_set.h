#pragma once
/// Cases made by the independent generator, and what rollrig's baseline makes of them.

#include <map>
#include <string>
#include <vector>

#include "measurements/measurement_set.h"
#include "sim/core/json.h"

namespace rollrig::tests {

/// A set, what the generator says is in it, and the same set without effect and noise.
struct GeneratedSet {
  measurements::MeasurementSet set;
  measurements::MeasurementSet counterfactual;
  Json truth;
};

/// Runs `rollrig_validation make-case <arguments>`, which must work, and reads what it writes.
GeneratedSet make_generated_set(const std::string& arguments);

/// A set with one effect of that size, without noise and with the files' parameters. `kind` may have further options.
GeneratedSet make_effect_set(const std::string& kind, const std::string& effect, const std::string& size,
                             int seed = 21);

/// Functional forms of each effect, as `rollrig_validation list` names them.
std::map<std::string, std::vector<std::string>> list_forms();

/// What make_effect_set takes as `kind` for a set of a kind whose effect has that form.
std::string with_form(const std::string& kind, const std::string& form);

/// Difference that the effects make, by row of a run.
std::vector<double> find_difference(const GeneratedSet& made, std::size_t run, const std::string& channel);

/// Noise floor of a channel: standard deviation of a mean over 10 samples at 1 Hz, without the offset; SI.
double calc_floor(const measurements::MeasurementSet& set, const std::string& channel);

/// Root mean square of a difference in noise floors, by channel.
using Floors = std::map<std::string, double>;

/// Between a set and rollrig's baseline, simulated again from its recorded inputs with the parameters of its files.
Floors compare_with_baseline(const measurements::MeasurementSet& set);
/// Between two sets of the same rows.
Floors compare(const measurements::MeasurementSet& a, const measurements::MeasurementSet& b);

}  // namespace rollrig::tests
