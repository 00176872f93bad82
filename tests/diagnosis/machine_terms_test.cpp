#include "diagnosis/terms/machine_terms.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "diagnosis/terms/hypothesis.h"
#include "measurements/resimulation.h"
#include "sim/core/error.h"
#include "tests/diagnosis/gap_sets.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using Catch::Detail::Approx;
using diagnosis::MachineTerm;

namespace {

const models::Effect& find_between(const std::string& id) {
  for (const models::Effect* effect : diagnosis::effects_between_machines()) {
    if (effect->info.id == id) return *effect;
  }
  throw std::invalid_argument(id);
}

/// Readings of the first run of a set with an effect, SI.
std::vector<double> simulate_run(const measurements::MeasurementSet& set,
                                 const std::vector<models::ActiveEffect>& effects, const char* channel) {
  models::Corner<double> corner(measurements::make_context(set), effects);
  const measurements::MeasuredRun& run = set.runs.front();
  return measurements::Resimulation(run, *set.kind).simulate(set, run, corner).channel(channel);
}

double find_largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("each effect of the catalog belongs to the tire, or to a machine and then has a term on each", "[fast]") {
  std::set<std::string> of_machine;
  for (const MachineTerm* term : diagnosis::all_machine_terms()) {
    of_machine.insert(term->name());
    CHECK(term->acts_on(term->machine()));
    CHECK_FALSE(term->acts_on(1 - term->machine()));
    CHECK_FALSE(diagnosis::belongs_to_tire(term->effect_name()));
  }
  CHECK(of_machine.size() == diagnosis::all_machine_terms().size());
  std::size_t tire = 0;
  for (const std::string& effect : models::effect_ids()) {
    if (diagnosis::belongs_to_tire(effect)) {
      ++tire;
      continue;
    }
    CHECK(of_machine.count(effect + " on A") == 1);
    CHECK(of_machine.count(effect + " on B") == 1);
  }
  CHECK(tire == 12);
  CHECK(of_machine.size() == 2 * (models::effect_ids().size() - tire + 4));
}

TEST_CASE("a hypothesis lists terms of one machine after those of both, in whatever order they were added", "[fast]") {
  const MachineTerm& on_a = *diagnosis::all_machine_terms().front();
  const MachineTerm& on_b = *diagnosis::all_machine_terms().back();
  const diagnosis::Term& both = diagnosis::find_term("slow_leak");
  const auto one = diagnosis::Hypothesis{}.with({&on_b, 1}).with({&both, 1}).with({&on_a, 1});
  const auto other = diagnosis::Hypothesis{}.with({&on_a, 1}).with({&on_b, 1}).with({&both, 1});
  CHECK(one == other);
  CHECK(one.names() == std::vector<std::string>{"slow_leak", on_a.name(), on_b.name()});
}

TEST_CASE("a drum that is larger than stated reads as one whose file states the larger diameter", "[fast]") {
  const measurements::MeasurementSet stated = tests::make_gap_set({}, 1);
  measurements::MeasurementSet larger = stated;
  larger.rig->drum.diameter_m *= 1.02;
  const models::ActiveEffect effect = tests::make_active(find_between("drum_diameter"), {2.0, 0.0});
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
    INFO(channel);
    const std::vector<double> as_effect = simulate_run(stated, {effect}, channel);
    const std::vector<double> as_stated = simulate_run(larger, {}, channel);
    const std::vector<double> without = simulate_run(stated, {}, channel);
    const double moved = find_largest_difference(as_stated, without);
    CHECK(moved > 0.0);
    CHECK(find_largest_difference(as_effect, as_stated) < 1e-6 * moved);
  }
}

TEST_CASE("a speed that is counted in turns of a drum is off as its diameter is", "[fast]") {
  const measurements::MeasurementSet stated = tests::make_gap_set({}, 1);
  measurements::MeasurementSet larger = stated;
  larger.rig->drum.diameter_m *= 1.02;
  for (double& speed_m_s : larger.runs.front().columns["speed_km_h"]) speed_m_s *= 1.02;
  const models::ActiveEffect effect = tests::make_active(find_between("drum_diameter"), {2.0, 1.0});
  const std::vector<double> as_effect = simulate_run(stated, {effect}, "drum_torque_Nm");
  const std::vector<double> as_stated = simulate_run(larger, {}, "drum_torque_Nm");
  CHECK(find_largest_difference(as_effect, as_stated) < 1e-3);  // Nm; the steps of integration differ
}

TEST_CASE("air that is warmer than recorded acts as if it had been recorded", "[fast]") {
  const measurements::MeasurementSet recorded = tests::make_gap_set({}, 1);
  measurements::MeasurementSet warmer = recorded;
  for (double& ambient_K : warmer.runs.front().columns["ambient_degC"]) ambient_K += 3.0;
  const models::ActiveEffect effect = tests::make_active(find_between("ambient_record"), {3.0, 0.0});
  for (const char* channel : {"drum_torque_Nm", "liner_temperature_degC"}) {
    INFO(channel);
    CHECK(find_largest_difference(simulate_run(recorded, {effect}, channel), simulate_run(warmer, {}, channel)) < 1e-9);
  }
}

TEST_CASE("a rougher surface takes more of the loss at the reference load, and warms the tire", "[fast]") {
  const measurements::MeasurementSet set = tests::make_gap_set({}, 1);
  const models::ActiveEffect effect = tests::make_active(find_between("surface_roughness"), {5.0, 0.0});
  const std::vector<double> with = simulate_run(set, {effect}, "liner_temperature_degC");
  const std::vector<double> without = simulate_run(set, {}, "liner_temperature_degC");
  // Less than 5 % of the rise: warmer rubber loses less.
  const double rise_K = without[1600] - 298.15;
  CHECK(with[1600] - without[1600] > 0.01 * rise_K);
  CHECK(with[1600] - without[1600] < 0.05 * rise_K);
}

TEST_CASE("a thermometer that reads high moves its own reading alone", "[fast]") {
  const measurements::MeasurementSet set = tests::make_gap_set({}, 1);
  const models::ActiveEffect effect = tests::make_active(find_between("liner_record"), {2.0, 0.0});
  const std::vector<double> with = simulate_run(set, {effect}, "liner_temperature_degC");
  const std::vector<double> without = simulate_run(set, {}, "liner_temperature_degC");
  CHECK(with[10] - without[10] == Approx(2.0));
  CHECK(with[1600] - without[1600] == Approx(2.0));
  CHECK(simulate_run(set, {effect}, "drum_torque_Nm") == simulate_run(set, {}, "drum_torque_Nm"));
}
