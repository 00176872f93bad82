// The emulated sensors against what the sets say of them (formats.md), by the noisy set less the clean one.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "measurements/whitener.h"
#include "tests/validation/generator/generated_set.h"

using namespace rollrig;
using namespace rollrig::tests;

namespace {

constexpr int kSeeds = 20;

struct Errors {
  std::vector<double> time_s;
  std::vector<double> values;  // measured minus true
  double mean = 0.0;
};

Errors find_errors(const GeneratedSet& made, std::size_t r, const std::string& channel) {
  Errors errors;
  const measurements::MeasuredRun& run = made.set.runs[r];
  const std::vector<double>& measured = run.columns.at(channel);
  const std::vector<double>& clean = made.counterfactual.runs[r].columns.at(channel);
  for (std::size_t row = 0; row < measured.size(); ++row) {
    if (std::isnan(measured[row])) continue;
    errors.time_s.push_back(run.time_s[row]);
    errors.values.push_back(measured[row] - clean[row]);
    errors.mean += errors.values.back();
  }
  errors.mean /= static_cast<double>(errors.values.size());
  return errors;
}

const std::vector<GeneratedSet>& noisy_sets() {
  static const std::vector<GeneratedSet> sets = [] {
    std::vector<GeneratedSet> made;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      made.push_back(make_generated_set(fmt::format("--effect none --seed {}", seed + 300)));
    }
    return made;
  }();
  return sets;
}

const std::vector<std::string> kChannels{"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"};

/// Variance of the mean drift and noise over a whole run of n samples at 1 Hz.
double calc_run_mean_variance(const models::SensorParameters& sensor, double n) {
  const double tau = sensor.drift_time_s;
  return sensor.drift_sd * sensor.drift_sd * 2.0 * tau / n + sensor.noise_sd * sensor.noise_sd / n;
}

}  // namespace

TEST_CASE("errors of sensors are white and of unit variance once whitened by the format's noise model", "[slow]") {
  for (const std::string& channel : kChannels) {
    double squares = 0.0;
    double neighbors = 0.0;
    double count = 0.0;
    for (const GeneratedSet& made : noisy_sets()) {
      for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
        Errors errors = find_errors(made, r, channel);
        for (double& value : errors.values) value -= errors.mean;
        const measurements::Whitener whitener(made.set.sensors.at(channel), errors.time_s);
        std::vector<double> white = errors.values;
        whitener.apply(white.data(), 1);
        for (std::size_t i = 1; i < white.size(); ++i) {
          squares += white[i] * white[i];
          neighbors += white[i] * white[i - 1];
          count += 1.0;
        }
      }
    }
    INFO(channel);
    // Some 300 000 samples: standard errors 0.0026 and 0.0018. Less the mean of each run: a few in 2500.
    CHECK(squares / count == Approx(1.0).margin(0.012));
    CHECK(std::abs(neighbors / count) < 0.01);
  }
}

TEST_CASE("offsets are shared by a session, differ between sessions, and have the stated size", "[slow]") {
  for (const std::string& channel : kChannels) {
    double within = 0.0;
    double offsets = 0.0;
    int pairs = 0;
    int sessions = 0;
    for (const GeneratedSet& made : noisy_sets()) {
      const models::SensorParameters& sensor = made.set.sensors.at(channel);
      for (std::size_t r = 0; r < made.set.runs.size(); ++r) {
        const Errors errors = find_errors(made, r, channel);
        const double noise = calc_run_mean_variance(sensor, static_cast<double>(errors.values.size()));
        if (r == 0 || made.set.runs[r].session != made.set.runs[r - 1].session) {
          offsets += errors.mean * errors.mean / (sensor.offset_sd * sensor.offset_sd + noise);
          ++sessions;
          continue;
        }
        const Errors before = find_errors(made, r - 1, channel);
        within += std::pow(errors.mean - before.mean, 2) / (2.0 * noise);
        ++pairs;
      }
    }
    INFO(channel << ": " << sessions << " sessions, " << pairs << " pairs of runs");
    // Means of squares of unit normals: four standard errors.
    CHECK(offsets / sessions == Approx(1.0).margin(4.0 * std::sqrt(2.0 / sessions)));
    CHECK(within / pairs == Approx(1.0).margin(4.0 * std::sqrt(2.0 / pairs)));
  }
}

TEST_CASE("readings are whole steps, and some are missing, alone and in gaps", "[slow]") {
  std::size_t missing = 0;
  std::size_t all = 0;
  std::size_t longest = 0;
  for (const GeneratedSet& made : noisy_sets()) {
    for (const measurements::MeasuredRun& run : made.set.runs) {
      for (const std::string& channel : {kChannels[1], kChannels[2]}) {
        const double step = made.set.sensors.at(channel).resolution;
        const double zero = channel == kChannels[1] ? 273.15 : 0.0;
        std::size_t gap = 0;
        for (const double value : run.columns.at(channel)) {
          ++all;
          gap = std::isnan(value) ? gap + 1 : 0;
          longest = std::max(longest, gap);
          missing += std::isnan(value) ? 1 : 0;
          if (std::isnan(value)) continue;
          const double steps = (value - zero) / step;
          if (std::abs(steps - std::round(steps)) > 1e-6) FAIL_CHECK(channel << " reads " << value);
        }
      }
    }
  }
  CHECK(missing > all / 200);
  CHECK(missing < all / 20);
  CHECK(longest > 20);
  CHECK(longest < 200);
}
