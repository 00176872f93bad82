#include "estimation/road_load/reference_speeds.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;
using Catch::Contains;

namespace {

const std::map<int, double> kSpeeds_m_s{
    {20, 20 / 3.6}, {50, 50 / 3.6}, {80, 80 / 3.6}, {110, 110 / 3.6}, {130, 130 / 3.6}};
const PairRule kTorques{false, 1.0, "torques"};

/// Runs whose values are those of a parabola, each pair higher by its own share.
std::vector<ReferenceRun> make_reference_runs(const std::vector<double>& shares) {
  std::vector<ReferenceRun> runs;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    for (const int heading : {1, -1}) {
      ReferenceRun run{std::to_string(runs.size() + 1), "day", heading, {}};
      for (const auto& [km_h, v] : kSpeeds_m_s) {
        run.values[km_h] = (1.0 + shares[i]) * (100.0 + 2.0 * v + 0.4 * v * v) + heading * 15.0;
      }
      runs.push_back(run);
    }
  }
  return runs;
}

/// Takes speeds out of the runs with these names.
void take_out(const std::vector<int>& names, const std::vector<int>& speeds, std::vector<ReferenceRun>& runs) {
  for (const int name : names) {
    for (const int speed : speeds) runs[static_cast<std::size_t>(name - 1)].values.erase(speed);
  }
}

std::size_t count_warnings(const ReferenceResult& result, const std::string& text) {
  std::size_t count = 0;
  for (const std::string& warning : result.warnings) count += warning.find(text) != std::string::npos ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("statistical precision: the published table of its coefficient", "[fast]") {
  // 70/220/EEC Annex III as Racelogic prints it: t for n = 4 to 15 and, to two digits, t/sqrt(n). Its t for n = 10 is a
  // misprint (2.2): 0.73 sqrt(10) is 2.3.
  const std::vector<double> t{3.2, 2.8, 2.6, 2.5, 2.4, 2.3, 2.3, 2.2, 2.2, 2.2, 2.2, 2.2};
  const std::vector<double> t_over_root{1.6, 1.25, 1.06, 0.94, 0.85, 0.77, 0.73, 0.66, 0.64, 0.61, 0.59, 0.57};
  for (int n = 4; n <= 15; ++n) {
    INFO(n);
    const auto at = static_cast<std::size_t>(n - 4);
    CHECK(calc_precision_coefficient(n) == Approx(t[at]));
    CHECK(calc_precision_coefficient(n) / std::sqrt(n) == Approx(t_over_root[at]).margin(0.0051));
  }
  CHECK(calc_precision_coefficient(3) == Approx(4.3));
  CHECK(calc_precision_coefficient(1000) == Approx(2.0));
}

TEST_CASE("statistical precision of four times, by hand", "[fast]") {
  // mean 10.1, squares 0.01 + 0.01 + 0.09 + 0.09 = 0.2, s = sqrt(0.2/3), p = 3.2 s/(2 * 10.1)
  const ReferencePrecision precision = calc_precision({10.0, 10.2, 9.8, 10.4});
  CHECK(precision.mean == Approx(10.1));
  CHECK(precision.sd == Approx(0.258199).epsilon(1e-5));
  CHECK(precision.precision == Approx(0.040903).epsilon(1e-4));
  CHECK(precision.pairs == 4);
}

TEST_CASE("reference speeds: headings cancel, the mean of the pairs is found", "[fast]") {
  const ReferenceResult result =
      evaluate_reference_runs(make_reference_runs({0.01, -0.01, 0.0}), kSpeeds_m_s, kTorques, {});
  CHECK(result.speeds == std::vector<int>{130, 110, 80, 50, 20});
  CHECK(result.coefficients(0) == Approx(100.0));
  CHECK(result.coefficients(1) == Approx(2.0));
  CHECK(result.coefficients(2) == Approx(0.4));
  // shares of 0.01, -0.01, 0 have a standard deviation of 0.01; that of their mean is 0.01/sqrt(3)
  CHECK(std::sqrt(result.covariance(0, 0)) == Approx(100.0 * 0.01 / std::sqrt(3.0)));
  CHECK(result.freedom(0) == Approx(2.0));
}

TEST_CASE("reference speeds: the pair that is far off is rejected, and at most a third of all", "[fast]") {
  std::vector<double> shares{0.001, -0.002, 0.002, 0.0, -0.001, 0.2};
  const ReferenceResult result = evaluate_reference_runs(make_reference_runs(shares), kSpeeds_m_s, kTorques, {});
  CHECK_FALSE(result.pairs.back().rejected.empty());
  CHECK(std::abs(result.coefficients(2) / 0.4 - 1.0) < 0.002);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(), Contains("runs 11 and 12"));
  // three of six far off: two may go, and the precision then says that it is not met
  shares = {0.0, 0.0, 0.0, 0.5, -0.5, 0.9};
  const ReferenceResult bad = evaluate_reference_runs(make_reference_runs(shares), kSpeeds_m_s, kTorques, {});
  CHECK(bad.warnings.size() == 2);
  CHECK(bad.precisions.front().precision > 0.03);
  // three pairs: none may go
  const ReferenceResult three =
      evaluate_reference_runs(make_reference_runs({0.0, 0.0, 0.3}), kSpeeds_m_s, kTorques, {});
  CHECK(three.warnings.empty());
}

