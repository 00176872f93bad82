// The line of an alignment and what a value on it is worth: a published data set, closed forms, simulated laboratories.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "estimation/alignment/alignment.h"
#include "estimation/alignment/alignment_doubts.h"
#include "estimation/alignment/alignment_rules.h"
#include "estimation/alignment/line_fit.h"
#include "sim/core/error.h"
#include "sim/core/random.h"

using namespace rollrig;
using namespace rollrig::estimation;

namespace {

/// NIST StRD "Norris": calibration of ozone monitors, {y, x}
/// (https://www.itl.nist.gov/div898/strd/lls/data/Norris.shtml).
const std::vector<std::pair<double, double>> kNorris{
    {0.1, 0.2},     {338.8, 337.4}, {118.1, 118.2}, {888.0, 884.6}, {9.2, 10.1},    {228.1, 226.5},
    {668.5, 666.3}, {998.5, 996.3}, {449.1, 448.6}, {778.9, 777.0}, {559.2, 558.2}, {0.3, 0.4},
    {0.1, 0.6},     {778.1, 775.5}, {668.8, 666.9}, {339.3, 338.0}, {448.9, 447.5}, {10.8, 11.6},
    {557.7, 556.0}, {228.3, 228.1}, {998.0, 995.8}, {888.8, 887.6}, {119.6, 120.2}, {0.3, 0.3},
    {0.6, 0.3},     {557.6, 556.8}, {339.3, 339.1}, {888.0, 887.2}, {998.5, 999.0}, {778.9, 779.0},
    {10.2, 11.1},   {117.6, 118.3}, {228.9, 229.2}, {668.4, 669.1}, {449.2, 448.9}, {0.2, 0.5}};

const std::vector<double> kTrue{6.5, 7.5, 8.6, 9.4, 10.7};  // of five tires on the candidate machine
constexpr double kA2 = 0.93, kB2 = 0.35;

/// A simulated alignment: three used measurements of each tire on both machines.
struct Laboratories {
  LineFit fit;
  AlignmentLine line;
};
Laboratories simulate(RandomStream& random, double sigma_m, double sigma_l, double between_sd = 0.0) {
  std::vector<std::vector<double>> candidate, reference;
  std::vector<double> x, y;
  for (const double truth : kTrue) {
    const double of_reference = kA2 * truth + kB2 + between_sd * random.normal();
    candidate.push_back({});
    reference.push_back({});
    for (int i = 0; i < 3; ++i) {
      candidate.back().push_back(truth + sigma_m * random.normal());
      reference.back().push_back(of_reference + sigma_l * random.normal());
    }
    x.push_back((candidate.back()[0] + candidate.back()[1] + candidate.back()[2]) / 3.0);
    y.push_back((reference.back()[0] + reference.back()[1] + reference.back()[2]) / 3.0);
  }
  const ScatterEstimate of_candidate = pool_repeats(candidate), of_reference = pool_repeats(reference);
  Laboratories made;
  made.fit = fit_line(x, y,
                      {of_candidate.sd / std::sqrt(3.0), of_reference.sd / std::sqrt(3.0),
                       of_candidate.degrees_of_freedom + of_reference.degrees_of_freedom});
  made.line = make_alignment_line(made.fit, of_candidate, of_reference.degrees_of_freedom);
  return made;
}

/// Five tires, four rounds, each in a week of its own; two decimals by default.
AlignmentFile make_measured_file(RandomStream& random, double step_N_per_kN = 0.01, double sigma_m = 0.04) {
  AlignmentFile file;
  file.rules = kRulesC1C2;
  for (std::size_t i = 0; i < kTrue.size(); ++i) {
    AlignmentTire tire;
    tire.name = "T" + std::to_string(i + 1);
    tire.tire_class = "C1";
    for (int round = 0; round < 4; ++round) {
      const double rrc = kTrue[i] + sigma_m * random.normal();
      const double day_s = 86400.0 * (20000.0 + 7.0 * round + static_cast<double>(i));
      tire.candidate.all.push_back({day_s, step_N_per_kN * std::round(rrc / step_N_per_kN), round > 0});
    }
    file.tires.push_back(tire);
  }
  return file;
}

/// The same tires on two machines that measure alike, the second one later.
AlignmentFile make_pair_file(RandomStream& random, double step_N_per_kN = 0.01, double sigma_m = 0.04) {
  AlignmentFile file = make_measured_file(random, step_N_per_kN, sigma_m);
  const AlignmentFile other = make_measured_file(random, step_N_per_kN, sigma_m);
  file.machine = "drum_B";
  file.reference_machine = "drum_A";
  file.first_s = 86400.0 * 20000.0;
  file.last_s = 86400.0 * 20025.0;
  for (std::size_t i = 0; i < file.tires.size(); ++i) {
    AlignmentTire& tire = file.tires[i];
    tire.reference = other.tires[i].candidate;
    for (AlignmentMeasurement& one : tire.reference.all) one.time_s += 86400.0 * 35.0;
    tire.reference_N_per_kN = tire.reference.mean();
    file.complete_s = std::max(file.complete_s, tire.reference.all.back().time_s);
  }
  file.newest_s = file.last_s;
  return file;
}

AlignmentResult align_file(const AlignmentFile& file) {
  AlignmentInput input;
  input.preliminary = true;
  return align_machine(file, input);
}

const std::vector<std::string> kNames{"T1", "T2", "T3", "T4", "T5"};

void add_to_tire(AlignmentFile& file, std::size_t place, TireMeasurements AlignmentTire::*side, double add_N_per_kN) {
  AlignmentTire& tire = file.tires[place];
  for (AlignmentMeasurement& one : (tire.*side).all) one.rrc_N_per_kN += add_N_per_kN;
  tire.reference_N_per_kN = tire.reference.mean();
}

void exchange_tires(AlignmentFile& file, std::size_t first, std::size_t second, TireMeasurements AlignmentTire::*side) {
  std::swap(file.tires[first].*side, file.tires[second].*side);
  for (const std::size_t place : {first, second}) {
    file.tires[place].reference_N_per_kN = file.tires[place].reference.mean();
  }
}

void sort_tires(AlignmentFile& file) {
  std::sort(file.tires.begin(), file.tires.end(),
            [](const AlignmentTire& a, const AlignmentTire& b) { return a.candidate.mean() < b.candidate.mean(); });
}

/// Empty where the alignment is computed.
std::string find_refusal(const AlignmentFile& file) {
  try {
    align_machine(file, AlignmentInput{});
  } catch (const InputError& error) {
    return error.problem().what;
  }
  return "";
}

bool is_in(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&words](const std::string& one) { return one.find(words) != std::string::npos; });
}

