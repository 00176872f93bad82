#pragma once
/// The comparison of two machines as text and as data.

#include <functional>
#include <string>

#include "include/rollrig/machine_pair.h"
#include "sim/core/columns.h"
#include "sim/core/json.h"

namespace rollrig::diagnosis {

/// The words of a finding: the terminal has the ids of effects, a page has their names.
struct PairWords {
  std::string machines = "they";
  std::function<std::string(const std::string& effect)> name_of = [](const std::string& effect) { return effect; };
};

/// The finding in one sentence: "they differ in load_record on B, probability 94 % (agree 1 %, unknown 5 %)".
std::string describe_pair_verdict(const rollrig::PairFindings& findings, const PairWords& words = {});
/// "+0.31 N/kN (+0.25 to +0.37)"
std::string show_rrc(const rollrig::RrcEstimate& estimate);
/// An effect with the machine that has it, where that is known with 90 %: "load_record on B".
std::string name_with_machine(const rollrig::OnMachine& on, const PairWords& words = {});

Table make_difference_table(const rollrig::PairFindings& findings);

/// As a test engineer reads it in the terminal.
std::string format_pair(const rollrig::PairFindings& findings);
/// rollrig-pair/1.
/// Checked  tests/diagnosis/machine_pair_test.cpp
Json make_pair_json(const rollrig::PairFindings& findings);
/// What of it is needed for a score: verdict, probabilities, causes. Throws Json::exception where it is no such JSON.
rollrig::PairFindings read_pair_json(const Json& json);

}  // namespace rollrig::diagnosis
