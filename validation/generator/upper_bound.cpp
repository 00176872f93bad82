#include "validation/generator/upper_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parallel.h"
#include "validation/files.h"
#include "validation/generator/laboratory.h"
#include "validation/generator/observer.h"
#include "validation/generator/sample_blocks.h"

namespace fs = std::filesystem;

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

/// A set whose truth is known, simulated again with other causes and other base parameters, without noise. Signals are
/// what a cause changes in all channels and runs: whitened means over 10 s of the samples that the set has, the force
/// from 30 s after each change of load on.
class KnownSet {
 public:
  explicit KnownSet(const SetOrder& order) : order_(order), lab_(draw_laboratory(order)) {
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

  /// Of the set's own effects.
  Eigen::VectorXd signal() const { return whiten(with_); }

  /// Of one of them alone, with its own size, form and shape.
  Eigen::VectorXd signal_of(std::size_t effect) const {
    SetOrder alone = order_;
    alone.effects = {order_.effects[effect]};
    alone.sizes = {order_.sizes[effect]};
    alone.forms = {order_.forms[effect]};
    return whiten(drive(lab_.specimen, draw_effects(alone, lab_.specimen)));
  }

  /// Of another effect at typical sizes, a column each: both forms at the middle one, one form at a small one, the
  /// other at a large one, each with a shape of its own.
  Eigen::MatrixXd signatures(const EffectKind& kind) const {
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

  /// What the observer does not know, a column each of one prior standard deviation: offsets of the sensors by session,
  /// base parameters that the files give an uncertainty of.
  Eigen::MatrixXd unknowns() const {
    std::vector<Eigen::VectorXd> columns = offsets();
    for (std::size_t i = 0; i < kBaseCount; ++i) {
      if (!order_.machine->gives(lab_.specimen, static_cast<Base>(i))) continue;
      Specimen moved = lab_.specimen;
      moved.base[i].truth += moved.base[i].sd;
      columns.push_back(whiten(drive(moved, {})));
    }
    return put_side_by_side(columns, rows_);
  }

  /// Effects of the catalog that validation sets may have in such a case.
  std::vector<const EffectKind*> rivals() const {
    const Ground ground{*order_.machine, lab_.specimen.constant_rrc};
    std::vector<const EffectKind*> found;
    for (const EffectKind* kind : effect_kinds()) {
      if (!kind->outside && kind->drawn(ground)) found.push_back(kind);
    }
    return found;
  }

 private:
  using Campaigned = std::vector<Columns>;  // channels by run

  Campaigned drive(const Specimen& specimen, const Effects& effects) const {
    Campaigned driven;
    for (const RunRecord& record : record_all(specimen, lab_.campaign, effects)) driven.push_back(columns_of(record));
    return driven;
  }

  Eigen::VectorXd whiten(const Campaigned& with) const {
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

  /// A session's offset shifts all samples of a channel in all its runs.
  std::vector<Eigen::VectorXd> offsets() const {
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

  SetOrder order_;
  Laboratory lab_;
  Campaigned with_;
  Campaigned without_;
  std::vector<std::vector<SampleBlocks>> blocks_;  // by run and channel
  Eigen::Index rows_ = 0;
};

constexpr double kToldApart = 3.0;  // expected log Bayes factor; the diagnosis' own measure

bool is_outside(const std::string& id) { return find_effect_kind(id)->outside; }

/// What another effect can do; of a pair's member also what it does there.
Eigen::MatrixXd find_alternatives(const KnownSet& set, const SetOrder& order, const EffectKind& rival) {
  Eigen::MatrixXd columns = set.signatures(rival);
  const auto member = std::find(order.effects.begin(), order.effects.end(), rival.id);
  if (member == order.effects.end()) return columns;
  columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
  columns.rightCols(1) = set.signal_of(static_cast<std::size_t>(member - order.effects.begin()));
  return columns;
}

/// Four digits are enough for a reader.
double round_off(double value) { return std::stod(fmt::format("{:.4g}", value)); }

Json describe_bound(const SetOrder& order, const UpperBound& bound) {
  Json described = {{"effects", order.effects}, {"d_prime", round_off(bound.d_prime)}};
  if (bound.log_bayes_factors.empty()) return described;
  described["identifiable"] = bound.twins().empty();
  described["twins"] = bound.twins();
  for (const auto& [id, factor] : bound.log_bayes_factors) described["log_bayes_factors"][id] = round_off(factor);
  return described;
}

/// Cases that are asked for, with their orders; none of those without effect.
std::vector<std::pair<std::string, SetOrder>> read_orders(const UpperBoundOrder& order, const Json& cases) {
  std::vector<std::string> numbers;
  for (const auto& [number, truth] : cases.items()) numbers.push_back(number);
  std::vector<std::pair<std::string, SetOrder>> orders;
  for (const std::string& number : order.cases.empty() ? numbers : order.cases) {
    if (!cases.contains(number)) {
      InputProblem problem = unknown_name("case", number, numbers);
      problem.key = "--cases";
      problem.allowed = fmt::format("{} to {}", numbers.front(), numbers.back());
      throw InputError(problem);
    }
    SetOrder one = read_order(cases.at(number));
    if (!one.effects.empty()) orders.emplace_back(number, std::move(one));
  }
  return orders;
}

/// The cases that an older file of the same truth holds; none where there is no such file.
Json read_kept(const std::string& file, const std::string& truth_sha256) {
  std::ifstream in(file);
  const Json old = Json::parse(in, nullptr, false);
  const bool is_ours = old.is_object() && old.value("format", "") == validation::kUpperBoundFormat &&
                       old.value("truth_sha256", "") == truth_sha256;
  return is_ours && old.contains("sets") ? old["sets"] : Json::object();
}

void check_place(const std::string& out, const std::string& set) {
  require_writable(out);
  for (const char* kept : {"sets", "truth.json", "truth.sha256", "seal.sha256"}) {
    if (!validation::lies_within(out, (fs::path(set) / kept).string())) continue;
    throw InputError({"the bound may not take the place of the validation set's own files", "", 0, "--out", out,
                      "another file", ""});
  }
}

}  // namespace

std::vector<std::string> UpperBound::twins() const {
  std::vector<std::string> ids;
  for (const auto& [id, factor] : log_bayes_factors) {
    if (factor < kToldApart) ids.push_back(id);
  }
  return ids;
}

UpperBound find_upper_bound(const SetOrder& order, bool detection_alone) {
  const KnownSet set(order);
  const Observer observer(set.unknowns());
  const Eigen::VectorXd signal = observer.reduce(set.signal());
  UpperBound bound{signal.norm(), {}};
  if (detection_alone || std::any_of(order.effects.begin(), order.effects.end(), is_outside)) return bound;
  for (const EffectKind* rival : set.rivals()) {
    if (order.effects.size() == 1 && order.effects.front() == rival->id) continue;
    const Eigen::MatrixXd alternatives = observer.reduce(find_alternatives(set, order, *rival));
    bound.log_bayes_factors[rival->id] = expect_log_bayes_factor(signal, alternatives);
  }
  return bound;
}

std::size_t write_upper_bounds(UpperBoundOrder& order, const Progress& progress) {
  const validation::TruthFile truth = validation::open_truth(order.set, "");
  if (order.out.empty()) order.out = (fs::path(order.set) / "upper_bound.json").string();
  check_place(order.out, order.set);
  const auto orders = read_orders(order, truth.cases);
  std::vector<Json> described(orders.size());
  const auto bound_case = [&](std::size_t i) {
    const auto& [number, set] = orders[i];
    require_same_files(validation::case_folder(order.set, number), set);
    described[i] = describe_bound(set, find_upper_bound(set, order.detection_alone));
  };
  parallel_for(orders.size(), order.threads, bound_case, progress);
  Json json = {{"format", validation::kUpperBoundFormat},
               {"truth_sha256", truth.sha256},
               {"sets", read_kept(order.out, truth.sha256)}};
  for (std::size_t i = 0; i < orders.size(); ++i) json["sets"][orders[i].first] = std::move(described[i]);
  write_output(order.out, json.dump(1) + "\n");
  return orders.size();
}

}  // namespace rollrig::generator
