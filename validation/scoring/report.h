#pragma once
/// A score as text for a terminal, as Markdown, as JSON.

#include <string>

#include "sim/core/json.h"
#include "validation/scoring/score.h"

namespace rollrig::proof {

/// At most 80 columns.
std::string format_score(const Score& score);
std::string format_score_markdown(const Score& score);
/// rollrig-blind-score/1.
Json make_score_json(const Score& score);

/// Value of a figure in its unit, "-" where there is none.
std::string format_value(const Figure& figure, const std::optional<double>& value);
/// Value of a baseline's figure.
std::optional<double> find_value(const BaselineScore& baseline, const Figure& figure);
/// What a case's data and answer are, in one sentence each.
std::string describe_truth(const Case& one);
std::string describe_answer(const Case& one);
/// A set whose causes could not be told apart, its next test, and what came of it.
std::string describe_follow_up(const Case& one, const FollowUp& test);
/// All of these: for a terminal, as Markdown, as JSON.
std::string format_follow_ups(const Score& score);
std::string write_follow_ups(const Score& score);
Json make_follow_ups_json(const Score& score);

}  // namespace rollrig::proof
