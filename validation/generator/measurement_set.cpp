#include "validation/generator/measurement_set.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/generator/laboratory.h"

namespace blind {
namespace {

using Json = nlohmann::ordered_json;

std::string write_set_file(const SetOrder& order, const Laboratory& lab) {
  std::string text = fmt::format("format = \"rollrig-measurements/1\"\nname = \"{}\"\n", order.name);
  text += "tire = \"tire.toml\"\n";
  if (lab.kind == Kind::kRoad) {
    text += fmt::format("kind = \"road\"\nvehicle = \"vehicle.toml\"\nbaseline = \"{}\"\n",
                        lab.specimen.constant_rrc ? "constant_rrc" : "combined");
  } else {
    text += "rig = \"rig.toml\"\n";
  }
  text += write_sensors(lab.kind, lab.sensors);
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

/// What the rig or the vehicle was told, or reports, at a row.
void write_given(const RunPlan& run, const RunRecord& record, std::size_t row, std::string& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:.0f},{:.9g},", record.time_s[row], record.speed_km_h[row]);
  if (record.specimen->kind == Kind::kRoad) {
    fmt::format_to(out, "{:.9g},{:.2f}", record.elevation_m[row], record.ambient_degC[row]);
    return;
  }
  fmt::format_to(out, "{:.10g},", record.load_N[row]);
  if (record.specimen->kind == Kind::kDyno) fmt::format_to(out, "{:.9g},", record.longitudinal_N[row]);
  fmt::format_to(out, "{:.2f}", record.ambient_degC[row]);
  if (run.surface_degC.has_value()) fmt::format_to(out, ",{:.10g}", *run.surface_degC);
  if (!run.hung_Nm.empty()) fmt::format_to(out, ",{:.10g}", run.hung_at(record.time_s[row]));
}

std::string write_header(Kind kind, const RunPlan& run) {
  std::string text = "time_s,speed_km_h,load_N,ambient_degC";
  if (kind == Kind::kDyno) text = "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC";
  if (kind == Kind::kRoad) text = "time_s,speed_km_h,elevation_m,ambient_degC";
  if (run.surface_degC.has_value()) text += ",surface_temperature_degC";
  if (!run.hung_Nm.empty()) text += ",hung_torque_Nm";
  for (const Channel& channel : channels_of(kind)) text += fmt::format(",{}", channel.name);
  return text + "\n";
}

std::string write_run_file(const RunPlan& run, const RunRecord& record, const Columns& measured, bool noise_free) {
  std::string text = write_header(record.specimen->kind, run);
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    write_given(run, record, row, text);
    for (const std::vector<double>& column : measured) {
      if (std::isnan(column[row])) {
        text += ",";
      } else if (noise_free) {
        fmt::format_to(std::back_inserter(text), ",{:.9g}", column[row]);
      } else {
        fmt::format_to(std::back_inserter(text), ",{:.6g}", column[row]);
      }
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
  if (lab.kind == Kind::kRoad) {
    files["vehicle.toml"] = write_vehicle(lab.specimen);
  } else {
    files["rig.toml"] = write_rig(lab.specimen);
  }
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
        const double floors = (a[i][row] - b[i][row]) / lab.sensors[i].floor();
        sum[i] += floors * floors;
      }
      count += 1.0;
    }
  }
  Json signal;
  for (std::size_t i = 0; i < channels; ++i) signal[channels_of(lab.kind)[i].name] = std::sqrt(sum[i] / count);
  return signal;
}

Json describe(const SetOrder& order, const Laboratory& lab) {
  Json base;
  for (std::size_t i = 0; i < kBaseCount; ++i) {
    if (!lab.specimen.gives(static_cast<Base>(i))) continue;
    const Identified& number = lab.specimen.base[i];
    base[number.key] = {{"nominal", number.nominal}, {"sd", number.sd}, {"true", number.truth}};
  }
  Json truth = {{"format", "rollrig-blind-truth/1"},
                {"name", order.name},
                {"seed", order.seed},
                {"campaign", lab.campaign.name},
                {"runs", lab.campaign.runs.size()},
                {"noise_free", order.noise_free}};
  if (lab.kind != Kind::kDrum) truth["kind"] = name_of(lab.kind);
  if (lab.kind == Kind::kRoad) truth["baseline"] = lab.specimen.constant_rrc ? "constant_rrc" : "combined";
  truth["effects"] = Json::array();
  truth["base"] = std::move(base);
  return truth;
}

}  // namespace

Files follow_up(const SetOrder& order, std::vector<RunPlan> further) {
  Laboratory lab = draw_laboratory(order);
  Json ignored = Json::array();
  const Effects effects = draw_effects(order, lab.specimen, ignored);
  for (RunPlan& run : further) {
    run.index = lab.campaign.runs.size();
    lab.campaign.runs.push_back(std::move(run));
  }
  return write_files(order, lab, record_all(lab.specimen, lab.campaign, effects), order.noise_free);
}

Grounds find_common_grounds(const std::vector<std::string>& effects, Kind kind, bool drawn) {
  Grounds grounds = grounds_of(kind);
  for (const std::string& id : effects) {
    const EffectKind& effect = *find_effect_kind(id);
    grounds &= drawn ? effect.drawn : effect.acts;
  }
  return grounds;
}

MadeSet make_set(const SetOrder& order, bool with_counterfactual) {
  const Laboratory lab = draw_laboratory(order);
  MadeSet made;
  made.truth = describe(order, lab);
  const Effects effects = draw_effects(order, lab.specimen, made.truth["effects"]);
  const std::vector<RunRecord> records = record_all(lab.specimen, lab.campaign, effects);
  made.files = write_files(order, lab, records, order.noise_free);
  const std::vector<RunRecord> without = effects.empty() ? records : record_all(lab.specimen, lab.campaign, {});
  made.truth["signal_floors"] = find_signal(lab, records, without);
  if (with_counterfactual) made.counterfactual = write_files(order, lab, without, true);
  return made;
}

}  // namespace blind
