#include "diagnosis/findings/energy_scale.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/kinds/measurement_kind.h"
#include "tests/diagnosis/driving_sets.h"
#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::EnergyScale;
using diagnosis::PreparedSet;
using diagnosis::Series;
using diagnosis::to_index;

namespace {

/// Differences of the force channel, as a function of the series and the block.
template <class Get>
Eigen::VectorXd make_difference(const PreparedSet& set, Get&& get) {
  Eigen::VectorXd difference = Eigen::VectorXd::Zero(to_index(set.residual_count()));
  for (const Series& series : set.series()) {
    if (!(set.channels()[series.channel] == set.source().kind->traits.force)) continue;
    for (std::size_t k = 0; k < series.size(); ++k) difference[to_index(series.first_residual + k)] = get(series, k);
  }
  return difference;
}

bool is_skim(const PreparedSet& set, const Series& series, std::size_t block) {
  return set.runs()[series.run].phases[series.phase[block]].name.rfind("skim", 0) == 0;
}

}  // namespace

TEST_CASE("on a drum the energy is the tire's under load: skim and parasitic loss do not count", "[fast]") {
  const PreparedSet set(tests::make_gap_set({}, 3));
  const EnergyScale scale(set);
  const rigs::RigFile& rig = *set.source().rig;
  // All that the tire takes, since the torque is that of tire and drum.
  const Eigen::VectorXd whole = make_difference(set, [&](const Series& series, std::size_t k) {
    const measurements::MeasuredRun& run = set.runs()[series.run].measured;
    return series.mean_over(series.blocks[k], [&](std::size_t row) {
      const double drum_N = models::calc_parasitic_N(rig.parasitic, run.column(models::quantities::kSpeed)[row]);
      return run.column(set.source().kind->traits.force)[row] - rig.lever_m() * drum_N;
    });
  });
  CHECK(scale.calc_percent(whole).value() == Approx(100.0).epsilon(1e-3));
  CHECK(scale.calc_percent(0.01 * whole).value() == Approx(1.0).epsilon(1e-3));
  const Eigen::VectorXd in_skim =
      make_difference(set, [&](const Series& series, std::size_t k) { return is_skim(set, series, k) ? 5.0 : 0.0; });
  REQUIRE(in_skim.norm() > 0.0);
  CHECK(scale.calc_percent(in_skim).value() == 0.0);
}

TEST_CASE("an error that comes and goes in a run adds up to nothing, and one of each sign in two runs does not",
          "[fast]") {
  const PreparedSet set(tests::make_gap_set({}, 2));
  const EnergyScale scale(set);
  const auto per_run = [&](double first, double second) {
    return scale
        .calc_percent(
            make_difference(set, [&](const Series& series, std::size_t) { return series.run == 0 ? first : second; }))
        .value();
  };
  const double both = per_run(0.5, 0.5);
  CHECK(both > 0.5);
  CHECK(per_run(0.5, -0.5) == Approx(both));
  CHECK(per_run(0.5, 0.0) < both);
}

TEST_CASE("on the road the energy is what drives: an error where the vehicle brakes does not count", "[fast]") {
  const PreparedSet set(tests::make_road_set({}, 2));
  const EnergyScale scale(set);
  const auto force_N = [&](const Series& series, std::size_t k) {
    const auto& values = set.runs()[series.run].measured.column(set.source().kind->traits.force);
    return series.mean_over(series.blocks[k], [&](std::size_t row) { return values[row]; });
  };
  const Eigen::VectorXd braking = make_difference(
      set, [&](const Series& series, std::size_t k) { return std::min(0.0, force_N(series, k) + 500.0); });
  const Eigen::VectorXd all = make_difference(set, force_N);
  REQUIRE(braking.norm() > 0.0);
  CHECK(scale.calc_percent(braking).value() < 1.0);  // of blocks that drive and brake
  CHECK(scale.calc_percent(all).value() == Approx(100.0).epsilon(0.1));
}

TEST_CASE("runs without energy do not count, and where there is none there is no share", "[fast]") {
  CHECK_FALSE(diagnosis::calc_rms_percent({{1.0, 0.0}}).has_value());
  CHECK(diagnosis::calc_rms_percent({{3.0, 100.0}, {-4.0, 100.0}, {5.0, 0.0}}).value() ==
        Approx(std::sqrt((9.0 + 16.0) / 2.0)));
}
