// Second effects beside a first one whose law may be wrong.
#include "diagnosis/comparison/law_errors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

#include "diagnosis/comparison/evaluator.h"
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

/// Adds a share of what an effect changes in the torque, more of it the faster the drum turns: at 120 km/h the whole
/// share, at 80 km/h nothing.
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

/// What the second effect gains, and gains beside a loose law of the first one.
std::pair<double, double> find_gains(const measurements::MeasurementSet& set) {
  const tests::ComparedSet compared(set, kTerms);
  const Evaluator evaluator(compared.study);
  const Candidate& pair = find_candidate(compared.comparison, kTerms);
  const Candidate& first = find_candidate(compared.comparison, {"windage"});
  const std::vector<const Term*> loose{&find_term("windage")};
  return {pair.log_evidence - first.log_evidence,
          evaluator.weigh_with_loose_laws(pair, loose) - evaluator.weigh_with_loose_laws(first, loose)};
}

}  // namespace

TEST_CASE("what a second effect gains from an error of the first one's law is less beside a loose law", "[fast]") {
  const models::ActiveEffect windage = tests::act("windage", 20.0);
  measurements::MeasurementSet bent = tests::measure_on_drum({windage}, {plan_steps()});
  bend_law(windage, 0.08, bent);
  const auto [of_error, of_error_beside_loose] = find_gains(bent);
  const auto [of_effect, of_effect_beside_loose] =
      find_gains(tests::measure_on_drum({windage, tests::act("standing_wave", 1.0)}, {plan_steps()}));
  CAPTURE(of_error, of_error_beside_loose, of_effect, of_effect_beside_loose);
  REQUIRE(of_error > 3.0);
  REQUIRE(of_effect > 3.0);
  CHECK(of_error_beside_loose < 0.5 * of_error);
  CHECK(of_effect_beside_loose > 0.8 * of_effect);
}

TEST_CASE("loose laws add unknowns that change only what their effect changes", "[fast]") {
  const tests::ComparedSet compared(tests::measure_on_drum({tests::act("windage", 5.0)}, {plan_steps()}), kTerms);
  const Fit& fit = find_candidate(compared.comparison, {"windage"}).fit;
  const Fit loose = loosen_laws(compared.study, fit, {&find_term("windage")});
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
  CHECK(loosen_laws(compared.study, fit, {}).jacobian == fit.jacobian);
}
