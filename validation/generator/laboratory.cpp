#include "validation/generator/laboratory.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/generator/machine.h"

namespace rollrig::generator {
namespace {

/// JSON has no infinity.
Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// The form of effect `i` of an order: a stream of its own, so that size and shape do not change with it.
const Form& choose_form(const SetOrder& order, std::size_t i) {
  const EffectKind& kind = *find_effect_kind(order.effects[i]);
  if (!order.forms.empty()) return *find_form(kind, order.forms[i]);
  Draws draws(order.seed, fmt::format("form/{}", kind.id));
  return draws.pick(kind.forms);
}

/// Whether the law that a set is to be judged against is a constant coefficient.
bool draw_constant_rrc(const SetOrder& order) {
  Draws draws(order.seed, "baseline");
  const bool drawn = draws.happens(0.5);
  const Laws laws = find_common_laws(order.effects, *order.machine, false);
  if (!laws.constant_rrc) return false;
  if (!laws.combined) return true;
  return order.constant_rrc.value_or(drawn);
}

}  // namespace

Laboratory draw_laboratory(const SetOrder& order) {
  Laboratory lab;
  lab.specimen = draw_specimen(order.seed, *order.machine, draw_constant_rrc(order), order.nominal_base);
  if (order.tire_seed.has_value()) {
    put_on_tire(draw_specimen(*order.tire_seed, *order.machine, lab.specimen.constant_rrc, order.nominal_base),
                lab.specimen);
  }
  lab.campaign = order.machine->draw_campaign({order.seed, order.runs, order.run_kind, order.tire_seed}, lab.specimen);
  lab.sensors = draw_sensors(order.seed, order.machine->channels);
  return lab;
}

Effects draw_effects(const SetOrder& order, const Specimen& specimen, Json* described) {
  Effects effects;
  for (std::size_t i = 0; i < order.effects.size(); ++i) {
    const EffectKind& kind = *find_effect_kind(order.effects[i]);
    Draws sizes(order.seed, fmt::format("size/{}", kind.id));
    const bool is_common = i < order.common_effects && order.tire_seed.has_value();
    Draws shapes(is_common ? *order.tire_seed : order.seed, fmt::format("shape/{}", kind.id));
    const bool has_class = !order.size_classes.empty();
    const double drawn = has_class ? draw_size(kind, order.size_classes[i], sizes) : draw_size(kind, sizes);
    const double size = order.sizes[i].value_or(drawn);
    const Form& form = choose_form(order, i);
    effects.push_back(make_effect(form, size, shapes, specimen));
    if (described == nullptr) continue;
    Json shape = Json::object();
    for (const auto& [name, value] : effects.back().shape) shape[name] = value;
    described->push_back({{"id", kind.id},
                          {"size", finite_or_null(size)},
                          {"unit", kind.size.unit},
                          {"size_is", kind.size.meaning},
                          {"neutral", finite_or_null(kind.size.neutral)},
                          {"form", form.name},
                          {"shape", shape},
                          {"law", form.law}});
    if (has_class) described->back()["size_class"] = kSizeClassNames[static_cast<std::size_t>(order.size_classes[i])];
  }
  return effects;
}

std::vector<RunRecord> record_all(const Specimen& specimen, const Campaign& campaign, const Effects& effects) {
  std::vector<RunRecord> records;
  for (const RunPlan& run : campaign.runs) records.push_back(record_run(specimen, effects, run));
  return records;
}

Columns columns_of(const RunRecord& record) {
  Columns columns{record.force};
  if (record.specimen->machine->channels.size() > 1) {
    columns.push_back(record.liner_degC);
    columns.push_back(record.pressure_kPa);
  }
  return columns;
}

Columns measure(std::uint64_t seed, const Laboratory& lab, const RunPlan& run, const RunRecord& record,
                bool noise_free) {
  Columns columns = columns_of(record);
  for (std::size_t i = 0; i < columns.size() && !noise_free; ++i) {
    const Channel& channel = lab.specimen.machine->channels[i];
    apply_sensor(lab.sensors[i], {seed, run.session, run.id}, channel, record.time_s, columns[i]);
    drop_samples(seed, run.id, channel, columns[i]);
  }
  for (std::size_t row = 0; row < record.time_s.size(); ++row) {
    const bool reads_zero = run.reads_zero && record.speed_km_h[row] == 0.0;
    if (record.speed_km_h[row] < kLeastForceSpeed_km_h && !reads_zero) columns[0][row] = std::nan("");
    if (run.is_read(record.time_s[row])) continue;
    for (std::vector<double>& column : columns) column[row] = std::nan("");
  }
  return columns;
}

std::vector<bool> find_settled_rows(const RunRecord& record) {
  constexpr double kSettling_s = 30.0;
  std::vector<bool> settled(record.time_s.size());
  double changed_s = -kSettling_s;
  for (std::size_t row = 0; row < settled.size(); ++row) {
    if (row > 0 && record.load_N[row] != record.load_N[row - 1]) changed_s = record.time_s[row];
    settled[row] = record.time_s[row] >= changed_s + kSettling_s;
  }
  return settled;
}

}  // namespace rollrig::generator
