#include "validation/generator/measurement_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/generator/laboratory.h"

namespace rollrig::generator {
namespace {

std::string write_set_file(const SetOrder& order, const Laboratory& lab) {
  std::string text = fmt::format("format = \"rollrig-measurements/1\"\nname = \"{}\"\n", order.name);
  text += "tire = \"tire.toml\"\n";
  const Machine& machine = *lab.specimen.machine;
  text += machine.write_set_keys(lab.specimen) + write_sensors(machine.channels, lab.sensors);
  for (const RunPlan& run : lab.campaign.runs) {
    text += fmt::format("\n[[run]]\nid = \"{0}\"\nfile = \"{0}.csv\"\nsession = \"{1}\"\n", run.id, run.session);
    text += fmt::format("initial_tire_temperature_degC = {:.10g}\ncold_pressure_kPa = {:.10g}\n", run.initial_degC,
                        run.cold_pressure_kPa);
    if (run.rest_before_min.has_value()) text += fmt::format("rest_before_min = {:.10g}\n", *run.rest_before_min);
    if (run.started_warm) text += "tire_state = \"warm\"\n";
    if (run.reversed) text += "reversed = true\n";
    if (run.reads_zero) text += "force_at_standstill = true\n";
  }
  return text;
}

std::string write_header(const Machine& machine, const RunPlan& run) {
  std::string text;
  for (const GivenColumn& column : machine.given_columns) text += fmt::format("{},", column.name);
  if (run.surface_degC.has_value()) text += "surface_temperature_degC,";
  if (!run.hung.empty()) text += machine.hung_column() + std::string(",");
  for (const Channel& channel : machine.channels) text += fmt::format("{},", channel.name);
  text.back() = '\n';
  return text;
}

std::string write_run_file(const RunPlan& run, const RunRecord& record, const Columns& measured, bool noise_free) {
  const Machine& machine = *record.specimen->machine;
  std::string text = write_header(machine, run);
  const auto out = std::back_inserter(text);
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    for (const GivenColumn& column : machine.given_columns) {
      if (text.back() != '\n') text += ',';
      fmt::format_to(out, fmt::runtime(column.format), (record.*column.values)[row]);
    }
    if (run.surface_degC.has_value()) fmt::format_to(out, ",{:.10g}", *run.surface_degC);
    if (!run.hung.empty()) fmt::format_to(out, ",{:.10g}", run.find_hung(record.time_s[row]));
    for (const std::vector<double>& column : measured) {
      text += ',';
      if (!std::isnan(column[row])) fmt::format_to(out, "{:.{}g}", column[row], noise_free ? 9 : 6);
    }
    text += "\n";
  }
  return text;
}

Files write_files(const SetOrder& order, const Laboratory& lab, const std::vector<RunRecord>& records,
                  bool noise_free) {
  Files files;
  files["set.toml"] = write_set_file(order, lab);
  files["tire.toml"] = write_tire(lab.specimen);
  files[lab.specimen.machine->file_name] = lab.specimen.machine->write_file(lab.specimen);
  for (std::size_t r = 0; r < records.size(); ++r) {
    const RunPlan& run = lab.campaign.runs[r];
    const Columns columns = measure(order.seed, lab, run, records[r], noise_free);
    files[run.id + ".csv"] = write_run_file(run, records[r], columns, noise_free);
  }
  return files;
}

/// Root mean square of what the effect does to each channel, in noise floors, 30 s after load changes left out.
Json find_signal(const Laboratory& lab, const std::vector<RunRecord>& with, const std::vector<RunRecord>& without) {
  const std::size_t channels = lab.sensors.size();
  std::vector<double> floors;
  for (const Sensor& sensor : lab.sensors) floors.push_back(sensor.floor());
  std::vector<double> sum(channels, 0.0);
  double count = 0.0;
  for (std::size_t r = 0; r < with.size(); ++r) {
    const Columns a = columns_of(with[r]);
    const Columns b = columns_of(without[r]);
    const std::vector<bool> settled = find_settled_rows(with[r]);
    for (std::size_t row = 0; row < with[r].time_s.size(); ++row) {
      if (!settled[row] || with[r].speed_km_h[row] < kLeastForceSpeed_km_h) continue;
      if (std::isnan(a[0][row])) continue;
      for (std::size_t i = 0; i < channels; ++i) {
        const double signal = (a[i][row] - b[i][row]) / floors[i];
        sum[i] += signal * signal;
      }
      count += 1.0;
    }
  }
  Json signal;
  for (std::size_t i = 0; i < channels; ++i) signal[lab.specimen.machine->channels[i].name] = std::sqrt(sum[i] / count);
  return signal;
}

Json describe_set(const SetOrder& order, const Laboratory& lab) {
  const Machine& machine = *lab.specimen.machine;
  Json base;
  for (std::size_t i = 0; i < kBaseCount; ++i) {
    if (!machine.gives(lab.specimen, static_cast<Base>(i))) continue;
    const Identified& number = lab.specimen.base[i];
    base[number.key] = {{"nominal", number.nominal}, {"sd", number.sd}, {"true", number.truth}};
  }
  Json truth = {{"format", "rollrig-blind-truth/1"},
                {"name", order.name},
                {"seed", order.seed},
                {"campaign", lab.campaign.name},
                {"runs", lab.campaign.runs.size()},
                {"noise_free", order.noise_free}};
  if (&machine != all_machines().front()) truth["kind"] = machine.word;
  if (machine.has_constant_law) truth["baseline"] = name_of_law(lab.specimen);
  truth["effects"] = Json::array();
  truth["base"] = std::move(base);
  return truth;
}

/// What is drawn of a set; `effects` become those that its truth describes.
Json describe_drawn(const SetOrder& order, const Laboratory& lab, Effects& effects) {
  Json truth = describe_set(order, lab);
  effects = draw_effects(order, lab.specimen, &truth["effects"]);
  return truth;
}

}  // namespace

Files follow_up(const SetOrder& order, std::vector<RunPlan> further) {
  Laboratory lab = draw_laboratory(order);
  const Effects effects = draw_effects(order, lab.specimen);
  add_runs(std::move(further), lab.campaign);
  return write_files(order, lab, record_all(lab.specimen, lab.campaign, effects), order.noise_free);
}

Laws find_common_laws(const std::vector<std::string>& effects, const Machine& machine, bool drawn) {
  const auto has_all = [&](bool constant_rrc) {
    return std::all_of(effects.begin(), effects.end(), [&](const std::string& id) {
      const EffectKind& effect = *find_effect_kind(id);
      return (drawn ? effect.drawn : effect.acts)({machine, constant_rrc});
    });
  };
  return {has_all(false), machine.has_constant_law && has_all(true)};
}

Json draw_truth(const SetOrder& order) {
  Effects effects;
  return describe_drawn(order, draw_laboratory(order), effects);
}

MadeSet make_set(const SetOrder& order, bool with_counterfactual) {
  const Laboratory lab = draw_laboratory(order);
  Effects effects;
  MadeSet made;
  made.truth = describe_drawn(order, lab, effects);
  const std::vector<RunRecord> records = record_all(lab.specimen, lab.campaign, effects);
  made.files = write_files(order, lab, records, order.noise_free);
  const std::vector<RunRecord> without = effects.empty() ? records : record_all(lab.specimen, lab.campaign, {});
  made.truth["signal_floors"] = find_signal(lab, records, without);
  if (!order.campaign.empty()) made.truth["campaign_kind"] = order.campaign;
  if (with_counterfactual) made.counterfactual = write_files(order, lab, without, true);
  return made;
}

}  // namespace rollrig::generator