TEST_CASE("reference speeds: of a rejected pair, the run that was braked is named", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002, 0.0, -0.001, 0.0});
  for (auto& [km_h, value] : runs[7].values) value *= 1.3;  // run 8: the - run of the fourth pair
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(), Contains("runs 7 and 8") && Contains("; run 8 has 28 % more resistance"));
}

TEST_CASE("reference speeds: on a slope, a run that is braked uphill is named, though little force is left downhill",
          "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002, 0.0, -0.001, 0.0});
  RandomStream random(4, "scatter of runs");
  for (ReferenceRun& run : runs) {
    const double more = run.heading * 95.0 + 2.0 * random.normal();  // of 123 at 20 km/h
    for (auto& [km_h, value] : run.values) value += more;
  }
  for (auto& [km_h, value] : runs[6].values) value += 60.0;
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(!result.warnings.empty());
  CHECK_THAT(result.warnings.front(), Contains("runs 7 and 8 is rejected") && Contains("; run 7 has"));
}

TEST_CASE("reference speeds: of three pairs, all of which are needed, the braked run is named", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002});
  for (auto& [km_h, value] : runs[2].values) value *= 1.2;
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(),
             Contains("runs 3 and 4 is far off, but stays") && Contains("run 3 has 21 % more resistance"));
}

TEST_CASE("reference speeds: a session that is wholly rejected is no part of the intervals", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002, 0.0, -0.001, 0.0, 1.001, 1.0, 0.999});
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].session = i < 6 ? "a" : i < 12 ? "b" : "c";
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(count_warnings(result, "all 3 pairs of session 'c' are rejected") == 1);
  CHECK(count_warnings(result, "more from session to session") == 0);
  CHECK(std::sqrt(result.covariance(2, 2)) < 0.01 * result.coefficients(2));
}

TEST_CASE("reference speeds: of a rejected pair whose runs are alike, none is named", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002, 0.2, -0.001, 0.0});
  CHECK(count_warnings(evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {}), "; run") == 0);
  // a pair that is rejected for its wind has no run that is named for its resistance
  runs = make_reference_runs({0.001, -0.002, 0.002, 0.0, -0.001, 0.0});
  for (auto& [km_h, value] : runs[7].values) value *= 1.3;
  const ReferenceResult windy = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {"8"});
  CHECK(count_warnings(windy, "runs 7 and 8 is rejected: wind of run 8") == 1);
  CHECK(count_warnings(windy, "; run") == 0);
}

TEST_CASE("reference speeds: split runs are paired part by part", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0});
  std::vector<ReferenceRun> low = make_reference_runs({0.02, 0.02, 0.02, 0.02});
  for (ReferenceRun& run : runs) {
    run.values.erase(20);
    run.values.erase(50);
  }
  for (ReferenceRun& run : low) {
    run.name = "low " + run.name;
    run.values.erase(130);
    run.values.erase(110);
  }
  runs.insert(runs.end(), low.begin(), low.end());
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(result.pairs.size() == 7);
  CHECK(result.overlaps == std::vector<int>{80});
  const double v = 80 / 3.6;
  const double force = 100.0 + 2.0 * v + 0.4 * v * v;
  CHECK(result.overlap_differences.front() == Approx(0.02 * force));
  CHECK(result.precisions[2].pairs == 7);
  CHECK(result.resistances[2] == Approx((3.0 + 4.0 * 1.02) / 7.0 * force));
  CHECK(result.resistances[4] == Approx(1.02 * (100.0 + 2.0 * 20 / 3.6 + 0.4 * 20 * 20 / 12.96)));
}

