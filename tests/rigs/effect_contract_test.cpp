// What every effect must keep, from its declaration alone: see docs/add_an_effect.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "build_paths.h"
#include "tests/rigs/effect_campaigns.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Effect;
using models::EffectInfo;
using tests::Campaign;
using tests::DrumFixture;
using tests::Effects;
using tests::measured_on;

namespace {

/// Of the readings, the channels of those that the kind measures.
std::vector<std::string> select_measured(const std::vector<models::Reading>& readings, tests::Machine kind) {
  std::vector<std::string> selected;
  for (const models::Reading reading : readings) {
    const std::string channel = reading == models::Reading::kForce              ? kind->traits.force.header()
                                : reading == models::Reading::kLinerTemperature ? "liner_temperature_degC"
                                                                                : "cavity_pressure_kPa";
    if (measured_on(kind).count(channel) == 1) selected.push_back(channel);
  }
  return selected;
}

std::vector<double> usual_values(const EffectInfo& info) {
  std::vector<double> values;
  for (const auto& parameter : info.parameters) values.push_back(parameter.prior.center());
  return values;
}

/// Every effect of the design's catalog; the registry has these and may have more.
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

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;  // no sample in either
    REQUIRE(std::isfinite(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
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

/// Tire models on which an effect keeps its contract: one alone, or all whose loss follows their temperature.
std::vector<std::string> models_for(const Effect& effect) {
  if (effect.info.only_against != nullptr) return {effect.info.only_against};
  std::vector<std::string> ids;
  for (const models::TireModel* model : models::all_tire_models()) {
    if (model->info.loss_follows_heat) ids.push_back(model->info.id);
  }
  return ids;
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

/// The effect with its size at `value` (in the unit of its key), everything else as usual.
Effects at_size(const Effect& effect, double value) {
  std::vector<double> values = usual_values(effect.info);
  values[0] = value;
  return {tests::make_active(effect, values)};
}

/// Equal to the bit; where there is no sample in one, there is none in the other.
bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

void check_is_baseline(const Campaign& campaign, const Effects& effects, const std::string& model,
                       const sim::Recording<double>& baseline) {
  const auto recording = campaign.run_quasi_static(effects, model);
  for (const std::string& channel : measured_on(campaign.kind)) {
    INFO(channel);
    CHECK(is_same(recording.channel(channel), baseline.channel(channel)));
  }
}

/// Largest change of a channel over the span of its values.
double find_change(const std::vector<double>& changed, const std::vector<double>& former) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : former) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return largest_difference(changed, former) / (high - low);
}

constexpr double kVisible = 1e-3;  // of a channel's span
constexpr double kFaint = 1e-2;

void check_shows_where_it_says(const Campaign& campaign, const Effect& effect, const std::string& model,
                               const sim::Recording<double>& baseline) {
  const auto on = campaign.run_quasi_static(at_size(effect, effect.info.parameters[0].prior.high), model);
  const bool faint = effect.info.faint_on(campaign.kind->traits);
  for (const std::string& channel : measured_on(campaign.kind)) {
    if (!faint) break;
    INFO(channel);
    CHECK(find_change(on.channel(channel), baseline.channel(channel)) < kFaint);
  }
  for (const std::string& channel : select_measured(effect.info.visible_in, campaign.kind)) {
    if (faint) break;
    INFO(channel);
    CHECK(find_change(on.channel(channel), baseline.channel(channel)) > kVisible);
  }
  for (const std::string& channel : select_measured(effect.info.clean_in, campaign.kind)) {
    INFO(channel);
    CHECK(is_same(on.channel(channel), baseline.channel(channel)));
  }
}

void check_audits_and_fidelities(const Campaign& campaign, const Effects& effects, const std::string& model) {
  const auto multibody = campaign.run_multibody(effects, model);
  const auto quasi_static = campaign.run_quasi_static(effects, model);
  CHECK_NOTHROW(multibody.audit.require_closed(campaign.audit_limit));
  CHECK_NOTHROW(quasi_static.audit.require_closed(campaign.audit_limit));
  if (measured_on(campaign.kind).count("liner_temperature_degC") == 1) {
    CHECK(largest_difference(multibody.channel("liner_temperature_degC"),
                             quasi_static.channel("liner_temperature_degC")) < 0.02);
  }
  const auto& force_m = multibody.channel(campaign.force_channel);
  const auto& force_q = quasi_static.channel(campaign.force_channel);
  for (const sim::PhaseSpan& phase : multibody.phases) {
    const auto& settled = campaign.settled_phases;
    if (std::find(settled.begin(), settled.end(), phase.name) == settled.end()) continue;
    const auto row = static_cast<std::size_t>(phase.end_s - 5.0);
    INFO(phase.name);
    CHECK(force_m[row] == Approx(force_q[row]).epsilon(1e-4));
  }
}

/// Place of the largest derivative of a channel.
std::size_t find_most_sensitive(const std::vector<Jet>& channel) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < channel.size(); ++i) {
    if (std::abs(channel[i].v[0]) > std::abs(channel[best].v[0]) || std::isnan(channel[best].a)) best = i;
  }
  return best;
}

