// Two machines that test the same tire: what makes them differ is named, and what only looks like the tire's on one of
// them is told from the tire.
#include "diagnosis/pair/machine_pair.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"
#include "diagnosis/output/machine_pair_output.h"
#include "diagnosis/pair/find_difference.h"
#include "diagnosis/terms/machine_terms.h"
#include "sim/core/error.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using diagnosis::diagnose_pair;

namespace {

/// A set with white noise of its sensors, so that two of them are not the same recording.
measurements::MeasurementSet make_noisy_set(const std::vector<models::ActiveEffect>& effects, std::size_t runs,
                                            unsigned seed, const std::string& name) {
  measurements::MeasurementSet set = tests::make_gap_set(effects, runs);
  set.name = name;
  set.path = name + "/set.toml";
  set.rig->name = "rig " + name;
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (measurements::MeasuredRun& run : set.runs) {
    for (const auto& [channel, sensor] : set.sensors) {
      for (double& value : run.columns[channel]) value += sensor.noise_sd * normal(engine);
    }
  }
  return set;
}

models::ActiveEffect make_rougher_surface(double percent) {
  for (const models::Effect* effect : diagnosis::effects_between_machines()) {
    if (effect->info.id == "surface_roughness") return tests::make_active(*effect, {percent, 0.0});
  }
  throw std::logic_error("no surface_roughness");
}

void check_refused(const measurements::MeasurementSet& a, const measurements::MeasurementSet& b,
                   const std::string& message, const DiagnosisOptions& options = {}) {
  CHECK_THROWS_MATCHES(diagnose_pair(a, b, options), InputError,
                       Catch::Matchers::Predicate<InputError>([&](const InputError& error) {
                         INFO(error.what());
                         return std::string(error.what()).find(message) != std::string::npos;
                       }));
}

bool names(const MachineDifference& cause, const std::string& effect) {
  return std::count(cause.effects.begin(), cause.effects.end(), effect) > 0 ||
         std::count(cause.indistinguishable_from.begin(), cause.indistinguishable_from.end(), effect) > 0;
}

}  // namespace

TEST_CASE("what is no pair of machines with one tire is refused", "[fast]") {
  const measurements::MeasurementSet a = make_noisy_set({}, 1, 1, "a");
  const measurements::MeasurementSet b = make_noisy_set({}, 1, 2, "b");
  check_refused(a, a, "compared with itself");
  measurements::MeasurementSet other = b;
  other.tire.name = "another";
  check_refused(a, other, "different tires: '" + a.tire.name + "' and 'another'");
  other = b;
  other.tire.values.rolling_resistance.A0_N *= 1.1;
  check_refused(a, other, "different tires: their files give rolling_resistance.");
  other = a;
  other.path = "copy/set.toml";
  check_refused(a, other, "same recording");
  // A row less, or some changed, is a copy all the same.
  measurements::MeasuredRun& run = other.runs.front();
  run.time_s.erase(run.time_s.begin() + 1000);
  for (auto& [channel, values] : run.columns) values.erase(values.begin() + 1000);
  for (std::size_t i = 0; i < 100; ++i) run.columns.at("drum_torque_Nm")[i] += 1.0;
  check_refused(a, other, "same recording");
  // So is one whose torque is rounded, or whose times begin later: the other columns are equal to the digit.
  other = a;
  other.path = "copy/set.toml";
  for (double& torque_Nm : other.runs.front().columns.at("drum_torque_Nm")) torque_Nm = std::round(torque_Nm);
  check_refused(a, other, "same recording");
  for (double& time_s : other.runs.front().time_s) time_s += 0.5;
  check_refused(a, other, "same recording");
  other = b;
  other.kind = &rigs::find_machine_kind("flat_belt");
  check_refused(a, other, "different kinds: 'drum' and 'flat_belt'");
  DiagnosisOptions options;
  options.only = {"surface_roughnes"};
  check_refused(a, b, "surface_roughnes", options);
}

