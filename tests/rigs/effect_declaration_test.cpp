// What every effect must declare, and that it reads only what stands before its port: see docs/add_an_effect.md.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "build_paths.h"
#include "tests/rigs/effects_of_contract.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Effect;
using models::EffectInfo;
using tests::DrumFixture;
using tests::models_for;
using tests::select_measured;
using tests::usual_values;

namespace {

/// Every effect that the registry must hold, so that none is lost by a line of effects.def; it may have more.
const std::set<std::string>& catalog() {
  static const std::set<std::string> ids{
      "bearing_warmup",     "tire_loss_in_skim", "bearing_load_friction", "windage",
      "torque_zero_drift",  "torque_gain",       "load_cross_talk",       "load_exponent",
      "pressure_exponent",  "standing_wave",     "rubber_memory",         "toe_camber_drag",
      "flat_spot",          "slip_loss",         "tread_liner_lag",       "rim_heat",
      "brake_heat",         "cell_air_warming",  "surface_warming",       "convection_law",
      "curvature_exponent", "slow_leak",         "cavity_volume",         "gas_heat_transfer",
      "brake_drag",         "tie_down_load",     "driveline_warming",     "inertia_error",
      "wind_and_grade",     "clock_shift",       "tire_temperature",      "speed_record",
      "load_record",        "pressure_record"};
  return ids;
}

void check_declaration(const EffectInfo& info) {
  CHECK_FALSE(info.summary.empty());
  CHECK_FALSE(info.equation.empty());
  CHECK_FALSE(info.source.empty());
  REQUIRE_FALSE(info.parameters.empty());
  CHECK(info.parameters.size() <= 5);  // four fit into one pass of a Jet beside the base parameters
  CHECK(info.parameters.front().off.has_value());
  for (const auto& parameter : info.parameters) {
    INFO(parameter.key);
    CHECK(parameter.prior.low < parameter.prior.high);
    CHECK(parameter.range.contains(parameter.prior.low));
    CHECK(parameter.range.contains(parameter.prior.high));
    CHECK_FALSE(std::string(parameter.doc).empty());
    if (parameter.off.has_value()) CHECK(parameter.range.contains(*parameter.off));
  }
  CHECK_FALSE(rigs::list_machines(info.acts_on).empty());
  for (const tests::Machine kind : rigs::machine_kinds()) {
    INFO(kind->word);
    if (info.faint_on(kind->traits)) {
      CHECK(info.acts_on(kind->traits));
    } else if (info.acts_on(kind->traits)) {
      CHECK_FALSE(select_measured(info.visible_in, kind).empty());
    }
  }
  for (const auto& id : info.confused_with) CHECK_NOTHROW(models::find_effect(id));
  CHECK_FALSE(info.splitting_tests.empty());
}

/// Fills everything that a port may not yet read with NaN, so that whoever reads it betrays itself.
void poison(models::Instant<double>& now) {
  const double nan = std::nan("");
  now.acting = {nan, nan, nan, nan, nan, false, nan, nan, nan, nan, nan};
  now.boundary = {nan, nan};
  now.gas = {nan, nan};
  now.pressure_Pa = nan;
  now.contact = {nan, nan, nan};
  now.loss = models::LossPort<double>{nan, nan, nan, nan};
  now.parasitic = {nan, nan};
  now.curvature_factor = now.rolling_resistance_N = now.heating_force_N = now.parasitic_N = nan;
  now.heat.heat_in_W = nan;
  now.thermal.heat_W.fill(nan);
  now.thermal.air_W_per_K.fill(nan);
}

void check_reads_only_what_stands_before(const Effect& effect, tests::Machine kind, const std::string& model) {
  models::Context<double> context = tests::make_context_on(kind);
  context.tire.own = tests::make_own(model);
  context.tire.constant.rrc = 0.0075;
  const models::Corner<double> corner(context, {tests::make_active(effect, usual_values(effect.info))});
  std::vector<double> x(corner.state_count());
  corner.initialize(310.0, {}, x.data());
  models::Instant<double> now;
  poison(now);
  now.inflation = DrumFixture().start().inflation();
  rigs::PresentProgram present;
  present.take(tests::drum_segment(10.0, 20.0, 22.0, 5400.0), 0.0);
  now.recorded = rigs::read_drum_inputs<double>(present, 5.0);
  now.recorded.brake_force_N = kind == tests::kDrum ? 0.0 : 500.0;
  corner.apply_inputs(x.data(), now);
  now.motion = {now.acting.speed_m_s, now.acting.acceleration_m_s2, now.acting.load_N, 30.0, 1.0, now.acting.speed_m_s};
  corner.calc_losses(x.data(), now);
  std::vector<double> rates(corner.state_count(), std::nan(""));
  corner.calc_rates(x.data(), now, rates.data());
  CHECK(std::isfinite(now.rolling_resistance_N + now.parasitic_N + now.pressure_Pa + now.heat.heat_in_W));
  for (const double rate : rates) CHECK(std::isfinite(rate));
}

void check_declared_file(const EffectInfo& info) {
  check_declaration(info);
  CHECK(std::filesystem::exists(std::filesystem::path(ROLLRIG_SOURCE_DIR) / "models/effects" / (info.id + ".cpp")));
}

}  // namespace

TEST_CASE("every effect declares itself, and reads only what stands before its port", "[fast][contract]") {
  for (const Effect* effect : models::all_effects()) {
    DYNAMIC_SECTION(effect->info.id << ": declaration") { check_declared_file(effect->info); }
    for (const tests::Machine kind : rigs::machine_kinds()) {
      DYNAMIC_SECTION(effect->info.id << " on " << kind->word << ": what it reads") {
        for (const std::string& model : models_for(*effect)) check_reads_only_what_stands_before(*effect, kind, model);
      }
    }
  }
}

TEST_CASE("the registry holds the whole catalog, and the table of ports in the docs names all that it holds",
          "[fast][contract]") {
  for (const std::string& id : catalog()) CHECK_NOTHROW(models::find_effect(id));
  std::ifstream in(std::filesystem::path(ROLLRIG_SOURCE_DIR) / "docs/ports.md");
  std::stringstream text;
  text << in.rdbuf();
  for (const std::string& id : models::effect_ids()) {
    INFO(id);
    CHECK(text.str().find("`" + id + "`") != std::string::npos);
  }
}
