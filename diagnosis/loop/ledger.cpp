#include "diagnosis/loop/ledger.h"

#include <fmt/format.h>

#include "diagnosis/output/diagnosis_json.h"
#include "diagnosis/output/summary.h"
#include "sim/core/columns.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"
#include "sim/core/parse_json.h"

namespace rollrig::diagnosis {
namespace {

constexpr const char* kFormat = "rollrig-loop/1";

const std::vector<std::pair<LoopState, std::string>> kStates{{LoopState::kWaiting, "waiting"},
                                                             {LoopState::kNamed, "named"},
                                                             {LoopState::kHoursGone, "hours_gone"},
                                                             {LoopState::kNothingToTest, "nothing_to_test"}};
const std::vector<std::pair<LoopTestState, std::string>> kTestStates{
    {LoopTestState::kPlanned, "planned"}, {LoopTestState::kMeasured, "measured"}, {LoopTestState::kFailed, "failed"}};

template <class Value>
std::string loop_word_of(const std::vector<std::pair<Value, std::string>>& words, Value value) {
  for (const auto& [known, word] : words) {
    if (known == value) return word;
  }
  return "";
}

template <class Value>
Value value_of(const std::vector<std::pair<Value, std::string>>& words, const std::string& word) {
  for (const auto& [value, known] : words) {
    if (known == word) return value;
  }
  throw std::invalid_argument("no such word: '" + word + "'");
}

Json make_loop_test_json(const LoopTest& test) {
  return {{"id", test.id},
          {"test", test.test},
          {"hours", test.hours},
          {"expected_bits_per_hour", test.expected_bits_per_hour},
          {"naming_chance", test.naming_chance},
          {"splits", test.splits},
          {"runs", test.runs},
          {"state", loop_word_of(kTestStates, test.state)}};
}

LoopTest read_loop_test(const Json& json) {
  return {json.at("id"),
          json.at("test"),
          json.at("hours"),
          json.at("expected_bits_per_hour"),
          json.at("naming_chance"),
          json.at("splits"),
          json.at("runs"),
          value_of(kTestStates, json.at("state").get<std::string>())};
}

Json make_answer_json(const LoopAnswer& answer) {
  return {
      {"tests", answer.tests},
      {"hours", answer.hours},
      {"verdict", name_of(answer.verdict)},
      {"effects", answer.effects},
      {"indistinguishable_from", answer.indistinguishable_from},
      {"probability", answer.probability},
      {"none", answer.none},
      {"unknown", answer.unknown},
      {"alone", answer.alone.has_value() ? Json(*answer.alone) : Json(nullptr)},
      {"nothing_detectable", answer.nothing_detectable.has_value() ? Json(*answer.nothing_detectable) : Json(nullptr)},
      {"is_trace", answer.is_trace}};
}

LoopAnswer read_answer(const Json& json) {
  LoopAnswer answer{json.at("tests"),
                    json.at("hours"),
                    read_verdict(json.at("verdict").get<std::string>()),
                    json.at("effects"),
                    json.at("indistinguishable_from"),
                    json.at("probability"),
                    json.at("none"),
                    json.at("unknown")};
  const Json alone = json.value("alone", Json(nullptr));  // earlier ledgers have none of these
  if (alone.is_number()) answer.alone = alone.get<double>();
  const Json hidden = json.value("nothing_detectable", Json(nullptr));
  if (hidden.is_number()) answer.nothing_detectable = hidden.get<double>();
  answer.is_trace = json.value("is_trace", false);
  return answer;
}

std::string describe_cause(const LoopAnswer& answer) {
  if (answer.effects.empty() || (answer.verdict == Verdict::kNoGap && !answer.is_trace)) return "-";
  std::string text = fmt::format("{}{}", answer.is_trace ? "a trace of " : "", fmt::join(answer.effects, " with "));
  for (const std::string& other : answer.indistinguishable_from) text += " or " + other;
  return text;
}

double probability_of_verdict(const LoopAnswer& answer) {
  return answer.verdict == Verdict::kNoGap ? answer.nothing_detectable.value_or(answer.none) : answer.probability;
}

/// The test before an answer; of the first answer, the set.
std::string describe_test(const LoopLedger& ledger, const LoopAnswer& answer) {
  if (answer.tests == 0) return "the set";
  const LoopTest& test = ledger.tests[answer.tests - 1];
  return fmt::format("test-{}: {}{}", answer.tests, test.id, test.state == LoopTestState::kFailed ? ", failed" : "");
}

}  // namespace

double calc_hours_used(const LoopLedger& ledger) {
  double hours = 0.0;
  for (const LoopTest& test : ledger.tests) hours += test.state == LoopTestState::kPlanned ? 0.0 : test.hours;
  return hours;
}

Json make_ledger_json(const LoopLedger& ledger) {
  return {{"format", kFormat},
          {"set", ledger.set},
          {"set_sha256", ledger.set_sha256},
          {"hours", ledger.hours},
          {"hours_used", calc_hours_used(ledger)},
          {"only", ledger.only},
          {"without", ledger.without},
          {"state", loop_word_of(kStates, ledger.state)},
          {"tests", make_list(ledger.tests, make_loop_test_json)},
          {"answers", make_list(ledger.answers, make_answer_json)}};
}

LoopLedger read_ledger(const std::string& file) {
  const auto problem = [&](const std::string& what) {
    return InputError({fmt::format("not the ledger of a loop: {}", what), file, 0, "", "", kFormat, ""});
  };
  try {
    const Json json = read_json(file);
    if (json.at("format") != kFormat) throw problem(fmt::format("format is {}", json.at("format").dump()));
    LoopLedger ledger;
    ledger.set = json.at("set");
    ledger.set_sha256 = json.at("set_sha256");
    ledger.hours = json.at("hours");
    ledger.only = json.at("only").get<std::vector<std::string>>();
    ledger.without = json.at("without").get<std::vector<std::string>>();
    ledger.state = value_of(kStates, json.at("state").get<std::string>());
    for (const Json& test : json.at("tests")) ledger.tests.push_back(read_loop_test(test));
    for (const Json& answer : json.at("answers")) ledger.answers.push_back(read_answer(answer));
    return ledger;
  } catch (const Json::exception& error) {
    throw problem(error.what());
  } catch (const std::invalid_argument& error) {
    throw problem(error.what());
  }
}

std::string format_ledger(const LoopLedger& ledger) {
  Table table{fmt::format("Loop: {:.1f} of {:g} h used", calc_hours_used(ledger), ledger.hours),
              {"after", "hours", "verdict", "probability", "cause"},
              {}};
  for (const LoopAnswer& answer : ledger.answers) {
    table.rows.push_back({describe_test(ledger, answer), fmt::format("{:.1f}", answer.hours), name_of(answer.verdict),
                          show_probability(probability_of_verdict(answer)), describe_cause(answer)});
  }
  return format_table(table);
}

}  // namespace rollrig::diagnosis