/// Whether the rule of this name is met. Requires that there is one.
bool is_rule_met(const AlignmentResult& result, const std::string& name) {
  const auto check = std::find_if(result.checks.begin(), result.checks.end(),
                                  [&name](const AlignmentCheck& one) { return one.name == name; });
  REQUIRE(check != result.checks.end());
  CHECK(check->is_rule);
  return check->is_met;
}

}  // namespace

TEST_CASE("the line of a published calibration has the certified numbers", "[published]") {
  std::vector<double> x, y;
  for (const auto& [at_y, at_x] : kNorris) {
    x.push_back(at_x);
    y.push_back(at_y);
  }
  const LineFit fit = fit_line(x, y, {});
  CHECK(fit.slope == Approx(1.00211681802045).epsilon(1e-12));
  CHECK(fit.offset == Approx(-0.262323073774029).epsilon(1e-10));
  CHECK(fit.slope_sd() == Approx(0.429796848199937e-03).epsilon(1e-9));
  CHECK(fit.offset_sd() == Approx(0.232818234301152).epsilon(1e-9));
  CHECK(fit.residual_sd == Approx(0.884796396144373).epsilon(1e-10));
}

TEST_CASE("leverages of a line add up to two, and its ends have the largest", "[fast]") {
  RandomStream random(3, "leverage");
  const LineFit fit = simulate(random, 0.05, 0.05).fit;
  double sum = 0.0, residuals = 0.0;
  for (const LinePoint& point : fit.points) {
    sum += point.leverage;
    residuals += point.residual;
  }
  CHECK(sum == Approx(2.0));
  CHECK(std::abs(residuals) < 1e-12);
  CHECK(fit.points.back().leverage > fit.points[2].leverage);
}

TEST_CASE("the repeats of groups are pooled by their degrees of freedom", "[fast]") {
  // Two groups of unequal size: (2 + 0.5)/(2 + 1), by hand.
  const ScatterEstimate pooled = pool_repeats({{7.0, 8.0, 9.0}, {5.0, 6.0}, {4.0}});
  CHECK(pooled.degrees_of_freedom == 3.0);
  CHECK(pooled.sd == Approx(std::sqrt(2.5 / 3.0)));
  // Chi-square of 3 degrees of freedom at 2.5 % and 97.5 %: 0.2158, 9.348 (any table).
  CHECK(pooled.low_95 == Approx(pooled.sd * std::sqrt(3.0 / 9.348)).epsilon(1e-3));
  CHECK(pooled.high_95 == Approx(pooled.sd * std::sqrt(3.0 / 0.2158)).epsilon(1e-3));
  CHECK_THROWS_AS(pool_repeats({{7.0}, {8.0}}), std::invalid_argument);
}

TEST_CASE("a machine of larger scatter measures more often, as Section 5 has it", "[fast]") {
  CHECK(calc_measurements(kRulesC1C2, 0.02) == 4);
  CHECK(calc_measurements(kRulesC1C2, 0.075) == 4);
  CHECK(calc_measurements(kRulesC1C2, 0.0751) == 5);  // 1 + 3.05
  CHECK(calc_measurements(kRulesC1C2, 0.100) == 7);   // 1 + 5.41
  CHECK(calc_measurements(kRulesC3, 0.0601) == 4);    // 1 + 2.95
  CHECK(calc_measurements(kRulesC3, 0.080) == 7);     // 1 + 5.22
}

TEST_CASE("errors of the measured values make the slope too small by the attenuation", "[fast]") {
  RandomStream random(11, "attenuation");
  const double sigma_m = 0.6;  // far beyond a machine's, so that the bias is seen
  double slope = 0.0, attenuation = 0.0;
  constexpr int kTimes = 8000;
  for (int i = 0; i < kTimes; ++i) {
    const LineFit fit = simulate(random, sigma_m, 0.0).fit;
    slope += fit.slope / kTimes;
    attenuation += fit.attenuation / kTimes;
  }
  const double bias = slope / kA2 - 1.0;
  CHECK(bias < -0.015);
  CHECK(-bias == Approx(attenuation).margin(0.004));  // three standard deviations of the mean
}

