// What decelerations of runs, made by hand, come to: means, intervals, ratios, exponents and directions.
#include "estimation/drum_deceleration/coast_evaluation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/estimation/hand_made_coasts.h"

using namespace rollrig;
using namespace rollrig::tests;
using Matrix = Eigen::Matrix2d;

namespace {

/// Sum over runs of the products of both speeds' deviations.
Matrix calc_products(const std::vector<Vector>& runs) {
  Matrix products = Matrix::Zero();
  for (const Vector& run : runs) products += (run - calc_mean(runs)) * (run - calc_mean(runs)).transpose();
  return products;
}

/// Variance of what is evaluated, by the scatter of runs and by differences: each group's runs moved together.
double calc_variance(const std::function<double(const Decelerations&)>& evaluated) {
  const auto of_group = [&](const std::function<std::vector<Vector>&(Decelerations&)>& group, const Matrix& of_a_run) {
    constexpr double kStep_m_s2 = 1e-6;
    Vector gradient;
    double runs = 0.0;
    for (int speed = 0; speed < 2; ++speed) {
      const auto moved = [&](double by_m_s2) {
        Decelerations values = kScattered;
        runs = static_cast<double>(group(values).size());
        for (Vector& run : group(values)) run[speed] += by_m_s2;
        return evaluated(values);
      };
      gradient[speed] = (moved(kStep_m_s2) - moved(-kStep_m_s2)) / (2.0 * kStep_m_s2);
    }
    return gradient.dot(of_a_run * gradient) / runs;
  };
  Decelerations values = kScattered;
  Matrix pooled = Matrix::Zero();  // over levels
  for (const auto& level : values.loaded) pooled += calc_products(level) / 3.0;
  double variance = of_group(
                        [](Decelerations & v) -> auto& { return v.drum; }, calc_products(values.drum) / 2.0) +
                    of_group(
                        [](Decelerations & v) -> auto& { return v.wheel; }, calc_products(values.wheel) / 3.0);
  for (std::size_t i = 0; i < values.loaded.size(); ++i) {
    variance += of_group(
        [i](Decelerations & v) -> auto& { return v.loaded[i]; }, pooled);
  }
  return variance;
}

const PressureLevel& level_of(const Evaluated& all, std::size_t speed, std::size_t level) {
  return all.fit.points[speed].levels[level];
}

}  // namespace

TEST_CASE("net decelerations, ratios and exponents have the variance that the scatter of all runs gives them",
          "[fast]") {
  const Evaluated all = evaluate(kScattered);
  for (std::size_t speed = 0; speed < 2; ++speed) {
    for (std::size_t level = 0; level < 2; ++level) {
      CAPTURE(speed, level);
      const auto net = [&](const Decelerations& v) { return level_of(evaluate(v), speed, level).net_m_s2.value; };
      CHECK(level_of(all, speed, level).net_m_s2.sd == Approx(std::sqrt(calc_variance(net))).epsilon(1e-6));
      const bool is_reference = speed == 1 && level == 1;
      const Interval ratio = *level_of(all, speed, level).ratio;
      CHECK((ratio.value == 1.0) == is_reference);
      const auto log_ratio = [&](const Decelerations& v) {
        return std::log(level_of(evaluate(v), speed, level).ratio->value);
      };
      if (!is_reference) CHECK(ratio.sd / ratio.value == Approx(std::sqrt(calc_variance(log_ratio))).epsilon(1e-6));
    }
    const auto exponent = [&](const Decelerations& v) {
      return evaluate(v).fit.points[speed].pressure_exponent->value;
    };
    CHECK(all.fit.points[speed].pressure_exponent->sd == Approx(std::sqrt(calc_variance(exponent))).epsilon(1e-6));
  }
}

TEST_CASE("the force is the drum's mass at its surface times the net deceleration, with its interval", "[fast]") {
  const PressureLevel level = level_of(evaluate(kScattered), 0, 0);
  const double mass_kg = 1500.0 / (0.85 * 0.85);
  const Vector loaded = calc_mean(kScattered.loaded[0]);
  const double net_m_s2 =
      loaded[0] - calc_mean(kScattered.drum)[0] + kMassRatio * (loaded[0] - calc_mean(kScattered.wheel)[0]);
  CHECK(level.net_m_s2.value == Approx(net_m_s2));
  CHECK(level.force_N->value == Approx(mass_kg * net_m_s2));
  CHECK(level.force_N->sd == Approx(mass_kg * level.net_m_s2.sd));
  CHECK(level.force_N->freedom == Approx(level.net_m_s2.freedom));
}

TEST_CASE("intervals are Student's: of one freedom by the tangent, of two by a root", "[fast]") {
  const Interval one = make_interval(3.0, {{0.04, 1.0}});
  CHECK(one.upper - 3.0 == Approx(0.2 * std::tan(0.475 * M_PI)));
  CHECK(one.lower + one.upper == Approx(6.0));
  const Interval two = make_interval(3.0, {{0.02, 1.0}, {0.02, 1.0}});  // two equal parts: twice the freedom
  CHECK(two.freedom == Approx(2.0));
  CHECK(two.upper - 3.0 == Approx(0.2 * 0.95 / std::sqrt(2.0 * 0.975 * 0.025)));
}

