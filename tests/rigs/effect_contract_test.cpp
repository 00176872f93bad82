// What every effect must keep in a run, from its declaration alone: see docs/add_an_effect.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "tests/rigs/effects_of_contract.h"
#include "tests/support/hand_fed_corner.h"

using namespace rollrig;
using models::Effect;
using models::EffectInfo;
using tests::EffectCampaign;
using tests::Effects;
using tests::measured_on;
using tests::models_for;
using tests::select_measured;
using tests::usual_values;

namespace {

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;  // no sample in either
    REQUIRE(std::isfinite(a[i] - b[i]));
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
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

void check_is_baseline(const EffectCampaign& campaign, const Effects& effects, const std::string& model,
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

void check_shows_where_it_says(const EffectCampaign& campaign, const Effect& effect, const std::string& model,
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

void check_audits_and_fidelities(const EffectCampaign& campaign, const Effects& effects, const std::string& model) {
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

void check_derivative(const EffectCampaign& campaign, const Effect& effect, const std::string& model) {
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

void check_on_campaign(const EffectCampaign& campaign, const Effect& effect, const std::string& model,
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

/// The campaign without an effect, simulated once: Catch2 runs a test case anew for each of its sections.
const sim::Recording<double>& baseline_of(const EffectCampaign& campaign, const std::string& model) {
  static std::map<std::pair<tests::Machine, std::string>, sim::Recording<double>> known;
  const auto [place, is_new] = known.try_emplace({campaign.kind, model});
  if (is_new) place->second = campaign.run_quasi_static({}, model);
  return place->second;
}

}  // namespace

TEST_CASE("every effect keeps the contract", "[slow][contract]") {
  for (const EffectCampaign& campaign : tests::campaigns()) {
    for (const Effect* effect : models::all_effects()) {
      for (const std::string& model : models_for(*effect)) {
        check_on_campaign(campaign, *effect, model, baseline_of(campaign, model));
      }
    }
  }
}

TEST_CASE("both audits close on every tire model with no effect and with every one, and the fidelities agree",
          "[slow][contract]") {
  for (const EffectCampaign& campaign : tests::campaigns()) {
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