TEST_CASE("the interval of an aligned value holds the reference's value as often as it says", "[fast]") {
  struct Case {
    double sigma_m, sigma_l, between_sd, least;
  };
  // More than 0.95 where the larger of two standard deviations is taken; less where the tires scatter by themselves,
  // and five of them happen to hide it.
  for (const Case& each : {Case{0.05, 0.04, 0.0, 0.94}, Case{0.02, 0.06, 0.0, 0.94}, Case{0.04, 0.03, 0.08, 0.905}}) {
    RandomStream random(29, "coverage");
    int covered = 0;
    constexpr int kTimes = 4000;
    double of_slope = 0.0;
    for (int i = 0; i < kTimes; ++i) {
      const Laboratories made = simulate(random, each.sigma_m, each.sigma_l, each.between_sd);
      const double truth = 6.5 + 4.2 * random.uniform();
      const double of_reference = kA2 * truth + kB2 + each.between_sd * random.normal();
      const UncertainValue aligned = align_value(made.line, truth + each.sigma_m * random.normal(), 1);
      covered += std::abs(aligned.value - of_reference) <= aligned.coverage_factor * aligned.sd ? 1 : 0;
      of_slope += std::abs(made.fit.slope - kA2) <= made.fit.coverage_factor() * made.fit.slope_sd() ? 1.0 : 0.0;
    }
    INFO(each.sigma_m << " " << each.sigma_l << " " << each.between_sd);
    CHECK(covered / double(kTimes) > each.least);
    CHECK(covered / double(kTimes) < 0.99);
    CHECK(of_slope / kTimes > 0.93);
  }
}

TEST_CASE("an aligned value is best in the middle, and repeats take away their part only", "[fast]") {
  RandomStream random(5, "value");
  Laboratories made = simulate(random, 0.05, 0.04);
  const double middle = made.line.mean_x;
  CHECK(align_value(made.line, middle, 1).sd < align_value(made.line, middle + 2.0, 1).sd);
  CHECK(align_value(made.line, middle - 2.0, 1).sd == Approx(align_value(made.line, middle + 2.0, 1).sd));
  const UncertainValue many = align_value(made.line, middle, 1000000);
  const double rest = std::hypot(made.line.line_sd / std::sqrt(5.0), made.line.between_sd);
  CHECK(many.sd == Approx(rest).epsilon(1e-3));
  const UncertainValue plain = align_value(made.line, 8.0, 2);
  made.line.A1 = 2.0;
  made.line.B1 = -1.0;
  const UncertainValue scaled = align_value(made.line, 8.0, 2);
  CHECK(scaled.value == Approx(2.0 * plain.value - 1.0));
  CHECK(scaled.sd == Approx(2.0 * plain.sd));
  CHECK(scaled.coverage_factor == Approx(plain.coverage_factor));
}

TEST_CASE("a tire that is off the line is seen, and the scatter that repeats cannot explain", "[fast]") {
  std::vector<double> x = kTrue, y;
  x.push_back(8.0);
  RandomStream random(8, "odd tire");
  for (const double value : x) y.push_back(kA2 * value + kB2 + 0.01 * random.normal());
  const RepeatScatter repeats{0.01, 0.01, 24.0};
  CHECK(fit_line(x, y, repeats).lack_of_fit_p > 0.01);
  y[2] += 0.3;
  const LineFit fit = fit_line(x, y, repeats);
  CHECK(fit.lack_of_fit_p < 1e-4);
  CHECK(fit.points[2].p_value < 0.05);
  CHECK(fit.points[2].studentized > 0.0);
  for (const std::size_t i : {0u, 1u, 3u, 4u, 5u}) CHECK(fit.points[i].p_value > fit.points[2].p_value);
  CHECK(fit.between_sd > 0.05);
}

TEST_CASE("a line needs three points of different x", "[fast]") {
  CHECK_THROWS_AS(fit_line({1.0, 2.0}, {1.0, 2.0}, {}), std::invalid_argument);
  CHECK_THROWS_AS(fit_line({1.0, 1.0, 1.0}, {1.0, 2.0, 3.0}, {}), std::invalid_argument);
  const LineFit exact = fit_line({1.0, 2.0, 4.0}, {3.0, 5.0, 9.0}, {});
  CHECK(exact.slope == Approx(2.0));
  CHECK(exact.offset == Approx(1.0));
  CHECK(exact.residual_sd < 1e-12);
}

TEST_CASE("an alignment is valid for two years to the day", "[fast]") {
  const double leap_day_s = read_day_s("2024-02-29", "--on");
  CHECK(format_day(leap_day_s) == "2024-02-29");
  CHECK(format_day(add_years(leap_day_s, 2)) == "2026-02-28");
  CHECK(format_day(add_years(read_day_s("2026-03-02", "--on"), 2)) == "2028-03-02");
  for (const char* wrong : {"02.03.2026", "2026-13-01", "2026-02-30", "tomorrow", "", "1066-10-14"}) {
    INFO(wrong);
    CHECK_THROWS_AS(read_day_s(wrong, "--on"), InputError);
  }
}

TEST_CASE("a round that has the values of an earlier one is doubted, whichever it is", "[fast]") {
  RandomStream random(17, "copied round");
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>(0, 1), {0, 3}, {1, 3}, {2, 3}}) {
    AlignmentFile file = make_measured_file(random, 0.001);
    CHECK(list_value_doubts(file).empty());
    for (AlignmentTire& tire : file.tires) tire.candidate.all[to].rrc_N_per_kN = tire.candidate.all[from].rrc_N_per_kN;
    const std::vector<std::string> doubts = list_value_doubts(file);
    INFO(from << " " << to);
    REQUIRE(doubts.size() == 1);
    CHECK(is_in(doubts, "5 tires have the same values on"));
    CHECK(is_in(doubts, format_day(86400.0 * (20000.0 + 7.0 * static_cast<double>(from))) + " to "));
    file.tires[2].candidate.all[to].rrc_N_per_kN += 0.01;
    CHECK(list_value_doubts(file).empty());
  }
}

