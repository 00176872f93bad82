/// Diagnoses every set of a bank and scores the answers against the sealed truth, which is opened afterwards.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <mutex>

#include "diagnosis/diagnosis.h"
#include "diagnosis/diagnosis_json.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/interrupt.h"
#include "sim/core/json.h"
#include "sim/core/parallel.h"

namespace fs = std::filesystem;
using namespace rollrig;

namespace {

struct Options {
  std::string bank;
  std::string json;
  std::vector<std::string> only;
  std::vector<std::string> truths;
  bool leave_out_truth = false;
  bool only_truth = false;
  int threads = 0;
};

struct Case {
  std::string set;
  std::vector<std::string> truth;
  double true_size = 0.0;
  double signal_floors = 0.0;
  diagnosis::Diagnosis answer;
  std::string failure;
  double seconds = 0.0;

  std::string truth_name() const { return truth.empty() ? "none" : fmt::format("{}", fmt::join(truth, "+")); }
  bool has_cause() const { return failure.empty() && !answer.causes.empty(); }
  std::vector<std::string> named() const {
    if (!has_cause()) return {};
    std::vector<std::string> all = answer.causes.front().effects;
    const auto& others = answer.causes.front().indistinguishable_from;
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }
  bool names_truth() const {
    constexpr std::size_t kLargestSet = 3;
    const std::vector<std::string> all = named();
    return all.size() <= kLargestSet && std::all_of(truth.begin(), truth.end(), [&](const std::string& id) {
             return std::find(all.begin(), all.end(), id) != all.end();
           });
  }
  bool is(diagnosis::Verdict verdict) const { return failure.empty() && answer.verdict == verdict; }
  bool named_above(double probability) const { return has_cause() && answer.causes.front().probability > probability; }
};

std::vector<Case> read_cases(const Options& options) {
  const Json truth = Json::parse(read_text_file((fs::path(options.bank) / "truth.json").string()));
  std::vector<Case> cases;
  for (const auto& [set, of] : truth.at("sets").items()) {
    Case one;
    one.set = set;
    for (const Json& effect : of.at("effects")) one.truth.push_back(effect.at("id").get<std::string>());
    if (one.truth.size() == 1 && of.at("effects").front().at("size").is_number()) {
      one.true_size = of.at("effects").front().at("size").get<double>();
    }
    for (const auto& [channel, floors] : of.at("signal_floors").items()) {
      one.signal_floors = std::max(one.signal_floors, floors.get<double>());
    }
    const bool wanted = options.truths.empty() || std::find(options.truths.begin(), options.truths.end(),
                                                            one.truth_name()) != options.truths.end();
    if (wanted && !((options.leave_out_truth || options.only_truth) && one.truth.empty())) cases.push_back(one);
  }
  return cases;
}

void diagnose_case(const Options& options, Case& one) {
  const auto start = std::chrono::steady_clock::now();
  try {
    diagnosis::DiagnosisOptions how;
    how.threads = 1;
    how.only = options.only;
    if (options.leave_out_truth) {
      how.without = one.truth;
      for (const std::string& id : one.truth)
        how.only.erase(std::remove(how.only.begin(), how.only.end(), id), how.only.end());
    }
    if (options.only_truth) how.only = one.truth;
    const std::string folder = (fs::path(options.bank) / "sets" / one.set).string();
    one.answer = diagnosis::diagnose(scenarios::read_measurement_set(folder), how);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    one.failure = error.what();
  }
  one.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_case(const Case& one) {
  const auto probability = [&](const char* name) {
    const auto at = one.answer.probability.find(name);
    return at == one.answer.probability.end() ? 0.0 : at->second;
  };
  std::string text = fmt::format("{} {:<24} size {:8.3g} floors {:6.2f}  ", one.set, one.truth_name(), one.true_size,
                                 one.signal_floors);
  if (!one.failure.empty()) {
    std::cout << text << one.failure << '\n';
    return;
  }
  text += fmt::format("{:<11} none {:.3f} unknown {:.3f}", diagnosis::name_of(one.answer.verdict), probability("none"),
                      probability("unknown"));
  if (one.has_cause()) {
    const diagnosis::Cause& cause = one.answer.causes.front();
    text += fmt::format("  {} {:.3f}", fmt::join(cause.effects, "+"), cause.probability);
    if (!cause.indistinguishable_from.empty())
      text += fmt::format(" ~ {}", fmt::join(cause.indistinguishable_from, ","));
    if (!cause.parameters.empty()) {
      const auto& size = cause.parameters.front();
      text += fmt::format(" {:.4g} ({:.4g} {:.4g})", size.value, size.low_95, size.high_95);
    }
    for (const std::string& objection : cause.objections) text += " ! " + objection;
  }
  const auto& gap = one.answer.gap;
  text += fmt::format("  gap {:.2f} {:.2f}->{:.2f}", gap.as_calibrated.before, gap.recalibrated.before,
                      gap.recalibrated.after);
  if (gap.shrink_percent) text += fmt::format(" {:.0f} %", *gap.shrink_percent);
  std::cout << text << fmt::format("  {:.1f} s\n", one.seconds) << std::flush;
}

struct Tally {
  int sets = 0, no_gap = 0, explained = 0, unexplained = 0, failed = 0;
  int named = 0, named_wrong = 0, wrong_above = 0, right_above = 0;
  double set_size = 0.0;

  void add(const Case& one) {
    constexpr double kConfident = 0.9;
    ++sets;
    failed += one.failure.empty() ? 0 : 1;
    no_gap += one.is(diagnosis::Verdict::kNoGap) ? 1 : 0;
    unexplained += one.is(diagnosis::Verdict::kUnexplained) ? 1 : 0;
    if (one.is(diagnosis::Verdict::kExplained)) {
      ++explained;
      set_size += static_cast<double>(one.named().size());
      const bool right = !one.truth.empty() && one.names_truth();
      named += right ? 1 : 0;
      named_wrong += right ? 0 : 1;
    }
    const bool right = !one.truth.empty() && one.names_truth();
    if (one.named_above(kConfident)) (right ? right_above : wrong_above) += 1;
  }

  void print(const std::string& label) const {
    std::cout << fmt::format(
        "{:<24} {:4} sets: named {:4} ({:5.1f} %), wrongly {:3}, unexplained {:3}, no gap {:3}, failed {}; above 0.9: "
        "right {:3}, wrong {:3} ({:.1f} %); mean set {:.2f}\n",
        label, sets, named, 100.0 * named / std::max(1, sets), named_wrong, unexplained, no_gap, failed, right_above,
        wrong_above, 100.0 * wrong_above / std::max(1, sets), set_size / std::max(1, explained));
  }
};

int score(const Options& options) {
  std::vector<Case> cases = read_cases(options);
  std::mutex printing;
  parallel_for(cases.size(), options.threads, [&](std::size_t i) {
    throw_if_interrupted();
    diagnose_case(options, cases[i]);
    const std::lock_guard<std::mutex> lock(printing);
    print_case(cases[i]);
  });
  std::map<std::string, Tally> tallies;
  Tally effects;
  Json json = Json::array();
  double seconds = 0.0;
  for (const Case& one : cases) {
    tallies[one.truth_name()].add(one);
    if (!one.truth.empty()) effects.add(one);
    seconds += one.seconds;
    Json entry = {{"set", one.set},         {"truth", one.truth},     {"true_size", one.true_size},
                  {"seconds", one.seconds}, {"failure", one.failure}, {"signal_floors", one.signal_floors}};
    if (one.failure.empty()) entry["diagnosis"] = diagnosis::make_diagnosis_json(one.answer);
    json.push_back(std::move(entry));
  }
  std::cout << '\n';
  for (const auto& [truth, tally] : tallies) tally.print(truth);
  effects.print("all effects");
  std::cout << fmt::format("{:.1f} s a set on one thread\n",
                           seconds / static_cast<double>(std::max<std::size_t>(1, cases.size())));
  if (!options.json.empty()) write_output(options.json, json.dump(1) + "\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Diagnoses every set of a bank and scores the answers"};
  Options options;
  app.add_option("bank", options.bank, "Folder made by rollrig_blind bank")->required();
  app.add_option("--json", options.json, "File for every case");
  app.add_option("--only", options.only, "Effects in the race")->delimiter(',');
  app.add_option("--truth", options.truths, "Only sets of these effects (none: without)")->delimiter(',');
  app.add_flag("--leave-out-truth", options.leave_out_truth, "The true effect is left out of the race");
  app.add_flag("--only-truth", options.only_truth, "The true effect is alone in the race: what it achieves");
  app.add_option("--threads", options.threads, "Sets at the same time [as many as the machine has]");
  CLI11_PARSE(app, argc, argv);
  install_interrupt_handler();
  try {
    return score(options);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
}