TEST_CASE("the scatter of three drum runs is known to what chi2 of two degrees of freedom says", "[fast]") {
  const SpeedPoint point = evaluate(kScattered).fit.points[0];
  const double sd = std::sqrt(calc_products(kScattered.drum)(0, 0) / 2.0);
  const double relative = sd / calc_mean(kScattered.drum)[0];
  CHECK(point.drum_repeatability->value == Approx(relative));
  CHECK(point.drum_repeatability->sd == Approx(relative / 2.0));
  CHECK(point.drum_repeatability->lower == Approx(relative / std::sqrt(-std::log(0.025))));
  CHECK(point.drum_repeatability->upper == Approx(relative / std::sqrt(-std::log(0.975))));
  CHECK(point.drum_alone_m_s2->sd == Approx(sd / std::sqrt(3.0)));
}

TEST_CASE("levels off a power law widen the interval of its exponent, and the F test says how unlikely that is",
          "[fast]") {
  // Three levels apart by one factor: what is off as (1, -2, 1) leaves slope and mean alone.
  constexpr double kOff = 0.01;
  constexpr double kExponent = -0.4;
  constexpr double kRepeat_m_s2 = 0.0002;  // so little that the law is shown not to hold
  std::vector<std::vector<Vector>> loaded;
  for (int i = 0; i < 3; ++i) {
    const double off = i == 1 ? -2.0 * kOff : kOff;
    const double net_m_s2 = 0.05 * std::exp(kExponent * i * std::log(1.2) + off);
    const double loaded_m_s2 = (net_m_s2 + 0.011 + kMassRatio * 0.021) / (1.0 + kMassRatio);
    loaded.push_back({{loaded_m_s2 - kRepeat_m_s2, 0.08}, {loaded_m_s2 + kRepeat_m_s2, 0.08}});
  }
  const SpeedPoint point = evaluate(make_exact_lifted(loaded)).fit.points[0];
  const double squares = 6.0 * kOff * kOff;  // one degree of freedom
  const double spread = 2.0 * std::pow(std::log(1.2), 2);
  CHECK(point.pressure_exponent->value == Approx(kExponent));
  CHECK(*point.level_scatter == Approx(std::sqrt(squares)));
  CHECK(point.pressure_exponent->sd == Approx(std::sqrt(squares / spread)));
  CHECK(point.pressure_exponent->freedom == Approx(1.0));
  // Two runs a level: the variance of a run is 2 d^2, of a level's mean d^2.
  double repeat = 0.0;
  double net_sum_m_s2 = 0.0;
  for (const PressureLevel& level : point.levels) {
    repeat += std::pow((1.0 + kMassRatio) * kRepeat_m_s2 / level.net_m_s2.value, 2) / 3.0;
    net_sum_m_s2 += level.net_m_s2.value;
  }
  CHECK(point.exponent_by_repeats->sd == Approx(std::sqrt(repeat / spread)));
  CHECK(point.exponent_by_repeats->freedom == Approx(3.0));
  CHECK(point.repeat_scatter == Approx((1.0 + kMassRatio) * std::sqrt(2.0) * kRepeat_m_s2 / (net_sum_m_s2 / 3.0)));
  // F of 1 and 3 degrees of freedom is Student's t of 3, squared.
  const double t = std::sqrt(squares / repeat);
  const double beyond = 1.0 - 2.0 / M_PI * (std::atan(t / std::sqrt(3.0)) + t / std::sqrt(3.0) / (1.0 + t * t / 3.0));
  CHECK(*point.lack_of_fit_p == Approx(beyond).epsilon(1e-6));
}

TEST_CASE("an exponent takes two pressures, each with a loss above that of the lifted runs", "[fast]") {
  const std::vector<Vector> first{{0.061, 0.083}, {0.064, 0.084}};
  CHECK_FALSE(evaluate(make_exact_lifted({first})).fit.points[0].pressure_exponent.has_value());
  // at the lower speed the second level coasts longer than the lifted drum
  const Evaluated lower = evaluate(make_exact_lifted({first, {{0.005, 0.071}, {0.006, 0.072}}}));
  CHECK_FALSE(lower.fit.points[0].pressure_exponent.has_value());
  CHECK(lower.fit.points[1].pressure_exponent.has_value());
}

TEST_CASE("a wheel that has a share of the mass must have coasted alone, one without need not", "[fast]") {
  Decelerations values = kScattered;
  values.wheel.clear();
  CHECK(evaluate(values).fit.points[0].levels.empty());
  const Evaluated without = evaluate(values, 0.0);
  CHECK(level_of(without, 0, 0).net_m_s2.value == Approx(calc_mean(values.loaded[0])[0] - calc_mean(values.drum)[0]));
}

