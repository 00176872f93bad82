#include "validation/generator/known_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "validation/generator/observer.h"

namespace rollrig::generator {
namespace {

/// Where a sensor's sample is compared.
std::vector<bool> find_samples(const RunRecord& record, const Columns& measured, std::size_t channel) {
  const std::vector<bool> settled = find_settled_rows(record);
  std::vector<bool> has_sample(settled.size());
  for (std::size_t row = 0; row < settled.size(); ++row) {
    const bool is_compared = channel > 0 || settled[row];
    has_sample[row] = is_compared && !std::isnan(measured[channel][row]);
  }
  return has_sample;
}

/// a -= factor b
void subtract(double factor, const KnownSet::Change& b, KnownSet::Change& a) {
  for (std::size_t r = 0; r < a.size(); ++r) {
    for (std::size_t i = 0; i < a[r].size(); ++i) {
      for (std::size_t row = 0; row < a[r][i].size(); ++row) a[r][i][row] -= factor * b[r][i][row];
    }
  }
}

}  // namespace

KnownSet::KnownSet(const SetOrder& order, std::vector<RunPlan> further) : order_(order), lab_(draw_laboratory(order)) {
  add_runs(std::move(further), lab_.campaign);
  const Effects effects = draw_effects(order_, lab_.specimen);
  const std::vector<RunRecord> records = record_all(lab_.specimen, lab_.campaign, effects);
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Columns measured = measure(order_.seed, lab_, lab_.campaign.runs[r], records[r], order_.noise_free);
    with_.push_back(columns_of(records[r]));
    samples_.emplace_back();
    blocks_.emplace_back();
    for (std::size_t i = 0; i < lab_.sensors.size(); ++i) {
      samples_.back().push_back(find_samples(records[r], measured, i));
      blocks_.back().emplace_back(lab_.sensors[i], samples_.back().back());
      rows_ += static_cast<Eigen::Index>(blocks_.back().back().size());
    }
  }
  without_ = drive(lab_.specimen, {});
}

Eigen::VectorXd KnownSet::signal() const { return whiten(find_change()); }

Eigen::VectorXd KnownSet::signal_of(std::size_t effect) const {
  SetOrder alone = order_;
  alone.effects = {order_.effects[effect]};
  alone.sizes = {order_.sizes[effect]};
  alone.forms = {order_.forms[effect]};
  return whiten(subtract_baseline(drive(lab_.specimen, draw_effects(alone, lab_.specimen))));
}

Eigen::MatrixXd KnownSet::signatures(const EffectKind& kind) const {
  const std::array<std::pair<const Form*, SizeClass>, 4> variants{{{&kind.forms.front(), SizeClass::kMiddle},
                                                                   {&kind.forms.back(), SizeClass::kMiddle},
                                                                   {&kind.forms.front(), SizeClass::kSmall},
                                                                   {&kind.forms.back(), SizeClass::kLarge}}};
  std::vector<Change> changes;
  for (const auto& [form, size_class] : variants) {
    Draws shape(order_.seed, fmt::format("ceiling/{}/{}", kind.id, changes.size()));
    const Effect effect = make_effect(*form, typical_size(kind, size_class), shape, lab_.specimen);
    changes.push_back(subtract_baseline(drive(lab_.specimen, {effect})));
  }
  return whiten_all(changes);
}

Eigen::MatrixXd KnownSet::unknowns() const { return whiten_all(list_unknowns()); }

std::vector<const EffectKind*> KnownSet::rivals() const {
  const Ground ground{*order_.machine, lab_.specimen.constant_rrc};
  std::vector<const EffectKind*> found;
  for (const EffectKind* kind : effect_kinds()) {
    if (!kind->outside && kind->drawn(ground)) found.push_back(kind);
  }
  return found;
}

KnownSet::Change KnownSet::find_change_after_retuning() const {
  Change left = find_change();
  const std::vector<Change> unknowns = list_unknowns();
  const Eigen::VectorXd fitted = Observer(whiten_all(unknowns)).fit(whiten(left));
  for (std::size_t k = 0; k < unknowns.size(); ++k) subtract(fitted[static_cast<Eigen::Index>(k)], unknowns[k], left);
  return left;
}

KnownSet::Change KnownSet::drive(const Specimen& specimen, const Effects& effects) const {
  Change driven;
  for (const RunRecord& record : record_all(specimen, lab_.campaign, effects)) driven.push_back(columns_of(record));
  return driven;
}

KnownSet::Change KnownSet::subtract_baseline(Change driven) const {
  subtract(1.0, without_, driven);
  for (Columns& run : driven) {
    for (std::vector<double>& column : run) {
      std::replace_if(
          column.begin(), column.end(), [](double change) { return std::isnan(change); }, 0.0);
    }
  }
  return driven;
}

Eigen::VectorXd KnownSet::whiten(const Change& change) const {
  Eigen::VectorXd whitened(rows_);
  double* out = whitened.data();
  for (std::size_t r = 0; r < change.size(); ++r) {
    for (std::size_t i = 0; i < change[r].size(); ++i) {
      blocks_[r][i].whiten(change[r][i], out);
      out += blocks_[r][i].size();
    }
  }
  return whitened;
}

Eigen::MatrixXd KnownSet::whiten_all(const std::vector<Change>& changes) const {
  Eigen::MatrixXd columns(rows_, static_cast<Eigen::Index>(changes.size()));
  for (std::size_t k = 0; k < changes.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = whiten(changes[k]);
  return columns;
}

/// A session's offset shifts all samples of a channel in all its runs.
std::vector<KnownSet::Change> KnownSet::offsets() const {
  Change nothing = without_;
  for (Columns& run : nothing) {
    for (std::vector<double>& column : run) std::fill(column.begin(), column.end(), 0.0);
  }
  std::map<std::string, std::vector<Change>> by_session;
  for (std::size_t r = 0; r < without_.size(); ++r) {
    auto& shifts = by_session[lab_.campaign.runs[r].session];
    shifts.resize(lab_.sensors.size(), nothing);
    for (std::size_t i = 0; i < lab_.sensors.size(); ++i) {
      std::fill(shifts[i][r][i].begin(), shifts[i][r][i].end(), lab_.sensors[i].offset_sd);
    }
  }
  std::vector<Change> all;
  for (auto& [session, shifts] : by_session) all.insert(all.end(), shifts.begin(), shifts.end());
  return all;
}

std::vector<KnownSet::Change> KnownSet::list_unknowns() const {
  std::vector<Change> all = offsets();
  for (std::size_t i = 0; i < kBaseCount; ++i) {
    if (!order_.machine->gives(lab_.specimen, static_cast<Base>(i))) continue;
    Specimen moved = lab_.specimen;
    moved.base[i].truth += moved.base[i].sd;
    all.push_back(subtract_baseline(drive(moved, {})));
  }
  return all;
}

}  // namespace rollrig::generator
