#include "diagnosis/comparison/discrepancy.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/diagnosis/gap_sets.h"

using namespace rollrig;
using diagnosis::Amplitudes;
using diagnosis::Discrepancy;
using diagnosis::PreparedSet;
using diagnosis::RowMatrix;
using diagnosis::Series;
using diagnosis::to_index;

namespace {

/// Two runs in two sessions.
const PreparedSet& two_runs() {
  static const PreparedSet set(tests::make_gap_set({}, 2));
  return set;
}

/// Two runs that are the same but for their name.
const PreparedSet& twins() {
  static const PreparedSet set([] {
    measurements::MeasurementSet same = tests::make_gap_set({}, 1);
    same.runs.push_back(same.runs.front());
    same.runs.back().id = "run_2";
    return same;
  }());
  return set;
}

/// The discrepancy's covariance of whitened residuals, of unit amplitude, over the whole set.
Eigen::MatrixXd make_process(const Discrepancy& discrepancy, const Amplitudes& amplitudes) {
  const Eigen::Index n = to_index(discrepancy.set().residual_count());
  Eigen::MatrixXd process = Eigen::MatrixXd::Zero(n, n);
  for (const Discrepancy::Basis& basis : discrepancy.bases()) {
    std::vector<Eigen::Index> rows;
    for (const std::size_t s : basis.series) {
      const Series& series = discrepancy.set().series()[s];
      for (std::size_t k = 0; k < series.size(); ++k) rows.push_back(to_index(series.first_residual + k));
    }
    REQUIRE(to_index(rows.size()) == basis.directions.rows());
    const Eigen::MatrixXd part = amplitudes[basis.channel] * amplitudes[basis.channel] * basis.directions *
                                 basis.strengths.asDiagonal() * basis.directions.transpose();
    for (Eigen::Index i = 0; i < part.rows(); ++i) {
      for (Eigen::Index j = 0; j < part.cols(); ++j) {
        process(rows[static_cast<std::size_t>(i)], rows[static_cast<std::size_t>(j)]) += part(i, j);
      }
    }
  }
  return process;
}

/// What the process is before whitening, in noise floors: a row a block.
Eigen::MatrixXd make_rows_in_floors(const Discrepancy& discrepancy, std::size_t s) {
  const Series& series = discrepancy.set().series()[s];
  for (const Discrepancy::Basis& basis : discrepancy.bases()) {
    Eigen::Index first = 0;
    for (const std::size_t other : basis.series) {
      const Eigen::Index size = to_index(discrepancy.set().series()[other].size());
      if (other == s) {
        RowMatrix rows = basis.directions.middleRows(first, size) * basis.strengths.cwiseSqrt().asDiagonal();
        series.whitener.undo(rows.data(), static_cast<std::size_t>(rows.cols()));
        return rows / series.floor;
      }
      first += size;
    }
  }
  throw std::logic_error("a series without a basis");
}

void check_inverse_root(const Discrepancy& discrepancy, const Amplitudes& amplitudes) {
  const Eigen::MatrixXd sigma =
      make_process(discrepancy, amplitudes) + Eigen::MatrixXd::Identity(to_index(discrepancy.set().residual_count()),
                                                                        to_index(discrepancy.set().residual_count()));
  const RowMatrix columns = RowMatrix::Random(sigma.rows(), 3);
  RowMatrix whitened = columns;
  discrepancy.whiten(amplitudes, whitened);
  const Eigen::MatrixXd expected = columns.transpose() * sigma.llt().solve(Eigen::MatrixXd(columns));
  CHECK((whitened.transpose() * whitened - expected).norm() < 1e-8 * expected.norm());
  Eigen::VectorXd column = columns.col(1);
  discrepancy.whiten(amplitudes, column);
  CHECK((column - whitened.col(1)).norm() < 1e-12 * column.norm());
}

}  // namespace