TEST_CASE("a day that is copied is doubted although one tire has a measurement more", "[fast]") {
  RandomStream random(18, "copied day");
  AlignmentFile file = make_measured_file(random, 0.001);
  for (AlignmentTire& tire : file.tires) {
    for (std::size_t round = 0; round < 4; ++round) {
      tire.candidate.all[round].time_s = 86400.0 * (20000.0 + 7.0 * static_cast<double>(round));
    }
    tire.candidate.all[3].rrc_N_per_kN = tire.candidate.all[1].rrc_N_per_kN;
  }
  std::vector<AlignmentMeasurement>& more = file.tires[0].candidate.all;
  more.insert(more.begin() + 2, {86400.0 * 20010.0, 6.71, true});
  CHECK(is_in(list_value_doubts(file), "5 tires have the same values on 2024-10-11 and on 2024-10-25"));
}

TEST_CASE("coarse values are equal by chance, and few of the sets that nobody copied are doubted", "[fast]") {
  RandomStream random(19, "coarse");
  for (const double step_N_per_kN : {0.001, 0.01, 0.02, 0.05, 0.1}) {
    int doubted = 0;
    constexpr int kTimes = 1000;
    for (int i = 0; i < kTimes; ++i) {
      AlignmentFile file = make_measured_file(random, step_N_per_kN);
      const AlignmentFile other = make_measured_file(random, step_N_per_kN);
      file.machine = "drum_B";
      file.reference_machine = "drum_A";
      for (std::size_t k = 0; k < file.tires.size(); ++k) file.tires[k].reference = other.tires[k].candidate;
      doubted += is_in(list_value_doubts(file), "copied") ? 1 : 0;
    }
    INFO(step_N_per_kN);
    CHECK(doubted < kTimes / 25);
  }
}

TEST_CASE("values of the reference machine under the candidate's name are doubted, also if one is changed", "[fast]") {
  RandomStream random(20, "copied machine");
  AlignmentFile file = make_measured_file(random, 0.001);
  file.machine = "drum_B";
  file.reference_machine = "drum_A";
  for (AlignmentTire& tire : file.tires) tire.reference = tire.candidate;
  CHECK(is_in(list_value_doubts(file), "15 of the 15 used values of machine 'drum_B' are equal"));
  file.tires[3].candidate.all[2].rrc_N_per_kN += 0.37;
  CHECK(is_in(list_value_doubts(file), "14 of the 15"));
  for (AlignmentTire& tire : file.tires) {
    for (AlignmentMeasurement& one : tire.candidate.all) one.rrc_N_per_kN *= 1.02;
  }
  CHECK_FALSE(is_in(list_value_doubts(file), "are equal"));
}

TEST_CASE("a probability is not shown on the other side of its level", "[fast]") {
  CHECK(format_p_value(0.048, 0.05) == "0.048");
  CHECK(format_p_value(0.0498, 0.05) == "0.0498");
  CHECK(format_p_value(0.05, 0.05) == "0.050");
  CHECK(format_p_value(0.4951, 0.05) == "0.50");
  CHECK(format_p_value(3.21e-7, 0.05) == "3.2e-07");
  CHECK(format_p_value(0.04999999, 0.05) == "0.04999999");
}

TEST_CASE("sets without a mistake are not doubted, fine or coarse", "[fast]") {
  struct Case {
    double step_N_per_kN, sigma_m;
  };
  for (const Case& each : {Case{0.001, 0.03},
                           {0.01, 0.03},
                           {0.01, 0.015},
                           {0.05, 0.02},
                           {0.05, 0.04},
                           {0.1, 0.03},
                           {0.1, 0.015},
                           {0.1, 0.04}}) {
    RandomStream random(31, "innocent");
    int doubted = 0, residual = 0, outliers = 0;
    constexpr int kTimes = 400;
    for (int i = 0; i < kTimes; ++i) {
      const AlignmentResult result = align_file(make_pair_file(random, each.step_N_per_kN, each.sigma_m));
      for (const char* words : {"copied", "computed", "of its own", "times right", "days lie", "sigma_m of the"}) {
        doubted += is_in(result.warnings, words) ? 1 : 0;
      }
      residual += is_in(result.warnings, "largest residual") || result.mistake.outlier.has_value() ? 1 : 0;
      outliers += result.mistake.outlier.has_value() ? 1 : 0;
      CHECK_FALSE(is_in(result.warnings, "change RRc by"));
    }
    INFO(each.step_N_per_kN << " " << each.sigma_m << ": " << doubted << " doubted, residual " << residual << ", "
                            << outliers << " outliers");
    CHECK(doubted <= kTimes / 25);    // 2.5 % of them by the interval of the reference's sigma_m
    CHECK(outliers <= kTimes / 100);  // level 0.005
    CHECK(residual <= kTimes / 20);   // level 0.05
  }
}

TEST_CASE("one tire that does not fit is named, where its error also breaks the rule of the range", "[fast]") {
  for (std::size_t place = 0; place < kTrue.size(); ++place) {
    for (const double factor : {1.3, 0.9}) {
      RandomStream random(41, "one bad tire");
      AlignmentFile file = make_pair_file(random);
      for (AlignmentMeasurement& one : file.tires[place].candidate.all) one.rrc_N_per_kN *= factor;
      const std::string name = "tire '" + file.tires[place].name + "' does not fit the line of the other tires";
      sort_tires(file);
      INFO(place << " " << factor);
      const AlignmentResult result = align_file(file);
      CHECK(is_in(result.warnings, name));
      CHECK_FALSE(is_in(result.warnings, "largest residual"));
    }
  }
  RandomStream random(42, "one bad tire");
  AlignmentFile file = make_pair_file(random);
  for (AlignmentMeasurement& one : file.tires[2].candidate.all) one.rrc_N_per_kN *= 1.5;
  sort_tires(file);
  AlignmentInput input;
  try {
    align_machine(file, input);
    FAIL("the range is too small");
  } catch (const InputError& error) {
    CHECK_THAT(error.problem().what, Catch::Contains("range of RRc, before and after. Tire 'T3' does not fit"));
  }
}

