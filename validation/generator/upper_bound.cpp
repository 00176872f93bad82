#include "validation/generator/upper_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parallel.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"
#include "validation/generator/observer.h"

namespace fs = std::filesystem;

namespace rollrig::generator {
namespace {

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
  if (!is_there(file)) return Json::object();
  Json old;
  try {
    old = read_json(file);
  } catch (const InputError&) {  // spoiled: as if it were not there
    return Json::object();
  }
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

UpperBound find_detectability(const KnownSet& set) {
  return {Observer(set.unknowns()).reduce(set.signal()).norm(), {}};
}

UpperBound find_upper_bound(const KnownSet& set, const SetOrder& order) {
  const Observer observer(set.unknowns());
  const Eigen::VectorXd signal = observer.reduce(set.signal());
  UpperBound bound{signal.norm(), {}};
  if (std::any_of(order.effects.begin(), order.effects.end(), is_outside)) return bound;
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
    const KnownSet known(set);
    described[i] =
        describe_bound(set, order.detection_alone ? find_detectability(known) : find_upper_bound(known, set));
  };
  parallel_for(orders.size(), order.threads, bound_case, progress);
  Json json = {{"format", validation::kUpperBoundFormat},
               {"truth_sha256", truth.sha256},
               {"sets", read_kept(order.out, truth.sha256)}};
  for (std::size_t i = 0; i < orders.size(); ++i) json["sets"][orders[i].first] = std::move(described[i]);
  throw_if_interrupted();
  write_output(order.out, to_text(json, 1));
  return orders.size();
}

}  // namespace rollrig::generator
