// Families of unknown effects: what is like them is unknown, and is described.
#include "diagnosis/terms/unknown_terms.h"

#include <catch2/catch.hpp>

#include "diagnosis/findings/likeness.h"
#include "diagnosis/findings/verdict.h"
#include "sim/core/error.h"
#include "tests/diagnosis/compared_set.h"

using namespace rollrig;
using namespace rollrig::diagnosis;

namespace {

const Term& find_family(const std::string& words) {
  for (const Term* term : list_unknown_terms()) {
    if (term->name().find(words) != std::string::npos) return *term;
  }
  throw std::logic_error("no such family: " + words);
}

/// Skim, then 40 to 120 km/h in steps of 10 km/h, nearly 3 min each, then skim.
measurements::MeasuredRun plan_steps() {
  measurements::MeasuredRun run = tests::plan_skim_run();
  run.id = "steps";
  for (std::size_t row = 0; row < run.time_s.size(); ++row) {
    const double step = std::floor(std::max(0.0, run.time_s[row] - 180.0) / 167.0);
    run.columns["speed_km_h"][row] = (40.0 + 10.0 * std::min(step, 8.0)) / 3.6;
  }
  return run;
}

measurements::MeasuredRun plan_long_steps() {
  measurements::MeasuredRun run = plan_steps();
  const std::size_t rows = run.time_s.size();
  for (std::size_t row = 0; row < rows; ++row) {  // down again
    run.time_s.push_back(run.time_s[row] + run.time_s[rows - 1] + 1.0);
    for (auto& [name, values] : run.columns) values.push_back(values[rows - 1 - row]);
  }
  return run;
}

struct Compared {
  Study study;
  Comparison comparison;

  explicit Compared(const measurements::MeasurementSet& set, const std::vector<std::string>& named)
      : study(set, settings_of(set, named)), comparison(compare_models(study)) {}

  static StudySettings settings_of(const measurements::MeasurementSet& set, const std::vector<std::string>& named) {
    StudySettings settings;
    for (const std::string& id : named) settings.terms.push_back(&find_term(id));
    settings.unknown_terms = choose_unknown_terms(set.kind->traits, set.tire.model(set.baseline));
    return settings;
  }
};

}  // namespace

TEST_CASE("a family of unknown effects cannot be asked for by name", "[fast]") {
  for (const Term* family : list_unknown_terms()) {
    CHECK(look_up_term(family->name()) == nullptr);
    CHECK_THROWS_AS(find_term(family->name()), InputError);
    const std::vector<std::string> names = term_names();
    CHECK(std::count(names.begin(), names.end(), family->name()) == 0);
  }
}

TEST_CASE("gas that leaves only above a pressure is unknown, and no slow leak", "[slow]") {
  constexpr double kPa_per_h = 1e3 / 3600.0;
  const Term& family = find_family("gas");
  models::ActiveEffect acting{&family.effect(), {6.0 * kPa_per_h, 5.0}};
  const auto set = tests::measure_on_drum({acting}, {plan_long_steps()});
  const Compared compared(set, {"slow_leak", "cavity_volume", "pressure_record"});
  CHECK(compared.comparison.unknown_probability > 0.9);
  const auto like = find_likeness(compared.study, compared.comparison, compared.comparison.unknown_probability);
  REQUIRE(like.has_value());
  CHECK_THAT(like->text, Catch::Contains("gas that leaves at"));
}

TEST_CASE("a leak at a steady rate is a slow leak", "[slow]") {
  const auto set = tests::measure_on_drum({tests::act("slow_leak", 4.0)}, {plan_long_steps()});
  const Compared compared(set, {"slow_leak", "cavity_volume", "pressure_record"});
  CHECK(compared.comparison.unknown_probability < 0.3);
}

TEST_CASE("a force in a band of speeds is unknown, and the band is told", "[slow]") {
  const Term& band = find_family("band");
  models::ActiveEffect acting{&band.effect(), {3.0, 80.0 / 3.6, 8.0 / 3.6, 0.5}};
  const auto set = tests::measure_on_drum({acting}, {plan_long_steps()});
  const Compared compared(set, {"standing_wave", "windage", "speed_record"});
  CHECK(compared.comparison.unknown_probability > 0.9);
  const auto like = find_likeness(compared.study, compared.comparison, compared.comparison.unknown_probability);
  REQUIRE(like.has_value());
  INFO(like->text);
  int low_km_h = 0;
  int high_km_h = 0;
  const std::size_t at = like->text.find("between");
  REQUIRE(at != std::string::npos);
  REQUIRE(std::sscanf(like->text.c_str() + at, "between %d and %d", &low_km_h, &high_km_h) == 2);
  CHECK(low_km_h == Approx(72).margin(4));
  CHECK(high_km_h == Approx(88).margin(4));
}

TEST_CASE("a named effect is not given up for a family that can do what it does", "[slow]") {
  const auto set = tests::measure_on_drum({tests::act("standing_wave", 2.0)}, {plan_long_steps()});
  const Compared compared(set, {"standing_wave", "windage", "speed_record"});
  const std::vector<Cause> causes = find_causes(compared.study, compared.comparison);
  REQUIRE_FALSE(causes.empty());
  CHECK(causes.front().effects == std::vector<std::string>{"standing_wave"});
  CHECK(causes.front().probability > 0.8);
}

TEST_CASE("hypotheses of named effects and of families share what there is", "[fast]") {
  StudySettings settings;
  for (const char* id : {"standing_wave", "windage", "speed_record"}) settings.terms.push_back(&find_term(id));
  settings.unknown_terms = list_unknown_terms();
  const Hypothesis family = Hypothesis{}.with({settings.unknown_terms.front(), 1});
  const Hypothesis named = Hypothesis{}.with({settings.terms.front(), 1});
  const Hypothesis both = named.with({settings.unknown_terms.front(), 1});
  CHECK(both.terms.front().term == settings.terms.front());  // families come last
  CHECK(both.has_unknown());
  CHECK_FALSE(named.has_unknown());
  const auto families = static_cast<double>(settings.unknown_terms.size());
  CHECK(families * find_prior(settings, family) == Approx(settings.priors.families));
  CHECK(find_prior(settings, both) < find_prior(settings, family));
  CHECK(find_prior(settings, both) < find_prior(settings, named));
  CHECK(find_prior(settings, named) == find_prior(settings, std::size_t{1}));
}