TEST_CASE("of two tires that do not fit, and of three tires, none is named", "[fast]") {
  RandomStream random(43, "two bad tires");
  AlignmentFile file = make_pair_file(random);
  for (const std::size_t place : {std::size_t{1}, std::size_t{3}}) {
    for (AlignmentMeasurement& one : file.tires[place].reference.all) one.rrc_N_per_kN += 0.5;
    file.tires[place].reference_N_per_kN += 0.5;
  }
  CHECK_FALSE(align_file(file).mistake.outlier.has_value());
  CHECK_FALSE(find_line_outlier(fit_line({6.0, 7.0, 8.0}, {6.0, 9.0, 8.0}, {}), 0.1).has_value());
}

TEST_CASE("a bad tire is named by the repeats, where three or four others scatter too few to tell", "[fast]") {
  struct Case {
    std::size_t place;
    double error_N_per_kN;
  };
  for (const Case& each : {Case{1, 0.4}, Case{2, 0.4}, Case{2, -0.4}, Case{3, 0.4}, Case{0, 0.7}, Case{4, -0.7}}) {
    for (const auto side : {&AlignmentTire::candidate, &AlignmentTire::reference}) {
      RandomStream random(45, "bad tire by repeats");
      int named = 0, by_residual = 0;
      constexpr int kTimes = 40;
      for (int i = 0; i < kTimes; ++i) {
        AlignmentFile file = make_pair_file(random);
        const std::string name = file.tires[each.place].name;
        add_to_tire(file, each.place, side, each.error_N_per_kN);
        sort_tires(file);
        const AlignmentResult result = align_file(file);
        named += is_in(result.warnings, "tire '" + name + "' does not fit the line of the other tires") ? 1 : 0;
        by_residual += find_line_outlier(result.fit, 0.27).has_value() ? 1 : 0;
        CHECK_FALSE(is_in(result.warnings, "look exchanged"));
      }
      INFO(each.place << " " << each.error_N_per_kN << ": " << named << ", by its residual " << by_residual);
      CHECK(named >= kTimes * 8 / 10);
      CHECK(by_residual < named);
    }
  }
}

TEST_CASE("two exchanged tires are named, on either machine, and where the line falls by them", "[fast]") {
  const std::vector<std::pair<std::size_t, std::size_t>> pairs{{1, 2}, {0, 2}, {0, 1}, {1, 3}, {3, 4}, {0, 3}};
  for (const auto& [first, second] : pairs) {
    for (const auto side : {&AlignmentTire::candidate, &AlignmentTire::reference}) {
      RandomStream random(46, "exchanged tires");
      int named = 0;
      constexpr int kTimes = 40;
      const std::string names =
          "'" + kNames[first] + "' and '" + kNames[second] + "' look exchanged on one of the machines";
      const std::string other_order =
          "'" + kNames[second] + "' and '" + kNames[first] + "' look exchanged on one of the machines";
      for (int i = 0; i < kTimes; ++i) {
        AlignmentFile file = make_pair_file(random);
        exchange_tires(file, first, second, side);
        sort_tires(file);
        const AlignmentResult result = align_file(file);
        named += is_in(result.warnings, names) || is_in(result.warnings, other_order) ? 1 : 0;
        CHECK_FALSE(is_in(result.warnings, "does not fit the line"));
      }
      INFO(first << " " << second << ": " << named);
      CHECK(named >= kTimes * 8 / 10);
    }
  }
  RandomStream random(47, "exchanged ends");
  AlignmentFile file = make_pair_file(random);
  exchange_tires(file, 0, 4, &AlignmentTire::reference);
  CHECK_THAT(find_refusal(file), Catch::Contains("the other way round") &&
                                     Catch::Contains(". Tires 'T1' and 'T5' look exchanged on one of the machines"));
}

TEST_CASE("a mistake that also breaks the rule of the range is named in the error", "[fast]") {
  for (const auto side : {&AlignmentTire::candidate, &AlignmentTire::reference}) {
    for (const auto& [place, error] : {std::pair{std::size_t{4}, -1.9}, std::pair{std::size_t{0}, 1.8}}) {
      RandomStream random(48, "bad range");
      AlignmentFile file = make_pair_file(random);
      const std::string name = file.tires[place].name;
      for (const auto both : {&AlignmentTire::candidate, &AlignmentTire::reference}) add_to_tire(file, 4, both, -0.3);
      add_to_tire(file, place, side, error);
      sort_tires(file);
      INFO(name);
      CHECK_THAT(find_refusal(file),
                 Catch::Contains("range of RRc, before and after. Tire '" + name + "' does not fit"));
    }
    RandomStream random(49, "bad range");
    AlignmentFile file = make_pair_file(random);
    exchange_tires(file, 0, 2, side);
    sort_tires(file);
    CHECK_THAT(find_refusal(file), Catch::Contains("range of RRc, before and after. Tires 'T") &&
                                       Catch::Contains("look exchanged on one of the machines"));
  }
}

