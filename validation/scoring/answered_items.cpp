#include "validation/scoring/answered_items.h"

#include <vector>

#include "sim/core/error.h"
#include "sim/core/interrupt.h"
#include "validation/scoring/answer.h"

namespace rollrig::validation {
namespace {

std::string failure_of(const Json& answer) {
  const auto failure = answer.find("failure");
  return failure != answer.end() && failure->is_string() ? failure->get<std::string>() : "";
}

}  // namespace

AnswerTally carry_out_answers(const AnsweredItems& items, const std::string& folder, int threads,
                              const std::function<void(std::size_t done, std::size_t of)>& progress) {
  AnswerTally tally;
  const auto note = [&](std::size_t item, const Json& answer, std::size_t& count) {
    ++count;
    const std::string failure = failure_of(answer);
    if (!failure.empty()) tally.failures[items.number_of(item)] = failure;
    if (progress) progress(tally.kept + tally.made, items.count());
  };
  try {
    std::vector<std::size_t> open;
    for (std::size_t item = 0; item < items.count(); ++item) {
      if (const auto before = items.find_before(item)) {
        note(item, *before, tally.kept);
      } else {
        open.push_back(item);
      }
      throw_if_interrupted();
    }
    const campaigns::CampaignFolder nowhere{"", "", 0};  // each answer is a file of its own
    const auto visit = [&](const campaigns::Record& record) {
      const Json answer = Json::parse(record.result);
      write_answer_json(folder, items.number_of(record.item), answer);
      note(record.item, answer, tally.made);
    };
    campaigns::carry_out_each(items, nowhere, open, threads, visit);
  } catch (const Interrupted&) {
    tally.interrupted = true;
  }
  return tally;
}

}  // namespace rollrig::validation
