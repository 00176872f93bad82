#include "blind/measurement_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "blind/effect.h"
#include "blind/recorder.h"
#include "blind/sensors.h"

namespace blind {
namespace {

using Json = nlohmann::ordered_json;
using Effects = std::vector<std::unique_ptr<Effect>>;
using Columns = std::array<std::vector<double>, kChannelCount>;

constexpr double kLeastTorqueSpeed_km_h = 20.0;  // formats.md: below it the torque may be empty

struct Laboratory {
  Specimen specimen;
  Campaign campaign;
  Sensors sensors;
};

Columns columns_of(const RunRecord& record) { return {record.torque_Nm, record.liner_degC, record.pressure_kPa}; }

std::string write_set_file(const SetOrder& order, const Laboratory& lab) {
  std::string text = fmt::format(
      "format = \"rollrig-measurements/1\"\nname = \"{}\"\ntire = \"tire.toml\"\nrig = \"rig.toml\"\n", order.name);
  text += write_sensors(lab.sensors);
  for (const RunPlan& run : lab.campaign.runs) {
    text += fmt::format("\n[[run]]\nid = \"{0}\"\nfile = \"{0}.csv\"\nsession = \"{1}\"\n", run.id, run.session);
    text += fmt::format("initial_tire_temperature_degC = {:.10g}\ncold_pressure_kPa = {:.10g}\n", run.initial_degC,
                        run.cold_pressure_kPa);
    if (run.rest_before_min.has_value()) text += fmt::format("rest_before_min = {:.10g}\n", *run.rest_before_min);
  }
  return text;
}

std::string write_run_file(const RunRecord& record, const Columns& measured, bool noise_free) {
  std::string text = "time_s,speed_km_h,load_N,ambient_degC";
  for (const char* name : kChannelNames) text += fmt::format(",{}", name);
  text += "\n";
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    fmt::format_to(std::back_inserter(text), "{:.0f},{:.9g},{:.10g},{:.2f}", record.time_s[row], record.speed_km_h[row],
                   record.load_N[row], record.ambient_degC[row]);
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
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    apply_sensor(lab.sensors[i], order.seed, run.session, run.id, channel, record.time_s, columns[i]);
    drop_samples(order.seed, run.id, channel, columns[i]);
  }
}

Files write_files(const SetOrder& order, const Laboratory& lab, const std::vector<RunRecord>& records,
                  bool noise_free) {
  Files files;
  files["set.toml"] = write_set_file(order, lab);
  files["tire.toml"] = write_tire(lab.specimen);
  files["rig.toml"] = write_rig(lab.specimen);
  for (std::size_t r = 0; r < records.size(); ++r) {
    Columns columns = columns_of(records[r]);
    if (!noise_free) add_noise(order, lab, lab.campaign.runs[r], records[r], columns);
    for (std::size_t row = 0; row < records[r].time_s.size(); ++row) {
      if (records[r].speed_km_h[row] < kLeastTorqueSpeed_km_h) columns[0][row] = std::nan("");
    }
    files[lab.campaign.runs[r].id + ".csv"] = write_run_file(records[r], columns, noise_free);
  }
  return files;
}

/// Root mean square of what the effect does to each channel, in noise floors, 30 s after load changes left out.
Json find_signal(const Laboratory& lab, const std::vector<RunRecord>& with, const std::vector<RunRecord>& without) {
  constexpr double kSettling_s = 30.0;
  std::array<double, kChannelCount> sum{};
  double count = 0.0;
  for (std::size_t r = 0; r < with.size(); ++r) {
    const Columns a = columns_of(with[r]);
    const Columns b = columns_of(without[r]);
    double changed_s = -kSettling_s;
    for (std::size_t row = 0; row < with[r].time_s.size(); ++row) {
      if (row > 0 && with[r].load_N[row] != with[r].load_N[row - 1]) changed_s = with[r].time_s[row];
      if (with[r].time_s[row] < changed_s + kSettling_s || with[r].speed_km_h[row] < kLeastTorqueSpeed_km_h) continue;
      for (std::size_t i = 0; i < kChannelCount; ++i) {
        const double floors = (a[i][row] - b[i][row]) / lab.sensors[i].floor();
        sum[i] += floors * floors;
      }
      count += 1.0;
    }
  }
  Json signal;
  for (std::size_t i = 0; i < kChannelCount; ++i) signal[kChannelNames[i]] = std::sqrt(sum[i] / count);
  return signal;
}

Json describe(const SetOrder& order, const Laboratory& lab) {
  Json base;
  for (const Identified& number : lab.specimen.base) {
    base[number.key] = {{"nominal", number.nominal}, {"sd", number.sd}, {"true", number.truth}};
  }
  Json truth = {{"format", "rollrig-blind-truth/1"},
                {"name", order.name},
                {"seed", order.seed},
                {"campaign", lab.campaign.name},
                {"runs", lab.campaign.runs.size()},
                {"noise_free", order.noise_free}};
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
    const double drawn = draw_size(kind, sizes);
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
  }
  return effects;
}

std::vector<RunRecord> record_all(const Laboratory& lab, const Effects& effects) {
  std::vector<RunRecord> records;
  for (const RunPlan& run : lab.campaign.runs) records.push_back(record_run(lab.specimen, effects, run));
  return records;
}

}  // namespace

MadeSet make_set(const SetOrder& order, bool with_counterfactual) {
  Laboratory lab;
  lab.specimen = draw_specimen(order.seed, order.nominal_base);
  lab.campaign = draw_campaign(order.seed, lab.specimen, order.runs);
  lab.sensors = draw_sensors(order.seed);
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
