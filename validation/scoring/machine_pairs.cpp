#include "validation/scoring/machine_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>

#include "diagnosis/output/machine_pair_output.h"
#include "diagnosis/pair/machine_pair.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/parse_json.h"
#include "validation/files.h"
#include "validation/scoring/answer.h"

namespace fs = std::filesystem;

namespace rollrig::validation {
namespace {

using rollrig::MachineDifference;
using rollrig::PairFindings;
using rollrig::PairVerdict;

constexpr const char* kPairAnswerFormat = "rollrig-validation-pair-answer/1";
constexpr double kPairSeen = 5.0;  // d' from which on a difference can be seen

double pair_cpu_s() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The answer to these files by this program; none where there is no such.
std::optional<Json> find_pair_answer(const std::string& file, const std::string& set_sha256,
                                     const std::string& program) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    Json answer = read_json(file);
    const bool is_ours = answer.at("format") == kPairAnswerFormat && answer.at("set_sha256") == set_sha256 &&
                         (program.empty() || answer.at("program_sha256") == program);
    if (is_ours) return answer;
  } catch (const Json::exception&) {  // spoiled: as if it were not there
  } catch (const InputError&) {
  }
  return std::nullopt;
}

Json answer_pair(const std::string& folder) {
  const auto read = [&folder](const char* name) {
    return measurements::read_measurement_set((fs::path(folder) / name).string());
  };
  rollrig::DiagnosisOptions how;
  how.threads = 1;
  return diagnosis::make_pair_json(diagnosis::diagnose_pair(read("a"), read("b"), how));
}

/// Pairs to be compared; the result of an item is its answer.
class PairItems : public AnsweredItems {
 public:
  explicit PairItems(const PairsRun& order) : order_(order), program_(hash_program()) {
    for (const std::string& number : list_cases(order.set)) {
      pairs_.push_back({number, hash_case(case_folder(order.set, number))});
    }
  }

  std::size_t count() const override { return pairs_.size(); }
  std::string number_of(std::size_t item) const override { return pairs_[item].number; }
  Json describe(std::size_t item) const override {
    return {{"pair", pairs_[item].number}, {"set_sha256", pairs_[item].set_sha256}};
  }
  Json carry_out(std::size_t item, std::uint64_t) const override {
    Json answer = {{"format", kPairAnswerFormat},
                   {"set_sha256", pairs_[item].set_sha256},
                   {"program_sha256", program_},
                   {"pair", nullptr},
                   {"failure", nullptr}};
    const double start_s = pair_cpu_s();
    try {
      answer["pair"] = answer_pair(case_folder(order_.set, pairs_[item].number));
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      answer["failure"] = error.what();
    }
    answer["cpu_seconds"] = pair_cpu_s() - start_s;
    return answer;
  }
  std::optional<Json> find_before(std::size_t item) const override {
    return find_pair_answer(answer_file(order_.out, pairs_[item].number), pairs_[item].set_sha256, program_);
  }

 private:
  struct Pair {
    std::string number;
    std::string set_sha256;
  };

  const PairsRun& order_;
  std::string program_;
  std::vector<Pair> pairs_;
};

PairTruth read_pair_truth(const Json& json) {
  PairTruth truth;
  if (json.at("effect").is_string()) truth.effect = json.at("effect").get<std::string>();
  truth.on = json.at("on") == "B" ? 1 : 0;
  truth.has_tire_effect = json.at("tire_effect").is_string();
  if (json.at("d_prime").is_number()) truth.d_prime = json.at("d_prime").get<double>();
  return truth;
}

std::string describe_answer(const PairFindings& answer) {
  if (answer.verdict == PairVerdict::kAgree) return "they agree";
  const std::string first = answer.causes.empty()
                                ? std::string("nothing")
                                : fmt::format("{} ({:.0f} %)", fmt::join(answer.causes.front().effects, " + "),
                                              100.0 * answer.causes.front().probability);
  return (answer.verdict == PairVerdict::kExplained ? "" : "unexplained, nearest ") + first;
}

}  // namespace

AnswerTally run_pairs(const PairsRun& order) {
  fs::create_directories(order.out);
  require_writable(answer_file(order.out, "any"));
  return carry_out_answers(PairItems(order), order.out, order.threads, order.progress);
}

PairJudgement judge_pair(const PairFindings& answer, const PairTruth& truth) {
  constexpr std::size_t kMostNamed = 3;
  PairJudgement judgement;
  judgement.is_any_named = answer.verdict == PairVerdict::kExplained && !answer.causes.empty();
  if (!judgement.is_any_named) return judgement;
  const MachineDifference& first = answer.causes.front();
  std::vector<std::string> named = first.effects;
  named.insert(named.end(), first.indistinguishable_from.begin(), first.indistinguishable_from.end());
  judgement.is_named = named.size() <= kMostNamed && std::count(named.begin(), named.end(), truth.effect) > 0;
  judgement.is_top = first.effects == std::vector<std::string>{truth.effect};
  for (const rollrig::OnMachine& on : first.on_machine) {
    if (on.effect != truth.effect) continue;
    const auto at = static_cast<std::size_t>(truth.on);
    judgement.is_right_machine = on.probability[at] > on.probability[1 - at];
  }
  return judgement;
}

