// Where a fit ends does not depend on where it starts, also where the start lies at the end of a range.
#include "diagnosis/comparison/refit.h"

#include <catch2/catch.hpp>

#include "diagnosis/study.h"
#include "diagnosis/terms/term.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/fit_study.h"

using namespace rollrig;

namespace {

/// The end of a fit with one effect, from these own parameters and the base parameters of the baseline's fit.
diagnosis::Fit fit_from(const diagnosis::Study& study, const std::string& effect, const Eigen::VectorXd& own) {
  const diagnosis::Model model = study.make_model(diagnosis::Hypothesis{}.with({&diagnosis::find_term(effect), 1}));
  Eigen::VectorXd start(own.size() + study.null.fit.unknowns.size());
  start << own, study.null.fit.unknowns;
  return refit(model, study.discrepancy, {study.null.amplitudes, start});
}

}  // namespace

TEST_CASE("a fit that starts at the end of a range ends where any other does", "[slow]") {
  const auto effect = tests::make_active(models::find_effect("convection_law"), {0.4, 20.0, 1.0, 0.6});
  const auto clean = tests::make_dyno_set({effect}, 2, models::Baseline::kCombined, 40.0);
  const tests::FittedBaseline study(tests::add_noise(clean, 3));
  const diagnosis::Fit from_middle = fit_from(study, "convection_law", Eigen::Vector4d(0.5, 0.0, 0.0, 0.2));
  for (const double other_air_u : {-2.5, 0.0, 2.6}) {  // of a range from -2.56 to 2.65
    for (const double fan_share_u : {-1.0, 1.0}) {
      for (const double deficit_u : {0.57, 3.0}) {
        const diagnosis::Fit from_end =
            fit_from(study, "convection_law", Eigen::Vector4d(deficit_u, 0.0, other_air_u, fan_share_u));
        INFO("from " << deficit_u << ", " << other_air_u << ", " << fan_share_u);
        CHECK(from_end.cost == Approx(from_middle.cost).margin(0.5));
      }
    }
  }
}
