#include "validation/generator/known_set.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

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

Eigen::MatrixXd put_side_by_side(const std::vector<Eigen::VectorXd>& columns, Eigen::Index rows) {
  Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

}  // namespace

KnownSet::KnownSet(const SetOrder& order) : order_(order), lab_(draw_laboratory(order)) {
  const Effects effects = draw_effects(order_, lab_.specimen);
  const std::vector<RunRecord> records = record_all(lab_.specimen, lab_.campaign, effects);
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Columns measured = measure(order_.seed, lab_, lab_.campaign.runs[r], records[r], order_.noise_free);
    with_.push_back(columns_of(records[r]));
    blocks_.emplace_back();
    for (std::size_t i = 0; i < lab_.sensors.size(); ++i) {
      blocks_.back().emplace_back(lab_.sensors[i], find_samples(records[r], measured, i));
      rows_ += static_cast<Eigen::Index>(blocks_.back().back().size());
    }
  }
  without_ = drive(lab_.specimen, {});
}

KnownSet::Campaigned KnownSet::drive(const Specimen& specimen, const Effects& effects) const {
  Campaigned driven;
  for (const RunRecord& record : record_all(specimen, lab_.campaign, effects)) driven.push_back(columns_of(record));
  return driven;
}

Eigen::VectorXd KnownSet::whiten(const Campaigned& with) const {
  Eigen::VectorXd whitened(rows_);
  double* out = whitened.data();
  for (std::size_t r = 0; r < with.size(); ++r) {
    for (std::size_t i = 0; i < with[r].size(); ++i) {
      std::vector<double> change = with[r][i];
      for (std::size_t row = 0; row < change.size(); ++row) change[row] -= without_[r][i][row];
      blocks_[r][i].whiten(change, out);
      out += blocks_[r][i].size();
    }
  }
  return whitened;
}

Eigen::VectorXd KnownSet::signal() const { return whiten(with_); }

Eigen::VectorXd KnownSet::signal_of(std::size_t effect) const {
  SetOrder alone = order_;
  alone.effects = {order_.effects[effect]};
  alone.sizes = {order_.sizes[effect]};
  alone.forms = {order_.forms[effect]};
  return whiten(drive(lab_.specimen, draw_effects(alone, lab_.specimen)));
}

Eigen::MatrixXd KnownSet::signatures(const EffectKind& kind) const {
  const std::array<std::pair<const Form*, SizeClass>, 4> variants{{{&kind.forms.front(), SizeClass::kMiddle},
                                                                   {&kind.forms.back(), SizeClass::kMiddle},
                                                                   {&kind.forms.front(), SizeClass::kSmall},
                                                                   {&kind.forms.back(), SizeClass::kLarge}}};
  std::vector<Eigen::VectorXd> columns;
  for (const auto& [form, size_class] : variants) {
    Draws shape(order_.seed, fmt::format("ceiling/{}/{}", kind.id, columns.size()));
    columns.push_back(
        whiten(drive(lab_.specimen, {make_effect(*form, typical_size(kind, size_class), shape, lab_.specimen)})));
  }
  return put_side_by_side(columns, rows_);
}

/// A session's offset shifts all samples of a channel in all its runs.
std::vector<Eigen::VectorXd> KnownSet::offsets() const {
  std::map<std::string, std::vector<Eigen::VectorXd>> by_session;
  Eigen::Index first = 0;
  for (std::size_t r = 0; r < blocks_.size(); ++r) {
    auto& columns = by_session[lab_.campaign.runs[r].session];
    columns.resize(lab_.sensors.size(), Eigen::VectorXd::Zero(rows_));
    for (std::size_t i = 0; i < lab_.sensors.size(); ++i) {
      const std::vector<double> shift(without_[r][i].size(), lab_.sensors[i].offset_sd);
      blocks_[r][i].whiten(shift, columns[i].data() + first);
      first += static_cast<Eigen::Index>(blocks_[r][i].size());
    }
  }
  std::vector<Eigen::VectorXd> all;
  for (auto& [session, columns] : by_session) all.insert(all.end(), columns.begin(), columns.end());
  return all;
}

Eigen::MatrixXd KnownSet::unknowns() const {
  std::vector<Eigen::VectorXd> columns = offsets();
  for (std::size_t i = 0; i < kBaseCount; ++i) {
    if (!order_.machine->gives(lab_.specimen, static_cast<Base>(i))) continue;
    Specimen moved = lab_.specimen;
    moved.base[i].truth += moved.base[i].sd;
    columns.push_back(whiten(drive(moved, {})));
  }
  return put_side_by_side(columns, rows_);
}

std::vector<const EffectKind*> KnownSet::rivals() const {
  const Grounds law = lab_.specimen.constant_rrc ? kConstantGround : ~kConstantGround;
  std::vector<const EffectKind*> found;
  for (const EffectKind* kind : effect_kinds()) {
    if (!kind->outside && (kind->drawn & order_.machine->grounds() & law) != 0) found.push_back(kind);
  }
  return found;
}

}  // namespace rollrig::generator