void check_derivative(const Campaign& campaign, const Effect& effect, const std::string& model) {
  const models::EffectParameter& size = effect.info.parameters[0];
  const double center = size.prior.center();
  const double step = 1e-3 * (size.prior.high - size.prior.low);
  const double to_file_unit = unit_of_key(size.key).factor;
  const auto derivatives = campaign.run_with_derivatives(at_size(effect, center), model);
  std::vector<sim::Recording<double>> runs;
  for (const double steps : {-2.0, -1.0, 1.0, 2.0}) {
    runs.push_back(campaign.run_quasi_static(at_size(effect, center + steps * step), model));
  }
  for (const std::string& channel : select_measured(effect.info.visible_in, campaign.kind)) {
    INFO(channel);
    const auto& by_size = derivatives.channel(channel);
    const std::size_t row = find_most_sensitive(by_size);
    const auto at = [&](std::size_t run) { return runs[run].channel(channel)[row]; };
    // Five points: a large step, since means are differences of a long integral, and still fourth order.
    const double difference = (8.0 * (at(2) - at(1)) - (at(3) - at(0))) / (12.0 * step);
    CHECK(by_size[row].v[0] * to_file_unit == Approx(difference).epsilon(1e-5));
  }
}

void check_on_campaign(const Campaign& campaign, const Effect& effect, const std::string& model,
                       const sim::Recording<double>& baseline) {
  const EffectInfo& info = effect.info;
  std::string name = info.id + " on " + campaign.kind->word;
  if (model != "combined") name += ", " + model;
  if (!models::acts_in(info, campaign.kind->traits, models::find_tire_model(model))) {
    DYNAMIC_SECTION(name << ": it does not act there, which is the baseline to the bit") {
      check_is_baseline(campaign, at_size(effect, info.parameters[0].prior.high), model, baseline);
    }
    return;
  }
  DYNAMIC_SECTION(name << ": at its off value it is the baseline to the bit") {
    check_is_baseline(campaign, at_size(effect, *info.parameters[0].off), model, baseline);
  }
  DYNAMIC_SECTION(name << ": a step of its size shows where it says, and nowhere that it calls clean") {
    check_shows_where_it_says(campaign, effect, model, baseline);
  }
  DYNAMIC_SECTION(name << ": both audits close with it on, and the fidelities agree") {
    check_audits_and_fidelities(campaign, {tests::make_active(effect, usual_values(info))}, model);
  }
  if (info.faint_on(campaign.kind->traits)) return;  // a derivative as small as rounding
  DYNAMIC_SECTION(name << ": its derivative by size agrees with differences") {
    check_derivative(campaign, effect, model);
  }
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

TEST_CASE("every effect keeps the contract", "[fast][contract]") {
  for (const Campaign& campaign : tests::campaigns()) {
    std::map<std::string, sim::Recording<double>> baselines;
    for (const models::TireModel* model : models::all_tire_models()) {
      baselines[model->info.id] = campaign.run_quasi_static({}, model->info.id);
    }
    for (const Effect* effect : models::all_effects()) {
      for (const std::string& model : models_for(*effect)) {
        check_on_campaign(campaign, *effect, model, baselines.at(model));
      }
    }
  }
}

TEST_CASE("both audits close on every tire model with no effect and with every one, and the fidelities agree",
          "[fast][contract]") {
  for (const Campaign& campaign : tests::campaigns()) {
    Effects all;
    for (const Effect* effect : models::all_effects()) {
      all.push_back(tests::make_active(*effect, usual_values(effect->info)));
    }
    for (const models::TireModel* model : models::all_tire_models()) {
      INFO(model->info.id << " on " << campaign.kind->word);
      check_audits_and_fidelities(campaign, {}, model->info.id);
      check_audits_and_fidelities(campaign, all, model->info.id);
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