PairScore score_pairs(const std::string& set, const std::string& answers) {
  const TruthFile opened = open_truth(set, "", kPairsTruthFormat);
  PairScore score;
  score.truth_sha256 = opened.sha256;
  PairShare detected{"a difference that can be seen is found", 0, 0, {}};
  PairShare named{"its effect is named, with at most two others", 0, 0, 0.85};
  PairShare top{"its effect is named first", 0, 0, {}};
  PairShare machine{"and on the right machine", 0, 0, {}};
  PairShare all_named{"the same of all differences, seen or not", 0, 0, {}};
  PairShare quiet{"pairs without a difference: nothing is named", 0, 0, 0.99};
  PairShare agree{"pairs without a difference: they agree", 0, 0, {}};
  std::map<std::string, PairShare> by_effect;
  std::vector<double> cpu_seconds;
  std::size_t lacking = 0;
  const auto count = [](PairShare& share, bool is_right) {
    ++share.cases;
    if (is_right) ++share.right;
  };
  for (const auto& [number, json] : opened.cases.items()) {
    const auto file = find_pair_answer(answer_file(answers, number), hash_case(case_folder(set, number)), "");
    if (!file.has_value()) {
      ++lacking;
      continue;
    }
    cpu_seconds.push_back(file->at("cpu_seconds").get<double>());
    PairFindings answer;
    answer.verdict = PairVerdict::kUnexplained;  // one that failed names nothing
    if (file->at("pair").is_object()) answer = diagnosis::read_pair_json(file->at("pair"));
    const PairTruth truth = read_pair_truth(json);
    const PairJudgement judgement = judge_pair(answer, truth);
    if (truth.effect.empty()) {
      count(quiet, !judgement.is_any_named);
      count(agree, answer.verdict == PairVerdict::kAgree);
      if (judgement.is_any_named) score.missed.push_back(number + ": no difference; " + describe_answer(answer));
      continue;
    }
    count(all_named, judgement.is_named);
    if (!(truth.d_prime >= kPairSeen)) continue;
    count(detected, answer.verdict != PairVerdict::kAgree);
    count(named, judgement.is_named);
    count(top, judgement.is_top);
    count(machine, judgement.is_named && judgement.is_right_machine);
    count(by_effect[truth.effect], judgement.is_named);
    if (!judgement.is_named) {
      score.missed.push_back(fmt::format("{}: {} on {}, d' {:.1f}; {}", number, truth.effect, truth.on == 0 ? "A" : "B",
                                         truth.d_prime, describe_answer(answer)));
    }
  }
  require_answers(lacking, opened.cases.size(), answers, fmt::format("rollrig_validation run-pairs {}", set));
  score.shares = {detected, named, top, machine, all_named, quiet, agree};
  for (auto& [effect, share] : by_effect) {
    share.label = effect;
    score.by_effect.push_back(share);
  }
  score.cpu_seconds = cpu_seconds.empty() ? 0.0 : calc_quantile(cpu_seconds, 0.5);
  return score;
}

Table make_shares_table(const PairScore& score) {
  Table table{"", {"figure", "pairs", "right", "share, %", "95 % interval", "target, %"}, {}, 1};
  const auto add = [&table](const PairShare& share, const std::string& label) {
    const Interval interval = share.interval();
    const double part = share.cases == 0 ? 0.0 : static_cast<double>(share.right) / static_cast<double>(share.cases);
    table.rows.push_back({label, fmt::format("{}", share.cases), fmt::format("{}", share.right),
                          fmt::format("{:.1f}", 100.0 * part),
                          fmt::format("{:.1f} to {:.1f}", 100.0 * interval.low, 100.0 * interval.high),
                          share.target.has_value() ? fmt::format("{:.0f}", 100.0 * *share.target) : ""});
  };
  for (const PairShare& share : score.shares) add(share, share.label);
  for (const PairShare& share : score.by_effect) add(share, "named: " + share.label);
  return table;
}

Json make_score_json(const PairScore& score) {
  const auto list = [](const std::vector<PairShare>& shares) {
    Json all = Json::array();
    for (const PairShare& share : shares) {
      const Interval interval = share.interval();
      all.push_back({{"label", share.label},
                     {"cases", share.cases},
                     {"right", share.right},
                     {"ci95", {interval.low, interval.high}},
                     {"target", share.target.has_value() ? Json(*share.target) : Json(nullptr)}});
    }
    return all;
  };
  return {{"format", "rollrig-validation-pair-score/1"},
          {"truth_sha256", score.truth_sha256},
          {"shares", list(score.shares)},
          {"by_effect", list(score.by_effect)},
          {"missed", score.missed},
          {"cpu_seconds", score.cpu_seconds}};
}

}  // namespace rollrig::validation
