// Second effects beside a first one whose law may be wrong.
#include "diagnosis/comparison/law_errors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "diagnosis/comparison/evaluator.h"
#include "diagnosis/comparison/evidence.h"
#include "measurements/resimulation.h"
#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

const std::vector<std::string> kTerms{"standing_wave", "windage"};

/// 40, 120 and 80 km/h for 8 min each.
measurements::MeasuredRun plan_steps() {
  measurements::MeasuredRun run = tests::plan_skim_run();
  const std::vector<double> speeds_km_h{40.0, 120.0, 80.0};
  run.time_s.clear();
  run.columns.clear();
  double speed_km_h = speeds_km_h.front();
  for (double time_s = 0.0; time_s < 3.0 * 480.0; time_s += 1.0) {
    const double wanted_km_h = speeds_km_h[static_cast<std::size_t>(time_s / 480.0)];
    speed_km_h += std::clamp(wanted_km_h - speed_km_h, -1.0, 1.0);
    run.time_s.push_back(time_s);
    run.columns["speed_km_h"].push_back(speed_km_h / 3.6);
    run.columns["load_N"].push_back(5400.0);
    run.columns["ambient_degC"].push_back(298.15);
  }
  return run;
}

/// Adds a share of what an effect changes in the torque: at 120 km/h the whole share, at 80 km/h nothing, at 40 km/h
/// minus the share.
void bend_law(const models::ActiveEffect& effect, double share, measurements::MeasurementSet& set) {
  for (measurements::MeasuredRun& run : set.runs) {
    const auto simulate = [&](const std::vector<models::ActiveEffect>& effects) {
      models::Corner<double> corner(rigs::make_context(set.tire, *set.rig, set.baseline), effects);
      return measurements::Resimulation(run, *set.kind)
          .simulate(set, run, corner)
          .channel(models::quantities::kDrumTorque);
    };
    const std::vector<double> with = simulate({effect});
    const std::vector<double> without = simulate({});
    for (std::size_t row = 0; row < with.size(); ++row) {
      const double faster = (3.6 * run.column(models::quantities::kSpeed)[row] - 80.0) / 40.0;
      run.column(models::quantities::kDrumTorque)[row] += share * faster * (with[row] - without[row]);
    }
  }
}

const Candidate& find_candidate(const Comparison& comparison, const std::vector<std::string>& names) {
  for (const Candidate& one : comparison.candidates) {
    if (one.fit.hypothesis.names() == names) return one;
  }
  FAIL("not among the candidates");
  return comparison.candidates.front();
}

/// Windage alone, and with a standing wave.
struct Compared {
  explicit Compared(const measurements::MeasurementSet& set)
      : compared(set, kTerms),
        pair(find_candidate(compared.comparison, kTerms)),
        first(find_candidate(compared.comparison, {"windage"})) {}

  /// What the standing wave gains beside a loose law of the windage.
  double find_gain() const {
    const Evaluator evaluator(compared.study);
    const std::vector<const Term*> loose{&find_term("windage")};
    return evaluator.weigh_with_loose_laws(pair, loose).value() - evaluator.weigh_with_loose_laws(first, loose).value();
  }

  tests::ComparedSet compared;
  const Candidate& pair;
  const Candidate& first;
};

}  // namespace

TEST_CASE("a second effect is told from an error of the first one's law", "[fast]") {
  const models::ActiveEffect windage = tests::act("windage", 20.0);
  measurements::MeasurementSet bent = tests::measure_on_drum({windage}, {plan_steps()});
  bend_law(windage, 0.08, bent);
  const Compared of_error(bent);
  const Compared of_effect(tests::measure_on_drum({windage, tests::act("standing_wave", 1.0)}, {plan_steps()}));
  CAPTURE(of_error.find_gain(), of_effect.find_gain());
  CHECK(of_error.find_gain() < 2.0);
  CHECK(of_effect.find_gain() > 5.0);
  CHECK(of_error.first.probability > of_error.pair.probability);
  CHECK(of_effect.first.probability < of_effect.pair.probability);
}

TEST_CASE("a loose law finds the error that a law has", "[fast]") {
  constexpr double kError = 0.15;  // at 120 km/h; minus that at 40 km/h
  const models::ActiveEffect windage = tests::act("windage", 60.0);
  measurements::MeasurementSet bent = tests::measure_on_drum({windage}, {plan_steps()});
  bend_law(windage, kError, bent);
  const tests::ComparedSet compared(bent, kTerms);
  const Candidate& first = find_candidate(compared.comparison, {"windage"});
  const auto loose = loosen_laws(compared.study, first.fit, {&find_term("windage")});
  REQUIRE(loose.has_value());
  const Evidence evidence(compared.study.discrepancy, *loose);
  const Amplitudes small(compared.study.set.channels().size(), 0.1);
  const auto solution = evidence.solve(small, true);
  const Eigen::Index speed_form = first.fit.jacobian.cols() + 1;  // of the torque, which is the first channel
  const double share = thresholds::kLooseLawShare * solution.step[speed_form];
  const double sd = thresholds::kLooseLawShare * std::sqrt(solution.covariance(speed_form, speed_form));
  CAPTURE(share, sd);
  CHECK(share == Approx(kError).margin(2.0 * sd));
  CHECK(sd < 0.3 * kError);
  CHECK(first.log_loose.has_value());
  CHECK(first.log_evidence > first.log_loose.value() + std::log(thresholds::kLooseLaw) - 1e-9);
}

TEST_CASE("loose laws add unknowns that change only what their effect changes", "[fast]") {
  const tests::ComparedSet compared(tests::measure_on_drum({tests::act("windage", 5.0)}, {plan_steps()}), kTerms);
  const Fit& fit = find_candidate(compared.comparison, {"windage"}).fit;
  const Fit loose = loosen_laws(compared.study, fit, {&find_term("windage")}).value();
  const Eigen::Index known = fit.jacobian.cols();
  REQUIRE(loose.jacobian.cols() > known);
  CHECK(loose.jacobian.leftCols(known) == fit.jacobian);
  CHECK(loose.unknowns.head(known) == fit.unknowns);
  CHECK(loose.unknowns.tail(loose.jacobian.cols() - known).norm() == 0.0);
  const RowMatrix added = loose.jacobian.rightCols(loose.jacobian.cols() - known);
  for (const Series& series : compared.study.set.series()) {
    const double norm = series.rows_of(added).norm();
    INFO(compared.study.set.channels()[series.channel].header());
    if (compared.study.set.channels()[series.channel] == models::quantities::kDrumTorque) {
      CHECK(norm > 0.0);
    } else {
      CHECK(norm == 0.0);  // air beside the drum heats no tire
    }
  }
  CHECK(loosen_laws(compared.study, fit, {}).value().jacobian == fit.jacobian);
}