TEST_CASE("real scatter of tires about the line is no mistake, and of three tires none is named", "[fast]") {
  RandomStream random(50, "innocent scatter");
  int accused = 0;
  constexpr int kTimes = 1200;
  for (int i = 0; i < kTimes; ++i) {
    const double sigma_m = 0.03 + 0.045 * random.uniform(), between_sd = 0.1 * random.uniform();
    AlignmentFile file = make_pair_file(random, 0.01, sigma_m);
    for (std::size_t place = 0; place < file.tires.size(); ++place) {
      add_to_tire(file, place, &AlignmentTire::reference, between_sd * random.normal());
    }
    const LineMistake mistake = align_file(file).mistake;
    accused += mistake.outlier.has_value() || mistake.exchange.has_value() ? 1 : 0;
  }
  INFO(accused);
  CHECK(accused <= kTimes / 200);
  // Of three tires, the line of any two describes both.
  const RepeatScatter repeats{0.02, 0.02, 16.0};
  const LineMistake of_three = find_line_mistake(fit_line({6.0, 7.0, 8.0}, {6.0, 8.0, 8.0}, repeats), repeats, 0.27);
  CHECK_FALSE(of_three.outlier.has_value());
  CHECK_FALSE(of_three.exchange.has_value());
}

TEST_CASE("a residual of a few points that happen to lie on a line is none by the repeats", "[fast]") {
  // Means of five tires on two machines, as simulated: no other point scatters, and the repeats do.
  const std::vector<double> x{6.50667, 7.49667, 8.51667, 9.51, 10.48}, y{6.50667, 7.49668, 8.51667, 9.49, 10.48};
  const LineFit fit = fit_line(x, y, {0.017, 0.022, 20.0});
  CHECK(fit.points[3].p_value > 0.5);
  CHECK(std::abs(fit.points[3].studentized) < 1.5);
  // Without repeats, the other points alone judge it.
  CHECK(fit_line(x, y, {}).points[3].p_value < 1e-3);
}

TEST_CASE("values that are computed from those of the other machine lie too near to the line", "[fast]") {
  RandomStream random(32, "computed");
  AlignmentFile file = make_pair_file(random);
  CHECK_FALSE(is_in(align_file(file).warnings, "computed"));
  for (AlignmentTire& tire : file.tires) {
    for (std::size_t i = 0; i < tire.reference.all.size(); ++i) {
      const double computed = 0.98 * tire.candidate.all[i].rrc_N_per_kN + 0.1;
      tire.reference.all[i].rrc_N_per_kN = std::round(100.0 * computed) / 100.0;
    }
    tire.reference_N_per_kN = tire.reference.mean();
  }
  CHECK(is_in(align_file(file).warnings, "were the values of one machine computed from those of the other?"));
}

TEST_CASE("reference values that are the candidate's own means are doubted", "[fast]") {
  RandomStream random(33, "means");
  for (const bool only_used : {true, false}) {
    AlignmentFile file = make_measured_file(random);
    file.machine = "drum_B";
    for (AlignmentTire& tire : file.tires) {
      double mean = tire.candidate.mean();
      if (!only_used) mean = 0.25 * (3.0 * mean + tire.candidate.all.front().rrc_N_per_kN);
      tire.reference_N_per_kN = std::round(100.0 * mean) / 100.0;
    }
    CHECK(is_in(align_file(file).warnings, "5 of the 5 values of the reference are the means of the candidate's own"));
    file.tires[0].reference_N_per_kN += 0.03;
    CHECK_FALSE(is_in(align_file(file).warnings, "of the candidate's own"));
  }
}

TEST_CASE("equal values of each tire are doubted on either machine, and coarse ones have their rounding", "[fast]") {
  RandomStream random(34, "equal");
  AlignmentFile file = make_pair_file(random);
  for (AlignmentTire& tire : file.tires) {
    for (AlignmentMeasurement& one : tire.reference.all) one.rrc_N_per_kN = tire.reference.all.back().rrc_N_per_kN;
    tire.reference_N_per_kN = tire.reference.mean();
  }
  CHECK(is_in(align_file(file).warnings, "all measurements of each tire on machine 'drum_A' are equal: real"));
  AlignmentFile coarse = make_pair_file(random, 0.1, 0.0);
  for (AlignmentTire& tire : coarse.tires) tire.reference_N_per_kN = tire.reference.mean();
  const AlignmentResult result = align_file(coarse);
  CHECK(is_in(result.warnings, "a step of 0.1 N/kN is too coarse to show their scatter"));
  CHECK_FALSE(is_in(result.warnings, "copied"));
  CHECK(result.sigma_m.sd == Approx(0.1 / std::sqrt(12.0)));
  CHECK(align_value(result.line, 8.5, 3).sd > 0.1 / std::sqrt(12.0) / std::sqrt(3.0));
}

TEST_CASE("the step of values is that of their decimals, or a greater one that enough of them show", "[fast]") {
  CHECK(find_value_step({6.5, 7.0, 8.5}) == Approx(0.1));
  CHECK(find_value_step({6.97, 7.83, 10.0}) == Approx(0.01));
  CHECK(find_value_step({7.0, 8.0}) == Approx(1.0));
  CHECK(find_value_step({7.0 / 3.0}) == 0.0);
  CHECK(find_value_step({}) == 0.0);
  CHECK(find_value_step({6.95, 7.80, 10.15}) == Approx(0.01));
  CHECK(find_greatest_step({6.95, 7.80, 10.15}) == Approx(0.05));
  CHECK(find_value_step({6.95, 7.80, 10.15, 8.05, 9.30, 6.95}) == Approx(0.05));
  CHECK(find_value_step({6.5, 7.0, 8.5, 9.5, 10.0}) == Approx(0.5));
  CHECK(find_value_step({6.52, 7.04, 8.58, 9.56, 10.02}) == Approx(0.01));  // five even ones in 32 are chance
}

TEST_CASE("values in steps of 0.05 have the rounding of these steps", "[fast]") {
  RandomStream random(40, "step");
  const AlignmentResult result = align_file(make_pair_file(random, 0.05, 0.005));
  CHECK(result.sigma_m.sd >= Approx(0.05 / std::sqrt(12.0)));
  CHECK(result.fit.candidate_sd >= Approx(0.05 / std::sqrt(12.0)));
}