TEST_CASE("a rougher surface of one machine looks like the tire on it, and is named beside a second one", "[slow]") {
  const measurements::MeasurementSet rough = make_noisy_set({make_rougher_surface(4.0)}, 2, 3, "rough");
  const measurements::MeasurementSet smooth = make_noisy_set({}, 2, 4, "smooth");
  DiagnosisOptions options;
  options.only = {"surface_roughness", "bearing_warmup", "torque_gain", "windage", "load_exponent"};
  // On one machine the tire's own numbers take it: no effect is named.
  DiagnosisOptions of_one = options;
  of_one.only.erase(of_one.only.begin());
  CHECK(diagnosis::diagnose(rough, of_one).verdict != Verdict::kExplained);
  const PairFindings pair = diagnose_pair(rough, smooth, options);
  REQUIRE(pair.verdict == PairVerdict::kExplained);
  const MachineDifference& first = pair.causes.front();
  CHECK(names(first, "surface_roughness"));
  // 4 % of some 6 N/kN, and less in a tire that it warms.
  CHECK(pair.difference.low_95_N_per_kN > 0.05);
  CHECK(pair.difference.high_95_N_per_kN < 0.4);
  REQUIRE(pair.remaining.has_value());
  CHECK(std::abs(pair.remaining->value_N_per_kN) < 0.5 * pair.difference.value_N_per_kN);
  // The machines the other way round: the same effect, the other sign of the difference.
  const PairFindings turned = diagnose_pair(smooth, rough, options);
  const double half = 0.5 * (pair.difference.high_95_N_per_kN - pair.difference.low_95_N_per_kN);
  CHECK(std::abs(turned.difference.value_N_per_kN + pair.difference.value_N_per_kN) < half);
  CHECK(names(turned.causes.front(), "surface_roughness"));
}

TEST_CASE("a torque in another unit on one machine is doubted, before any cause", "[slow]") {
  DiagnosisOptions options;
  options.only = {"torque_gain", "bearing_warmup"};
  const measurements::MeasurementSet a = make_noisy_set({}, 1, 13, "a");
  measurements::MeasurementSet b = make_noisy_set({}, 1, 14, "b");
  CHECK(diagnose_pair(a, b, options).doubt.empty());
  for (measurements::MeasuredRun& run : b.runs) {
    for (double& value : run.columns.at("drum_torque_Nm")) value *= 0.737562;
  }
  const PairFindings pair = diagnose_pair(a, b, options);
  CHECK(pair.verdict == PairVerdict::kUnexplained);
  CHECK(pair.causes.empty());
  CHECK_THAT(pair.doubt, Catch::StartsWith("B: drum_torque_Nm seems to be in lbf ft and not in Nm"));
}

TEST_CASE("what the tire does on both machines does not make them differ", "[slow]") {
  const models::ActiveEffect of_tire = tests::make_active(models::find_effect("load_exponent"), {1.12});
  const measurements::MeasurementSet a = make_noisy_set({of_tire}, 3, 5, "a");
  const measurements::MeasurementSet b = make_noisy_set({of_tire}, 3, 6, "b");
  DiagnosisOptions options;
  options.only = {"surface_roughness", "bearing_warmup", "torque_gain", "load_exponent", "load_record"};
  const PairFindings pair = diagnose_pair(a, b, options);
  CHECK(pair.verdict == PairVerdict::kAgree);
  CHECK(pair.probability.at("agree") > 0.5);
  CHECK(std::abs(pair.difference.value_N_per_kN) < 0.05);
  // Even where the comparison does not know what the tire does.
  options.without = {"load_exponent"};
  options.only.erase(std::find(options.only.begin(), options.only.end(), "load_exponent"));
  CHECK(diagnose_pair(a, b, options).verdict != PairVerdict::kExplained);
}

TEST_CASE("the comparison of two machines is told in words and as JSON that can be read back", "[fast]") {
  PairFindings pair;
  pair.sets = {"first", "second"};
  pair.machines = {"old drum", "new drum"};
  pair.tire = "a50";
  pair.verdict = PairVerdict::kExplained;
  pair.probability = {{"agree", 0.01}, {"unknown", 0.02}, {"load_record", 0.9}};
  pair.causes = {{{"load_record"}, 0.97, {"surface_roughness"}, {{"load_record", {0.02, 0.88}}}, {}}};
  pair.difference = {0.31, 0.25, 0.37};
  pair.remaining = RrcEstimate{0.02, -0.04, 0.08};
  const std::string text = diagnosis::format_pair(pair);
  CHECK_THAT(text, Catch::Contains("they differ in load_record on B, probability 97 %"));
  CHECK_THAT(text, Catch::Contains("+0.31 N/kN (+0.25 to +0.37)"));
  CHECK_THAT(text, Catch::Contains("+0.02 N/kN (-0.04 to +0.08)"));
  const PairFindings read = diagnosis::read_pair_json(diagnosis::make_pair_json(pair));
  CHECK(read.verdict == pair.verdict);
  CHECK(read.probability == pair.probability);
  CHECK(read.causes.front().indistinguishable_from == pair.causes.front().indistinguishable_from);
  CHECK(read.remaining->high_95_N_per_kN == 0.08);
  pair.verdict = PairVerdict::kAgree;
  CHECK_THAT(diagnosis::format_pair(pair), Catch::Contains("they agree") && Catch::Contains("within 0.37 N/kN"));
  pair.verdict = PairVerdict::kUnexplained;
  CHECK_THAT(diagnosis::format_pair(pair), Catch::Contains("differ in an unknown effect"));
}
