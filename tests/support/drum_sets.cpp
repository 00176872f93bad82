#include "tests/support/drum_sets.h"

#include <cmath>

#include "measurements/sensor_file.h"
#include "tests/support/drum_fixture.h"

namespace rollrig::tests {
namespace {

bool is_measured(const std::string& channel) {
  return channel == "drum_torque_Nm" || channel == "liner_temperature_degC" || channel == "cavity_pressure_kPa";
}

/// One run cut out of a recording. A mean at its ends reaches beyond the cut: no sample there.
measurements::MeasuredRun cut_run(const std::string& id, const sim::Recording<double>& recording,
                                  const scenarios::SetRun& cut) {
  measurements::MeasuredRun run;
  run.id = id;
  run.file = id + ".csv";
  run.session = "day";
  run.initial_tire_temperature_K = cut.initial_tire_temperature_K;
  run.cold_pressure_Pa = cut.cold_pressure_Pa;
  constexpr double kSlack_s = 1e-6;
  const auto is_end = [](double time_s, double end_s) { return std::abs(time_s - end_s) <= kSlack_s; };
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    const double time_s = recording.time_s[row];
    if (time_s < cut.start_s - kSlack_s || time_s > cut.end_s + kSlack_s) continue;
    rows.push_back(row);
    run.time_s.push_back(time_s - cut.start_s);
  }
  for (const char* column :
       {"speed_km_h", "load_N", "ambient_degC", "drum_torque_Nm", "liner_temperature_degC", "cavity_pressure_kPa"}) {
    const std::vector<double>& values = recording.channel(column);
    std::vector<double>& kept = run.columns[column];
    for (const std::size_t row : rows) {
      const bool at_cut = is_end(recording.time_s[row], cut.start_s) || is_end(recording.time_s[row], cut.end_s);
      kept.push_back(at_cut && is_measured(column) ? std::nan("") : values[row]);
    }
  }
  return run;
}

}  // namespace

Campaign make_short_campaign() {
  Campaign campaign;
  campaign.parts = {{"warm_up", {"speed_km_h=80"}}, {"warm_up", {"speed_km_h=120"}}, {"transient_skim", {"repeats=3"}}};
  return campaign;
}

Campaign make_wide_campaign() {
  Campaign campaign = make_short_campaign();
  campaign.parts.push_back({"load_sweep", {"settle_min=0"}});
  campaign.parts.push_back({"pressure_sweep", {"settle_min=0"}});
  return campaign;
}

measurements::MeasurementSet simulate_campaign(const Campaign& campaign, std::uint64_t seed) {
  measurements::MeasurementSet set;
  set.path = "simulated/set.toml";
  set.name = "simulated";
  set.tire = models::read_tire(read_config(campaign.tire));
  set.rig = make_uneven_drum();
  set.kind = set.rig->kind;
  set.sensors = measurements::read_sensor_asset("source");
  for (std::size_t part = 0; part < campaign.parts.size(); ++part) {
    const auto& [scenario, settings] = campaign.parts[part];
    scenarios::RunSpec spec = make_spec(scenario, campaign.tire, settings, "quasi_static");
    spec.rig = *set.rig;
    spec.effects = campaign.effects;
    const scenarios::Outcome outcome = scenarios::run_scenario(spec, {});
    for (const scenarios::SetRun& cut : outcome.set_runs) {
      set.runs.push_back(cut_run(std::to_string(part + 1) + "-" + cut.id, outcome.recording, cut));
    }
  }
  for (measurements::MeasuredRun& run : set.runs) {
    for (const auto& [channel, sensor] : set.sensors) {
      models::apply_sensor(sensor, channel, {seed, run.session, run.id}, run.time_s, run.columns.at(channel));
    }
  }
  return set;
}

models::ActiveEffect make_effect_at(const std::string& id, double between) {
  const models::Effect& effect = models::find_effect(id);
  std::vector<double> values;
  for (const models::EffectParameter& parameter : effect.info.parameters) {
    const models::Prior& prior = parameter.prior;
    values.push_back(prior.scale == models::Prior::Scale::kLog ? prior.low * std::pow(prior.high / prior.low, between)
                                                               : prior.low + between * (prior.high - prior.low));
  }
  return make_active(effect, values);
}

}  // namespace rollrig::tests