TEST_CASE("reference speeds: one heading, too few pairs, too few speeds", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0});
  for (ReferenceRun& run : runs) run.heading = 1;
  CHECK_THROWS_WITH(evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {}), Contains("same heading"));
  for (ReferenceRun& run : runs) run.heading = 0;
  CHECK_THROWS_WITH(evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {}), Contains("not known"));
  CHECK_THROWS_WITH(evaluate_reference_runs(make_reference_runs({0.0, 0.0}), kSpeeds_m_s, kTorques, {}),
                    Contains("fewer than 3 pairs of opposite headings: 2"));
  runs = make_reference_runs({0.0, 0.0, 0.0});
  for (ReferenceRun& run : runs) run.values = {{20, 100.0}, {50, 200.0}, {80, 300.0}};
  CHECK_THROWS_WITH(evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {}), Contains("3 reference speeds only"));
  // the wind of one run of three pairs leaves two
  CHECK_THROWS_WITH(evaluate_reference_runs(make_reference_runs({0.0, 0.0, 0.0}), kSpeeds_m_s, kTorques, {"3"}),
                    Contains("fewer than 3 pairs of opposite headings: 2") && Contains("wind: 3"));
}

TEST_CASE("reference speeds: runs whose ends scatter are all used", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.01, -0.01, 0.003, 0.004, -0.004});
  take_out({2, 3}, {130}, runs);  // odd runs have the heading +
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(result.warnings.empty());
  CHECK(result.speeds.size() == 5);
  CHECK(result.list_used_runs().size() == 10);
  REQUIRE(result.pairs.size() == 5);
  for (const ReferencePair& pair : result.pairs) CHECK(pair.part == 0);
  CHECK(result.overlaps.empty());
  CHECK(result.precisions.front().pairs == 3);  // 130 km/h: runs 5 to 10
  for (std::size_t i = 1; i < 5; ++i) CHECK(result.precisions[i].pairs == 5);
  const double v = 130 / 3.6;
  CHECK(result.resistances.front() == Approx(1.001 * (100.0 + 2.0 * v + 0.4 * v * v)));
  // three of five pairs at one speed tell less than five, and more than three at all
  CHECK(result.freedom(2) > 2.0);
  CHECK(result.freedom(2) < 4.0);
}

TEST_CASE("reference speeds: runs are paired with their neighbors, in any order of the file", "[fast]") {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  const auto name_pairs = [](const std::vector<ReferenceRun>& runs) {
    Pairs names;
    for (const ReferencePair& pair : pair_runs(runs).pairs) {
      names.emplace_back(runs[pair.plus].name, runs[pair.minus].name);
    }
    std::sort(names.begin(), names.end());
    return names;
  };
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].position = static_cast<double>(i);
  const Pairs neighbors{{"1", "2"}, {"3", "4"}, {"5", "6"}, {"7", "8"}};
  std::vector<ReferenceRun> shuffled{runs[7], runs[0], runs[5], runs[2], runs[3], runs[4], runs[1], runs[6]};
  CHECK(name_pairs(shuffled) == neighbors);
  take_out({2}, {130}, runs);  // one that begins late
  CHECK(name_pairs(runs) == neighbors);
  runs.erase(runs.begin() + 3);  // run 4 is missing
  CHECK(name_pairs(runs) == Pairs{{"1", "2"}, {"5", "6"}, {"7", "8"}});
  CHECK(pair_runs(runs).alone == std::vector<std::size_t>{2});
  // one heading after the other: the n-th with the n-th
  for (ReferenceRun& run : shuffled) run.position += run.heading > 0 ? 0.0 : 100.0;
  CHECK(name_pairs(shuffled) == neighbors);
}

TEST_CASE("reference speeds: sessions that differ widen the covariance, those that do not leave it", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.001, 0.0, 0.052, 0.048, 0.05});
  for (std::size_t i = 6; i < runs.size(); ++i) runs[i].session = "pm";
  const ReferenceResult apart = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(apart.has_session_scatter);
  CHECK(count_warnings(apart, "with 1 degree of freedom, so that they are wide") == 1);
  CHECK(apart.freedom(0) == Approx(1.0));
  // of means of two sessions, 5 % apart: a standard deviation of 2.5 % at least
  CHECK(std::sqrt(apart.covariance(0, 0)) > 0.02 * apart.coefficients(0));
  runs = make_reference_runs({0.001, -0.001, 0.0, 0.002, -0.002, 0.0005});
  for (std::size_t i = 6; i < runs.size(); ++i) runs[i].session = "pm";
  const ReferenceResult alike = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK_FALSE(alike.has_session_scatter);
  CHECK(alike.freedom(0) == Approx(5.0));
}

TEST_CASE("reference speeds: a pair that begins late is used at the speeds that it has", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.01, -0.01, 0.0, 0.02});
  take_out({7, 8}, {110, 130}, runs);
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(result.warnings.empty());
  CHECK(result.overlaps.empty());
  CHECK(result.precisions[1].pairs == 3);
  CHECK(result.precisions[2].pairs == 4);
  const double v = 80 / 3.6;
  CHECK(result.resistances[2] == Approx(1.005 * (100.0 + 2.0 * v + 0.4 * v * v)));
}