TEST_CASE("samples hours apart, of which each touches few of thousands of hats, have one direction each", "[fast]") {
  measurements::MeasurementSet sparse = tests::make_gap_set({}, 1);
  constexpr double kApart = 4000.0;  // times as far apart
  measurements::MeasuredRun& run = sparse.runs.front();
  constexpr std::size_t kRows = 30;
  run.time_s.resize(kRows);
  for (auto& [quantity, values] : run.columns) values.resize(kRows);
  for (double& time_s : run.time_s) time_s *= kApart;
  const PreparedSet set(sparse);
  const Discrepancy discrepancy(set);
  for (std::size_t s = 0; s < set.series().size(); ++s) {
    CHECK(discrepancy.bases()[s].strengths.size() == to_index(set.series()[s].size()));
    // The constants of run and phase are whole in every sample, of the hats at least half.
    const Eigen::VectorXd variances = make_rows_in_floors(discrepancy, s).rowwise().squaredNorm();
    CHECK(variances.minCoeff() > 0.75 - 1e-9);
    CHECK(variances.maxCoeff() < 1.0 + 1e-9);
  }
  check_inverse_root(discrepancy, Amplitudes(set.channels().size(), 0.7));
}

TEST_CASE("the squared length after whitening is r' Sigma^-1 r, of either kind", "[fast]") {
  const Discrepancy of_time(two_runs());
  check_inverse_root(of_time, {0.1, 2.0, 0.5});
  const Discrepancy of_conditions(of_time, {0.2, 0.3, 0.4});
  check_inverse_root(of_conditions, {0.1, 2.0, 0.5});
}

TEST_CASE("a discrepancy of no size changes nothing", "[fast]") {
  const Discrepancy of_time(two_runs());
  const Discrepancy of_conditions(of_time, {0.0, 0.0, 0.0});
  const RowMatrix columns = RowMatrix::Random(to_index(two_runs().residual_count()), 2);
  for (const Discrepancy* discrepancy : {&of_time, &of_conditions}) {
    RowMatrix whitened = columns;
    discrepancy->whiten({0.0, 0.0, 0.0}, whitened);
    CHECK(whitened == columns);
    discrepancy->whiten_below(whitened);
    CHECK(whitened == columns);
    CHECK(discrepancy->log_determinant_below() == 0.0);
  }
}

TEST_CASE("a channel of no size is left alone", "[fast]") {
  const Discrepancy discrepancy(two_runs());
  const Eigen::VectorXd column = Eigen::VectorXd::Random(to_index(two_runs().residual_count()));
  Eigen::VectorXd whitened = column;
  discrepancy.whiten({0.0, 3.0, 0.0}, whitened);
  for (const Series& series : two_runs().series()) {
    const auto change = (whitened - column).segment(to_index(series.first_residual), to_index(series.size())).norm();
    CHECK((change > 0.1) == (series.channel == 1));
  }
}

TEST_CASE("of what it stands on, a discrepancy knows the inverse root and the determinant", "[fast]") {
  const Discrepancy of_time(two_runs());
  CHECK(of_time.log_determinant_below() == 0.0);
  const Amplitudes amplitudes{0.2, 1.0, 0.4};
  const Discrepancy of_conditions(of_time, amplitudes);
  const Eigen::VectorXd column = Eigen::VectorXd::Random(to_index(two_runs().residual_count()));
  Eigen::VectorXd below = column;
  Eigen::VectorXd of_its_own = column;
  of_conditions.whiten_below(below);
  of_time.whiten(amplitudes, of_its_own);
  CHECK(below == of_its_own);
  const Eigen::Index n = to_index(two_runs().residual_count());
  const Eigen::LLT<Eigen::MatrixXd> sigma(make_process(of_time, amplitudes) + Eigen::MatrixXd::Identity(n, n));
  const double log_determinant = 2.0 * sigma.matrixLLT().diagonal().array().log().sum();
  CHECK(of_conditions.log_determinant_below() == Approx(log_determinant));
}

