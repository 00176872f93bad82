#include "diagnosis/comparison/model.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/comparison/base_parameters.h"
#include "models/tire/model_parts.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/fit_study.h"

using namespace rollrig;
using diagnosis::Hypothesis;
using diagnosis::Model;
using diagnosis::PreparedSet;
using diagnosis::RowMatrix;
using diagnosis::Series;
using diagnosis::to_index;

namespace {

const PreparedSet& two_runs() {
  static const PreparedSet set(tests::add_noise(tests::make_gap_set({}, 2), 4));
  return set;
}

const std::vector<estimation::FreeParameter>& base() {
  static const auto parameters = diagnosis::find_base_parameters(two_runs().source(), two_runs().context());
  return parameters;
}

Hypothesis with(const std::vector<const char*>& ids, int sign = 1) {
  Hypothesis hypothesis;
  for (const char* id : ids) hypothesis = hypothesis.with({&diagnosis::find_term(id), sign});
  return hypothesis;
}

/// Somewhere off the priors' middles.
Eigen::VectorXd make_unknowns(const Model& model) {
  Eigen::VectorXd unknowns(to_index(model.unknown_count()));
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) unknowns[i] = 0.3 * std::sin(static_cast<double>(i + 1));
  return unknowns;
}

void check_derivatives(const PreparedSet& set, const std::vector<estimation::FreeParameter>& base,
                       const Hypothesis& hypothesis) {
  const Model model(set, base, hypothesis);
  const Eigen::VectorXd unknowns = make_unknowns(model);
  Eigen::VectorXd residuals;
  RowMatrix jacobian;
  REQUIRE(model.evaluate(unknowns, 0, residuals, &jacobian));
  constexpr double kStep = 1e-4;
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
    Eigen::VectorXd above = unknowns;
    Eigen::VectorXd below = unknowns;
    above[i] += kStep;
    below[i] -= kStep;
    Eigen::VectorXd residuals_above;
    Eigen::VectorXd residuals_below;
    REQUIRE(model.evaluate(above, 0, residuals_above, nullptr));
    REQUIRE(model.evaluate(below, 0, residuals_below, nullptr));
    const Eigen::VectorXd difference = (residuals_above - residuals_below) / (2.0 * kStep);
    INFO(hypothesis.name() << ", unknown " << i << ", of length " << difference.norm());
    CHECK((jacobian.col(i) - difference).norm() < 1e-4 * difference.norm() + 1e-7);
  }
}

void check_derivatives(const Hypothesis& hypothesis) { check_derivatives(two_runs(), base(), hypothesis); }

/// A tire model with more numbers of its own than a Jet has places: each is a term of speed and load in the loss.
struct ManyNumbers : models::OneNode {
  static constexpr int kCount = 20;

  static models::TireModelInfo info() {
    models::TireModelInfo info;
    info.id = "many_numbers";
    info.nodes = {{models::Node::kLiner, "rubber"}};
    info.tables = {"rolling_resistance", "thermal"};
    for (int i = 0; i < kCount; ++i) info.parameters.push_back({{kKeys[i], any_number(), ""}, 0.01, 0.1});
    return info;
  }

  template <class S>
  static S calc_loss_N(const models::Instant<S>& now) {
    using std::pow;
    S factor(1.0);
    const S speed = now.motion.speed_m_s / quantity<S>(30.0, dimension::kSpeed) + S(0.1);
    const S load = now.motion.load_N / quantity<S>(4000.0, dimension::kForce);
    for (int i = 0; i < kCount; ++i) {
      factor += now.context->tire.own[static_cast<std::size_t>(i)] * pow(speed, S(i % 5)) * pow(load, S(i / 5));
    }
    return factor * models::CombinedLaw::calc_loss_N(now);
  }

  static constexpr const char* kKeys[kCount]{"a0", "a1", "a2", "a3", "a4", "b0", "b1", "b2", "b3", "b4",
                                             "c0", "c1", "c2", "c3", "c4", "d0", "d1", "d2", "d3", "d4"};
};

}  // namespace

TEST_CASE("a tire model may have more numbers than derivatives are taken by at once", "[fast]") {
  const models::TireModel& many = models::make_tire_model<ManyNumbers>();
  measurements::MeasurementSet set = two_runs().source();
  set.tire.values.own = {&many, {}};
  for (int i = 0; i < ManyNumbers::kCount; ++i) set.tire.values.own.values.push_back(0.01 * (1 + i % 3));
  set.tire.standard_uncertainties.own = {&many, std::vector<double>(ManyNumbers::kCount)};
  set.tire.standard_uncertainties.own.values[7] = 0.004;
  const PreparedSet prepared(set);
  auto parameters = diagnosis::find_base_parameters(set, prepared.context());
  estimation::put_correlations({{"tire.many_numbers.d4", parameters.front().key, 0.8}}, parameters);  // far apart
  REQUIRE(parameters.size() == base().size() + ManyNumbers::kCount);
  for (const estimation::FreeParameter& parameter : parameters) {
    if (parameter.key == "tire.many_numbers.b2") CHECK(parameter.prior_sd_SI == 0.004);
    if (parameter.key == "tire.many_numbers.d4") CHECK(parameter.prior_sd_SI == Approx(0.1 * 0.02));
  }
  check_derivatives(prepared, parameters, with({"rim_heat"}));
}