TEST_CASE("reference speeds: an end that fewer than three pairs have is left out, with a word", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0, 0.0, 0.0});
  take_out({1, 3, 4, 5}, {130}, runs);
  ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(result.speeds == std::vector<int>{110, 80, 50, 20});
  CHECK(result.list_used_runs().size() == 10);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(),
             Contains("130 km/h (2 pairs, of 2 runs with + and 4 with -)") && Contains("--speed-to 120 leaves"));
  CHECK(result.coefficients(0) == Approx(100.0));

  runs = make_reference_runs({0.0, 0.0, 0.0, 0.0, 0.0});
  take_out({2, 4, 6, 8}, {20}, runs);
  result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(), Contains("20 km/h (1 pair, of") && Contains("--speed-from 35"));

  // two ends, and speeds of the same pairs in one
  runs = make_reference_runs({0.0, 0.0, 0.0});
  for (int km_h = 140; km_h < 180; km_h += 10) runs[4].values[km_h] = runs[5].values[km_h] = 1000.0;
  runs[4].values[10] = 50.0;
  result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(count_warnings(result, "140 to 170 km/h (1 pair, of 1 run with + and 1 with -). More") == 1);
  CHECK(count_warnings(result, "10 km/h (0 pairs, of 1 run with + and 0 with -)") == 1);
  CHECK(count_warnings(result, "--speed-from 15 ") == 1);

  // the wind takes the third pair at 130 km/h away
  runs = make_reference_runs({0.0, 0.0, 0.0, 0.0});
  take_out({1}, {130}, runs);
  result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {"3"});
  CHECK(count_warnings(result, "130 km/h (2 pairs and 1 rejected, of 3 runs with + and 4 with -)") == 1);
}

TEST_CASE("reference speeds: a speed in between that fewer than three pairs have is an error", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0, 0.0});
  take_out({1, 3}, {80}, runs);
  CHECK_THROWS_WITH(evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {}),
                    Contains("fewer than 3 pairs have torques at 80 km/h, and there are enough above and below: 2 "
                             "pairs, of 2 runs with + and 4 with -"));
}

TEST_CASE("reference speeds: parts of split runs whose ends scatter stay parts", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs(std::vector<double>(8, 0.0));
  take_out({1, 2, 3, 4, 5, 6, 7, 8}, {20, 50}, runs);
  take_out({9, 10, 11, 12, 13, 14, 15, 16}, {110, 130}, runs);
  take_out({3}, {130}, runs);
  take_out({11}, {80}, runs);
  for (std::size_t i = 0; i < 8; i += 2) std::swap(runs[i], runs[i + 8]);  // the order of the parts is nothing
  const ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(result.warnings.empty());
  REQUIRE(result.pairs.size() == 8);
  for (std::size_t i = 0; i < 8; ++i) CHECK(result.pairs[i].part == (i < 4 ? 0 : 1));
  CHECK(result.list_used_runs().size() == 16);
  CHECK(result.overlaps == std::vector<int>{80});
  CHECK(result.precisions[0].pairs == 3);
  CHECK(result.precisions[2].pairs == 7);
}

TEST_CASE("reference speeds: runs without a partner, and speeds that a partner lacks, are said", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.0, 0.0, 0.0, 0.0});
  runs.pop_back();
  ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(), Contains("no run of the opposite heading") && Contains("7 (20 to 130 km/h)"));

  runs = make_reference_runs({0.0, 0.0, 0.0, 0.0});
  take_out({8}, {80, 110, 130}, runs);
  result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings.front(),
             Contains("run 7 is not used at 130, 110, 80 km/h, which run 8, its partner, does not have"));
  CHECK(result.precisions.back().pairs == 4);
}

TEST_CASE("reference speeds: where all pairs of one session are rejected, the session is named", "[fast]") {
  std::vector<ReferenceRun> runs = make_reference_runs({0.001, -0.002, 0.002, 0.0, -0.001, 0.001, 0.1, 0.102, 0.098});
  for (std::size_t i = 6; i < runs.size(); ++i) runs[i].session = i < 12 ? "noon" : "evening";
  ReferenceResult result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(count_warnings(result, "is rejected") == 3);
  CHECK(count_warnings(result, "all 3 pairs of session 'evening' are rejected") == 1);
  // pairs of several sessions, and the session of all pairs, are not named
  runs[12].session = runs[13].session = "noon";
  runs[0].session = runs[1].session = "evening";
  result = evaluate_reference_runs(runs, kSpeeds_m_s, kTorques, {});
  CHECK(count_warnings(result, "is rejected") == 3);
  CHECK(count_warnings(result, "of session") == 0);
}
