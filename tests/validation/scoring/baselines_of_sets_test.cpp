// The baselines on simulated sets, from the measured runs to the answer.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/diagnosis/gap_sets.h"
#include "validation/scoring/baselines/baselines.h"

using namespace rollrig;
using namespace rollrig::tests;
using diagnosis::Diagnosis;
using diagnosis::Verdict;

namespace {

const validation::BaselineMethod& method_of(const std::string& id) {
  for (const validation::BaselineMethod& method : validation::all_baselines()) {
    if (id == method.id) return method;
  }
  FAIL("no method " << id);
  return validation::all_baselines().front();
}

measurements::MeasurementSet make_leaking() {
  const models::Effect& leak = models::find_effect("slow_leak");
  std::vector<double> parameters;
  for (const models::EffectParameter& parameter : leak.info.parameters) {
    parameters.push_back(diagnosis::from_prior_units(parameter, 1.0, 1).value_SI);
  }
  return make_gap_set({{&leak, parameters}}, 3);
}

}  // namespace

TEST_CASE("a slow leak is named with its size, and shrinks the gap on the runs left out", "[slow]") {
  const measurements::MeasurementSet set = make_leaking();
  const models::EffectParameter& size = models::find_effect("slow_leak").info.parameters.front();
  const double true_size = size.prior.high;
  for (const char* id : {"aic", "bic", "sparse"}) {  // without noise the whole residual passes the test of "nearest"
    INFO(id);
    const Diagnosis diagnosis = validation::diagnose_by(method_of(id), set, {});
    REQUIRE(diagnosis.verdict == Verdict::kExplained);
    CHECK(diagnosis.causes.front().effects.front() == "slow_leak");
    CHECK(diagnosis.causes.front().parameters.front().value == Approx(true_size).epsilon(0.2));
    CHECK(diagnosis.gap.shrink_percent.value() > 80.0);
  }
}

TEST_CASE("effects that are not in the comparison are not named", "[fast]") {
  validation::Settings settings;
  settings.only = {"windage", "slow_leak"};
  settings.without = {"slow_leak"};
  const Diagnosis diagnosis = validation::diagnose_by(method_of("bic"), make_leaking(), settings);
  CHECK(diagnosis.probability.size() == 3);  // none, unknown, windage
}

TEST_CASE("on the baseline itself no method sees a gap", "[fast]") {
  const measurements::MeasurementSet set = make_gap_set({}, 2);
  for (const char* id : {"nearest", "aic", "bic", "sparse"}) {
    INFO(id);
    const Diagnosis diagnosis = validation::diagnose_by(method_of(id), set, {});
    CHECK(diagnosis.verdict == Verdict::kNoGap);
    CHECK_FALSE(diagnosis.gap.shrink_percent.has_value());
  }
}

TEST_CASE("the process shrinks a gap that repeats from run to run, and names nothing", "[slow]") {
  measurements::MeasurementSet set = make_gap_set({}, 3);
  for (measurements::MeasuredRun& run : set.runs) {
    add_to_channel(run, "liner_temperature_degC", [](double time_s) { return 5.0 * std::sin(time_s / 400.0); });
  }
  const Diagnosis diagnosis = validation::diagnose_by(method_of("gp"), set, {});
  CHECK(diagnosis.verdict == Verdict::kUnexplained);
  CHECK(diagnosis.causes.empty());
  CHECK(diagnosis.gap.shrink_percent.value() > 50.0);
}
