#include "validation/generator/ceiling.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "validation/generator/known_set.h"
#include "validation/generator/observer.h"
#include "validation/generator/opened_truth.h"
#include "validation/generator/output.h"
#include "validation/generator/problem.h"
#include "validation/generator/workers.h"

namespace fs = std::filesystem;

namespace blind {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "rollrig-blind-ceiling/1";
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

Json describe(const SetOrder& order, const Ceiling& ceiling) {
  Json described = {{"effects", order.effects}, {"d_prime", round_off(ceiling.d_prime)}};
  if (ceiling.log_bayes_factors.empty()) return described;
  described["identifiable"] = ceiling.twins().empty();
  described["twins"] = ceiling.twins();
  for (const auto& [id, factor] : ceiling.log_bayes_factors) described["log_bayes_factors"][id] = round_off(factor);
  return described;
}

/// Sets that are asked for, with their orders; none of those without effect.
std::vector<std::pair<std::string, SetOrder>> read_orders(const CeilingOrder& order, const Json& sets) {
  std::vector<std::string> numbers;
  for (const auto& [number, truth] : sets.items()) numbers.push_back(number);
  std::vector<std::pair<std::string, SetOrder>> orders;
  for (const std::string& number : order.sets.empty() ? numbers : order.sets) {
    if (!sets.contains(number)) {
      throw InputError({fmt::format("the bank has no set '{}'", number), "--sets", number,
                        fmt::format("{} to {}", numbers.front(), numbers.back()), find_nearest(number, numbers)});
    }
    SetOrder one = read_order(sets.at(number));
    if (!one.effects.empty()) orders.emplace_back(number, std::move(one));
  }
  return orders;
}

/// The sets that an older ceiling of the same truth holds; none where there is no such file.
Json read_kept(const std::string& file, const std::string& truth_sha256) {
  std::ifstream in(file);
  const Json old = Json::parse(in, nullptr, false);
  const bool is_ours =
      old.is_object() && old.value("format", "") == kFormat && old.value("truth_sha256", "") == truth_sha256;
  return is_ours && old.contains("sets") ? old["sets"] : Json::object();
}

void check_place(const std::string& out, const std::string& bank) {
  require_writable(out, "--out");
  for (const char* kept : {"sets", "truth.json", "seal.sha256"}) {
    if (!lies_within(out, (fs::path(bank) / kept).string())) continue;
    throw InputError({"the ceiling may not take the place of the bank's own files", "--out", out, "another file", ""});
  }
}

}  // namespace

std::vector<std::string> Ceiling::twins() const {
  std::vector<std::string> ids;
  for (const auto& [id, factor] : log_bayes_factors) {
    if (factor < kToldApart) ids.push_back(id);
  }
  return ids;
}

Ceiling find_ceiling(const SetOrder& order, bool detection_alone) {
  const KnownSet set(order);
  const Observer observer(set.unknowns());
  const Eigen::VectorXd signal = observer.reduce(set.signal());
  Ceiling ceiling{signal.norm(), {}};
  if (detection_alone || std::any_of(order.effects.begin(), order.effects.end(), is_outside)) return ceiling;
  for (const EffectKind* rival : set.rivals()) {
    if (order.effects.size() == 1 && order.effects.front() == rival->id) continue;
    const Eigen::MatrixXd alternatives = observer.reduce(find_alternatives(set, order, *rival));
    ceiling.log_bayes_factors[rival->id] = expect_log_bayes_factor(signal, alternatives);
  }
  return ceiling;
}

CeilingWritten write_ceiling(const CeilingOrder& order, const std::function<void(std::size_t, std::size_t)>& progress) {
  const OpenedTruth truth = open_truth(order.bank);
  const std::string out = order.out.empty() ? (fs::path(order.bank) / "ceiling.json").string() : order.out;
  check_place(out, order.bank);
  const auto orders = read_orders(order, truth.sets);
  std::vector<Json> described(orders.size());
  const auto work = [&](std::size_t i) {
    const auto& [number, set] = orders[i];
    require_same_files((fs::path(order.bank) / "sets" / number).string(), set);
    described[i] = describe(set, find_ceiling(set, order.detection_alone));
  };
  work_on_all(orders.size(), order.threads, work, progress);
  Json json = {{"format", kFormat}, {"truth_sha256", truth.sha256}, {"sets", read_kept(out, truth.sha256)}};
  for (std::size_t i = 0; i < orders.size(); ++i) json["sets"][orders[i].first] = std::move(described[i]);
  write_file(out, json.dump(1) + "\n", "--out");
  return {out, orders.size()};
}

}  // namespace blind
