// What every effect must keep, from its declaration alone: see docs/add_an_effect.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "rigs/trace_effects.h"
#include "tests/support/drum_fixture.h"

using namespace rollrig;
using models::Effect;
using models::EffectInfo;
using tests::DrumFixture;

namespace {

/// A campaign that shows every effect of a drum: cold start, two loads, two speeds, skims, rest.
sim::Program campaign() {
  const double v80 = 80.0 / 3.6;
  const double v120 = 120.0 / 3.6;
  sim::Program program;
  sim::Phase up = tests::rolling("run-up", 60.0, 0.0, 200.0);
  up.segments = {tests::drum_segment(60.0, 0.0, v80, 200.0)};
  sim::Phase faster = tests::rolling("faster", 60.0, v80, 5400.0);
  faster.segments = {tests::drum_segment(60.0, v80, v120, 5400.0)};
  sim::Phase down = tests::rolling("run-down", 60.0, v120, 200.0);
  down.segments = {tests::drum_segment(60.0, v120, 0.0, 200.0)};
  program.phases = {up,
                    tests::rolling("load", 600.0, v80, 5400.0),
                    tests::rolling("skim", 180.0, v80, 200.0),
                    tests::rolling("high load", 300.0, v80, 6865.0),
                    tests::rolling("load again", 60.0, v80, 5400.0),
                    faster,
                    tests::rolling("fast", 300.0, v120, 5400.0),
                    tests::rolling("fast skim", 120.0, v120, 200.0),
                    down,
                    tests::rolling("rest", 300.0, 0.0, 200.0)};
  return program;
}

DrumFixture with_effect(const Effect& effect, const std::vector<double>& values) {
  DrumFixture fixture;
  fixture.effects = {tests::make_active(effect, values)};
  return fixture;
}

std::vector<double> usual_values(const EffectInfo& info) {
  std::vector<double> values;
  for (const auto& parameter : info.parameters) values.push_back(parameter.prior.centre());
  return values;
}

/// Every effect of the design's catalogue, done or not.
const std::set<std::string>& catalogue() {
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

const std::set<std::string> kMeasured{"drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(std::isfinite(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

void check_declaration(const EffectInfo& info) {
  CHECK(catalogue().count(info.id) == 1);
  CHECK_FALSE(info.summary.empty());
  CHECK_FALSE(info.equation.empty());
  CHECK_FALSE(info.source.empty());
  REQUIRE_FALSE(info.parameters.empty());
  CHECK(info.parameters.front().off.has_value());
  for (const auto& parameter : info.parameters) {
    INFO(parameter.key);
    CHECK(parameter.prior.low < parameter.prior.high);
    CHECK(parameter.range.contains(parameter.prior.low));
    CHECK(parameter.range.contains(parameter.prior.high));
    CHECK_FALSE(std::string(parameter.doc).empty());
    if (parameter.off.has_value()) CHECK(parameter.range.contains(*parameter.off));
  }
  CHECK_FALSE(info.visible_in.empty());
  for (const auto& channel : info.visible_in) CHECK(kMeasured.count(channel) == 1);
  for (const auto& channel : info.clean_in) CHECK(kMeasured.count(channel) == 1);
  for (const auto& id : info.confused_with) CHECK(catalogue().count(id) == 1);
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

void check_reads_only_what_stands_before(const Effect& effect) {
  const DrumFixture fixture = with_effect(effect, usual_values(effect.info));
  const models::Corner<double> corner = fixture.corner();
  std::vector<double> x(corner.state_count());
  corner.initialize(310.0, {}, x.data());
  models::Instant<double> now;
  poison(now);
  now.inflation = fixture.start().inflation();
  now.recorded = rigs::read_drum_inputs<double>(tests::drum_segment(10.0, 20.0, 22.0, 5400.0), 5.0, false);
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

/// The campaign with the effect's size at `value` (in the unit of its key), everything else as usual.
sim::Recording<double> run_at_size(const Effect& effect, double value) {
  std::vector<double> values = usual_values(effect.info);
  values[0] = value;
  return with_effect(effect, values).run_quasi_static(campaign());
}

void check_off_is_baseline(const Effect& effect, const sim::Recording<double>& baseline) {
  const auto off = run_at_size(effect, *effect.info.parameters[0].off);
  for (const std::string& channel : kMeasured) {
    INFO(channel);
    CHECK(off.channel(channel) == baseline.channel(channel));
  }
}

void check_shows_where_it_says(const Effect& effect, const sim::Recording<double>& baseline) {
  const auto on = run_at_size(effect, effect.info.parameters[0].prior.high);
  for (const std::string& channel : effect.info.visible_in) {
    INFO(channel);
    const auto& former = baseline.channel(channel);
    const double span =
        *std::max_element(former.begin(), former.end()) - *std::min_element(former.begin(), former.end());
    CHECK(largest_difference(on.channel(channel), former) > 1e-3 * span);
  }
  for (const std::string& channel : effect.info.clean_in) {
    INFO(channel);
    CHECK(on.channel(channel) == baseline.channel(channel));
  }
}

void check_audits_and_fidelities(const Effect& effect) {
  const DrumFixture fixture = with_effect(effect, usual_values(effect.info));
  const auto multibody = fixture.run_multibody(campaign());
  const auto quasi_static = fixture.run_quasi_static(campaign());
  CHECK_NOTHROW(multibody.audit.require_closed(sim::kAuditLimit));
  CHECK_NOTHROW(quasi_static.audit.require_closed(sim::kAuditLimit));
  CHECK(largest_difference(multibody.channel("liner_temperature_degC"),
                           quasi_static.channel("liner_temperature_degC")) < 0.02);
  const auto& torque_m = multibody.channel("drum_torque_Nm");
  const auto& torque_q = quasi_static.channel("drum_torque_Nm");
  for (const sim::PhaseSpan& phase : multibody.phases) {
    if (phase.name != "load" && phase.name != "skim" && phase.name != "fast") continue;
    const auto row = static_cast<std::size_t>(phase.end_s - 5.0);  // settled
    INFO(phase.name);
    CHECK(torque_m[row] == Approx(torque_q[row]).epsilon(1e-4));
  }
}

constexpr std::size_t kRowInSkim = 800;

/// The torque in the skim phase, with its derivative by the size.
Jet calc_torque_by_size(const Effect& effect) {
  const DrumFixture fixture = with_effect(effect, usual_values(effect.info));
  models::Corner<Jet> corner(models::convert_context<Jet>(fixture.context()), fixture.effects);
  corner.effects()[0].parameters[0] = Jet(corner.effects()[0].parameters[0].a, 0);
  rigs::DrumStart<Jet> start;
  start.tire_temperature_K = Jet(fixture.initial_K);
  start.cold_pressure_Pa = Jet(fixture.cold_pressure_Pa);
  start.ambient_pressure_Pa = Jet(fixture.rig.environment.ambient_pressure_Pa);
  rigs::QuasiStaticDrum<Jet> drum(corner, start, false, rigs::Detail::kMeasured);
  sim::FixedGridIntegrator<Jet> integrator(drum);
  sim::Recording<Jet> recording = sim::simulate<Jet>(drum, integrator, rigs::refine_near_standstill(campaign()));
  rigs::apply_trace_effects(corner, recording);
  return recording.channel("drum_torque_Nm")[kRowInSkim];
}

void check_derivative(const Effect& effect) {
  const models::EffectParameter& size = effect.info.parameters[0];
  const double centre = size.prior.centre();
  const double step = 1e-3 * (size.prior.high - size.prior.low);
  const auto torque_Nm = [&](double value) { return run_at_size(effect, value).channel("drum_torque_Nm")[kRowInSkim]; };
  // Five points: a large step, since means are differences of a long integral, and still fourth order.
  const double difference = (8.0 * (torque_Nm(centre + step) - torque_Nm(centre - step)) -
                             (torque_Nm(centre + 2.0 * step) - torque_Nm(centre - 2.0 * step))) /
                            (12.0 * step);
  const double to_file_unit = unit_of_key(size.key).factor;
  CHECK(calc_torque_by_size(effect).v[0] * to_file_unit == Approx(difference).epsilon(1e-5));
}

}  // namespace

TEST_CASE("every effect keeps the contract", "[fast][contract]") {
  const auto baseline = DrumFixture().run_quasi_static(campaign());
  for (const Effect* effect : models::all_effects()) {
    const std::string& id = effect->info.id;
    DYNAMIC_SECTION(id << ": declaration") { check_declared_file(effect->info); }
    DYNAMIC_SECTION(id << ": at its off value it is the baseline to the bit") {
      check_off_is_baseline(*effect, baseline);
    }
    DYNAMIC_SECTION(id << ": a step of its size shows where it says, and nowhere that it calls clean") {
      check_shows_where_it_says(*effect, baseline);
    }
    DYNAMIC_SECTION(id << ": both audits close with it on, and the fidelities agree") {
      check_audits_and_fidelities(*effect);
    }
    DYNAMIC_SECTION(id << ": it reads only what stands before its port") {
      check_reads_only_what_stands_before(*effect);
    }
    DYNAMIC_SECTION(id << ": its derivative by size agrees with differences") { check_derivative(*effect); }
  }
}

TEST_CASE("the table of ports in the docs names all 34 effects", "[fast][contract]") {
  std::ifstream in(std::filesystem::path(ROLLRIG_SOURCE_DIR) / "docs/ports.md");
  std::stringstream text;
  text << in.rdbuf();
  CHECK(catalogue().size() == 34);
  for (const std::string& id : catalogue()) {
    INFO(id);
    CHECK(text.str().find("`" + id + "`") != std::string::npos);
  }
}