TEST_CASE("a limit is met by a value that reaches it, whatever its binary form", "[fast]") {
  CHECK(calc_measurements(kRulesC1C2, 0.043 * std::sqrt(3.0)) == 4);
  CHECK(calc_measurements(kRulesC1C2, 0.086 * (1.0 + 1e-12)) == 5);
  CHECK(calc_measurements(kRulesC1C2, 0.0861) == 6);
  CHECK(calc_measurements(kRulesC1C2, 0.075 * (1.0 + 1e-12)) == 4);
  const auto align_range = [](double low, double high) {
    RandomStream random(41, "range");
    AlignmentFile file = make_pair_file(random);
    for (std::size_t i = 0; i < file.tires.size(); ++i) {
      const double rrc = low + (high - low) * static_cast<double>(i) / 4.0;
      for (TireMeasurements* side : {&file.tires[i].candidate, &file.tires[i].reference}) {
        const double scatter[] = {0.05, 0.03, -0.03, 0.0};
        for (std::size_t k = 0; k < 4; ++k) side->all[k].rrc_N_per_kN = rrc + scatter[k];
      }
      file.tires[i].reference_N_per_kN = file.tires[i].reference.mean();
    }
    const std::vector<AlignmentCheck> checks = align_file(file).checks;
    const auto check = std::find_if(checks.begin(), checks.end(), [](const AlignmentCheck& one) {
      return one.name == "range of RRc, before and after";
    });
    REQUIRE(check != checks.end());
    return check->is_met;
  };
  for (int tenths = 55; tenths < 91; ++tenths) {
    INFO(tenths);
    CHECK(align_range(tenths / 10.0, (tenths + 30) / 10.0));
  }
  CHECK_FALSE(align_range(6.0, 8.999));
}

TEST_CASE("reference values that are rounded as coarsely as a machine may scatter make no alignment", "[fast]") {
  const auto align_rounded = [](double step_N_per_kN) {
    RandomStream random(42, "coarse reference");
    AlignmentFile file = make_measured_file(random);
    file.machine = "drum_B";
    for (AlignmentTire& tire : file.tires) {
      const double rrc = 0.97 * tire.candidate.mean() + 0.13;
      tire.reference_N_per_kN = step_N_per_kN * std::round(rrc / step_N_per_kN);
    }
    return align_file(file);
  };
  const auto is_met = [](const AlignmentResult& result) {
    return is_rule_met(result, "rounding of the reference values");
  };
  CHECK_FALSE(is_met(align_rounded(1.0)));
  CHECK_FALSE(align_rounded(1.0).is_valid);
  CHECK(is_met(align_rounded(0.1)));
  CHECK(is_in(align_rounded(0.1).warnings, "the reference values have steps of 0.1 N/kN"));
  CHECK(is_met(align_rounded(0.01)));
  CHECK_FALSE(is_in(align_rounded(0.01).warnings, "have steps of"));
}

TEST_CASE("a measurement that is dated far from the others of its machine is doubted", "[fast]") {
  RandomStream random(43, "dates");
  const AlignmentFile innocent = make_pair_file(random);
  CHECK(list_time_doubts(innocent).empty());
  for (const double days : {-366.0, -365.0, 365.0, 90.0}) {
    AlignmentFile file = innocent;
    std::vector<AlignmentMeasurement>& all = file.tires[3].candidate.all;
    all[3].time_s += 86400.0 * days;
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
    INFO(days);
    CHECK(is_in(list_time_doubts(file), "1 measurement on machine 'drum_B', the first of tire 'T4' on"));
    CHECK(is_in(list_time_doubts(file), "days from the others: is its date right?"));
  }
  // A round of all tires each quarter is none, a year between two rounds is.
  for (const double round_days : {91.0, 365.0}) {
    AlignmentFile file = innocent;
    for (AlignmentTire& tire : file.tires) {
      for (std::size_t k = 0; k < 4; ++k) tire.candidate.all[k].time_s += 86400.0 * round_days * static_cast<double>(k);
    }
    CHECK(is_in(list_time_doubts(file), "are their dates right?") == (round_days > 180.0));
  }
}

TEST_CASE("of two measurements on one day, one without a time of day is doubted", "[fast]") {
  RandomStream random(44, "day");
  AlignmentFile file = make_pair_file(random);
  std::vector<AlignmentMeasurement>& all = file.tires[0].candidate.all;
  all[1].time_s = all[0].time_s + 36000.0;
  CHECK_FALSE(is_in(list_time_doubts(file), "without a time"));  // at 0:00
  all[0].is_day_alone = true;
  CHECK(is_in(list_time_doubts(file), "tire 'T1' has two measurements on 2024-10-04, one of them without a time"));
  all[1].is_day_alone = true;
  CHECK_FALSE(is_in(list_time_doubts(file), "without a time"));
}

TEST_CASE("coarse values of many tires and repeats stand on both machines, and nobody copied them", "[fast]") {
  struct Case {
    double sigma_m;
    std::size_t rounds;
  };
  for (const Case& each : {Case{0.02, 1}, {0.035, 1}, {0.035, 2}, {0.05, 2}}) {
    RandomStream random(45, "many repeats");
    int doubted = 0;
    constexpr int kTimes = 400;
    for (int i = 0; i < kTimes; ++i) {
      AlignmentFile file = make_pair_file(random, 0.1, each.sigma_m);
      for (std::size_t more = 1; more < each.rounds; ++more) {
        const AlignmentFile later = make_pair_file(random, 0.1, each.sigma_m);
        for (std::size_t k = 0; k < file.tires.size(); ++k) {
          for (const auto& [to, from] : {std::pair(&file.tires[k].candidate, &later.tires[k].candidate),
                                         std::pair(&file.tires[k].reference, &later.tires[k].reference)}) {
            for (AlignmentMeasurement one : from->all) {
              one.time_s += 86400.0 * 28.0;
              to->all.push_back(one);
            }
          }
        }
      }
      doubted += is_in(list_value_doubts(file), "copied?") ? 1 : 0;
    }
    INFO(each.sigma_m << ", " << each.rounds << ": " << doubted);
    CHECK(doubted <= kTimes / 100);
  }
}