TEST_CASE("derivatives of residuals are those of the simulation", "[fast]") {
  check_derivatives({});
  for (const char* id : {"bearing_warmup", "load_exponent", "rim_heat", "rubber_memory", "slow_leak",
                         "torque_zero_drift", "tread_liner_lag"}) {
    check_derivatives(with({id}));
  }
  check_derivatives(with({"bearing_warmup", "slow_leak"}));
  check_derivatives(with({"torque_zero_drift"}, -1));
}

TEST_CASE("a clock that is late has the derivatives of its traces", "[fast]") {
  check_derivatives(with({"clock_shift"}));
}

TEST_CASE("residuals and derivatives are the same to the bit from one thread or two", "[fast]") {
  const Model model(two_runs(), base(), with({"bearing_warmup", "rim_heat"}));
  const Eigen::VectorXd unknowns = make_unknowns(model);
  Eigen::VectorXd one;
  Eigen::VectorXd two;
  Eigen::VectorXd alone;
  RowMatrix jacobian_of_one;
  RowMatrix jacobian_of_two;
  REQUIRE(model.evaluate(unknowns, 1, one, &jacobian_of_one));
  REQUIRE(model.evaluate(unknowns, 2, two, &jacobian_of_two));
  REQUIRE(model.evaluate(unknowns, 1, alone, nullptr));
  CHECK(one == two);
  CHECK(jacobian_of_one == jacobian_of_two);
  CHECK((one - alone).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("at the truth, without noise, nothing is left", "[fast]") {
  const auto effect = [] {
    models::ActiveEffect active{&models::find_effect("bearing_warmup"), {}};
    for (const models::EffectParameter& parameter : active.effect->info.parameters) {
      active.parameters.push_back(diagnosis::from_prior_units(parameter, 0.0, 1).value_SI);
    }
    return active;
  }();
  const PreparedSet set(tests::make_gap_set({effect}, 2));
  const Model model(set, base(), with({"bearing_warmup"}));
  Eigen::VectorXd residuals;
  REQUIRE(model.evaluate(Eigen::VectorXd::Zero(to_index(model.unknown_count())), 1, residuals, nullptr));
  CHECK(residuals.cwiseAbs().maxCoeff() < 1e-3);
  const Model none(set, base(), {});
  REQUIRE(none.evaluate(Eigen::VectorXd::Zero(to_index(none.unknown_count())), 1, residuals, nullptr));
  CHECK(residuals.cwiseAbs().maxCoeff() > 1.0);
}

TEST_CASE("residuals of the truth are of unit variance", "[fast]") {
  // Rounding is not white where the true value holds still for minutes: its share is below 2 %.
  const Model model(two_runs(), base(), {});
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
  Eigen::VectorXd residuals;
  RowMatrix jacobian;
  REQUIRE(model.evaluate(unknowns, 1, residuals, &jacobian));
  // The sessions' offsets, which are the truth's only unknowns here, by least squares.
  const RowMatrix offsets = jacobian.rightCols(to_index(two_runs().offset_count()));
  const Eigen::VectorXd best = (offsets.transpose() * offsets).llt().solve(-offsets.transpose() * residuals);
  const Eigen::VectorXd left = residuals + offsets * best;
  const double freedom = static_cast<double>(left.size() - best.size());
  CHECK(left.squaredNorm() / freedom == Approx(1.0).margin(4.0 * std::sqrt(2.0 / freedom)));
  CHECK(best.cwiseAbs().maxCoeff() < 4.5);  // in standard deviations of an offset
}

TEST_CASE("a parameter out of its range is no hypothesis", "[fast]") {
  const Model model(two_runs(), base(), with({"bearing_warmup"}));
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(to_index(model.unknown_count()));
  unknowns[0] = model.own_parameters()[0].bounds().upper + 0.1;
  Eigen::VectorXd residuals;
  CHECK_FALSE(model.evaluate(unknowns, 1, residuals, nullptr));
}

TEST_CASE("without base parameters, only own parameters and offsets are unknown", "[fast]") {
  const Model model(two_runs(), {}, with({"bearing_warmup"}));
  CHECK(model.unknown_count() == model.own_count() + two_runs().offset_count());
}

TEST_CASE("correlated base parameters move together, and the derivatives follow them", "[fast]") {
  std::vector<estimation::FreeParameter> correlated = base();
  REQUIRE(correlated.size() > 2);
  estimation::put_correlations({{correlated[0].key, correlated[2].key, -0.7}}, correlated);
  const Model together(two_runs(), correlated, {});
  const Model apart(two_runs(), base(), {});
  const Eigen::VectorXd unknowns = make_unknowns(together);
  Eigen::VectorXd same_numbers = unknowns;  // by hand: the third is rho times the first, and what is its own
  same_numbers[2] = -0.7 * unknowns[0] + std::sqrt(1.0 - 0.7 * 0.7) * unknowns[2];
  Eigen::VectorXd residuals;
  Eigen::VectorXd expected;
  REQUIRE(together.evaluate(unknowns, 0, residuals, nullptr));
  REQUIRE(apart.evaluate(same_numbers, 0, expected, nullptr));
  CHECK((residuals - expected).norm() < 1e-6 * expected.norm());  // rounding of the numbers alone
  CHECK((together.moves_by_unknowns() * unknowns - same_numbers).norm() < 1e-12);
  check_derivatives(two_runs(), correlated, with({"bearing_warmup"}));
}