TEST_CASE("directions are orthonormal and strengths positive", "[fast]") {
  const Discrepancy of_time(two_runs());
  const Discrepancy of_conditions(of_time, {0.2, 1.0, 0.4});
  for (const Discrepancy* discrepancy : {&of_time, &of_conditions}) {
    for (const Discrepancy::Basis& basis : discrepancy->bases()) {
      const Eigen::Index n = basis.directions.cols();
      CHECK((basis.directions.transpose() * basis.directions - Eigen::MatrixXd::Identity(n, n)).norm() < 1e-6);
      CHECK(basis.strengths.minCoeff() > 0.0);
    }
  }
}

TEST_CASE("an amplitude is a standard deviation in noise floors, the same all along a run", "[fast]") {
  const Discrepancy discrepancy(two_runs());
  for (std::size_t s = 0; s < two_runs().series().size(); ++s) {
    const Eigen::VectorXd variance = make_rows_in_floors(discrepancy, s).rowwise().squaredNorm();
    CHECK(variance.maxCoeff() < 1.001);
    CHECK(variance.minCoeff() > 0.7);  // between two hats, less
  }
}

TEST_CASE("a discrepancy of time differs from run to run, and one of conditions repeats", "[fast]") {
  const Discrepancy of_time(twins());
  for (const Discrepancy::Basis& basis : of_time.bases()) CHECK(basis.series.size() == 1);
  const Discrepancy of_conditions(of_time, {0.0, 0.0, 0.0});
  CHECK(of_conditions.bases().size() == twins().channels().size());
  for (const Discrepancy::Basis& basis : of_conditions.bases()) {
    REQUIRE(basis.series.size() == 2);
    const Eigen::MatrixXd first = make_rows_in_floors(of_conditions, basis.series[0]);
    const Eigen::MatrixXd second = make_rows_in_floors(of_conditions, basis.series[1]);
    CHECK((first - second).norm() < 1e-6 * first.norm());
  }
}

TEST_CASE("what lasts is taken for a discrepancy, what jumps from block to block is not", "[fast]") {
  const Discrepancy discrepancy(two_runs());
  const Series& series = two_runs().series().front();
  Eigen::VectorXd slow = Eigen::VectorXd::Zero(to_index(two_runs().residual_count()));
  Eigen::VectorXd fast = slow;
  for (std::size_t k = 0; k < series.size(); ++k) {
    slow[to_index(series.first_residual + k)] = std::sin(series.time_s[k] / 300.0);
    fast[to_index(series.first_residual + k)] = k % 2 == 0 ? 1.0 : -1.0;
  }
  const auto kept = [&](Eigen::VectorXd difference) {
    diagnosis::whiten(two_runs(), difference);
    const double before = difference.squaredNorm();
    discrepancy.whiten({100.0, 100.0, 100.0}, difference);
    return difference.squaredNorm() / before;
  };
  CHECK(kept(slow) < 0.05);
  CHECK(kept(fast) > 0.7);
}

TEST_CASE("a discrepancy of conditions holds what runs straight over time, at whatever row between its knots",
          "[fast]") {
  const Discrepancy of_time(two_runs());
  const Discrepancy of_conditions(of_time, {0.0, 0.0, 0.0});
  Eigen::VectorXd straight = Eigen::VectorXd::Zero(to_index(two_runs().residual_count()));
  for (const Series& series : two_runs().series()) {
    const double start_s = two_runs().runs()[series.run].measured.time_s.front();
    for (std::size_t k = 0; k < series.size(); ++k) {
      straight[to_index(series.first_residual + k)] = series.floor * (series.time_s[k] - start_s) / 1000.0;
    }
  }
  diagnosis::whiten(two_runs(), straight);
  const double before = straight.norm();
  of_conditions.whiten({1e4, 1e4, 1e4}, straight);
  CHECK(straight.norm() < 1e-3 * before);
}
