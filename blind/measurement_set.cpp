#include "blind/measurement_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blind/recorder.h"
#include "blind/sensors.h"

namespace blind {
namespace {

using Json = nlohmann::ordered_json;
using Effects = std::vector<std::unique_ptr<Effect>>;
using Columns = std::vector<std::vector<double>>;

constexpr double kLeastForceSpeed_km_h = 20.0;  // formats.md: below it the force may be empty

struct Laboratory {
  Kind kind = Kind::kDrum;
  Specimen specimen;
  Campaign campaign;
  Sensors sensors;
};

Columns columns_of(const RunRecord& record) {
  Columns columns{record.force};
  if (record.specimen->kind != Kind::kRoad) {
    columns.push_back(record.liner_degC);
    columns.push_back(record.pressure_kPa);
  }
  return columns;
}

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
  }
  return text;
}

/// What the rig or the vehicle was told, or reports, at a row.
void write_given(const RunRecord& record, std::size_t row, std::string& text) {
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:.0f},{:.9g},", record.time_s[row], record.speed_km_h[row]);
  if (record.specimen->kind == Kind::kRoad) {
    fmt::format_to(out, "{:.9g},{:.2f}", record.elevation_m[row], record.ambient_degC[row]);
    return;
  }
  fmt::format_to(out, "{:.10g},", record.load_N[row]);
  if (record.specimen->kind == Kind::kDyno) fmt::format_to(out, "{:.9g},", record.longitudinal_N[row]);
  fmt::format_to(out, "{:.2f}", record.ambient_degC[row]);
}

std::string write_header(Kind kind) {
  std::string text = "time_s,speed_km_h,load_N,ambient_degC";
  if (kind == Kind::kDyno) text = "time_s,speed_km_h,load_N,longitudinal_force_N,ambient_degC";
  if (kind == Kind::kRoad) text = "time_s,speed_km_h,elevation_m,ambient_degC";
  for (const Channel& channel : channels_of(kind)) text += fmt::format(",{}", channel.name);
  return text + "\n";
}

std::string write_run_file(const RunRecord& record, const Columns& measured, bool noise_free) {
  std::string text = write_header(record.specimen->kind);
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    write_given(record, row, text);
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

void add_noise(const SetOrder& order, const Laboratory& lab, const RunPlan& run, const RunRecord& record,
               Columns& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Channel& channel = channels_of(lab.kind)[i];
    apply_sensor(lab.sensors[i], order.seed, run.session, run.id, channel, record.time_s, columns[i]);
    drop_samples(order.seed, run.id, channel, columns[i]);
  }
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
    Columns columns = columns_of(records[r]);
    if (!noise_free) add_noise(order, lab, lab.campaign.runs[r], records[r], columns);
    for (std::size_t row = 0; row < records[r].time_s.size(); ++row) {
      if (records[r].speed_km_h[row] < kLeastForceSpeed_km_h) columns[0][row] = std::nan("");
    }
    files[lab.campaign.runs[r].id + ".csv"] = write_run_file(records[r], columns, noise_free);
  }
  return files;
}

/// Root mean square of what the effect does to each channel, in noise floors, 30 s after load changes left out.
Json find_signal(const Laboratory& lab, const std::vector<RunRecord>& with, const std::vector<RunRecord>& without) {
  constexpr double kSettling_s = 30.0;
  const std::size_t channels = lab.sensors.size();
  std::vector<double> sum(channels, 0.0);
  double count = 0.0;
  for (std::size_t r = 0; r < with.size(); ++r) {
    const Columns a = columns_of(with[r]);
    const Columns b = columns_of(without[r]);
    double changed_s = -kSettling_s;
    for (std::size_t row = 0; row < with[r].time_s.size(); ++row) {
      if (row > 0 && with[r].load_N[row] != with[r].load_N[row - 1]) changed_s = with[r].time_s[row];
      if (with[r].time_s[row] < changed_s + kSettling_s || with[r].speed_km_h[row] < kLeastForceSpeed_km_h) continue;
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

Effects draw_effects(const SetOrder& order, const Specimen& specimen, Json& described) {
  Effects effects;
  for (std::size_t i = 0; i < order.effects.size(); ++i) {
    const EffectKind& kind = *find_effect_kind(order.effects[i]);
    Draws sizes(order.seed, fmt::format("size/{}", kind.id));
    Draws shapes(order.seed, fmt::format("shape/{}", kind.id));
    const bool has_class = !order.size_classes.empty();
    const double drawn = has_class ? draw_size(kind, order.size_classes[i], sizes) : draw_size(kind, sizes);
    const double size = order.sizes[i].value_or(drawn);
    effects.push_back(kind.make(size, shapes, specimen));
    Json shape = Json::object();
    for (const auto& [name, value] : effects.back()->shape) shape[name] = value;
    described.push_back({{"id", kind.id},
                         {"size", size},
                         {"unit", kind.unit},
                         {"size_is", kind.meaning},
                         {"neutral", kind.neutral},
                         {"shape", shape},
                         {"law", kind.law}});
    if (has_class) described.back()["size_class"] = kSizeClassNames[static_cast<std::size_t>(order.size_classes[i])];
  }
  return effects;
}

std::vector<RunRecord> record_all(const Laboratory& lab, const Effects& effects) {
  std::vector<RunRecord> records;
  for (const RunPlan& run : lab.campaign.runs) records.push_back(record_run(lab.specimen, effects, run));
  return records;
}

/// Which law a road set is to be judged against.
bool draw_constant_rrc(const SetOrder& order) {
  if (order.kind != Kind::kRoad) return false;
  Draws draws(order.seed, "baseline");
  const bool drawn = draws.happens(0.5);
  const Grounds grounds = find_common_grounds(order.effects, order.kind, false);
  if ((grounds & kConstantGround) == 0) return false;
  if ((grounds & kRoadGround) == 0) return true;
  return order.constant_rrc.value_or(drawn);
}

}  // namespace

Grounds find_common_grounds(const std::vector<std::string>& effects, Kind kind, bool drawn) {
  Grounds grounds = grounds_of(kind);
  for (const std::string& id : effects) {
    const EffectKind& effect = *find_effect_kind(id);
    grounds &= drawn ? effect.drawn : effect.acts;
  }
  return grounds;
}

MadeSet make_set(const SetOrder& order, bool with_counterfactual) {
  Laboratory lab;
  lab.kind = order.kind;
  lab.specimen = draw_specimen({order.seed, order.kind, draw_constant_rrc(order), order.nominal_base});
  lab.campaign = draw_campaign(order.seed, lab.specimen, order.runs, order.dyno_runs);
  lab.sensors = draw_sensors(order.seed, order.kind);
  MadeSet made;
  made.truth = describe(order, lab);
  const Effects effects = draw_effects(order, lab.specimen, made.truth["effects"]);
  const std::vector<RunRecord> records = record_all(lab, effects);
  made.files = write_files(order, lab, records, order.noise_free);
  const std::vector<RunRecord> without = effects.empty() ? records : record_all(lab, {});
  made.truth["signal_floors"] = find_signal(lab, records, without);
  if (with_counterfactual) made.counterfactual = write_files(order, lab, without, true);
  return made;
}

}  // namespace blind