TEST_CASE("the exponent moves with the wheel's share of the mass as differences say", "[fast]") {
  const SpeedPoint point = evaluate(kScattered).fit.points[1];
  const auto exponent_at = [](double share) {
    const auto net = [share](std::size_t level) {
      const double loaded = calc_mean(kScattered.loaded[level])[1];
      return loaded - calc_mean(kScattered.drum)[1] + share * (loaded - calc_mean(kScattered.wheel)[1]);
    };
    return std::log(net(1) / net(0)) / std::log(1.2);
  };
  CHECK(point.pressure_exponent->value == Approx(exponent_at(kMassRatio)));
  const double slope = (exponent_at(kMassRatio + 1e-4) - exponent_at(kMassRatio - 1e-4)) / 2e-4;
  CHECK(point.exponent_per_mass_ratio == Approx(slope).epsilon(1e-2));
}

TEST_CASE("what one direction is above the other is the mean over pressures, known by their scatter", "[fast]") {
  std::vector<std::vector<Vector>> loaded;
  for (const double log_ratio : {0.02, 0.05}) {  // of net decelerations, first over second by alphabet
    const auto at = [](double net_m_s2) { return (net_m_s2 + 0.011 + kMassRatio * 0.021) / (1.0 + kMassRatio); };
    loaded.push_back(
        {{at(0.05 * std::exp(log_ratio)), 0.08}, {at(0.05), 0.08}, {at(0.05 * std::exp(log_ratio)), 0.08}});
  }
  const SpeedPoint point = evaluate(make_exact_lifted(loaded)).fit.points[0];
  CHECK(point.direction_ratio->value == Approx(std::expm1(0.035)));
  CHECK(point.direction_ratio->sd == Approx(0.015));
  CHECK(point.direction_ratio->upper == Approx(std::expm1(0.035 + 0.015 * std::tan(0.475 * M_PI))));
  CHECK(point.direction_sd == Approx(0.03 / std::sqrt(2.0)));
}

TEST_CASE("where no pressure was run twice, the scatter within a run stands for it", "[fast]") {
  const Evaluated all = evaluate(make_exact_lifted({{{0.061, 0.083}}, {{0.049, 0.071}}}));
  CHECK(level_of(all, 0, 0).net_m_s2.sd == Approx((1.0 + kMassRatio) * 0.004));
  Decelerations one_lifted = kScattered;
  one_lifted.drum.resize(1);
  CHECK(evaluate(one_lifted).fit.points[0].drum_alone_m_s2->sd == Approx(0.004));
}

TEST_CASE("a run that does not pass a speed counts at the other alone", "[fast]") {
  Decelerations values = kScattered;
  values.loaded[0].push_back({std::nan(""), 0.085});
  values.drum.push_back({std::nan(""), 0.0200});
  const Evaluated all = evaluate(values);
  const Evaluated without = evaluate(kScattered);
  CHECK(level_of(all, 0, 0).net_m_s2.value == level_of(without, 0, 0).net_m_s2.value);
  CHECK(level_of(all, 0, 0).net_m_s2.sd == level_of(without, 0, 0).net_m_s2.sd);
  CHECK(level_of(all, 0, 0).runs == 3);
  CHECK(level_of(all, 1, 0).runs == 4);
}

TEST_CASE("a covariance of means does not ask where zero is, not with runs that lack a speed either", "[fast]") {
  RunTable table;
  table.value_m_s2.resize(5, 2);
  table.value_m_s2 << 0.061, 0.083, 0.064, 0.084, 0.066, 0.088, 0.070, std::nan(""), std::nan(""), 0.091;
  table.sd_m_s2 = Eigen::MatrixXd::Constant(5, 2, 0.004);
  RunTable shifted = table;
  shifted.value_m_s2.col(0).array() += 0.5;
  shifted.value_m_s2.col(1).array() -= 0.2;
  const double covariance = calc_mean_covariance(table, 0, 1);
  CHECK(covariance != 0.0);
  CHECK(calc_mean_covariance(shifted, 0, 1) == Approx(covariance));
  CHECK(calc_mean_covariance(table, 1, 0) == Approx(covariance));
}

TEST_CASE("levels that lie on a power law by chance leave the exponent the scatter of its repeats", "[fast]") {
  // three levels on a line, whose runs scatter
  std::vector<std::vector<Vector>> loaded;
  for (int level = 0; level < 3; ++level) {
    const double net = 0.05 * std::pow(1.2, -0.45 * level);
    const double mean = net / (1.0 + kMassRatio);
    loaded.push_back({});
    for (const double error : {-0.02, 0.02}) {
      const double own = (mean * (1.0 + error)) + (0.011 + kMassRatio * 0.021) / (1.0 + kMassRatio);
      loaded.back().push_back({own, 1.5 * own});
    }
  }
  const Evaluated all = evaluate(make_exact_lifted(loaded));
  const SpeedPoint& point = all.fit.points[0];
  REQUIRE(point.pressure_exponent.has_value());
  CHECK(point.pressure_exponent->upper == point.exponent_by_repeats->upper);
  CHECK(point.pressure_exponent->lower == point.exponent_by_repeats->lower);
  CHECK_FALSE(point.is_exponent_by_law);
}
