#include <fmt/format.h>

#include <array>
#include <utility>

#include "validation/scoring/report.h"

namespace rollrig::validation {
namespace {

const std::array kTests{std::pair(&Case::next_test, "Next test"), std::pair(&Case::drawn_test, "Drawn test")};

/// What became of a named set, in a few words.
std::string judge_follow_up(const Case& one, const FollowUp& test) {
  if (!test.answer.has_value()) return "not made, " + test.plan.not_made;
  if (one.is_split_by(test)) return "split";
  const Case after = one.answered_after(test);
  if (!after.is(diagnosis::Verdict::kExplained)) return after.said();
  if (!one.truth.is_within(after.named_set())) {
    return one.truth.is_within(test.plan.named) ? "the truth lost" : "the truth in neither";
  }
  return after.named_set().size() < test.plan.named.size() ? "more than three left" : "not smaller";
}

struct Counts {
  std::size_t open = 0, done = 0, split = 0;
};

Counts count(const Score& score, std::optional<FollowUp> Case::*test) {
  Counts counts;
  for (const Case& one : score.followed_up) {
    const std::optional<FollowUp>& of = one.*test;
    counts.open += of.has_value() ? 1 : 0;
    counts.done += of.has_value() && of->answer.has_value() ? 1 : 0;
    counts.split += of.has_value() && one.is_split_by(*of) ? 1 : 0;
  }
  return counts;
}

std::string summarize(const Score& score, std::optional<FollowUp> Case::*test, const char* what) {
  const Counts counts = count(score, test);
  if (counts.open == 0) return "";
  return fmt::format("{}: {} cases whose cause could not be told from others, {} followed up, {} split", what,
                     counts.open, counts.done, counts.split);
}

Json make_follow_up(const Case& one, const std::optional<FollowUp>& test) {
  if (!test.has_value()) return nullptr;
  const Case after = one.answered_after(*test);
  const bool is_done = test->answer.has_value();
  return {{"test", test->plan.test},
          {"not_made", test->plan.not_made.empty() ? Json(nullptr) : Json(test->plan.not_made)},
          {"said", is_done ? Json(after.said()) : Json(nullptr)},
          {"named", is_done ? Json(after.named_set()) : Json(nullptr)},
          {"outcome", judge_follow_up(one, *test)},
          {"split", one.is_split_by(*test)}};
}

}  // namespace

std::vector<Table> make_follow_up_tables(const Score& score) {
  std::vector<Table> tables;
  for (const auto& [test, what] : kTests) {
    Table table{summarize(score, test, what), {"case", "true", "named before", "test", "named after", ""}, {}};
    for (const Case& one : score.followed_up) {
      const std::optional<FollowUp>& of = one.*test;
      if (!of.has_value()) continue;
      table.rows.push_back({one.truth.number + " " + one.truth.campaign, one.truth.name(),
                            fmt::format("{}", fmt::join(of->plan.named, ", ")), of->plan.test,
                            fmt::format("{}", fmt::join(one.answered_after(*of).named_set(), ", ")),
                            judge_follow_up(one, *of)});
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

Json make_follow_ups_json(const Score& score) {
  Json all = Json::array();
  for (const Case& one : score.followed_up) {
    all.push_back({{"set", one.truth.number},
                   {"campaign", one.truth.campaign},
                   {"effects", one.truth.ids()},
                   {"named", one.named_set()},
                   {"next_test", make_follow_up(one, one.next_test)},
                   {"drawn_test", make_follow_up(one, one.drawn_test)}});
  }
  return all;
}

}  // namespace rollrig::validation
