// Steps of the gap: from the files' numbers to the first cause, each effect added to those before it.
#include "diagnosis/findings/gap_steps.h"

#include <catch2/catch.hpp>

#include "diagnosis/findings/gap.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::Candidate;
using diagnosis::GapStep;

namespace {

/// Noise floors: as in gap_test.cpp.
constexpr double kGapOfNoise = 0.5;

models::ActiveEffect make_warming_bearings() {
  return tests::make_active(models::find_effect("bearing_warmup"), {0.02, 20.0, 15.0, 1.0});
}
models::ActiveEffect make_load_exponent() { return tests::make_active(models::find_effect("load_exponent"), {1.12}); }

/// Two effects fitted together, from the middles of their priors.
Candidate fit_both(const diagnosis::Study& study) {
  const diagnosis::Hypothesis both = diagnosis::Hypothesis{}
                                         .with({&diagnosis::find_term("bearing_warmup")})
                                         .with({&diagnosis::find_term("load_exponent")});
  const diagnosis::Model model = study.make_model(both);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(diagnosis::to_index(model.unknown_count()));
  Candidate candidate;
  candidate.amplitudes = study.null.amplitudes;
  candidate.fit = diagnosis::refit(model, study.discrepancy, {candidate.amplitudes, start});
  return candidate;
}

}  // namespace

TEST_CASE("the gap's steps go from the files' numbers over recalibration and each effect to what remains", "[fast]") {
  const tests::FittedBaseline fitted(
      tests::add_noise(tests::make_gap_set({make_warming_bearings(), make_load_exponent()}, 2), 5));
  const Candidate cause = fit_both(fitted);
  const std::vector<GapStep> steps = diagnosis::find_gap_steps(fitted, {}, &cause);
  const std::vector<std::string> effects = cause.fit.hypothesis.names();
  REQUIRE(effects.size() == 2);
  REQUIRE(steps.size() == 4);
  CHECK(steps[0].name == "as calibrated");
  CHECK(steps[1].name == "recalibrated");
  CHECK(steps[2].name == effects[0]);
  CHECK(steps[3].name == effects[1]);
  const diagnosis::Gap gap = diagnosis::find_gap(fitted, &cause);
  CHECK(steps[0].floors == gap.as_calibrated.before);
  CHECK(steps[1].floors == gap.fitted->gap.before);
  CHECK(steps[3].floors == gap.fitted->gap.after);
  CHECK(steps[1].energy_percent == gap.fitted->energy_percent->before);
  // What makes the gap is both effects: each takes a part of it, and next to nothing remains.
  CHECK(steps[1].floors < steps[0].floors);
  CHECK(steps[2].floors < steps[1].floors);
  CHECK(steps[3].floors < steps[2].floors);
  CHECK(steps[0].floors > 1.0);
  CHECK(steps[3].floors < kGapOfNoise);
  REQUIRE(steps[0].channels.size() == 3);
  CHECK(steps[0].channels[0].channel == "drum_torque_Nm");
  CHECK(steps[0].channels[0].unit == "N");
  CHECK(steps[3].channels[0].rms < steps[2].channels[0].rms);
}

TEST_CASE("without a cause the steps end with the recalibration", "[fast]") {
  const tests::FittedBaseline fitted(tests::add_noise(tests::make_gap_set({}, 2), 1));
  const std::vector<GapStep> steps = diagnosis::find_gap_steps(fitted, {}, nullptr);
  REQUIRE(steps.size() == 2);
  CHECK(steps[1].floors < kGapOfNoise);
}