TEST_CASE("a tire that has the values of another one is doubted", "[fast]") {
  RandomStream random(35, "copied tire");
  AlignmentFile file = make_pair_file(random);
  CHECK_FALSE(is_in(list_value_doubts(file), "has the 4 values"));
  for (std::size_t i = 0; i < 4; ++i) {
    file.tires[2].candidate.all[i].rrc_N_per_kN = file.tires[1].candidate.all[i].rrc_N_per_kN;
  }
  CHECK(is_in(list_value_doubts(file), "tire 'T3' has the 4 values of tire 'T2' on machine 'drum_B'"));
}

TEST_CASE("repeats without a new test are doubted by their times, days alone are not", "[fast]") {
  RandomStream random(36, "times");
  AlignmentFile file = make_pair_file(random);
  CHECK(list_time_doubts(file).empty());
  const auto set_times = [&file](double round_s, double tire_s) {
    for (std::size_t i = 0; i < file.tires.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        file.tires[i].candidate.all[k].time_s =
            86400.0 * 20000.0 + 36000.0 + round_s * static_cast<double>(k) + tire_s * static_cast<double>(i);
      }
    }
  };
  set_times(60.0, 0.0);
  CHECK(is_in(list_time_doubts(file),
              "15 measurements on machine 'drum_B' follow one of the same tire by less than "
              "180 min of soak and 30 min of warm-up; the least is 1 min"));
  CHECK(is_in(list_time_doubts(file), "follow one of another tire by less than the 30 min of a warm-up"));
  set_times(5.0 * 3600.0, 3600.0);  // five tires in turn, an hour each
  CHECK(list_time_doubts(file).empty());
  for (AlignmentTire& tire : file.tires) tire.tire_class = "C2";  // 6 h of soak
  CHECK(is_in(list_time_doubts(file), "360 min of soak and 50 min of warm-up"));
}

TEST_CASE("more than a year between the two machines is doubted", "[fast]") {
  RandomStream random(37, "year");
  AlignmentFile file = make_pair_file(random);
  for (AlignmentTire& tire : file.tires) {
    for (AlignmentMeasurement& one : tire.reference.all) one.time_s += 86400.0 * 396.0;
  }
  CHECK(is_in(list_time_doubts(file), "406 days lie between the measurements of the two machines"));
}

TEST_CASE("a line that does not describe the tires is not valid", "[fast]") {
  RandomStream random(38, "exchanged");
  AlignmentFile file = make_pair_file(random);
  const auto describes = [](const AlignmentResult& result) {
    return is_rule_met(result, "the line describes the tires");
  };
  CHECK(describes(align_file(file)));
  std::swap(file.tires[1].reference, file.tires[2].reference);
  std::swap(file.tires[1].reference_N_per_kN, file.tires[2].reference_N_per_kN);
  CHECK_FALSE(describes(align_file(file)));
  CHECK_FALSE(align_file(file).is_valid);
}

TEST_CASE("a reference machine of large scatter is doubted where its interval is above the limit", "[fast]") {
  RandomStream random(39, "sigma of the reference");
  AlignmentFile file = make_pair_file(random);
  CHECK_FALSE(is_in(align_file(file).warnings, "sigma_m of the reference machine"));
  for (AlignmentTire& tire : file.tires) {
    const double mean = tire.reference.mean();
    for (AlignmentMeasurement& one : tire.reference.all) {
      one.rrc_N_per_kN = mean + std::round(500.0 * (one.rrc_N_per_kN - mean)) / 100.0;
    }
    tire.reference_N_per_kN = tire.reference.mean();
  }
  CHECK(is_in(align_file(file).warnings, "sigma_m of the reference machine: 0."));
}

TEST_CASE("reference values that are all equal have a message of their own", "[fast]") {
  RandomStream random(46, "equal reference");
  AlignmentFile file = make_measured_file(random);
  for (AlignmentTire& tire : file.tires) tire.reference_N_per_kN = 8.0;
  CHECK_THROWS_WITH(align_file(file), Catch::Contains("all tires have one reference value"));
}

TEST_CASE("a drift of the reference machine's control tires is a warning, not the end of the alignment", "[fast]") {
  RandomStream random(47, "reference controls");
  AlignmentFile file = make_pair_file(random);
  const auto make_control = [&](double by_month) {
    ControlTire control{"K1", {}};
    for (int month = 0; month < 12; ++month) {
      const double rrc = 8.0 + by_month * month + 0.02 * random.normal();
      control.measurements.push_back({86400.0 * (19700.0 + 28.0 * month), rrc, true});
    }
    return control;
  };
  file.reference_controls = {make_control(0.0)};
  const bool is_valid = align_file(file).is_valid;
  CHECK_FALSE(is_in(align_file(file).warnings, "on the reference machine"));
  file.reference_controls = {make_control(0.05)};
  CHECK(is_in(align_file(file).warnings, "the control tires on the reference machine 'drum_A' drift by +0.6"));
  CHECK(align_file(file).is_valid == is_valid);
}
